#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a C program that holds headers and libraries to api.json: make_pins.py api.json OUTPUT.c

While it is compiled it checks size, alignment and offset of every struct and field, the value of every constant, and
the signature of every function and callback. When it runs it checks versions and documented defaults.
"""
import json
import math
import re
import sys


def declare(spelling, name):
    """A C declaration of `name` with the type `spelling`."""
    array = re.fullmatch(r"(.*?)\s*(\[\d+\])", spelling)
    return f"{array.group(1)} {name}{array.group(2)}" if array else f"{spelling} {name}"


def parameters(function):
    return ", ".join(declare(p["c"], p["name"]) for p in function["parameters"]) or "void"


def structs(api):
    for struct in api["structs"]:
        name = struct["name"]
        yield f"PIN(sizeof({name}) == {struct['size']});"
        yield f"PIN(_Alignof({name}) <= {struct['alignment']});"
        for field in struct["fields"]:
            place = f"{name}, {field['name']}"
            yield f"PIN(offsetof({place}) == {field['offset']});"
            yield f"PIN(sizeof((({name} *)0)->{field['name']}) == {field['size']});"


def literal(value):
    return f"UINT64_C({value})" if isinstance(value, str) else f"({value})"


def constants(api):
    for constant in api["constants"]:
        yield f"PIN({constant['name']} == {literal(constant['value'])});"
    for enum in api["enums"]:
        yield f"PIN(sizeof({enum['name']}) == sizeof({enum['base']}));"
        for value in enum["values"]:
            yield f"PIN({value['name']} == {literal(value['value'])});"


def signatures(api):
    for function in api["functions"]:
        name = function["name"]
        yield f"{function['returns']['c']} (*const pin_{name})({parameters(function)}) = {name};"
    for callback in api["callbacks"]:
        yield f"{callback['returns']['type']} pin_{callback['name']}({parameters(callback)});"
        yield f"const {callback['name']} pin_type_{callback['name']} = NULL;"
        yield f"PIN(_Generic(&pin_{callback['name']}, {callback['name']}: 1, default: 0));"


def number(api, text):
    """A documented default as a number; None for words: "identity"."""
    values = {value["name"]: value["value"] for enum in api["enums"] for value in enum["values"]}
    values["pi"] = math.pi
    match = re.fullmatch(r"(\S+)( degrees(?:/s)?)?", text)
    if not match:
        return None
    try:
        value = values.get(match.group(1))
        value = float(match.group(1)) if value is None else value
    except ValueError:
        return None
    return value * math.pi / 180 if match.group(2) else value


def defaults(api):
    for struct in api["structs"]:
        if not struct["init"]:
            continue
        yield f"  {{ {struct['name']} options; memset(&options, 0xff, sizeof options);"
        yield f"    CHECK({struct['init']}(&options, sizeof options, NULL) == CAIRN_OK, \"{struct['init']}\");"
        for field in struct["fields"]:
            name = f"{struct['name']}.{field['name']}"
            value = 0 if field["role"] == "reserved" else number(api, field["default"] or "")
            if value is None or field["kind"] == "struct":
                continue
            elements = [f"[{i}]" for i in range(field["length"])] if field["length"] else [""]
            for element in elements:
                yield f"    CHECK(NEAR(options.{field['name']}{element}, {value!r}), \"the default of {name}\");"
        yield "  }"


def main(source, output):
    with open(source, encoding="utf-8") as file:
        api = json.load(file)
    headers = [header for library in api["libraries"] for header in library["headers"]]
    lines = [f"/* Made by tests/api/make_pins.py from {source.split('/')[-1]}. */"]
    lines += [f"#include <{header}>" for header in headers]
    lines += ["#include <math.h>", "#include <stddef.h>", "#include <stdio.h>", "#include <string.h>", "",
              "#define PIN(condition) _Static_assert(condition, #condition)", ""]
    lines += [*structs(api), *constants(api), *signatures(api)]
    lines += ["", "static int failures;",
              "static void check(int good, const char *what) {",
              "  if (!good) { fprintf(stderr, \"wrong: %s\\n\", what); failures++; }", "}",
              "#define CHECK(good, what) check(good, what)",
              "#define NEAR(a, b) (fabs((double)(a) - (b)) <= 1e-12 * fabs((double)(b)))", "",
              "int main(void) {",
              f"  CHECK(strcmp(cairn_version(), \"{api['version']}\") == 0, \"cairn_version\");",
              f"  CHECK(cairn_version_number() == {api['version_number']}, \"cairn_version_number\");",
              "  CHECK(cairn_id_none() == CAIRN_ID_NONE, \"cairn_id_none\");"]
    lines += [*defaults(api)]
    lines += ["  return failures != 0;", "}"]
    with open(output, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
