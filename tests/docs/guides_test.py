# SPDX-License-Identifier: BSD-3-Clause
"""The guides in docs/ work: their programs compile and print what the pages say, and every page is in one list.

CAIRN_BUILD is the build tree, which is installed into a temporary folder; CC the compiler; CMAKE the program cmake.
"""
import glob
import os
import re
import shlex
import subprocess
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
LISTS = ("start", "guides", "theory", "measurements", "development")
STRICT = ["-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror"]


def read(page):
    with open(os.path.join(ROOT, "docs", page + ".md"), encoding="utf-8") as file:
        return file.read()


def blocks(page, kind):
    """All code blocks of a kind in a page, one after the other."""
    return "".join(re.findall(rf"^```{kind}\n(.*?)^```$", read(page), re.MULTILINE | re.DOTALL))


class ProgramsTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        room = tempfile.TemporaryDirectory(prefix="cairn guides.")
        cls.addClassCleanup(room.cleanup)
        cls.room, prefix = room.name, os.path.join(room.name, "a prefix")
        for component in ("runtime", "development"):
            subprocess.run([os.environ["CMAKE"], "--install", os.environ["CAIRN_BUILD"], "--prefix", prefix, "--component",
                            component], check=True, stdout=subprocess.DEVNULL)
        (description,) = glob.glob(os.path.join(glob.escape(prefix), "**", "cairn.pc"), recursive=True)
        pkgconfig = os.path.dirname(description)
        cls.environment = dict(os.environ, PKG_CONFIG_PATH=pkgconfig, LD_LIBRARY_PATH=os.path.dirname(pkgconfig))

    def run_in_room(self, command):
        told = subprocess.run(command, cwd=self.room, env=self.environment, text=True, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT)
        self.assertEqual(told.returncode, 0, told.stdout)
        return told.stdout

    def write(self, name, text):
        with open(os.path.join(self.room, name), "w", encoding="utf-8") as file:
            file.write(text)

    def flags(self):
        return shlex.split(self.run_in_room(["pkg-config", "--cflags", "--libs", "cairn"]))

    def test_first_filter(self):
        """By the commands of the page. A prefix with a space needs eval, so the flags come through a wrapper."""
        self.write("first_filter.c", blocks("first_filter", "c"))
        compiler, quoted = os.environ["CC"], "$(pkg-config --cflags --libs cairn)"
        commands = blocks("first_filter", "sh")
        self.assertIn(quoted, commands)
        commands = commands.replace(quoted, shlex.join(self.flags())).replace("cc ", shlex.quote(compiler) + " ", 1)
        self.assertEqual(self.run_in_room(["sh", "-euc", commands]), blocks("first_filter", "text"))
        self.run_in_room([compiler, *STRICT, "-fsyntax-only", "first_filter.c", *self.flags()])

    def test_noise(self):
        """The program of "Choosing the noise" stands below the function of "Reading the verdict"."""
        self.write("noise.c", blocks("verdict", "c") + blocks("choosing_noise", "c"))
        self.run_in_room([os.environ["CC"], *STRICT, "noise.c", *self.flags(), "-lm", "-o", "noise"])
        self.assertEqual(self.run_in_room(["./noise"]), blocks("choosing_noise", "text"))


class ListsTest(unittest.TestCase):
    def test_every_page_is_in_one_list(self):
        listed = [page for name in LISTS for page in re.findall(r"^- \[[^]]*\]\((\w+)\.md\)", read(name), re.MULTILINE)]
        pages = {os.path.basename(path)[:-len(".md")] for path in glob.glob(os.path.join(ROOT, "docs", "*.md"))}
        self.assertEqual(sorted(listed), sorted(pages - {"start"}))

    def test_every_header_is_on_the_start_page(self):
        headers = {os.path.basename(path) for path in glob.glob(os.path.join(ROOT, "include", "cairn", "*.h"))}
        named = set(re.findall(r"`cairn/(\w+\.h)`", read("start")))
        self.assertEqual(named, headers - {"cairn.h", "describe.h", "export.h"})


if __name__ == "__main__":
    unittest.main()
