# SPDX-License-Identifier: BSD-3-Clause
"""Names in the documentation exist: paths, functions and constants of the C interface, options of the program, classes.

Searched are README.md and the other READMEs, docs/*.md, docs/cairn.1, the headers, and the comments of src and of the
examples. A name that is wrong on purpose belongs into ALLOWED, with the reason.
"""
import fnmatch
import functools
import glob
import os
import re
import subprocess
import sys
import unittest

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
TOP = r"(?:src|tests|docs|examples|include|bindings)"
CODE_FILE = r"[\w./-]*\w\.(?:hpp|cpp|def|py|sh|md)"  # unlike .h and .c, these are never files of the system

ALLOWED = {
    "--component": "an option of cmake",
    "--toolchain": "an option of cmake",
    "CAIRN_MATCHED": "a name of 0.1, in the changelog",
    "CAIRN_NEW": "a name of 0.1, in the changelog",
    "CAIRN_REJECTED": "a name of 0.1, in the changelog",
    "add_subdirectory": "a command of cmake",
    "find_package": "a command of cmake",
    "print_verdict": "a function of the guides",
    "DataAssociationFcn": "a property of ekfSLAM",
    "InverseMeasurementFcn": "a property of ekfSLAM",
    "MaxNumLandmark": "a property of ekfSLAM",
    "MeasurementFcn": "a property of ekfSLAM",
    "ProcessNoise": "a property of ekfSLAM",
    "StateCovariance": "a property of ekfSLAM",
    "StateTransitionFcn": "a property of ekfSLAM",
    "create_simplemap": "an option of MRPT",
    "data_assoc_method": "an option of MRPT",
    "data_assoc_metric": "an option of MRPT",
    "std_sensor_pitch": "an option of MRPT",
    "std_sensor_range": "an option of MRPT",
    "std_sensor_yaw": "an option of MRPT",
    "Exp": "a symbol of formulas",
    "Log": "a symbol of formulas",
    "Sigma": "a symbol of formulas",
    "Sigma_a": "a symbol of formulas",
    "Sigma_b": "a symbol of formulas",
    "Word": "stands for any word in backticks",
}


# --- the tree ---

def read(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


@functools.lru_cache(None)
def tree():
    """All files of the project, relative to its root, and all folders."""
    files, folders = set(), set()
    for folder, names, leaves in os.walk(ROOT):
        here = os.path.relpath(folder, ROOT)
        names[:] = [n for n in names
                    if n not in (".git", "__pycache__") and not (here == "." and n.startswith("build"))]
        folders.update(os.path.normpath(os.path.join(here, n)) for n in names)
        files.update(os.path.normpath(os.path.join(here, n)) for n in leaves)
    return files, folders


def exists(path):
    files, folders = tree()
    path = os.path.normpath(path)
    if "*" in path:
        return bool(fnmatch.filter(files | folders, path))
    return path in files or path in folders


def exists_anywhere(name):
    files, _ = tree()
    name = name.lstrip("./")
    return name in files or any(f.endswith("/" + name) for f in files)


def is_stem(name):
    """A file of the project by its name without the ending: a program of the benchmarks."""
    return any(os.path.splitext(os.path.basename(f))[0] == name for f in tree()[0])


def files_under(*patterns):
    paths = {os.path.relpath(p, ROOT) for pattern in patterns
             for p in glob.glob(os.path.join(ROOT, pattern), recursive=True)}
    return sorted(p for p in paths if not p.startswith(("build", "tests/docs/")))


# --- pages: (path, line, text) of everything that is to be checked ---

COMMENT = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|\'(?:\\.|[^\'\\\n])*\'', re.DOTALL)


def comments(code):
    """The code with everything but its comments blanked out; lines stay where they are."""
    kept, at = [], 0
    for match in COMMENT.finditer(code):
        kept.append(re.sub(r"[^\n]", " ", code[at:match.start()]))
        text = match.group(0)
        kept.append(text if text.startswith("/") else re.sub(r"[^\n]", " ", text))
        at = match.end()
    kept.append(re.sub(r"[^\n]", " ", code[at:]))
    return "".join(kept)


