# SPDX-License-Identifier: BSD-3-Clause
"""The Python package follows api.json, the description of the C interface: functions, constants and structs."""
import enum
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import support
import cairn
import numpy as np
from cairn import constants, layouts, structs

BINDING = os.path.join(support.ROOT, "bindings", "python")
API_JSON = os.path.join(support.ROOT, "src", "api", "api.json")
ONLY_IN_C = {"cairn_last_message", "cairn_sim_last_message"}  # errors are exceptions

with open(API_JSON, encoding="utf-8") as file:
    API = json.load(file)


def sources():
    """The text of the package's modules that are written by hand."""
    folder = pathlib.Path(cairn.__file__).parent
    return {path.name: path.read_text(encoding="utf-8") for path in folder.glob("*.py") if path.name != "_declarations.py"}


class DeclarationsTest(unittest.TestCase):
    @unittest.skipUnless(os.path.isdir(BINDING), "the source tree has no bindings")
    def test_generated_files_are_those_of_the_description(self):
        done = subprocess.run([sys.executable, "-B", os.path.join(BINDING, "generate.py"), "--check"],
                              stderr=subprocess.PIPE, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        with tempfile.TemporaryDirectory() as folder:  # a description that differs is noticed
            changed = os.path.join(folder, "api.json")
            with open(API_JSON, encoding="utf-8") as file, open(changed, "w", encoding="utf-8") as copy:
                copy.write(file.read().replace('"max_landmarks"', '"most_landmarks"'))
            done = subprocess.run([sys.executable, "-B", os.path.join(BINDING, "generate.py"), changed, "--check"],
                                  stderr=subprocess.PIPE, text=True)
        self.assertIn("cairn/_declarations.py, cairn/structs.py", done.stderr)

    def test_every_function_is_there_and_used(self):
        used = set(re.findall(r"lib\.(cairn_\w+)", "\n".join(sources().values())))
        used |= {f"{struct['name']}_init" for struct in API["structs"] if struct["init"]}  # defaults(), and every option
        used |= {f"cairn_{kind}_{verb}" for kind in ("world", "fleet") for verb in ("next", "rewind", "steps")}
        names = [function["name"] for function in API["functions"]]
        self.assertGreater(len(names), 100)
        for name in names:
            self.assertTrue(callable(getattr(cairn.lib, name)), name)
        self.assertEqual(set(names) - used, ONLY_IN_C)
        self.assertEqual(used - set(names), set())
        self.assertEqual(set(dir(cairn.lib)), set(names))

    def test_every_constant_is_there(self):
        count = 0
        for described in API["enums"]:
            members = getattr(cairn, "".join(part.capitalize() for part in described["name"].split("_")[1:]))
            self.assertEqual([member.value for member in members], [value["value"] for value in described["values"]])
            for member, value in zip(members, described["values"]):
                self.assertTrue(value["name"].endswith("_" + member.name), (value["name"], member))
                count += 1
        self.assertGreater(count, 100)
        self.assertEqual(cairn.ID_NONE, 2**64 - 1)
        self.assertEqual(cairn.id_none(), cairn.ID_NONE)
        self.assertEqual(cairn.Encoder["PER_FRAME"], 1)
        with self.assertRaises(AttributeError):
            cairn.NO_SUCH_CONSTANT

    def test_structs_have_the_described_layout(self):
        for described in API["structs"]:
            name, fields = described["name"], described["fields"]
            kind = cairn.ffi.typeof(name)
            self.assertEqual(cairn.ffi.sizeof(name), described["size"], name)
            self.assertEqual([(field, told.offset) for field, told in kind.fields],
                             [(field["name"], field["offset"]) for field in fields], name)
            if described["role"] == "plain":
                layout = getattr(cairn, name.split("_", 1)[1].upper())
                self.assertIs(layout, layouts.OF_STRUCT[name])
                self.assertEqual(layout.itemsize, described["size"])
                for field in fields:
                    if field["role"] != "reserved":
                        of, offset = layout.fields[field["name"]][:2]
                        self.assertEqual((of.itemsize, offset), (field["size"], field["offset"]), (name, field["name"]))

    def test_every_option_is_a_keyword(self):
        for described in API["structs"]:
            if described["role"] not in ("options", "report") or described["name"].endswith("_step"):
                continue
            typed = getattr(cairn, "".join(part.capitalize() for part in described["name"].split("_")[1:]))
            names = [field["name"] for field in described["fields"] if field["role"] not in ("struct_size", "reserved")]
            self.assertEqual(list(typed.__annotations__), names, described["name"])
            if described["role"] == "options":
                self.assertEqual(list(cairn.defaults(typed)), names, described["name"])
        self.assertEqual(cairn.defaults(cairn.FilterOptions)["join"], cairn.Join.AUTO)
        self.assertIs(cairn.defaults(cairn.TeamOptions)["baseline"], False)
        with self.assertRaisesRegex(TypeError, "must be one of .*FilterOptions"):
            cairn.defaults(cairn.Health)

    def test_nothing_of_the_interface_is_missing(self):
        sys.path.insert(0, os.path.dirname(API_JSON))
        import bindings_check
        names = {function["name"] for function in API["functions"] if hasattr(cairn.lib, function["name"])}
        names |= {name for name in bindings_check.constants(API) if name == "CAIRN_ID_NONE" or
                  name.startswith("CAIRN_VERSION")}  # cairn.ID_NONE, cairn.__version__
        for described in API["enums"]:
            members = getattr(cairn, "".join(part.capitalize() for part in described["name"].split("_")[1:]))
            names |= {value["name"] for member, value in zip(members, described["values"])
                      if value["name"].endswith("_" + member.name)}
        with_lengths = {"cairn_world_step": ["motion_count", "observation_count"], "cairn_fleet_step": ["vehicle_count"]}
        for described in API["structs"]:
            name, camel = described["name"], "".join(part.capitalize() for part in described["name"].split("_")[1:])
            if name == "cairn_pose":
                shown = cairn.Pose._fields
            elif name == "cairn_error":
                shown = cairn.CairnError.__annotations__
            elif described["role"] == "plain":
                shown = layouts.OF_STRUCT[name].names
            else:
                shown = [*getattr(structs, camel).__annotations__, *with_lengths.get(name, [])]  # len(step.motions)
            names |= {f"{name}.{field}" for field in shown if field in {field["name"] for field in described["fields"]}}
        self.assertEqual(bindings_check.missing(API, names), [])
        self.assertEqual(bindings_check.unknown(API, names), [])

    def test_documentation_names_what_exists(self):
        """Generated documentation says Filter.calibrate_sensor where the C documentation names the C function."""
        text = "\n".join(sources()[name] for name in ("constants.py", "structs.py", "layouts.py"))
        names = set(re.findall(r"\b(Filter|Map|Team|World|Fleet)\.([a-z_]+)", text))
        self.assertGreater(len(names), 10)
        for owner, name in sorted(names):
            self.assertTrue(hasattr(getattr(cairn, owner), name), f"{owner}.{name}")
        self.assertNotRegex(text, r"\\ref|\\since|(?<!\")\bcairn_[a-z_]+_init")

    def test_public_names(self):
        for name in dir(cairn):
            self.assertTrue(hasattr(cairn, name), name)
        for module in (constants, structs, layouts):
            self.assertLessEqual(set(module.__all__), set(dir(cairn)))
        kinds = {name for name in dir(constants) if isinstance(getattr(constants, name), enum.EnumMeta)}
        self.assertEqual(kinds, set(constants.__all__) - {"ID_NONE"})
        self.assertIsInstance(cairn.OBSERVATION, np.dtype)


class LoadingTest(unittest.TestCase):
    @staticmethod
    def load(library):
        done = subprocess.run([sys.executable, "-B", "-c", "import cairn; cairn.lib"], stderr=subprocess.PIPE, text=True,
                              env=dict(os.environ, CAIRN_LIBRARY=library))
        return done.returncode, done.stderr.strip().splitlines()[-1] if done.stderr else ""

    def test_unknown_names(self):
        with self.assertRaisesRegex(AttributeError, "no function cairn_fly"):
            cairn.lib.cairn_fly
        self.assertFalse(hasattr(cairn, "fly"))

    def test_a_missing_library(self):
        status, told = self.load("/nowhere/at all")
        self.assertEqual(status, 1)
        self.assertRegex(told, rf"ImportError: this package is cairn {cairn.__version__} and needs libcairn.so.0.2, which "
                               r"can't be loaded \(.*/nowhere.*\): install that version")

    @unittest.skipUnless(support.compiler(), "there is no C compiler")
    def test_another_version_of_the_library(self):
        major, minor, patch = map(int, cairn.__version__.split("."))
        for version, refused in ((f"{major}.{minor - 1}.9", True), (f"{major}.{minor + 1}.0", True),
                                 (f"{major}.{minor}.{patch - 1}", True), (f"{major}.{minor}.{patch + 1}", False)):
            with tempfile.TemporaryDirectory() as folder:
                library = os.path.join(folder, "libcairn.so")
                subprocess.run([support.compiler(), "-shared", "-fPIC", "-x", "c", "-", "-o", library], check=True, text=True,
                               input=f'const char *cairn_version(void) {{ return "{version}"; }}\n')
                status, told = self.load(library)
                self.assertEqual(status, int(refused), told)
                if refused:
                    self.assertEqual(told, f"ImportError: this package is cairn {cairn.__version__}, but the loaded library "
                                           f"is cairn {version}: install the same version of both")

    def test_version(self):
        self.assertEqual(cairn.version(), cairn.__version__)
        self.assertEqual(cairn.version(), API["version"])
        self.assertEqual(cairn.version_number(), API["version_number"])
        self.assertTrue(cairn.has("errors"))
        self.assertFalse(cairn.has("wings"))
        self.assertIn(cairn.build(), ("x86-64", "x86-64-v3", "generic"))


if __name__ == "__main__":
    unittest.main()
