#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the low level of the package from api.json, the description of the C interface: no struct field, constant or
signature is written by hand.

generate.py [API_JSON] [--check]

| file | content |
|---|---|
| cairn/_declarations.py | the C declarations for cffi, and which fields hold constants or booleans |
| cairn/constants.py | the types of constants, as enumerations |
| cairn/structs.py | options and reports, as typed dictionaries; steps of simulations, as classes |
| cairn/layouts.py | numpy types of the structs that arrays hold |

Without API_JSON, ../../src/api/api.json of the source tree is read. --check writes nothing, and fails if a file differs.
"""

import argparse
import json
import math
import pathlib
import re
import sys
import textwrap

HERE = pathlib.Path(__file__).resolve().parent
WIDTH = 120
LICENCE = "# SPDX-License-Identifier: BSD-3-Clause\n"
NUMPY = {"double": "f8", "int32_t": "i4", "uint32_t": "u4", "uint64_t": "u8"}
PYTHON = {"double": "float", "int32_t": "int", "uint32_t": "int", "uint64_t": "int"}


def camel(name):
    """cairn_filter_options -> FilterOptions"""
    return "".join(part.capitalize() for part in name.split("_")[1:])


def upper(name):
    """cairn_world_motion -> WORLD_MOTION"""
    return name.split("_", 1)[1].upper()


def members(enum):
    """[(name in Python, value), ...] of a type of constants. The name of the type is no part of a member's name."""
    prefix = enum["name"].upper() + "_"
    if not all(value["name"].startswith(prefix) for value in enum["values"]):
        prefix = enum["prefix"]
    return [(value["name"][len(prefix):], value) for value in enum["values"]]


class Text:
    """Documentation of the C interface in the names of Python."""

    def __init__(self, api):
        self.names = {struct["name"]: camel(struct["name"]) for struct in api["structs"]}
        for struct in api["structs"]:
            if struct["role"] == "plain" and struct["name"] != "cairn_pose":
                self.names[struct["name"]] = upper(struct["name"])
        for enum in api["enums"]:
            self.names[enum["name"]] = camel(enum["name"])
            for member, value in members(enum):
                self.names[value["name"]] = f"{camel(enum['name'])}.{member}"
            self.names[enum["prefix"] + "..."] = f"{camel(enum['name'])}"
        for handle in api["handles"]:
            self.names[handle["name"]] = camel(handle["name"])
            for function in api["functions"]:
                if function["name"].startswith(handle["name"] + "_"):
                    verb = function["name"][len(handle["name"]) + 1:]
                    self.names.setdefault(function["name"], camel(handle["name"]) + ("" if verb == "create" else "." + verb))
        self.names.update({"cairn_bool": "bool", "NULL": "None", "CAIRN_ID_NONE": "ID_NONE"})
        names = sorted(self.names, key=len, reverse=True)
        self.pattern = re.compile(r"(?<!\w)(?:" + "|".join(map(re.escape, names)) + r")(?!\w)")

    def __call__(self, text):
        text = self.pattern.sub(lambda found: self.names[found.group()], text or "")
        text = re.sub(r"\s*\\since \S+|\s*Set them by \S+_init first\.", "", text).strip()
        text = re.sub(r"Set them by \S+_init first; (\w)", lambda found: found.group(1).upper(), text)
        return text.replace("\\", "\\\\").replace('"""', "'''")


def docstring(text, indent):
    """A docstring that fits into the lines of the project."""
    if not text:
        return ""
    space = " " * indent
    if text[1:2].islower():  # a word, not a symbol
        text = text[0].upper() + text[1:]
    if not text.endswith((".", ":", ")")):
        text += "."
    one = f'{space}"""{text}"""'
    if len(one) <= WIDTH:
        return one + "\n"
    lines = textwrap.wrap(text, WIDTH - indent, initial_indent=space + '"""', subsequent_indent=space,
                          break_long_words=False, break_on_hyphens=False)
    if len(lines[-1]) + 3 > WIDTH:
        lines.append(space)
    return "\n".join(lines) + '"""\n'


