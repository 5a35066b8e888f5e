# SPDX-License-Identifier: BSD-3-Clause
"""Links of the documentation site lead somewhere: links_test.py HTML checks a folder that Doxygen made.

Checked are the links, pictures, styles and scripts of all pages, and the addresses in the scripts of navigation and
search: the file exists inside the folder, and so does the place in it. No command of Doxygen may stand in the text: it
does when Doxygen lost its way in a page. Links to other sites are not opened; --external prints them. Without a folder
the tests of this file run.
"""
import argparse
import collections
import html.parser
import json
import os
import re
import sys
import tempfile
import unittest
import urllib.parse

ADDRESS = {"a": "href", "area": "href", "link": "href", "img": "src", "script": "src", "iframe": "src",
           "object": "data"}
COMMAND = re.compile(r"(?:^|\s)[@\\](?:ref|subpage|section|subsection|page)\s")
IN_SCRIPT = re.compile(r"""["']((?:\.\./)?[\w.-]+\.html(?:#[^"'\\]*)?)["']""")


class Page(html.parser.HTMLParser):
    """The places of a page, what it refers to and the commands in its text: (line, address or command)."""

    def __init__(self, text):
        super().__init__()
        self.places, self.addresses, self.commands = set(), [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.places.update(value for key in ("id", "name") if (value := values.get(key)))
        address = values.get(ADDRESS.get(tag))
        if address is not None and not address.startswith("javascript:"):
            self.addresses.append((self.getpos()[0], address))

    def handle_data(self, data):
        self.commands += [(self.getpos()[0], command.strip()) for command in COMMAND.findall(data)]


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


class Site:
    def __init__(self, root):
        self.root = os.path.abspath(root)
        self.external = collections.defaultdict(set)
        self.links = 0
        self._pages = {}

    def page(self, path):
        if path not in self._pages:
            self._pages[path] = Page(read(path))
        return self._pages[path]

    def files(self, *endings):
        for folder, _, names in sorted(os.walk(self.root)):
            yield from (os.path.join(folder, name) for name in sorted(names) if name.endswith(endings))

    def wrong(self, source, folder, address):
        """Says what is wrong with an address that is relative to a folder; None: nothing."""
        parts = urllib.parse.urlsplit(address)
        if parts.scheme or parts.netloc:
            self.external[address].add(os.path.relpath(source, self.root))
            return "it names a file of the machine that made the page" if parts.scheme == "file" else None
        self.links += 1
        path = urllib.parse.unquote(parts.path)
        target = os.path.normpath(os.path.join(folder, path)) if path else source
        if not (target + os.sep).startswith(self.root + os.sep):
            return "it leads out of the site"
        if not os.path.isfile(target):
            return "there is no such file"
        place = urllib.parse.unquote(parts.fragment)
        if place and target.endswith(".html") and place not in self.page(target).places:
            return "the page has no such place"
        return None

    def problems(self):
        for path in self.files(".html"):
            for line, address in self.page(path).addresses:
                if cause := self.wrong(path, os.path.dirname(path), address):
                    yield f"{os.path.relpath(path, self.root)}:{line}: {address}: {cause}"
            for line, command in self.page(path).commands:
                yield f"{os.path.relpath(path, self.root)}:{line}: {command}: a command of Doxygen in the text"
        for path in self.files(".js"):  # the tree and the search
            for address in sorted(set(IN_SCRIPT.findall(read(path)))):
                # Every script stands beside the page that loads it; those of the tree name pages of the root.
                if cause := self.wrong(path, os.path.dirname(path), address):
                    yield f"{os.path.relpath(path, self.root)}: {address}: {cause}"


class LinksTest(unittest.TestCase):
    def problems(self, files):
        with tempfile.TemporaryDirectory() as root:
            for name, text in files.items():
                os.makedirs(os.path.dirname(os.path.join(root, name)), exist_ok=True)
                with open(os.path.join(root, name), "w", encoding="utf-8") as file:
                    file.write(text)
            return [problem.rsplit(": ", 1)[1] for problem in Site(root).problems()]

    def test_right_links(self):
        self.assertEqual(self.problems({
            "index.html": '<a href="a%20page.html#here">x</a><a href="#top"></a><a id="top"></a><img src="a.png">'
                          '<a href="https://example.org/nothing">x</a><a href="javascript:void(0)">x</a>',
            "a page.html": '<a name="here"></a>', "a.png": "", "tree.js": 'var t = [["A", "index.html#top", null]];',
            "search/all.js": "['x',['../index.html#top',1,'']]"}), [])

    def test_wrong_links(self):
        for text, cause in (('<a href="nothing.html">', "there is no such file"),
                            ('<img src="nothing.png">', "there is no such file"),
                            ('<a href="#nowhere">', "the page has no such place"),
                            ('<a href="index.html#nowhere">', "the page has no such place"),
                            ('<a href="../README.md">', "it leads out of the site"),
                            ('<a href="/etc/passwd">', "it leads out of the site"),
                            ('<a href="file:///etc/passwd">', "it names a file of the machine that made the page")):
            self.assertEqual(self.problems({"index.html": text}), [cause], text)

    def test_commands_in_the_text(self):
        self.assertEqual(self.problems({"index.html": "<p>see\n@ref somewhere and more</p>"}),
                         ["a command of Doxygen in the text"])

    def test_wrong_addresses_in_scripts(self):
        self.assertEqual(self.problems({"tree.js": '["A", "nothing.html", null]'}), ["there is no such file"])
        self.assertEqual(self.problems({"search/all.js": "['../index.html#nowhere',1]", "index.html": ""}),
                         ["the page has no such place"])


def main():
    parser = argparse.ArgumentParser(description="Checks the links of a site.")
    parser.add_argument("html", help="the folder of the site")
    parser.add_argument("--external", action="store_true", help="print the links to other sites, as JSON")
    arguments = parser.parse_args()
    site = Site(arguments.html)
    found = list(site.problems())
    if not os.path.isfile(os.path.join(site.root, "index.html")):
        found.append(f"{arguments.html}: there is no index.html")
    for problem in found:
        print(problem)
    if arguments.external:
        print(json.dumps({address: sorted(pages) for address, pages in sorted(site.external.items())}, indent=1))
    print(f"{site.links} links inside the site, {len(found)} broken; {len(site.external)} links to other sites")
    return 1 if found else 0


if __name__ == "__main__":
    if len(sys.argv) > 1:
        sys.exit(main())
    unittest.main()
