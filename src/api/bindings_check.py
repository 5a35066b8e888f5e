#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""What a binding lacks of the interface that api.json describes. A binding's tests call it:

    problems = bindings_check.missing(api, names) + bindings_check.unknown(api, names)

or, where the binding is not in Python,

    bindings_check.py api.json NAMES        (NAMES: a file, or "-" for the standard input; one name a line)

Names are those of C: functions (cairn_filter_update), fields (cairn_wheels.radius), constants (CAIRN_JOIN_AUTO). A
binding need not show the fields `struct_size` and `reserved`.
"""
import json
import sys


def functions(api, libraries=None):
    """Names of the functions; of all libraries, or of some."""
    return [f["name"] for f in api["functions"] if libraries is None or f["library"] in libraries]


def fields(api, libraries=None):
    """Names of the fields that a user sees."""
    owner = {h["name"]: h["library"] for h in api["headers"]}
    return [f"{s['name']}.{f['name']}" for s in api["structs"] for f in s["fields"]
            if f["role"] not in ("struct_size", "reserved") and (libraries is None or owner[s["header"]] in libraries)]


def constants(api, libraries=None):
    """Names of the constants, those of enums included."""
    owner = {h["name"]: h["library"] for h in api["headers"]}
    alone = [c["name"] for c in api["constants"] if libraries is None or owner[c["header"]] in libraries]
    return alone + [v["name"] for e in api["enums"] if libraries is None or owner[e["header"]] in libraries
                    for v in e["values"]]


def required(api, libraries=None):
    return functions(api, libraries) + fields(api, libraries) + constants(api, libraries)


def missing(api, implemented_names, libraries=None):
    """What the binding lacks, in the order of the interface."""
    implemented = set(implemented_names)
    return [name for name in required(api, libraries) if name not in implemented]


def unknown(api, implemented_names):
    """What the binding has and the interface has not: wrong or outdated names."""
    hidden = {f"{s['name']}.{f['name']}" for s in api["structs"] for f in s["fields"]}
    return sorted(set(implemented_names) - set(required(api)) - hidden)


def main(arguments):
    if len(arguments) != 2:
        sys.exit(__doc__)
    with open(arguments[0], encoding="utf-8") as file:
        api = json.load(file)
    if arguments[1] == "-":
        names = sys.stdin.read().split()
    else:
        with open(arguments[1], encoding="utf-8") as file:
            names = file.read().split()
    problems = [f"the binding lacks {name}" for name in missing(api, names)]
    problems += [f"the interface has no {name}" for name in unknown(api, names)]
    print("\n".join(problems) or f"all {len(required(api))} names")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