def made(text):
    return f'{LICENCE}# Written by generate.py from the description of the C interface: do not edit.\n{text}'


def exported(names):
    """The list of a module's public names."""
    quoted = ", ".join(f'"{name}"' for name in sorted(names))
    return "\n".join(textwrap.wrap(f"__all__ = [{quoted}]", WIDTH, subsequent_indent="           ")) + "\n\n"


def is_bool(field):
    return field["type"] == "cairn_bool"


def shown(struct):
    """The fields that a Python caller sets and sees."""
    return [field for field in struct["fields"] if field["role"] not in ("struct_size", "reserved")]


def shape(field):
    """Shape of a field in numpy: covariances are square, all other arrays are flat."""
    length = field["length"]
    side = math.isqrt(length)
    return (side, side) if "covariance" in field["name"] and side * side == length and side > 1 else (length,)


# _declarations.py


def declarator(c, name):
    """A C declaration of a parameter: its type stands around its name."""
    kind, bracket, length = c.partition("[")
    space = "" if kind.endswith("*") else " "
    return f"{kind}{space}{name}{bracket}{length}"


def prototype(function, name):
    parameters = ", ".join(declarator(p["c"], p["name"]) for p in function["parameters"]) or "void"
    returns = function["returns"]
    result = returns.get("c", returns["type"])
    return f"{declarator(result, name)}({parameters});"


def c_structs(api):
    """The definitions of all structs, those first that others contain."""
    named = {struct["name"]: struct for struct in api["structs"]}
    done = {}

    def define(struct):
        if struct["name"] in done:
            return
        for field in struct["fields"]:
            if field["type"] in named:
                define(named[field["type"]])
        fields = " ".join(f"{field['type']} {field['name']}{'[%d]' % field['length'] if field['length'] else ''};"
                          for field in struct["fields"])
        done[struct["name"]] = f"typedef struct {struct['name']} {{ {fields} }} {struct['name']};"

    for struct in api["structs"]:
        define(struct)
    return list(done.values())


def declarations(api):
    lines = ["typedef int32_t cairn_bool;"]
    lines += [f"typedef {enum['base']} {enum['name']};" for enum in api["enums"]]
    lines += [f"typedef struct {handle['name']} {handle['name']};" for handle in api["handles"]]
    lines += c_structs(api)
    lines += ["typedef " + prototype(callback, f"(*{callback['name']})") for callback in api["callbacks"]]
    lines += [prototype(function, function["name"]) for function in api["functions"]]
    text = "\n".join("\n".join(textwrap.wrap(line, WIDTH - 1, subsequent_indent="  ", break_long_words=False,
                                              break_on_hyphens=False)) for line in lines)
    enums = {enum["name"]: camel(enum["name"]) for enum in api["enums"]}
    typed = {}
    for struct in api["structs"]:
        kinds = {field["name"]: "bool" if is_bool(field) else enums[field["type"]] for field in shown(struct)
                 if is_bool(field) or field["type"] in enums}
        if kinds:
            typed[struct["name"]] = kinds
    functions = {library["name"]: [f["name"] for f in api["functions"] if f["library"] == library["name"]]
                 for library in api["libraries"]}
    out = '"""The C declarations for cffi, and what they do not say: which fields hold constants or booleans."""\n\n'
    out += f"VERSION = {api['version']!r}\n"
    out += literal("SONAMES: dict[str, str]", {library["name"]: library["soname"] for library in api["libraries"]})
    out += f'CDEF = """\n{text}\n"""\n'
    out += "\n# Fields that hold a constant (the name of its type) or a yes or no.\n"
    out += literal("TYPED_FIELDS: dict[str, dict[str, str]]", typed)
    out += literal("OPTIONS: dict[str, str]", {camel(s["name"]): s["name"] for s in api["structs"] if s["init"]})
    out += literal("FUNCTIONS: dict[str, list[str]]", functions)
    return made(out)


