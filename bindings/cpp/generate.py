#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes what the C++ headers know of the C interface, from its description api.json.

  python3 generate.py [--api FILE]           writes the generated headers and the documentation of methods
  python3 generate.py --check [--api FILE]   changes nothing; fails if a file differs or a function has no method
  python3 generate.py --fields FILE          writes names and fields of the types for the conformance test

include/cairn/cpp/types.hpp       enums and structs of libcairn in C++'s names; their layout is compared with C's
include/cairn/cpp/sim_types.hpp   the same of libcairn_sim
include/cairn/cpp/*.hpp           in a file written by hand, a line `//~ cairn_filter_pose` stands above the method that
                                  calls this function; the method's documentation is written below that line
"""
import argparse
import json
import pathlib
import re
import sys
import textwrap

HERE = pathlib.Path(__file__).resolve().parent
HEADERS = HERE / "include" / "cairn" / "cpp"
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE.parent.parent / "src" / "api"))
import bindings_check  # noqa: E402
MARK = re.compile(r"^(\s*)//~ (cairn_\w+)$")
# The one struct without an _init function whose zeros are not a value. A test compares it with cairn_pose_identity.
INITIAL = {("cairn_pose", "quaternion"): "{{1.0, 0.0, 0.0, 0.0}}"}


def camel(name):
    return "".join(part.capitalize() for part in name.removeprefix("cairn_").split("_"))


def enumerator(enum, value):
    own = enum["name"].upper() + "_"
    prefix = own if all(v["name"].startswith(own) for v in enum["values"]) else enum["prefix"]
    return "k" + "".join(part.capitalize() for part in value["name"].removeprefix(prefix).split("_"))


def is_sim(api, item):
    return next(h["library"] for h in api["headers"] if h["name"] == item["header"]) == "cairn_sim"


def structs_of(api):
    return [struct for struct in api["structs"] if struct["role"] != "error"]


def values(struct):
    return [field for field in struct["fields"] if field["role"] not in ("struct_size", "reserved")]


# Documentation --------------------------------------------------------------------------------------------------------

ONLY_IN_C = re.compile(  # sentences that say who frees what, or what a pointer may be
    r"[Cc]apacity 0|^NULL is allowed|struct_size|writes at most|`capacity`|Never NULL|destroys it with|frees it with|On an error `\*|"
    r"older or a newer header|`release` \(or|`user` is passed|(user|payload)` stays|Fails only for NULL|longjmp|"
    r"must be NULL if|NULL, the default|NULL and any other|`base` may be NULL|^Each may be NULL|^`place` NULL")
IN_CPP = [(r"; each may be NULL", ""), (r" \(or NULL\)", ""), (r", or NULL\)", ")"), (r"is not NULL", "is given"),
          (r"(: |; )NULL, not finite", r"\1not finite"), (r"\(NULL, ", "("), (r"^NULL, ", ""), (r"\bNULL\b", "none"), (r"`\*(\w+)`", r"`\1`")]


class Names:
    """What the names of C are in C++, for the documentation."""

    def __init__(self, api, methods):
        self.names = {item["name"]: camel(item["name"]) for key in ("structs", "enums", "handles") for item in api[key]}
        self.names.update({s["init"]: f"{camel(s['name'])}::{camel(s['name'])}" for s in api["structs"] if s["init"]})
        self.names.update({v["name"]: f"{camel(e['name'])}::{enumerator(e, v)}"
                           for e in api["enums"] for v in e["values"]})
        self.names.update(methods)
        self.names.update({"CAIRN_ID_NONE": "kIdNone", "cairn_bool": "bool", "cairn_error": "Error"})

    def prose(self, text):
        return "\n\n".join(filter(None, map(self.paragraph, re.split(r"\n\s*\n", text or ""))))

    def paragraph(self, text):
        sentences = re.split(r"(?<=[.;:]) (?=[A-Z`])", " ".join(text.split()))
        text = " ".join(sentence for sentence in sentences if not ONLY_IN_C.search(sentence))
        for c, cpp in IN_CPP:
            text = re.sub(c, cpp, text)
        return re.sub(r"\b(cairn_\w+|CAIRN_\w+)\b", lambda match: self.names.get(match.group(0), match.group(0)), text)

    def comment(self, text, indent=""):
        lines = []
        for paragraph in self.prose(text).split("\n"):
            lines += textwrap.wrap(paragraph, 116 - len(indent), break_long_words=False,
                                   break_on_hyphens=False) or [""]
        return "".join(f"{indent}/// {line}".rstrip() + "\n" for line in lines)


# Types ----------------------------------------------------------------------------------------------------------------

def field_type(field):
    if field["role"] == "struct_size":
        base = "std::uint32_t"
    elif field["kind"] == "bool":
        base = "Bool"
    elif field["kind"] == "number":
        base = "double"
    elif field["kind"] == "integer":
        base = "std::" + field["base"]
    else:
        base = camel(field["type"])
    return f"std::array<{base}, {field['length']}>" if field["length"] else base


def cpp_enum(names, enum):
    name = camel(enum["name"])
    out = ["\n", names.comment(enum["doc"]), f"enum class {name} : std::{enum['base']} {{\n"]
    for value in enum["values"]:
        out.append(names.comment(value["doc"], "  ") + f"  {enumerator(enum, value)} = {value['name']},\n")
    out.append("};\n\n")
    if enum["bits"]:
        for operator in "|&":
            out.append(f"constexpr {name} operator{operator}({name} a, {name} b) noexcept {{\n"
                       f"  return static_cast<{name}>(static_cast<std::{enum['base']}>(a) {operator} "
                       f"static_cast<std::{enum['base']}>(b));\n}}\n")
        out.append(f"/// Whether any bit is set.\nconstexpr bool any({name} value) noexcept {{ "
                   f"return value != {name}{{}}; }}\n\n")
    out.append(f"/// The name in C of a constant or, of any other value, \"\".\n"
               f"constexpr const char* constant_name({name} value) noexcept {{\n  switch (value) {{\n" +
               "".join(f"    case {name}::{enumerator(enum, v)}: return \"{v['name']}\";\n" for v in enum["values"]) +
               "  }\n  return \"\";\n}\n")
    return "".join(out)


def cpp_struct(names, struct):
    name, c = camel(struct["name"]), struct["name"]
    options = struct["role"] == "options"
    out = ["\n", names.comment(struct["doc"]), f"struct CAIRN_CPP_SAME_BYTES {name} {{\n  using C = {c};\n"]
    for field in struct["fields"]:
        hidden = {"struct_size": "set by the constructor; leave it", "reserved": "leave it zero"}
        initial = INITIAL.get((c, field["name"]), "{}")
        if field["role"] == "struct_size":
            initial = f" = sizeof({c})"
        out.append((f"  /// {hidden[field['role']]}\n" if field["role"] in hidden else
                    names.comment(field["doc"], "  ")) + f"  {field_type(field)} {field['name']}{initial};\n")
    if options:
        out.append(f"\n  /// The defaults of the library.\n  {name}() {{ detail::fill_defaults<{c}>(*this, {c}_init); }}\n"
                   if struct["init"] == f"{c}_init" else sys.exit(f"{c} has another function of defaults"))
        for field in values(struct):
            out.append(f"  /// A copy with another `{field['name']}`.\n  {name} with_{field['name']}"
                       f"(const {field_type(field)}& value) const {{\n    {name} copy = *this;\n"
                       f"    copy.{field['name']} = value;\n    return copy;\n  }}\n")
    out.append("};\n")
    out.append(f"static_assert(detail::same_layout<{name}, {c}>);\n")
    out += [f"static_assert(offsetof({name}, {f['name']}) == offsetof({c}, {f['name']}) && "
            f"sizeof({name}::{f['name']}) == sizeof({c}::{f['name']}));\n" for f in struct["fields"]]
    return "".join(out)


def types(api, names, sim):
    guard = f"CAIRN_CPP_{'SIM_' if sim else ''}TYPES_HPP"
    includes = (["<cairn/cpp/types.hpp>", "<cairn/sim.h>", "<cairn/fleet.h>"] if sim else
                ["<cairn/cairn.h>", "<cairn/cpp/basic.hpp>"]) + ["<array>", "<cstddef>", "<cstdint>"]
    out = ["// SPDX-License-Identifier: BSD-3-Clause\n// Written by generate.py from api.json. Do not edit.\n"
           f"#ifndef {guard}\n#define {guard}\n\n" + "".join(f"#include {name}\n" for name in includes) +
           "\n// clang-format off\nnamespace cairn {\n"]
    if not sim:
        number, version = api["version_number"], api["version"]
        out.append(f"\nstatic_assert(CAIRN_VERSION == {number},\n              \"cairn.hpp is of version {version}, and "
                   "the C headers are of another one: install both from one place\");\n")
        constant = next(c for c in api["constants"] if c["name"] == "CAIRN_ID_NONE")
        out.append("\n" + names.comment(constant["doc"]) + "inline constexpr std::uint64_t kIdNone = CAIRN_ID_NONE;\n\n"
                   "/// Version of these headers: 10000 major + 100 minor + patch.\n"
                   "inline constexpr std::uint32_t kHeaderVersion = CAIRN_VERSION;\n"
                   "inline constexpr std::uint32_t kHeaderVersionMajor = CAIRN_VERSION_MAJOR;\n"
                   "inline constexpr std::uint32_t kHeaderVersionMinor = CAIRN_VERSION_MINOR;\n"
                   "inline constexpr std::uint32_t kHeaderVersionPatch = CAIRN_VERSION_PATCH;\n")
    out += [cpp_enum(names, enum) for enum in api["enums"] if is_sim(api, enum) == sim]
    out += [cpp_struct(names, struct) for struct in structs_of(api) if is_sim(api, struct) == sim]
    out.append("\n}  // namespace cairn\n// clang-format on\n\n#endif\n")
    return "".join(out)


# Fields for the conformance test --------------------------------------------------------------------------------------

def test_fields(api):
    out = ["// Written by generate.py from api.json.\n#include <cairn/cairn.hpp>\n#include <cairn/sim.hpp>\n\n"
           "namespace cairn {\n"]
    for enum in api["enums"]:
        name = camel(enum["name"])
        table = "".join(f"      {{\"{v['name']}\", {name}::{enumerator(enum, v)}}},\n" for v in enum["values"])
        out.append(f"inline constexpr bool is_bits({name}) {{ return {'true' if enum['bits'] else 'false'}; }}\n"
                   f"inline const Constants<{name}>& constants_of({name}) {{\n  static const Constants<{name}> all = {{\n"
                   f"{table}  }};\n  return all;\n}}\n")
    for struct in structs_of(api):
        body = "".join(f"  visit(\"{f['name']}\", object.{f['name']}, {'true' if f['repeatable'] else 'false'});\n"
                       for f in values(struct))
        out.append("template <class T, class Visit, std::enable_if_t<std::is_same_v<std::remove_const_t<T>, "
                   f"{camel(struct['name'])}>, int> = 0>\nvoid for_each_field(T& object, Visit visit) {{\n{body}}}\n")
    table = "".join(f"      {{\"{v['name']}\", {v['name']}}},\n" for e in api["enums"] for v in e["values"])
    out.append("}  // namespace cairn\n\ninline const std::map<std::string, std::int64_t>& replayer_constants() {\n"
               f"  static const std::map<std::string, std::int64_t> all = {{\n{table}  }};\n  return all;\n}}\n")
    return "".join(out)


# Documentation of methods ---------------------------------------------------------------------------------------------

def sources():
    return sorted(path for path in HEADERS.glob("*.hpp") if not path.name.endswith("types.hpp"))


def find_methods():
    """C++'s name of each function of C that has a method: the function below its mark."""
    methods = {}
    for path in sources():
        owner, waiting = "", []
        for line in path.read_text(encoding="utf-8").split("\n"):
            block = re.match(r"class (\w+)", line)
            mark, method = MARK.match(line), re.match(r"\s*[^/\s].*?(~?\w+|operator\S)\(", line)
            if block:
                owner = block.group(1) + "::"
            elif line == "};":
                owner = ""
            if mark:
                waiting.append(mark.group(2))
            elif method and waiting:
                methods.update(dict.fromkeys(waiting, owner + method.group(1)))
                waiting = []
    # The owner calls it; a user calls close().
    destroyed = {name: camel(name.removesuffix("_destroy")) + "::close" for name in methods if name.endswith("_destroy")}
    return {**methods, **destroyed}


def method_doc(names, function):
    text = function["doc"] or ""
    errors = [(entry["status"], entry["when"]) for entry in function["errors"] if entry["when"] != "NULL"]
    if errors:
        text += "\n\nThrows Error: " + "; ".join(
            status + (f" ({when})" if when else "") for status, when in errors) + "."
    if function["complexity"]:
        text += "\n\nComplexity: " + function["complexity"].rstrip(".") + "."
    return text


def documented(functions, names, path):
    """The file with the documentation below each mark. Lines that begin with `//!` follow it and are written by hand."""
    lines, out = path.read_text(encoding="utf-8").split("\n"), []
    while lines:
        out.append(lines.pop(0))
        mark = MARK.match(out[-1])
        if not mark:
            continue
        if mark.group(2) not in functions:
            sys.exit(f"{path}: {mark.group(2)} is not in api.json")
        while re.match(r"\s*/// ?", lines[0]):
            lines.pop(0)
        out.append(names.comment(method_doc(names, functions[mark.group(2)]), mark.group(1)).rstrip("\n"))
    return "\n".join(out)


