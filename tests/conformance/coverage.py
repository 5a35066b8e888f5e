#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""coverage.py API_JSON: fails if a function, a constant, a field or an option is in no scenario."""

import json
import pathlib
import sys

FOLDER = pathlib.Path(__file__).resolve().parent

# README.md: the error parameter replaces them; the C replayer reads them after each failed call.
ONLY_C = {"cairn_last_message", "cairn_sim_last_message"}
# Constants that no call of a scenario can give or take for certain, and why.
NEVER_SEEN = {
    "CAIRN_ID_NONE": "written as the number that it is",
}


def texts(value):
    """All texts of a JSON value."""
    if isinstance(value, dict):
        value = list(value.values())
    if isinstance(value, list):
        return set().union(*map(texts, value)) if value else set()
    return {value} if isinstance(value, str) else set()


def main(path):
    api = json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
    functions = {function["name"]: function for function in api["functions"]}
    called, failed, seen, fields = set(), set(), set(), set()
    for file in sorted(FOLDER.glob("*.json")):
        for call in json.loads(file.read_text(encoding="utf-8"))["calls"]:
            (failed if "status" in call else called).add(call["call"])
            seen |= texts([call.get("with"), call.get("gives"), call.get("status")])
            for parameter in functions[call["call"]]["parameters"]:
                given = call.get("with", {}).get(parameter["name"])
                if isinstance(given, dict):
                    fields |= {(parameter["type"], key) for key in given}
    missing = []
    for function in api["functions"]:
        name = function["name"]
        if name in ONLY_C:
            continue
        if name not in called:
            missing.append(f"{name}: no scenario calls it with success")
        errors = {error["status"] for error in function["errors"]}
        if "CAIRN_ERROR_ARGUMENT" in errors and refuses_values(function) and name not in failed:
            missing.append(f"{name}: no scenario calls it wrongly")
    for enum in api["enums"]:
        for value in enum["values"]:
            if value["name"] not in seen and value["name"] not in NEVER_SEEN:
                missing.append(f"{value['name']}: no scenario takes or gives it")
    for struct in api["structs"]:
        if struct["role"] != "options":
            continue
        for field in struct["fields"]:
            if field["role"] == "value" and (struct["name"], field["name"]) not in fields:
                missing.append(f"{struct['name']}.{field['name']}: no scenario sets it")
    if missing:
        sys.exit("\n".join(missing))


def refuses_values(function):
    """Whether a call can be wrong in every language: it takes numbers, not only handles and room for outputs."""
    return any(parameter["direction"] == "in" and parameter["kind"] in ("number", "struct")
               for parameter in function["parameters"])


if __name__ == "__main__":
    main(*sys.argv[1:])