def literal(name, value):
    """An assignment with one entry of a dictionary a line."""
    lines = [f"{name} = {{"]
    for key, item in value.items():
        lines += textwrap.wrap(f"{json.dumps(key)}: {json.dumps(item)},", WIDTH, initial_indent="    ",
                               subsequent_indent="        ", break_long_words=False, break_on_hyphens=False)
    return "\n".join([*lines, "}"]) + "\n"


# constants.py


def constants(api, text):
    out = '"""The constants of the C interface, as enumerations. An option takes a member, its value, or its name as a word:\n'
    out += 'join=Join.SPARSE, join=2 and join="sparse" are the same."""\n\nimport enum\n\n'
    out += exported(["ID_NONE", *(camel(enum["name"]) for enum in api["enums"])])
    for constant in api["constants"]:
        if constant["name"] == "CAIRN_ID_NONE":
            out += f"ID_NONE = {int(constant['value'])}\n{docstring(text(constant['doc']), 0)}"
    for enum in api["enums"]:
        base = "enum.IntFlag" if enum["bits"] else "enum.IntEnum"
        out += f"\n\nclass {camel(enum['name'])}({base}):\n{docstring(text(enum['doc']), 4)}\n"
        for member, value in members(enum):
            out += f"    {member} = {value['value']}\n{docstring(text(value['doc']), 4)}"
    return made(out)


# structs.py


def input_type(field, api):
    enums = {enum["name"]: enum for enum in api["enums"]}
    if is_bool(field):
        return "bool"
    if field["type"] in enums:
        enum = enums[field["type"]]
        words = ", ".join(f'"{member.lower()}"' for member, _ in members(enum))
        return f"{camel(enum['name'])} | Literal[{words}]"
    if field["type"] == "cairn_pose":
        return "PoseLike"
    return "ArrayLike" if field["length"] else PYTHON[field["base"]]


def output_type(field, api):
    if is_bool(field):
        return "bool"
    if field["type"] in {enum["name"] for enum in api["enums"]}:
        return camel(field["type"])
    if field["type"] == "cairn_pose":
        return "Pose"
    return "NDArray[np.float64]" if field["length"] else PYTHON[field["base"]]


def entry(field, kind, text):
    line = f"    {field['name']}: {kind}"
    if len(line) > WIDTH:
        head, _, words = line.partition("Literal[")
        line = "\n".join(textwrap.wrap(words, WIDTH, initial_indent=f"{head}Literal[\n        ", subsequent_indent="        "))
    return line + "\n" + docstring(text(field["doc"]), 4)


def steps(api):
    """The structs that a `next` function fills: the steps of a simulation."""
    return {parameter["type"] for function in api["functions"] if function["name"].endswith("_next")
            for parameter in function["parameters"] if parameter["kind"] == "struct" and parameter["role"] != "error"}


