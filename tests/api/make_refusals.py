#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a C program that holds the library to what api.json says of inputs: make_refusals.py api.json OUTPUT.c

- Each function that can fail is called with NULL for one pointer and something valid for all others. A pointer that may
  not be NULL must be refused by its name. One that may be NULL must not.
- Each double, array of doubles and pose that a function reads gets NaN, and each double with a range what lies outside.
- Each field of options gets values outside its range, NaN, constants and booleans that do not exist, and a reserved
  field gets 1. A function that takes the options must refuse each by the field's name, and must not refuse the ends
  that belong to the range.

tests/api/refusals.h has what is valid, and counts.
"""
import json
import math
import re
import sys

from make_pins import number

POINTERS = ("handle", "created", "object", "array", "needed", "callback")  # roles whose NULL is looked at
PREPARED = ("cairn_pose", "cairn_filter_options", "cairn_merge_options", "cairn_fleet_options")  # by refusals.h


def valid(parameter, initialised):
    """A C expression for an argument that is not refused at first sight. `initialised`: the struct of an _init."""
    role, kind, name = parameter["role"], parameter["kind"], parameter["name"]
    if role == "handle":
        return f"fresh.{parameter['type'][len('cairn_'):]}"
    if role == "created":
        return f"&created_{name}"
    if role in ("object", "array") and kind == "number":
        return f"valid_doubles({ {'9': 3, '36': 6}.get(parameter['length'], 1)})"
    if role in ("object", "array"):
        return f"valid_{parameter['type']}()" if kind == "struct" else f"valid_{parameter['base']}()"
    if role == "struct_size":
        return f"sizeof *valid_{initialised}()"
    return {"needed": "&needed", "callback": f"valid_{parameter['type']}", "user": "NULL", "release": "NULL",
            "error": "&error", "capacity": "1", "count": "1", "sensor": "0", "text": '""',
            "value": "0" if kind == "integer" and name != "vehicle" else "1"}[role]


def call(function, initialised, replaced, expression):
    """C lines that call a function, with one argument replaced, and keep its `status`."""
    arguments = [expression if p is replaced else valid(p, initialised) for p in function["parameters"]]
    created = [p for p in function["parameters"] if p["role"] == "created"]
    yield "    begin();"
    for p in created:
        yield f"    {p['type']} *created_{p['name']} = NULL;"
    yield f"    const cairn_status status = {function['name']}({', '.join(arguments)});"
    for p in created:
        yield f"    {p['type']}_destroy(created_{p['name']});"
    yield "    end();"


def null_calls(api):
    initialised = {s["init"]: s["name"] for s in api["structs"]}
    for function in api["functions"]:
        for pointer in function["parameters"] if function["fallible"] else []:
            if pointer["role"] in POINTERS:
                yield "  {"
                yield from call(function, initialised.get(function["name"]), pointer, "NULL")
                yield f"    judge_null(status, \"{function['name']}\", \"{pointer['name']}\", " \
                      f"{int(pointer['optional'])});"
                yield "  }"


def constants_of(api, name):
    return next(enum["values"] for enum in api["enums"] if enum["name"] == name)


def bounds(api, field):
    """Both ends of a range: (figure, whether it belongs to the range); None: no end in figures."""
    match = re.fullmatch(r"([\[(])(.+), (.+)([\])])", field["range"] or "(-inf, inf)")

    def end(text, bracket):
        value = math.pi / 2 if text == "pi/2" else number(api, text)
        return None if value is None or math.isinf(value) else (value, bracket in "[]")
    return end(match.group(2), match.group(1)), end(match.group(3), match.group(4))


def values(api, field):
    """(C expression, whether it must be refused) for a field of options."""
    if field["role"] == "reserved":
        yield "1", True
    elif field["kind"] == "bool":
        yield from (("2", True), ("-1", True))
    elif field["kind"] == "enum":
        known = [value["value"] for value in constants_of(api, field["type"])]
        yield from ((str(value), True) for value in (min(known) - 1, max(known) + 1))
    elif field["kind"] in ("integer", "number"):
        lower, upper = bounds(api, field)
        whole = field["kind"] == "integer"
        special = number(api, field["default"] or "")  # a default may lie outside the range
        for bound, sign in ((lower, -1), (upper, 1)):
            if bound is None:
                continue
            value, belongs = bound
            step = 1 if whole else 1e-3 * max(1, abs(value))
            outside = value + sign * step if belongs or value == special else value
            if not whole or outside >= 0:
                yield repr(int(outside) if whole else outside), True
            if belongs and (not whole or value <= 4096):  # large ones take memory
                yield repr(int(value) if whole else value), False
        if not whole:
            yield "NAN", True


def parameter_calls(api):
    for function in api["functions"]:
        for p in function["parameters"] if function["fallible"] else []:
            if p["direction"] != "in":
                continue
            if p["kind"] == "number" and p["role"] == "value":
                tried = [value for value, refused in values(api, {**p, "default": None}) if refused]
            elif p["type"] == "cairn_pose" or p["kind"] == "number":
                tried = [f"not_a_number_{p['type']}()"]
            else:
                continue
            for value in tried:
                yield "  {"
                yield from call(function, None, p, value)
                yield f"    judge_parameter(status, \"{function['name']}\", \"{p['name']}\", \"{value}\");"
                yield "  }"


def option_calls(api):
    for struct in api["structs"]:
        if struct["role"] != "options":
            continue
        takers = [(f, p) for f in api["functions"] for p in f["parameters"]
                  if p["type"] == struct["name"] and p["role"] == "object" and p["const"]]
        for field in struct["fields"]:
            element = "[0]" if field["length"] else ""
            for value, refused in values(api, field):
                yield "  { int refusals = 0;"
                for function, parameter in takers:
                    yield "  {"
                    yield f"    {struct['name']} options = *valid_{struct['name']}();"
                    yield f"    options.{field['name']}{element} = {value};"
                    yield from call(function, None, parameter, "&options")
                    yield f"    refusals += names(status, \"{field['name']}\");"
                    yield "  }"
                yield f"    judge_option(refusals, {len(takers)}, {int(refused)}, " \
                      f"\"{struct['name']}.{field['name']}\", \"{value}\");"
                yield "  }"


def valid_structs(api):
    for struct in api["structs"]:
        name = struct["name"]
        if struct["role"] == "error":
            continue
        yield from (f"static {name} *valid_{name}(void) {{", f"  static {name} value;",
                    "  memset(&value, 0, sizeof value);")
        if struct["init"]:
            yield f"  {struct['init']}(&value, sizeof value, NULL);"
        elif struct["versioned"]:
            yield "  value.struct_size = sizeof value;"
        if name in PREPARED:
            yield f"  prepare_{name}(&value);"
        yield from ("  return &value;", "}", "")


def main(source, output):
    with open(source, encoding="utf-8") as file:
        api = json.load(file)
    lines = ["/* Made by tests/api/make_refusals.py. */", '#include "refusals.h"', "", *valid_structs(api),
             "static void null_calls(void) {", *null_calls(api), "}", "",
             "static void parameter_calls(void) {", *parameter_calls(api), "}", "",
             "static void option_calls(void) {", *option_calls(api), "}", "",
             "int main(void) {", "  null_calls();", "  parameter_calls();", "  option_calls();",
             "  return report();", "}"]
    with open(output, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
