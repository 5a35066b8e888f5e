# SPDX-License-Identifier: BSD-3-Clause
"""Makes the search of the site find names by each of their words: search_words.py HTML changes a folder that Doxygen made.

Doxygen's search finds a name by its beginning only. The names of C functions all begin with "cairn_", so "pose" would
not find cairn_filter_pose, and "noise" would not find "Choosing the noise". Here each entry is repeated for each later
word of its name. The search itself stays that of Doxygen.
"""
import collections
import os
import re
import sys

ENTRY = re.compile(r"^  \['(?P<key>.*?)_\d+',(?P<rest>\['(?P<name>.*?)',\[.*\]\])\],?$")
FILLERS = {"a", "and", "are", "for", "from", "in", "is", "of", "or", "the", "to"}


def read(path):
    with open(path, encoding="utf-8") as file:
        return file.read()


def write(path, text):
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def encoded(text):
    """As Doxygen writes the key of an entry: what is neither a letter nor a digit becomes its code."""
    return "".join(c if c.isascii() and c.isalnum() else "".join(f"_{byte:02x}" for byte in c.encode())
                   for c in text.lower())


def keys(name):
    """The ends of a name, from each of its words on."""
    for start in [0] + [match.end() for match in re.finditer(r"[ _/(:]+", name)]:
        end = name[start:]
        if end and end[0].isascii() and end[0].isalnum() and (start == 0 or re.split(r"\W", end)[0] not in FILLERS):
            yield end


def entries(text):
    """The entries of one script of the index: (name, the text that follows the key)."""
    body = text.split("[\n", 1)[1].rsplit("\n];", 1)[0]
    for line in filter(None, body.split("\n")):
        match = ENTRY.match(line)
        if not match:
            sys.exit(f"this entry of the search index was not understood: {line}")
        yield match["name"], match["rest"]


def rewrite(folder, section, letters):
    """Rewrites the index of a section, whose scripts are numbered by the first letters. Returns the new letters."""
    by_letter = collections.defaultdict(set)
    page = read(os.path.join(folder, f"{section}_0.html"))
    for number in range(len(letters)):
        for name, rest in entries(read(os.path.join(folder, f"{section}_{number:x}.js"))):
            for key in keys(name):
                by_letter[key[0].lower()].add((encoded(key), rest))
    for number, letter in enumerate(sorted(by_letter)):
        lines = [f"  ['{key}_{count}',{rest}]" for count, (key, rest) in enumerate(sorted(by_letter[letter]))]
        write(os.path.join(folder, f"{section}_{number:x}.js"), "var searchData=\n[\n" + ",\n".join(lines) + "\n];\n")
        write(os.path.join(folder, f"{section}_{number:x}.html"), page.replace(f"{section}_0.js", f"{section}_{number:x}.js"))
    return "".join(sorted(by_letter))


def main():
    folder = os.path.join(sys.argv[1], "search")
    path = os.path.join(folder, "searchdata.js")
    data = read(path)
    content, names = data.split("var indexSectionNames")
    for number, section in re.findall(r'(\d+): "(\w+)"', names.split("var indexSectionLabels")[0]):
        old = re.search(rf'  {number}: "(.*)"', content)
        content = content.replace(old[0], f'  {number}: "{rewrite(folder, section, old[1])}"')
    write(path, content + "var indexSectionNames" + names)


if __name__ == "__main__":
    main()
