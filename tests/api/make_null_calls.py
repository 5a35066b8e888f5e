#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes a C program that holds the marks of pointers to the library: make_null_calls.py api.json OUTPUT.c

Each function that can fail is called with NULL for one pointer and something valid for all others. A pointer that may
not be NULL must be refused by its name. One that may be NULL must not. tests/api/null_calls.h has what is valid.
"""
import json
import sys

POINTERS = ("handle", "created", "object", "array", "needed", "callback")  # roles whose NULL is looked at


def valid(parameter, initialised):
    """A C expression for an argument that is not refused at first sight. `initialised`: the struct of an _init."""
    role, kind, name = parameter["role"], parameter["kind"], parameter["name"]
    if role == "handle":
        return f"fresh.{parameter['type'][len('cairn_'):]}"
    if role == "created":
        return f"&created_{name}"
    if role in ("object", "array"):
        return f"valid_{parameter['type']}()" if kind == "struct" else f"valid_{parameter['base']}()"
    if role == "struct_size":
        return f"sizeof *valid_{initialised}()"
    return {"needed": "&needed", "callback": f"valid_{parameter['type']}", "user": "NULL", "release": "NULL",
            "error": "&error", "capacity": "1", "count": "1", "sensor": "0", "text": '""',
            "value": "0" if kind == "integer" and name != "vehicle" else "1"}[role]


PREPARED = ("cairn_pose", "cairn_filter_options")  # structs whose defaults are not valid here


def calls(function, initialised):
    for at, pointer in enumerate(function["parameters"]):
        if pointer["role"] not in POINTERS:
            continue
        arguments = ["NULL" if i == at else valid(p, initialised) for i, p in enumerate(function["parameters"])]
        created = [p for p in function["parameters"] if p["role"] == "created"]
        yield "  { begin();"
        for p in created:
            yield f"    {p['type']} *created_{p['name']} = NULL;"
        yield f"    const cairn_status status = {function['name']}({', '.join(arguments)});"
        for p in created:
            yield f"    {p['type']}_destroy(created_{p['name']});"
        yield f"    end(status, \"{function['name']}\", \"{pointer['name']}\", {int(pointer['optional'])}); }}"


def main(source, output):
    with open(source, encoding="utf-8") as file:
        api = json.load(file)
    initialised = {s["init"]: s["name"] for s in api["structs"]}
    lines = ["/* Made by tests/api/make_null_calls.py. */", '#include "null_calls.h"', ""]
    for struct in api["structs"]:
        name = struct["name"]
        if struct["role"] == "error":
            continue
        lines += [f"static {name} *valid_{name}(void) {{", f"  static {name} value;",
                  "  memset(&value, 0, sizeof value);"]
        if struct["init"]:
            lines.append(f"  {struct['init']}(&value, sizeof value, NULL);")
        elif struct["versioned"]:
            lines.append("  value.struct_size = sizeof value;")
        if name in PREPARED:
            lines.append(f"  prepare_{name}(&value);")
        lines += ["  return &value;", "}", ""]
    lines += ["static void all_calls(void) {"]
    for function in api["functions"]:
        if function["fallible"]:
            lines += calls(function, initialised.get(function["name"]))
    lines += ["}", "", "int main(void) {", "  all_calls();", "  return report();", "}"]
    with open(output, "w", encoding="utf-8") as file:
        file.write("\n".join(lines) + "\n")


if __name__ == "__main__":
    main(*sys.argv[1:])