def implemented(api, methods):
    """The names of C that a user of the headers has: functions that have a mark and are called, generated types."""
    code = "\n".join(path.read_text(encoding="utf-8") for path in HEADERS.glob("*.hpp"))
    code = re.sub(r"//.*", "", code)
    names = {name for name in set(methods) | {s["init"] for s in api["structs"] if s["init"]}
             if re.search(rf"\b{name}\b", code)}
    for struct in structs_of(api):
        body = re.search(rf"struct CAIRN_CPP_SAME_BYTES {camel(struct['name'])} {{(.*?)\n}};", code, re.DOTALL)
        names |= {f"{struct['name']}.{f['name']}" for f in values(struct)
                  if body and f"  {field_type(f)} {f['name']}" in body.group(1)}
    names |= {v["name"] for e in api["enums"] for v in e["values"] if f" = {v['name']}," in code}
    names |= {c["name"] for c in api["constants"] if f" = {c['name']};" in code}
    return names | {"cairn_error.status", "cairn_error.message"}  # methods of Error


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--api", type=pathlib.Path, default=HERE.parent.parent / "src" / "api" / "api.json")
    arguments.add_argument("--check", action="store_true")
    arguments.add_argument("--fields", type=pathlib.Path)
    arguments = arguments.parse_args()
    api = json.loads(arguments.api.read_text(encoding="utf-8"))
    if arguments.fields:
        arguments.fields.write_text(test_fields(api), encoding="utf-8")
        return
    methods = find_methods()
    names = Names(api, methods)
    functions = {function["name"]: function for function in api["functions"]}
    files = {HEADERS / "types.hpp": types(api, names, False), HEADERS / "sim_types.hpp": types(api, names, True)}
    files.update({path: documented(functions, names, path) for path in sources()})
    differing = [path for path, text in files.items() if not path.exists() or path.read_text(encoding="utf-8") != text]
    if not arguments.check:
        for path in differing:
            path.write_text(files[path], encoding="utf-8")
            print(f"wrote {path.relative_to(HERE)}")
    have = implemented(api, methods)
    missing = bindings_check.missing(api, have) + bindings_check.unknown(api, have)
    for name in missing:
        print(f"the headers lack {name}", file=sys.stderr)
    if arguments.check:
        for path in differing:
            print(f"{path.relative_to(HERE)} is not what generate.py writes", file=sys.stderr)
        print(f"{len(bindings_check.required(api))} names of functions, fields and constants, of which {len(missing)} "
              f"are missing; {len(files)} files, of which {len(differing)} differ")
        sys.exit(1 if differing or missing else 0)


main()