def without_comments(code):
    return COMMENT.sub(lambda m: " " if m.group(0).startswith("/") else m.group(0), code)


class Page:
    def __init__(self, path, text):
        self.path = path
        self.kind = ("markdown" if path.endswith(".md") else "manual" if path.endswith(".1") else "code")
        self.text = text
        if self.kind == "code":
            self.text = comments(text)
        if self.kind == "manual":
            self.text = re.sub(r"\\f[A-Z]", "", text.replace("\\-", "-").replace("\\&", ""))

    def line(self, position):
        return self.text.count("\n", 0, position) + 1

    def spans(self):
        """Words in backticks, and the lines of code blocks: (position, text, is a line of a code block)."""
        fence = re.compile(r"^ *```.*?^ *```", re.DOTALL | re.MULTILINE)
        for block in fence.finditer(self.text):
            for line in re.finditer(r"[^\n]+", block.group(0)):
                yield block.start() + line.start(), line.group(0), True
        prose = fence.sub(lambda block: re.sub(r"[^\n]", " ", block.group(0)), self.text)
        for match in re.finditer(r"`([^`]+)`", prose):
            yield match.start(1), re.sub(r"\s*\n[\s*/]*", " ", match.group(1)), False


@functools.lru_cache(None)
def pages():
    paths = files_under("README.md", "docs/*.md", "docs/cairn.1", "examples/**/README.md", "include/cairn/*.h",
                        "examples/**/*.[ch]", "src/**/*.[ch]pp", "src/**/*.def")
    return [Page(path, read(path)) for path in paths]


# --- what is known ---

@functools.lru_cache(None)
def public_names():
    code = "\n".join(without_comments(read(p)) for p in files_under("include/cairn/*.h"))
    return set(re.findall(r"\b(?:cairn|CAIRN)_\w+", code))


@functools.lru_cache(None)
def build_names():
    """Targets, variables of the build and of the environment, and the library's own macros and files."""
    paths = files_under("CMakeLists.txt", "CMakePresets.json", "*/**/CMakeLists.txt", "**/*.cmake", "**/*.cmake.in",
                        "**/*.pc.in", "**/*.map", "**/*.sh", "bindings/**/*.py", "tests/**/*.py", "src/**/*.[ch]pp",
                        "src/**/*.def")
    words = set()
    for path in paths:
        text = read(path)
        if path.endswith("pp"):
            text = without_comments(text)
        elif not path.endswith("json"):
            text = re.sub(r"(?m)#.*$", "", text)
        words.update(re.findall(r"\b(?:cairn|CAIRN)_\w+", text))
    return words


@functools.lru_cache(None)
def code_words():
    paths = files_under("src/**/*.[ch]pp", "src/**/*.def", "src/api/*.py", "include/cairn/*.h",
                        "bindings/python/**/*.py", "tests/unit/**/*.[ch]pp")
    words = set()
    for path in paths:
        text = read(path)
        text = re.sub(r"(?m)#.*$", "", text) if path.endswith(".py") else without_comments(text)
        words.update(re.findall(r"[A-Za-z_]\w*", text))
    return words


@functools.lru_cache(None)
def program_options():
    words = set()
    for path in files_under("src/program/**/*.[ch]pp", "src/options/*"):
        words.update(re.findall(r"--[a-z][a-z-]*[a-z]", without_comments(read(path))))
    program = os.environ.get("CAIRN_PROGRAM")
    if program:
        told = subprocess.run([program, "--help"], stdout=subprocess.PIPE, text=True, check=True).stdout
        words.update(re.findall(r"--[a-z][a-z-]*[a-z]", told))
    return words


@functools.lru_cache(None)
def script_options():
    """Options of the report, of the examples' scripts and of the tests' scripts."""
    words = set()
    for path in files_under("bindings/python/**/*.py", "examples/**/*.sh", "tests/**/*.sh", "tests/bench/*.py"):
        words.update(re.findall(r"--[a-z][a-z-]*[a-z]", read(path)))
    return words


# --- the checks: each yields (line, message) ---

