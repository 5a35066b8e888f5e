# SPDX-License-Identifier: BSD-3-Clause
"""The Python interface follows the C headers: every symbol, constant and struct of the headers is reachable."""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import support
import cairn
from cairn import _declarations


def symbols(folder):
    with open(os.path.join(support.ROOT, "src", folder, "symbols.txt")) as file:
        return [line.split("@")[0].strip() for line in file if line.strip() and not line.startswith("#")]


class DeclarationsTest(unittest.TestCase):
    def test_every_exported_symbol_is_reachable(self):
        names = symbols("cairn/capi")
        self.assertGreater(len(names), 50)
        for name in names:
            self.assertTrue(callable(getattr(cairn.lib, name)), name)

    def test_every_exported_symbol_of_the_simulation_is_reachable(self):
        names = symbols("sim")
        self.assertGreater(len(names), 10)
        for name in names:
            self.assertTrue(callable(getattr(cairn.lib, name)), name)

    def test_every_constant_of_the_headers_is_there(self):
        include, count = _declarations.find_include_dir(), 0
        for header in os.listdir(os.path.join(include, "cairn")):
            with open(os.path.join(include, "cairn", header)) as file:
                text = re.sub(r"/\*.*?\*/", "", file.read(), flags=re.DOTALL)
            for name, value in re.findall(r"^\s*(CAIRN_\w+) = (-?\d+)", text, re.MULTILINE):
                self.assertEqual(getattr(cairn.lib, name), int(value), name)
                count += 1
        self.assertGreater(count, 30)
        self.assertEqual(cairn.ID_NONE, 2**64 - 1)
        self.assertEqual(cairn.ERROR_ARGUMENT, -1)
        with self.assertRaises(AttributeError):
            cairn.NO_SUCH_CONSTANT

    def test_a_new_function_takes_no_edit(self):
        with tempfile.TemporaryDirectory() as folder:
            include = os.path.join(folder, "a place")
            shutil.copytree(_declarations.find_include_dir(), include)
            with open(os.path.join(include, "cairn", "later.h"), "w") as file:
                file.write("#ifndef LATER\n#define LATER\n#include <cairn/pose.h>\n#define CAIRN_LATER (12u)\n"
                           "/** New. */\nCAIRN_API cairn_status cairn_later(const cairn_pose *pose, double out[6]);\n#endif\n")
            ffi = _declarations.make_ffi(include)
            opened = ffi.dlopen(None)
            self.assertIn("cairn_later", dir(opened))
            self.assertEqual(opened.CAIRN_LATER, 12)

    @staticmethod
    def has_size(name):  # a handle has none; cffi 2 aborts where it is asked for the fields of one
        try:
            return cairn.ffi.sizeof(name) > 0
        except (ValueError, getattr(cairn.ffi, "error", ValueError)):
            return False

    def test_struct_sizes_are_the_compilers(self):
        structs = sorted(name for name in cairn.ffi.list_types()[0] if cairn.ffi.typeof(name).kind == "struct"
                         and self.has_size(name))
        self.assertLessEqual({"cairn_filter_options", "cairn_team_options", "cairn_team_report", "cairn_range_bearing",
                              "cairn_fleet_options"}, set(structs))
        with tempfile.TemporaryDirectory() as folder:
            source, program = os.path.join(folder, "sizes.c"), os.path.join(folder, "sizes")
            with open(source, "w") as file:
                file.write("#include <stdio.h>\n#include <cairn/cairn.h>\n#include <cairn/fleet.h>\n"
                           "#include <cairn/sim.h>\nint main(void) {\n")
                for name in structs:
                    file.write(f'  printf("{name} %zu\\n", sizeof({name}));\n')
                file.write("  return 0;\n}\n")
            subprocess.run([support.compiler(), "-I", _declarations.find_include_dir(), source, "-o", program], check=True)
            told = subprocess.run([program], stdout=subprocess.PIPE, text=True, check=True).stdout.split()
        self.assertEqual(dict(zip(told[::2], map(int, told[1::2]))), {name: cairn.ffi.sizeof(name) for name in structs})

    def test_unknown_names_and_missing_places(self):
        with self.assertRaisesRegex(AttributeError, "no function cairn_fly"):
            cairn.lib.cairn_fly
        self.assertFalse(hasattr(cairn, "fly"))
        for variable, told in (("CAIRN_INCLUDE_DIR", "no cairn/cairn.h in"), ("CC", "preprocessor can't be run"),
                               ("CAIRN_LIBRARY", "can't be loaded")):
            environment = dict(os.environ, **{variable: "/nowhere/at all" if variable != "CC" else "/nowhere/cc"})
            script = ("from cairn import _declarations as d; d.declarations(d.find_include_dir())"
                      if variable != "CAIRN_LIBRARY" else "import cairn; cairn.lib")
            done = subprocess.run([sys.executable, "-B", "-c", script], env=environment, stderr=subprocess.PIPE, text=True)
            self.assertNotEqual(done.returncode, 0, variable)
            self.assertIn(told, done.stderr, variable)

    def test_version(self):
        self.assertEqual(cairn.version(), cairn.__version__)
        self.assertEqual(cairn.version(), "{}.{}.{}".format(cairn.VERSION_MAJOR, cairn.VERSION_MINOR, cairn.VERSION_PATCH))


if __name__ == "__main__":
    unittest.main()
