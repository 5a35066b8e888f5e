#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Describes the C interface: reads include/cairn/*.h by libclang and writes api.json, from which bindings are made.

    describe.py [--output FILE] [--check FILE] [--target TRIPLE] [--layout]

What C says is taken from C: types, values, sizes, offsets. What C does not say is taken from the macros of
include/cairn/describe.h and from sentences of fixed wording in the comments ("Threads: any.", "Errors: ...",
"m, > 0; default 0.3"). Whatever is missing is an error with its place. docs/api_description.md explains the result.

It needs libclang and its Python module, of version 14 or later (Debian: python3-clang-14).
"""
import argparse
import difflib
import json
import os
import re
import sys

try:
    import clang.cindex as clang
except ImportError:
    sys.exit("describe.py: the Python module clang.cindex is missing (Debian: python3-clang-14, for /usr/bin/python3)")

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
FORMAT = 1  # of api.json: a change that is more than an addition increases it

# The libraries with their headers and the lists of what they export.
LIBRARIES = (
    {"name": "cairn", "pkg_config": "cairn", "main": ["cairn/cairn.h"], "symbols": "src/cairn/capi/symbols.txt"},
    {"name": "cairn_sim", "pkg_config": "cairn-sim", "main": ["cairn/sim.h", "cairn/fleet.h"],
     "symbols": "src/sim/symbols.txt"},
)
INTEGERS = {"int32_t", "uint32_t", "uint64_t", "uint8_t", "size_t"}
NOT_CONSTANTS = re.compile(r"_H$|_API$")  # macros that are no values: include guards, visibility

# Units of doubles. "1" is a plain number, "pose" the error [dp; dtheta] of a pose (m and rad), "sensor" the units of a
# sensor's values, "kind" those of the kind of a systematic error. A list belongs to the elements of an array one by
# one. A random walk has its unit in the square root of a second.
UNITS = {
    "1", "m", "rad", "s", "m/s", "rad/s", "m/s^2", "m^2", "rad^2", "pixels", "m, rad, rad", "m/s or m/s^2",
    "m/s^0.5", "rad/s^0.5", "m/s^1.5", "rad/s^1.5", "1/s^0.5", "sensor/s^0.5",
    "pose", "pose^2", "[pose, m]^2", "m/pose",
    "sensor", "sensor^2", "sensor/pose", "sensor/m", "m/sensor",
    "kind", "kind^2",
}
UNITS_IN_WORDS = {"standard deviations": "1"}
NOT_IN_WORDS = {"1", "kind", "sensor", "pose"}  # words that mean something else in a sentence


# --- problems ---

class Problems:
    def __init__(self, root):
        self.root, self.lines = root, []

    def add(self, cursor, text):
        where = "api"
        if cursor is not None and cursor.location.file:
            where = f"{os.path.relpath(cursor.location.file.name, self.root)}:{cursor.location.line}"
        self.lines.append(f"{where}: {text}")


# --- comments ---

def plain(comment):
    """The text of a Doxygen comment, without its frame; a paragraph is one line."""
    if not comment:
        return ""
    text = re.sub(r"^/\*\*<?", "", comment.strip())
    text = re.sub(r"\*/$", "", text)
    lines = [re.sub(r"^\s*\*( |$)", "", line) if number else line for number, line in enumerate(text.splitlines())]
    paragraphs, current = [], []
    for line in lines:
        line = line.strip()
        if line and not line.startswith("\\param") and not line.startswith("\\return"):
            current.append(line)
            continue
        paragraphs.append(" ".join(current))
        current = [line] if line else []
    paragraphs.append(" ".join(current))
    text = "\n\n".join(p for p in paragraphs if p)
    return re.sub(r"\\ref\s+(\w+)", r"\1", text)


def split_at_depth(text, separator):
    """Splits where the separator is outside parentheses."""
    parts, depth, start = [], 0, 0
    for at, char in enumerate(text):
        depth += (char == "(") - (char == ")")
        if char == separator and depth == 0:
            parts.append(text[start:at])
            start = at + 1
    return parts + [text[start:]]


def take(text, pattern):
    """Cuts the match out of a text: (match or None, rest)."""
    match = re.search(pattern, text)
    if not match:
        return None, text
    return match, (text[:match.start()].rstrip() + " " + text[match.end():].lstrip()).strip()


def take_since(text):
    match, text = take(text, r"\\since (\d+\.\d+\.\d+)")
    return (match.group(1) if match else None), text


def sentence(text, label):
    """Cuts "Label: ....", up to its full stop outside parentheses, out of a text: (sentence or None, rest)."""
    match = re.search(rf"(?:^|(?<=\s)){label}", text)
    if not match:
        return None, text
    depth = 0
    for at in range(match.end(), len(text)):
        char = text[at]
        depth += (char == "(") - (char == ")")
        if char == "." and depth == 0 and (at + 1 == len(text) or text[at + 1].isspace()):
            rest = (text[:match.start()].rstrip(" ") + " " + text[at + 1:].lstrip(" ")).strip()
            return text[match.end():at].strip(), rest
    return None, text


THREADS = {
    "any": "any",
    "one a handle": "one",
    "as any const query of the handle": "query",
}


def parse_threads(words):
    """The rule and the exact words: "`map` one a handle; `other` as any const query of the handle" is "one"."""
    rules = [re.sub(r"^`\w+` ", "", re.sub(r" \(.*\)$", "", part.strip())) for part in words.split(";")]
    if any(rule not in THREADS for rule in rules):
        return None
    known = [THREADS[rule] for rule in rules]
    return "one" if "one" in known else known[0]


def parse_errors(words):
    errors = []
    for part in split_at_depth(words, ","):
        match = re.fullmatch(r"\s*(CAIRN_ERROR_[A-Z_]+)(?:\s+\((.*)\))?\s*", part, re.DOTALL)
        if not match:
            return None
        errors.append({"status": match.group(1), "when": match.group(2) or ""})
    return errors


NUMBER = r"(?:-?\d[\d.e-]*(?: pi)?(?: degrees)?|pi(?:/2)?)"
START = r"(?:^|[,;:] |, and |[,.] )"
INTERVAL = re.compile(rf"{START}(?:in )?([\[(])({NUMBER}), ([^\[\]()]+?)([\])])")
BOUND = re.compile(rf"{START}(>=|>) ([-\w.]+?)(?=[,;:.]?(?:\s|$))")
SPAN = re.compile(rf"{START}({NUMBER}) to ({NUMBER})(?=[,;:.]?(?:\s|$))")
MOST = re.compile(rf"{START}(?:up to|at most) ({NUMBER}|half of `\w+`|`\w+`)(?=[,;:.]?(?:\s|$))")


def documented_range(text):
    """A range in a comment of fixed wording, as an interval: "(0, inf)"; None if the comment has none."""
    text = re.sub(r" \([a-z][^()]*\)", "", text)  # remarks: "1 (plain EKF) to 50"
    match = INTERVAL.search(text)
    if match:
        return f"{match.group(1)}{match.group(2)}, {match.group(3)}{match.group(4)}"
    match = SPAN.search(text)
    if match:
        return f"[{match.group(1)}, {match.group(2)}]"
    match = BOUND.search(text)
    if match:
        upper = MOST.search(text)
        end = upper.group(1).replace("`", "") + "]" if upper else "inf)"
        return f"{'[' if match.group(1) == '>=' else '('}{match.group(2)}, {end}"
    match = MOST.search(text)
    if match:
        return f"[0, {match.group(1)}]"
    return None


def interval(conditions):
    """The interval of a mark: "> 0, <= 1" is "(0, 1]". None if it is not understood."""
    lower, upper = "(-inf", "inf)"
    for condition in conditions.split(","):
        match = re.fullmatch(r"\s*(>=|>|<=|<)\s*([-\w.]+)\s*", condition)
        if not match:
            return None
        sign, bound = match.groups()
        if sign[0] == ">":
            lower = ("[" if sign == ">=" else "(") + bound
        else:
            upper = bound + ("]" if sign == "<=" else ")")
    return f"{lower}, {upper}"


def documented_default(text):
    match = re.search(r"(?:^|[;,.] )(?:all )?([-\w.]+), the default\b", text)
    if match:
        return match.group(1)
    match = re.search(r"(?:^|[;,.] )[Dd]efault:? (.*)", text)
    if not match:
        return None
    rest = match.group(1)
    for separator in (";", ":", ","):
        rest = split_at_depth(rest, separator)[0]
    rest = re.sub(r" \((?:not in the paper|paper\b.*|Table 1)\).*", "", rest.split(". ")[0].rstrip("."))
    return re.sub(r" each$", "", rest.strip())


def documented_units(text):
    """Units that stand between commas, as in "distance between the wheels, m, > 0"."""
    parts = [part.strip() for part in re.split(r"[,;:.](?:\s|$)", text)]
    found = [UNITS_IN_WORDS.get(part, part) for part in parts if part not in NOT_IN_WORDS]
    return [unit for unit in dict.fromkeys(found) if unit in UNITS]


# --- C ---

class Marks:
    """What the macros of describe.h say about a declaration."""
    KNOWN = {"in", "out", "inout", "optional", "length", "unit", "range", "values", "bits", "borrowed"}

    def __init__(self, cursor, problems):
        self.all = {}
        for child in cursor.get_children():
            if child.kind == clang.CursorKind.ANNOTATE_ATTR:
                key, _, value = child.spelling.partition("=")
                if key not in self.KNOWN or key in self.all:
                    problems.add(cursor, f"the mark {child.spelling!r} is unknown or there twice")
                self.all[key] = value

    def __contains__(self, key):
        return key in self.all

    def __getitem__(self, key):
        return self.all.get(key)

    def direction(self):
        found = [d for d in ("in", "out", "inout") if d in self.all]
        return found[0] if len(found) == 1 else None


def typedef_name(kind):
    return re.sub(r"^(const|struct|enum) ", "", re.sub(r"^(const|struct|enum) ", "", kind.spelling))


class DescriptionError(Exception):
    """The headers cannot be read."""


class Api:
    def __init__(self, arguments=(), root=ROOT):
        self.root, self.include, self.problems = root, os.path.join(root, "include"), Problems(root)
        self.arguments = ["-x", "c", "-std=c99", "-ffreestanding", "-DCAIRN_DESCRIBE", f"-I{self.include}", *arguments]
        self.handles, self.structs, self.enums, self.callbacks, self.functions = {}, {}, {}, {}, {}
        self.constants, self.headers, self.integers, self.aliases = [], [], {}, {}
        self.enum_bodies, self.struct_bodies = [], {}
        self.read()
        self.finish()

    def read(self):
        mains = [main for library in LIBRARIES for main in library["main"]]
        source = "".join(f"#include <{main}>\n" for main in mains)
        unit = clang.Index.create().parse("interface.c", args=self.arguments,
                                          unsaved_files=[("interface.c", source)],
                                          options=clang.TranslationUnit.PARSE_DETAILED_PROCESSING_RECORD)
        errors = [str(d) for d in unit.diagnostics if d.severity >= clang.Diagnostic.Warning]
        if errors:
            raise DescriptionError("\n".join(["the headers do not compile:"] + errors))
        self.owners = self.header_owners()
        cursors = [c for c in unit.cursor.get_children() if c.location.file and self.header(c) is not None]
        values = self.macro_values([c for c in cursors if c.kind == clang.CursorKind.MACRO_DEFINITION])
        for cursor in cursors:
            if cursor.kind == clang.CursorKind.MACRO_DEFINITION and cursor.spelling in values:
                self.add_constant(cursor, values[cursor.spelling])
            elif cursor.kind == clang.CursorKind.STRUCT_DECL:
                self.add_struct_body(cursor)
            elif cursor.kind == clang.CursorKind.TYPEDEF_DECL:
                self.add_typedef(cursor)
            elif cursor.kind == clang.CursorKind.ENUM_DECL:
                self.add_enum_body(cursor)
            elif cursor.kind == clang.CursorKind.FUNCTION_DECL:
                self.functions[cursor.spelling] = cursor
            elif cursor.kind not in (clang.CursorKind.MACRO_DEFINITION, clang.CursorKind.MACRO_INSTANTIATION,
                                     clang.CursorKind.INCLUSION_DIRECTIVE):
                self.problems.add(cursor, f"{cursor.kind.name} {cursor.spelling}: a declaration of an unknown sort")

    def header_owners(self):
        """The library of each header: the first one whose main headers include it."""
        owners = {}
        for library in LIBRARIES:
            waiting = list(library["main"])
            while waiting:
                name = waiting.pop(0)
                if name in owners:
                    continue
                owners[name] = library["name"]
                with open(os.path.join(self.include, name), encoding="utf-8") as file:
                    waiting += re.findall(r"#include <(cairn/\w+\.h)>", file.read())
        for name in sorted(os.listdir(os.path.join(self.include, "cairn"))):
            if f"cairn/{name}" not in owners:
                self.problems.add(None, f"include/cairn/{name} belongs to no library")
        return owners

    def header(self, cursor):
        path = os.path.relpath(os.path.abspath(cursor.location.file.name), self.include)
        return path if path in self.owners else None

    def macro_values(self, cursors):
        """Values of the macros that are constants. The compiler computes them."""
        names = [c.spelling for c in cursors
                 if c.spelling.startswith("CAIRN_") and not NOT_CONSTANTS.search(c.spelling)
                 and self.header(c) != "cairn/describe.h" and len(list(c.get_tokens())) > 1]
        source = "".join(f"#include <{main}>\n" for library in LIBRARIES for main in library["main"])
        source += "".join(f"enum {{ value_of_{name} = ({name}) }};\n" for name in names)
        unit = clang.Index.create().parse("macros.c", args=self.arguments, unsaved_files=[("macros.c", source)])
        found = {}
        for cursor in unit.cursor.walk_preorder():
            if cursor.kind == clang.CursorKind.ENUM_CONSTANT_DECL and cursor.spelling.startswith("value_of_"):
                found[cursor.spelling[len("value_of_"):]] = cursor.enum_value
        return found

    # --- declarations ---

    def add_constant(self, cursor, value):
        text = self.macro_comment(cursor)
        if not text:
            self.problems.add(cursor, f"{cursor.spelling} has no comment")
        wide = value > 2**32 - 1
        self.constants.append({"name": cursor.spelling, "type": "uint64_t" if wide else "int32_t",
                               "value": str(value) if wide else value, "header": self.header(cursor), "doc": text})

    def macro_comment(self, cursor):
        """libclang gives no comments of macros: the one behind it, or the one that ends in the line above."""
        with open(cursor.location.file.name, encoding="utf-8") as file:
            lines = file.read().splitlines()
        line = lines[cursor.location.line - 1]
        behind = re.search(r"/\*\*<.*\*/", line)
        if behind:
            return plain(behind.group(0))
        above = "\n".join(lines[:cursor.location.line - 1])
        match = re.search(r"/\*\*(?:(?!\*/).)*\*/\Z", above, re.DOTALL)
        return plain(match.group(0)) if match else ""

    def add_struct_body(self, cursor):
        if cursor.is_definition():
            self.struct_bodies[cursor.spelling] = cursor

    def add_typedef(self, cursor):
        name, kind = cursor.spelling, cursor.underlying_typedef_type
        canonical = kind.get_canonical()
        if canonical.kind == clang.TypeKind.RECORD:
            if canonical.get_declaration().is_definition():
                self.structs[name] = canonical.get_declaration()
            else:
                self.handles[name] = cursor
        elif canonical.kind == clang.TypeKind.POINTER:
            self.callbacks[name] = cursor
        else:
            self.aliases[name] = cursor
            if name != "cairn_bool":
                self.enums[name] = None

    def add_enum_body(self, cursor):
        marks = Marks(cursor, self.problems)
        name = marks["values"] or marks["bits"]
        if name is None:
            self.problems.add(cursor, "an enum needs CAIRN_VALUES(type) or CAIRN_BITS(type)")
            candidates = [a for a, c in self.aliases.items()
                          if self.enums.get(a, 0) is None and c.location.file.name == cursor.location.file.name]
            name = candidates[-1] if candidates else None
        if name not in self.enums:
            self.problems.add(cursor, f"{name} is no type of constants")
        elif self.enums[name] is not None:
            self.problems.add(cursor, f"{name} has values already")
        else:
            self.enums[name] = (cursor, "bits" in marks)

    # --- types ---

    def describe_type(self, kind):
        """Type, sort, pointers, constness, length of an array."""
        fixed = None
        if kind.kind in (clang.TypeKind.CONSTANTARRAY,):
            fixed, kind = kind.element_count, kind.element_type
        if kind.kind == clang.TypeKind.UNEXPOSED:
            kind = kind.get_canonical()
        depth, const = 0, kind.is_const_qualified()
        name = typedef_name(kind)
        if name not in self.callbacks:
            while kind.kind == clang.TypeKind.POINTER:
                depth, kind = depth + 1, kind.get_pointee()
                const = kind.is_const_qualified()
            name = typedef_name(kind)
        return {"type": name, "kind": self.sort(name), "pointers": depth, "const": const, "fixed": fixed}

    def sort(self, name):
        if name == "cairn_bool":
            return "bool"
        for sort, names in (("enum", self.enums), ("struct", self.structs), ("handle", self.handles),
                            ("callback", self.callbacks), ("integer", INTEGERS)):
            if name in names:
                return sort
        return {"double": "number", "char": "char", "void": "void"}.get(name)

    def base(self, name):
        cursor = self.aliases.get(name)
        return cursor.underlying_typedef_type.spelling if cursor is not None else name

    # --- results ---

    def finish(self):
        self.out = {"format": FORMAT, "name": "cairn"}
        versions = {c["name"]: c["value"] for c in self.constants}
        version = [versions[f"CAIRN_VERSION_{part}"] for part in ("MAJOR", "MINOR", "PATCH")]
        self.out["version"] = ".".join(map(str, version))
        self.out["version_number"] = 10000 * version[0] + 100 * version[1] + version[2]
        self.out["libraries"] = [self.finish_library(library, version) for library in LIBRARIES]
        self.out["headers"] = [self.finish_header(name) for name in self.owners]
        self.out["constants"] = self.constants
        self.out["types"] = [self.finish_alias(name) for name in self.aliases if name not in self.enums]
        self.out["enums"] = [self.finish_enum(name) for name in self.enums]
        self.out["structs"] = [self.finish_struct(name, body) for name, body in self.structs.items()]
        self.out["handles"] = [self.finish_handle(name) for name in self.handles]
        self.out["callbacks"] = [self.finish_callback(name) for name in self.callbacks]
        self.out["functions"] = [self.finish_function(name) for name in self.functions]
        self.compare_symbols()

    def finish_library(self, library, version):
        symbols = self.symbols(library)
        nodes = sorted({node for _, node in symbols})
        if len(nodes) != 1:
            self.problems.add(None, f"{library['symbols']}: one symbol version is expected, not {nodes}")
        return {"name": library["name"], "soname": f"lib{library['name']}.so.{version[0]}.{version[1]}",
                "symbol_version": nodes[0], "pkg_config": library["pkg_config"],
                "headers": [name for name, owner in self.owners.items() if owner == library["name"]]}

    def symbols(self, library):
        with open(os.path.join(self.root, library["symbols"]), encoding="utf-8") as file:
            return [tuple(line.split("@@")) for line in file.read().split("\n") if line and not line.startswith("#")]

    def finish_header(self, name):
        with open(os.path.join(self.include, name), encoding="utf-8") as file:
            match = re.search(r"/\*\* \\file\n(.*?)\*/", file.read(), re.DOTALL)
        if not match:
            self.problems.add(None, f"include/{name} has no \\file comment")
        return {"name": name, "library": self.owners[name], "doc": plain("/**\n" + match.group(1)) if match else ""}

    def documented(self, cursor):
        text = plain(cursor.raw_comment)
        if not text:
            self.problems.add(cursor, f"{cursor.spelling} has no comment")
        since, text = take_since(text)
        return text, since

    def finish_alias(self, name):
        doc, since = self.documented(self.aliases[name])
        return {"name": name, "header": self.header(self.aliases[name]), "base": self.base(name), "doc": doc,
                "since": since}

    def finish_enum(self, name):
        alias = self.aliases[name]
        doc, since = self.documented(alias)
        if self.enums[name] is None:
            self.problems.add(alias, f"{name} has no values")
            return {"name": name, "values": []}
        body, bits = self.enums[name]
        values = []
        for child in body.get_children():
            if child.kind == clang.CursorKind.ENUM_CONSTANT_DECL:
                text, from_version = self.documented(child)
                values.append({"name": child.spelling, "value": child.enum_value, "doc": text, "since": from_version})
        heads = os.path.commonprefix([v["name"] for v in values])
        return {"name": name, "header": self.header(alias), "base": self.base(name), "bits": bits,
                "prefix": heads[:heads.rfind("_") + 1], "doc": doc, "since": since, "values": values}

    def finish_struct(self, name, body):
        doc, since = self.documented(body)
        kind = body.type
        fields, end = [], 0
        for child in body.get_children():
            if child.kind != clang.CursorKind.FIELD_DECL:
                continue
            offset = kind.get_offset(child.spelling) // 8
            if offset != end:
                self.problems.add(child, f"{name}.{child.spelling}: {offset - end} bytes of padding before it")
            end = offset + child.type.get_size()
            fields.append(self.finish_field(name, child, offset))
        if end != kind.get_size():
            self.problems.add(body, f"{name}: {kind.get_size() - end} bytes of padding at its end")
        versioned = bool(fields) and fields[0]["name"] == "struct_size"
        init = self.init_of(name)
        frozen = "Layout frozen." in doc
        if versioned == frozen:
            self.problems.add(body, f"{name} must either begin with struct_size or say \"Layout frozen.\"")
        role = ("error" if name == "cairn_error" else "options" if init else "report" if versioned else "plain")
        return {"name": name, "header": self.header(body), "role": role, "versioned": versioned, "init": init,
                "size": kind.get_size(), "alignment": kind.get_align(), "doc": doc, "since": since, "fields": fields}

    def init_of(self, name):
        function = self.functions.get(name + "_init")
        return function.spelling if function is not None else None

    def finish_field(self, struct, cursor, offset):
        what = self.describe_type(cursor.type)
        name, marks = cursor.spelling, Marks(cursor, self.problems)
        doc, since = self.documented(cursor)
        self.check_type(cursor, f"{struct}.{name}", what)
        if what["pointers"] or what["type"] == "size_t":
            self.problems.add(cursor, f"{struct}.{name}: a public struct holds no pointer and no size_t")
        role = ("struct_size" if name == "struct_size" else "reserved" if name == "reserved" else
                "sensor" if name == "sensor" else "value")
        if what["type"] == "int32_t" and role == "value" and "counted from 0" not in doc:
            self.problems.add(cursor, f"{struct}.{name}: an int32_t that is no enum, no cairn_bool, no sensor and not "
                                      "\"counted from 0\"")
        field = {"name": name, "type": what["type"], "base": self.base(what["type"]), "kind": what["kind"],
                 "role": role, "offset": offset, "size": cursor.type.get_size(), "length": what["fixed"]}
        if what["kind"] == "char":
            field["kind"] = "text"
        if what["kind"] == "number":
            field["unit"] = self.unit(cursor, f"{struct}.{name}", marks, doc)
        field["repeatable"] = "differs from run to run" not in doc
        if field["repeatable"] == bool(re.fullmatch(r"(.*_)?seconds", name)):
            self.problems.add(cursor, f"{struct}.{name}: durations, and only they, are named `seconds` or `..._seconds` "
                                      "and \"differ from run to run\"")
        field["range"] = self.range(cursor, marks) or (documented_range(doc) if role == "value" else None)
        field["default"] = documented_default(doc) if role == "value" else None
        if role == "value" and self.init_of(struct) and field["default"] is None:
            self.problems.add(cursor, f"{struct}.{name} is an option and does not say \"default ...\"")
        field.update(doc=doc, since=since)
        return field

    def unit(self, cursor, name, marks, doc):
        written = documented_units(doc)
        unit = marks["unit"]
        if unit is None and len(written) == 1:
            unit = written[0]
        if unit is None:
            self.problems.add(cursor, f"{name}: a double needs one unit, CAIRN_UNIT or \", m,\" in its comment"
                                      f"{'; the comment has ' + ' and '.join(written) if written else ''}")
        elif unit not in UNITS:
            self.problems.add(cursor, f"{name}: the unit {unit!r} is unknown")
        elif written and unit not in written:
            self.problems.add(cursor, f"{name}: the mark says {unit!r}, the comment says {written}")
        return unit

    def range(self, cursor, marks):
        if marks["range"] is None:
            return None
        found = interval(marks["range"])
        if found is None:
            self.problems.add(cursor, f"CAIRN_RANGE({marks['range']}) must be like \"> 0\" or \"> 0, <= 1\"")
        return found

    def check_type(self, cursor, name, what):
        if what["kind"] is None:
            self.problems.add(cursor, f"{name}: the type {what['type']!r} is no type of this interface")

    def finish_handle(self, name):
        doc, since = self.documented(self.handles[name])
        destroy = name + "_destroy"
        if destroy not in self.functions:
            self.problems.add(self.handles[name], f"{name} has no {destroy}")
        creators, lenders = [], []
        for function, cursor in self.functions.items():
            for parameter in cursor.get_arguments():
                what = self.describe_type(parameter.type)
                if what["type"] == name and what["pointers"] == 2:
                    creators.append(function)
            result = self.describe_type(cursor.result_type)
            if result["type"] == name:
                lenders.append(function)
        return {"name": name, "header": self.header(self.handles[name]), "doc": doc, "since": since,
                "destroy": destroy, "created_by": creators, "lent_by": lenders}

    def finish_callback(self, name):
        cursor = self.callbacks[name]
        text = plain(cursor.raw_comment)
        parts = re.split(r"\n\n(?=\\param|\\return)", "\n\n" + text)
        described, returns, after = {}, "", []
        for part in parts[1:]:
            first, _, rest = part.partition("\n\n")
            match = re.match(r"\\param\s+(\w+)\s+(.*)", first, re.DOTALL)
            if match:
                described[match.group(1)] = match.group(2)
            else:
                returns = re.sub(r"^\\return\s+", "", first)
            after.append(rest)
        doc = "\n\n".join(p for p in [parts[0].strip(), *after] if p)
        since, doc = take_since(doc)
        function = cursor.underlying_typedef_type.get_canonical().get_pointee()
        result = self.describe_type(function.get_result())
        children = [c for c in cursor.get_children() if c.kind == clang.CursorKind.PARM_DECL]
        parameters = self.finish_parameters(name, children, described)
        if result["type"] not in ("void", "int"):
            self.problems.add(cursor, f"{name}: a callback returns int32_t or nothing")
        answers = result["type"] != "void"
        return {"name": name, "header": self.header(cursor), "doc": doc, "since": since,
                "returns": {"type": "int32_t" if answers else "void", "role": "answer" if answers else None,
                            "doc": returns},
                "parameters": parameters}

    def finish_function(self, name):
        cursor = self.functions[name]
        library = self.owners[self.header(cursor)]
        text, since = self.documented(cursor)
        threads, text = sentence(text, "Threads: ")
        errors, text = sentence(text, "Errors: ")
        complexity, text = take(text, r"(?:^|(?<=\s))Complexity(?:: |, )(.*?)\.?\s*(?:(?=\n\n)|\Z)")
        statuses = {value.spelling for value in self.enums["cairn_status"][0].get_children()}
        result = self.describe_type(cursor.result_type)
        marks = Marks(cursor, self.problems)
        fallible = result["type"] == "cairn_status" and name != "cairn_status_name"
        if since is None:
            self.problems.add(cursor, f"{name} does not say \"\\since\"")
        rule = parse_threads(threads) if threads else None
        if rule is None:
            self.problems.add(cursor, f"{name} does not say \"Threads: ...\" in the fixed words, but {threads!r}")
        listed = parse_errors(errors) if errors else []
        if listed is None or bool(listed) != fallible:
            self.problems.add(cursor, f"{name}: \"Errors: ...\" must list statuses exactly if it can fail: {errors!r}")
        for error in listed or []:
            if error["status"] not in statuses:
                self.problems.add(cursor, f"{name}: there is no status {error['status']}")
        parameters = self.finish_parameters(name, list(cursor.get_arguments()), {})
        if fallible and (not parameters or parameters[-1]["role"] != "error"):
            self.problems.add(cursor, f"{name}: its last parameter must be cairn_error *error")
        handles = [p for p in parameters if p["role"] == "handle"]
        expected = "any" if not handles else "one" if any(p["changes"] for p in handles) else "query"
        if rule is not None and rule != expected:
            self.problems.add(cursor, f"{name}: its parameters ask for the thread rule {expected!r}, not {rule!r}")
        destroys = None
        for handle in self.handles:
            if name == handle + "_destroy":
                destroys = handle
        return {"name": name, "library": library, "header": self.header(cursor), "doc": text, "since": since,
                "threads": rule, "threads_text": threads, "errors": listed or [],
                "complexity": complexity.group(1) if complexity else "O(1)", "fallible": fallible,
                "destroys": destroys, "returns": self.finish_result(cursor, result, marks),
                "parameters": parameters}

    def finish_result(self, cursor, what, marks):
        self.check_type(cursor, f"{cursor.spelling}: its result", what)
        kind, borrowed = what["kind"], marks["borrowed"]
        if kind == "char" and what["pointers"] == 1:
            kind = "text"
        if what["pointers"] and borrowed is None:
            self.problems.add(cursor, f"{cursor.spelling} returns a pointer: CAIRN_BORROWED(owner) must say whose it "
                                      "is")
        owners = {"library", "thread", *(parameter.spelling for parameter in cursor.get_arguments())}
        if borrowed is not None and borrowed not in owners:
            self.problems.add(cursor, f"{cursor.spelling}: its result belongs to {borrowed}, which is no parameter")
        return {"type": what["type"], "base": self.base(what["type"]), "kind": kind, "c": cursor.result_type.spelling,
                "borrowed_from": borrowed}

    def finish_parameters(self, function, cursors, described):
        marked = [(cursor, self.describe_type(cursor.type), Marks(cursor, self.problems)) for cursor in cursors]
        lengths = [m["length"] for _, _, m in marked if m["length"]]
        names = [cursor.spelling for cursor in cursors]
        arrays = {n: [c.spelling for c, _, m in marked if m["length"] and re.search(rf"\b{n}\b", m["length"])]
                  for n in names}
        release = next((c.spelling for c, w, _ in marked if w["type"] == "cairn_release_fn"), None)
        callbacks = [c.spelling for c, w, _ in marked if w["kind"] == "callback" and c.spelling != release]
        result = []
        for cursor, what, marks in marked:
            parameter = self.finish_parameter(function, cursor, what, marks, arrays, callbacks, described, release)
            result.append(parameter)
            for word in re.findall(r"[A-Za-z_][\w.]*", marks["length"] or ""):
                struct, _, field = word.partition(".")
                if not (field in self.field_names(struct) if field else word in names):
                    self.problems.add(cursor, f"{function}: the length of {cursor.spelling} names {word}, which is "
                                              "neither a parameter nor a field of a struct")
        if "capacity" in names and not any("capacity" in length for length in lengths):
            self.problems.add(cursors[0], f"{function}: `capacity` is the length of nothing")
        return result

    def finish_parameter(self, function, cursor, what, marks, arrays, callbacks, described, release):
        name, where = cursor.spelling, f"{function}: {cursor.spelling}"
        self.check_type(cursor, where, what)
        kind, pointers = what["kind"], what["pointers"]
        versioned = kind == "struct" and self.is_versioned(what["type"])
        direction, optional = marks.direction(), "optional" in marks
        length, changes = marks["length"], None
        if what["fixed"] is not None:
            role, length = "array", str(what["fixed"])
            direction = direction or ("in" if what["const"] else None)
        elif kind == "handle":
            role, changes = ("handle", not what["const"]) if pointers == 1 else ("created", None)
            direction = "in" if pointers == 1 else "out"
            optional = optional or function == what["type"] + "_destroy"
        elif what["type"] == "cairn_error":
            role, direction, optional = "error", "out", True
        elif kind == "callback":
            role, direction = "release" if name == release else "callback", "in"
            optional = optional or name == release
        elif kind == "void":
            role, direction, optional = "user", "in", True
        elif kind == "char" and pointers == 1 and what["const"]:
            role, direction, kind = "text", "in", "text"
        elif pointers == 0:
            role, direction = self.value_role(cursor, name, what, arrays), "in"
        elif name == "needed":
            role, direction = "needed", "out"
        else:
            role = "array" if length else "object"
            if what["const"] and versioned:
                direction = direction or "in"
            elif direction is None:
                self.problems.add(cursor, f"{where} needs CAIRN_IN, CAIRN_OUT or CAIRN_INOUT, or one of their arrays")
        if direction is None and role == "array":
            self.problems.add(cursor, f"{where} needs CAIRN_OUT or CAIRN_INOUT")
        if what["const"] and direction not in ("in", None):
            self.problems.add(cursor, f"{where} is const and {direction}")
        if not what["const"] and pointers == 1 and direction == "in" and role in ("array", "object"):
            self.problems.add(cursor, f"{where} is an input that is not const")
        if length and versioned:
            self.problems.add(cursor, f"{where}: structs that begin with struct_size form no arrays")
        spelling = cursor.type.spelling
        result = {"name": name, "type": what["type"], "base": self.base(what["type"]), "kind": kind, "c": spelling,
                  "role": role, "direction": direction, "optional": optional,
                  "pointers": 1 if what["fixed"] is not None else pointers,
                  "const": what["const"], "length": length}
        if role in ("capacity", "count"):
            result["length_of"] = arrays[name]
        if role == "needed":
            result["length_of"] = arrays.get("capacity", [])
            if not result["length_of"]:
                self.problems.add(cursor, f"{where} without `capacity`")
        if changes is not None:
            result["changes"] = changes
        if role in ("user", "release"):
            result["callbacks"] = callbacks
        if role == "user":
            result["released_by"] = release
        if kind == "number":
            result["unit"] = self.unit(cursor, where, marks, "")
        result["range"] = self.range(cursor, marks)
        if name in described:
            result["doc"] = described[name]
        return result

    def value_role(self, cursor, name, what, arrays):
        if what["type"] == "size_t" and name == "struct_size":
            return "struct_size"
        if what["type"] == "size_t" and name == "capacity":
            return "capacity"
        if what["type"] == "size_t" and arrays[name]:
            return "count"
        if name == "sensor" and what["type"] == "int32_t":
            return "sensor"
        if what["type"] == "int32_t":
            self.problems.add(cursor, f"{name}: an int32_t that is no enum, no cairn_bool and no sensor")
        return "value"

    def field_names(self, struct):
        return [c.spelling for c in self.structs[struct].get_children()] if struct in self.structs else []

    def is_versioned(self, name):
        first = next(iter(self.structs[name].get_children()))
        return first.spelling == "struct_size"

    def compare_symbols(self):
        for library in LIBRARIES:
            listed = {name for name, _ in self.symbols(library)}
            declared = {f["name"] for f in self.out["functions"] if f["library"] == library["name"]}
            for name in sorted(declared - listed):
                self.problems.add(self.functions[name], f"{name} is not in {library['symbols']}")
            for name in sorted(listed - declared):
                self.problems.add(None, f"{library['symbols']}: no header declares {name}")


# --- the program ---

def to_json(value, depth=0):
    """JSON of which a difference is easy to read: a parameter, a field or a constant is one line."""
    if depth == 4 or not isinstance(value, (dict, list)) or not value:
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, dict):
        items = [f"{json.dumps(key)}: {to_json(item, depth + 1)}" for key, item in value.items()]
    elif not isinstance(value[0], dict):
        return json.dumps(value, ensure_ascii=False)
    else:
        items = [to_json(item, depth + 1) for item in value]
    begin, end = "{}" if isinstance(value, dict) else "[]"
    pad = " " * (depth + 1)
    return begin + "\n" + ",\n".join(pad + item for item in items) + "\n" + pad[1:] + end


def layout(api):
    """Sizes and offsets of all structs: lines that can be compared between machines."""
    for struct in api["structs"]:
        yield f"{struct['name']} {struct['size']}"
        for field in struct["fields"]:
            yield f"{struct['name']}.{field['name']} {field['offset']} {field['size']}"


def main(arguments=None):
    parser = argparse.ArgumentParser(description="Describes the C interface in JSON.")
    parser.add_argument("--output", metavar="FILE", help="write the description to this file")
    parser.add_argument("--check", metavar="FILE", help="compare the description with this file")
    parser.add_argument("--target", metavar="TRIPLE", help="describe the interface of this machine")
    parser.add_argument("--layout", action="store_true", help="print sizes and offsets of all structs")
    options = parser.parse_args(arguments)

    try:
        api = Api([f"--target={options.target}"] if options.target else [])
    except DescriptionError as error:
        sys.exit(f"describe.py: {error}")
    print("\n".join(api.problems.lines), end="\n" if api.problems.lines else "", file=sys.stderr)
    text = to_json(api.out) + "\n"
    if options.layout:
        print("\n".join(layout(api.out)))
    if options.output:
        with open(options.output, "w", encoding="utf-8") as file:
            file.write(text)
    same = True
    if options.check:
        with open(options.check, encoding="utf-8") as file:
            written = file.read()
        same = written == text
        if not same:
            sys.stderr.writelines(difflib.unified_diff(
                written.splitlines(True), text.splitlines(True), options.check, "the headers", n=1))
            print(f"{options.check} is not what the headers say: run src/api/describe.py --output {options.check}",
                  file=sys.stderr)
    return 0 if same and not api.problems.lines else 1


if __name__ == "__main__":
    sys.exit(main())