def structs(api, text):
    out = '"""The options and reports of the C interface, as typed dictionaries, and the steps of simulations.\n\n'
    out += "Options are keyword arguments: Filter(max_landmarks=500). One that is not given has the default of the library.\n"
    out += '"""\n\nfrom __future__ import annotations\n\nimport dataclasses\nfrom typing import TYPE_CHECKING, Literal, TypedDict\n\n'
    names = sorted({camel(field["type"]) for struct in api["structs"] if struct["role"] in ("options", "report")
                    for field in struct["fields"] if field["kind"] == "enum" and not is_bool(field)})
    imports = textwrap.fill(", ".join(names), WIDTH - 9, initial_indent="        ", subsequent_indent="        ")
    out += "if TYPE_CHECKING:\n    import numpy as np\n    from numpy.typing import ArrayLike, NDArray\n\n"
    out += "    from ._pose_type import Pose, PoseLike\n"
    out += f"    from .constants import (\n{imports})\n"
    out += "\n" + exported(camel(struct["name"]) for struct in api["structs"]
                           if struct["role"] in ("options", "report") and struct["name"] not in steps(api)).rstrip("\n") + "\n"
    for struct in api["structs"]:
        if struct["role"] not in ("options", "report"):
            continue
        doc = docstring(text(struct["doc"]), 4)
        fields = shown(struct)
        if struct["role"] == "options":
            body = "".join(entry(field, input_type(field, api), text) for field in fields)
            out += f"\n\nclass {camel(struct['name'])}(TypedDict, total=False):\n{doc}\n{body}"
        elif struct["name"] in steps(api):
            counts = [field for field in fields if not field["name"].endswith("_count")]
            body = "".join(entry(field, output_type(field, api), text) for field in counts)
            out += f"\n\n@dataclasses.dataclass\nclass {camel(struct['name'])}:\n{doc}\n{body}"
        else:
            body = "".join(entry(field, output_type(field, api), text) for field in fields)
            out += f"\n\nclass {camel(struct['name'])}(TypedDict):\n{doc}\n{body}"
    return made(out)


# layouts.py


def layouts(api, text):
    out = '"""The numpy types of the structs that arrays hold: frames, matches, landmarks. They have the layout of C, so\n'
    out += 'that no array is copied."""\n\nfrom __future__ import annotations\n\nfrom typing import Any\n\nimport numpy as np\n\n'
    plain = [struct for struct in api["structs"] if struct["role"] == "plain"]
    out += exported(upper(struct["name"]) for struct in plain) + "Layout = np.dtype[Any]\n"
    for struct in plain:
        fields = [field for field in struct["fields"] if field["role"] != "reserved"]
        formats = ", ".join(f'("{NUMPY[f["base"]]}", {shape(f)})' if f["length"] else f'"{NUMPY[f["base"]]}"' for f in fields)
        names = ", ".join(f'"{field["name"]}"' for field in fields)
        offsets = ", ".join(str(field["offset"]) for field in fields)
        out += f"\n{upper(struct['name'])}: Layout = np.dtype({{\n    \"names\": [{names}],\n    \"formats\": [{formats}],\n"
        out += f"    \"offsets\": [{offsets}], \"itemsize\": {struct['size']}}})\n"
        told = [f"{field['name']}: {text(field['doc'])}" for field in fields]
        out += docstring(text(struct["doc"]).rstrip(".") + ". Fields: " + "; ".join(told) + ".", 0)
    names = ", ".join(f'"{s["name"]}": {upper(s["name"])}' for s in plain)
    out += "\n# By the names of C.\n" + "\n".join(textwrap.wrap(f"OF_STRUCT: dict[str, Layout] = {{{names}}}", WIDTH,
                                                             subsequent_indent="    ", break_on_hyphens=False)) + "\n"
    return made(out)


def generated(api):
    """The text of each file, by its path."""
    text = Text(api)
    return {"cairn/_declarations.py": declarations(api), "cairn/constants.py": constants(api, text),
            "cairn/structs.py": structs(api, text), "cairn/layouts.py": layouts(api, text)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("api", nargs="?", type=pathlib.Path, default=HERE.parents[1] / "src" / "api" / "api.json")
    parser.add_argument("--check", action="store_true", help="write nothing; fail if a file differs")
    arguments = parser.parse_args()
    differ = []
    for name, content in generated(json.loads(arguments.api.read_text(encoding="utf-8"))).items():
        path = HERE / name
        if not path.is_file() or path.read_text(encoding="utf-8") != content:
            differ.append(name)
            if not arguments.check:
                path.write_text(content, encoding="utf-8")
    if arguments.check and differ:
        sys.exit(f"{', '.join(differ)}: not what {arguments.api} gives; run bindings/python/generate.py")


if __name__ == "__main__":
    main()