def wrong_paths(page):
    for match in re.finditer(r"(?<![\w/$}.*<-])" + TOP + r"/[\w./*-]*", page.text):
        path = match.group(0).rstrip(".").rstrip("/")
        following = page.text[match.end():match.end() + 1]
        if following in ("<", "{", "$"):  # a path that the reader fills in
            path = path.rsplit("/", 1)[0]
        if path not in ALLOWED and not exists(path):
            yield page.line(match.start()), f"there is no {path}"
    if page.kind == "markdown":
        for match in re.finditer(r"\]\(([^)\s]+)\)", page.text):
            target = match.group(1).split("#")[0]
            if target and not re.match(r"\w+:", target):
                path = os.path.normpath(os.path.join(os.path.dirname(page.path), target))
                if not exists(path):
                    yield page.line(match.start()), f"the link leads to {path}, which does not exist"
    for match in re.finditer(r"(?<![\w/$}.*<>(-])" + CODE_FILE + r"(?![\w/])", page.text):
        if re.match(TOP + "/", match.group(0)):
            continue  # judged above
        if match.group(0) not in ALLOWED and not exists_anywhere(match.group(0)):
            yield page.line(match.start()), f"there is no file {match.group(0)}"
    for match in re.finditer(r"(?<![\w/])cairn/\w+\.h\b", page.text):
        if not exists("include/" + match.group(0)):
            yield page.line(match.start()), f"there is no header {match.group(0)}"


def wrong_names(page):
    spans = [(at, text) for at, text, _ in page.spans()] if page.kind == "markdown" else [(0, page.text)]
    for at, text in spans:
        for match in re.finditer(r"(?<![\w/-])(?:cairn|CAIRN)_\w+(?:\.\.\.|\*)?", text):
            name = match.group(0).rstrip(".*")
            known = public_names() | build_names()
            if name in known or name in ALLOWED or exists_anywhere(name):
                continue
            begins = match.group(0) != name or name.endswith("_") or text[match.end():].startswith(("<", "..."))
            if begins and any(k.startswith(name) for k in known):
                continue
            yield page.line(at + match.start()), f"no header declares {name}"


def wrong_options(page):
    if page.kind == "code":
        return
    if page.kind == "manual":
        for number, line in enumerate(page.text.splitlines(), 1):
            if line.startswith('.\\"'):
                continue  # a comment: it is about scripts
            for word in re.findall(r"--[a-z][a-z-]*[a-z]", line):
                if word not in program_options() | script_options():
                    yield number, f"the program has no option {word}"
        return
    for at, text, is_block in page.spans():
        calls = re.search(r"(?:^|\s|;)cairn (?:run|simulate)\b(.*)", text)
        if calls:
            known, words = program_options(), re.findall(r"--[a-z][a-z-]*[a-z]", calls.group(1).split("#")[0])
        elif not is_block and text.startswith("--"):
            known, words = program_options() | script_options(), re.findall(r"--[a-z][a-z-]*[a-z]", text)
        else:
            continue
        for word in words:
            if word not in known and word not in ALLOWED:
                yield page.line(at), f"the program has no option {word}"


def wrong_identifiers(page):
    if page.kind == "manual":
        return
    for at, text, is_block in page.spans():
        if is_block:
            continue
        found = re.findall(r"\b([A-Z]\w*)::(\w+)", text)
        names = [name for pair in found for name in pair]
        if re.fullmatch(r"[A-Z][a-z]+\w*", text):
            names.append(text)
        names += re.findall(r"\b([a-z]\w+)\(\)", text)
        names += re.findall(r"\b([A-Z][a-z0-9]+[A-Z][a-z]\w+)\b", text)
        if re.fullmatch(r"[a-z]{3,}(?:_[a-z]{3,})+|[a-z]\w*_", text):
            names.append(text)
        for name in names:
            if name.startswith("cairn_"):
                continue  # wrong_names judges it
            if name not in code_words() and name not in ALLOWED and not is_stem(name):
                yield page.line(at), f"the code has no {name}"
    if page.kind == "code":
        for match in re.finditer(r"\b([A-Z]\w*)::(\w+)", page.text):
            for name in match.groups():
                if name not in code_words() and name not in ALLOWED:
                    yield page.line(match.start()), f"the code has no {name}"


