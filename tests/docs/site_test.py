# SPDX-License-Identifier: BSD-3-Clause
"""What docs/site does to the pages and to the search of the documentation site."""
import os
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
SITE = os.path.join(ROOT, "docs", "site")
sys.path.insert(0, SITE)

import search_words  # noqa: E402


def filtered(name, text):
    """A page as Doxygen gets it."""
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, name + ".md")
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return subprocess.run(["awk", "-v", "headers=" + os.path.join(ROOT, "include", "cairn"), "-f",
                               os.path.join(SITE, "page_filter.awk"), path], check=True, stdout=subprocess.PIPE,
                              text=True).stdout


class PageFilterTest(unittest.TestCase):
    def check(self, text, expected, name="a_page"):
        self.assertEqual(filtered(name, text + "\n"), expected + "\n")

    def test_links_become_references(self):
        self.check("see [one](one.md), [two](two.md#a-place) and [here](#a-place)",
                   "see [one](@ref one), [two](@ref two_a-place) and [here](@ref a_page_a-place)")

    def test_a_link_in_two_lines(self):
        self.check("see [the\n  page](one.md)\nmore", "see [the page](@ref one)\nmore")

    def test_headings_get_labels(self):
        self.check("# Top {#top}\n## A place: `x`", "# Top {#top}\n## A place: `x` {#a_page_a-place-x}")

    def test_files_become_names(self):
        self.check("[a rover](../examples/rover.c)", "a rover (`examples/rover.c`)")

    def test_functions_become_links(self):
        self.check("`cairn_filter_update` and `cairn_filter_options`",
                   "<code>@ref cairn_filter_update</code> and `cairn_filter_options`")

    def test_code_stays(self):
        code = "```c\n/* [x](one.md) */\n## `cairn_filter_update`\n```"
        self.check(code, code)

    def test_lists_make_the_tree(self):
        self.check("## Part\n\n- [One](one.md): about [two](two.md)",
                   '<h2>Part</h2>\n\n- @subpage one "One": about [two](@ref two)', "guides")
        self.check("- [One](one.md): text", "- [One](@ref one): text")


class SearchTest(unittest.TestCase):
    def test_keys(self):
        self.assertEqual(list(search_words.keys("cairn_filter_pose")), ["cairn_filter_pose", "filter_pose", "pose"])
        self.assertEqual(list(search_words.keys("Choosing the noise")), ["Choosing the noise", "noise"])

    def test_a_section(self):
        with tempfile.TemporaryDirectory() as folder:
            target = "['../x.html#a',1,'']"
            search_words.write(os.path.join(folder, "all_0.js"), "var searchData=\n[\n"
                               f"  ['cairn_5fpose_0',['cairn_pose',{target}]],\n  ['cut_1',['cut',{target}]]\n];\n")
            search_words.write(os.path.join(folder, "all_0.html"), '<script src="all_0.js"></script>')
            self.assertEqual(search_words.rewrite(folder, "all", "c"), "cp")
            self.assertEqual(search_words.read(os.path.join(folder, "all_1.js")),
                             f"var searchData=\n[\n  ['pose_0',['cairn_pose',{target}]]\n];\n")
            self.assertEqual(search_words.read(os.path.join(folder, "all_1.html")), '<script src="all_1.js"></script>')
            self.assertEqual(len(list(search_words.entries(search_words.read(os.path.join(folder, "all_0.js"))))), 2)

    def test_an_unknown_form_is_an_error(self):
        with self.assertRaises(SystemExit):
            list(search_words.entries("var searchData=\n[\n  [\"other\"]\n];\n"))


if __name__ == "__main__":
    unittest.main()
