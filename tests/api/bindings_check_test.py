# SPDX-License-Identifier: BSD-3-Clause
"""src/api/bindings_check.py finds what a binding lacks and what it has too much."""
import json
import os
import subprocess
import sys
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SOURCE = os.path.join(ROOT, "src", "api")
sys.path.insert(0, SOURCE)
import bindings_check  # noqa: E402


class BindingsCheckTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        with open(os.path.join(SOURCE, "api.json"), encoding="utf-8") as file:
            cls.api = json.load(file)
        cls.all = bindings_check.required(cls.api)

    def test_names_of_each_sort_are_required(self):
        for name in ("cairn_filter_update", "cairn_wheels.radius", "cairn_error.message", "CAIRN_JOIN_AUTO",
                     "CAIRN_ID_NONE", "cairn_fleet_next", "CAIRN_FLEET_COAST", "cairn_fleet_step.time"):
            self.assertIn(name, self.all)
        self.assertNotIn("cairn_wheels.struct_size", self.all)
        self.assertEqual(len(self.all), len(set(self.all)))

    def test_a_complete_binding_lacks_nothing(self):
        names = self.all + ["cairn_wheels.struct_size"]
        self.assertEqual(bindings_check.missing(self.api, names), [])
        self.assertEqual(bindings_check.unknown(self.api, names), [])

    def test_each_name_that_lacks_is_found(self):
        for name in self.all:
            self.assertEqual(bindings_check.missing(self.api, set(self.all) - {name}), [name])

    def test_a_wrong_name_is_found(self):
        self.assertEqual(bindings_check.unknown(self.api, self.all + ["cairn_filter_" + "fly"]),
                         ["cairn_filter_" + "fly"])

    def test_one_library_alone(self):
        names = bindings_check.required(self.api, ["cairn"])
        self.assertNotIn("cairn_fleet_next", names)
        self.assertEqual(bindings_check.missing(self.api, names, ["cairn"]), [])
        self.assertIn("cairn_fleet_next", bindings_check.missing(self.api, names))

    def test_the_program(self):
        def run(names):
            command = [sys.executable, os.path.join(SOURCE, "bindings_check.py"), os.path.join(SOURCE, "api.json"), "-"]
            return subprocess.run(command, input="\n".join(names), capture_output=True, text=True, check=False)
        self.assertEqual(run(self.all).returncode, 0)
        result = run(self.all[1:] + ["cairn_nothing"])
        self.assertEqual(result.returncode, 1)
        self.assertEqual(result.stdout.splitlines(),
                         [f"the binding lacks {self.all[0]}", "the interface has no cairn_nothing"])


if __name__ == "__main__":
    unittest.main()