CHECKS = (wrong_paths, wrong_names, wrong_options, wrong_identifiers)


def problems(page):
    return sorted({(page.path, line, message) for check in CHECKS for line, message in check(page)})


class NamesTest(unittest.TestCase):
    def test_all_names_exist(self):
        found = [problem for page in pages() for problem in problems(page)]
        self.assertEqual(found, [], "\n" + "\n".join(f"{path}:{line}: {message}" for path, line, message in found))

    def test_enough_is_searched(self):
        self.assertGreater(len(pages()), 100)
        self.assertGreater(sum(len(list(page.spans())) for page in pages()), 1000)
        self.assertGreater(len(public_names()), 200)
        self.assertGreater(len(program_options()), 50)


class SelfTest(unittest.TestCase):
    """Wrong names are found, right ones are not."""

    def messages(self, path, text):
        return [message for _, _, message in problems(Page(path, text))]

    def test_right_names(self):
        self.assertEqual(self.messages("docs/made_up.md", """
`src/cairn/core/error.hpp`, `error.hpp`, `src/cairn/*`, [a page](notation.md), [a file](../README.md#try-it),
`cairn_filter_update`, `CAIRN_REASON_...`, `CAIRN_OK`, `CAIRN_BUILD_DOCS`, `--submap-landmarks 60`,
`cairn run LOG --quiet`,
`SpatialIndex`, `SE3::exp`, `Exp`, `cairn/sensor.h`

```sh
cairn simulate mars --runs 3   # --nonsense is a comment
```

`SpatialIndex`
"""), [])
        code = "// See docs/notation.md and SE3::exp.\nint not_a_name = cairn_x;\n"
        self.assertEqual(self.messages("src/made_up.cpp", code), [])

    def test_wrong_paths(self):
        for text in ("`src/nowhere/file.cpp`", "see tests/nothing", "[link](nothing.md)", "`nothing.hpp`",
                     "`cairn/nothing.h`", "src/nowhere/*"):
            self.assertTrue(self.messages("docs/made_up.md", text), text)
        self.assertTrue(self.messages("src/made_up.cpp", "/* as docs/nothing.md says */"))
        self.assertTrue(self.messages("src/made_up.cpp", "// nothing.cpp does that"))

    def test_wrong_names(self):
        for text in ("`cairn_filter_fly`", "`CAIRN_REASON_WEATHER`", "`CAIRN_NOTHING_...`",
                     "```c\ncairn_filter_fly(f);\n```"):
            self.assertTrue(self.messages("docs/made_up.md", text), text)
        self.assertTrue(self.messages("include/cairn/made_up.h", "/** As \\ref cairn_filter_fly does. */"))

    def test_wrong_options(self):
        for text in ("`--fly`", "`cairn run LOG --fly`", "```sh\ncairn simulate mars --fly 3\n```"):
            self.assertTrue(self.messages("docs/made_up.md", text), text)
        self.assertTrue(self.messages("docs/made_up.1", ".B \\-\\-fly"))

    def test_wrong_identifiers(self):
        for text in ("`FlyingFilter`", "`SE3::levitate`", "`fly_away()`", "`flying_landmarks`", "`flying_`"):
            self.assertTrue(self.messages("docs/made_up.md", text), text)
        self.assertTrue(self.messages("src/made_up.cpp", "// SpatialIndex::levitate"))

    def test_words_after_a_code_block_are_found(self):
        self.assertTrue(self.messages("docs/made_up.md", "```\nblock\n```\n\n`FlyingFilter`\n"))

    def test_the_line_is_told(self):
        self.assertEqual(problems(Page("docs/made_up.md", "one\ntwo\n`--fly`\n"))[0][1], 3)


if __name__ == "__main__":
    if "--list" in sys.argv:  # all problems, one a line
        for item in pages():
            for place, number, text in problems(item):
                print(f"{place}:{number}: {text}")
    else:
        unittest.main()
