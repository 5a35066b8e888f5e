#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the conformance scenarios: the calls of scenarios/*.py, and the values that the C replayer gets for them.

make.py                  fails if the calls of a file *.json are not those of scenarios/
make.py --record REPLAY  writes all files; REPLAY is the C replayer, which runs the calls
"""

import json
import math
import pathlib
import re
import struct
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
from scenarios import (  # noqa: E402
    association, custom, every_option, first, library, maps, poses, sensors, submaps, systematic, teams, worlds, wrong)

FOLDER = pathlib.Path(__file__).resolve().parent
MODULES = [first, library, poses, sensors, association, custom, submaps, maps, systematic, teams, worlds, wrong,
           every_option]
BITS = re.compile("x[0-9a-f]{16}")


def decimal(value):
    """A value of a replayer's output as a scenario holds it: the bits of a double become the shortest number."""
    if isinstance(value, dict):
        return {key: decimal(item) for key, item in value.items()}
    if isinstance(value, list):
        return [decimal(item) for item in value]
    if isinstance(value, str) and BITS.fullmatch(value):
        number = struct.unpack(">d", bytes.fromhex(value[1:]))[0]
        return number if math.isfinite(number) else str(number)
    return value


def text(scenario):
    """A scenario as its file holds it: one call a line."""
    calls = ",\n".join(json.dumps(call) for call in scenario["calls"])
    head = ",\n".join(f'"{key}": {json.dumps(scenario[key])}' for key in ("name", "about"))
    return f'{{\n{head},\n"calls": [\n{calls}\n]\n}}\n'


def written():
    """The scenarios as scenarios/ writes them: calls without recorded values."""
    for module in MODULES:
        for make in module.SCENARIOS:
            made = make()
            yield {"name": made.name, "about": made.about, "calls": made.calls}


def without_values(scenario):
    """A scenario of a file without what was recorded."""
    calls = []
    for call in scenario["calls"]:
        names = {key: value for key, value in call.get("gives", {}).items() if is_name(value)}
        call = {key: value for key, value in call.items() if key not in ("gives", "message", "log")}
        if names:
            call["gives"] = names
        calls.append(call)
    return {**scenario, "calls": calls}


def is_name(value):
    return isinstance(value, str) and value.startswith("$")


def recorded(scenario, output, problems):
    """A scenario with the values that a replayer got."""
    calls = []
    for call, got in zip(scenario["calls"], output["calls"]):
        got = decimal(got)
        if got.get("status") != call.get("status"):
            problems.append(f"{scenario['name']}: {json.dumps(call)} gives {got.get('status')}, {got.get('message')}")
        gives = {**got.get("gives", {}), **call.get("gives", {})}
        calls.append({**call, **got, **({"gives": gives} if gives else {})})
    return {**scenario, "calls": calls}


def record(replay):
    with tempfile.TemporaryDirectory() as folder:
        calls = pathlib.Path(folder, "calls")
        output = pathlib.Path(folder, "output")
        for path in calls, output:
            path.mkdir()
        scenarios = list(written())
        for scenario in scenarios:
            (calls / f"{scenario['name']}.json").write_text(text(scenario), encoding="utf-8")
        run = subprocess.run([replay, "--record", calls, output])
        problems = []
        for number, scenario in enumerate(scenarios):
            got = json.loads((output / f"{scenario['name']}.json").read_text(encoding="utf-8"))
            scenarios[number] = recorded(scenario, got, problems)
    if problems or run.returncode:
        sys.exit("\n".join(["nothing was written:", *problems]))
    for scenario in scenarios:
        (FOLDER / f"{scenario['name']}.json").write_text(text(scenario), encoding="utf-8")


def check():
    names = set()
    for scenario in written():
        names.add(scenario["name"])
        path = FOLDER / f"{scenario['name']}.json"
        if not path.exists() or without_values(json.loads(path.read_text(encoding="utf-8"))) != scenario:
            sys.exit(f"{path.name} is not what scenarios/ says: run make.py --record REPLAY")
    for path in FOLDER.glob("*.json"):
        if path.stem not in names:
            sys.exit(f"{path.name} is in no file of scenarios/")


def main(arguments):
    if not arguments:
        check()
    elif len(arguments) == 2 and arguments[0] == "--record":
        record(arguments[1])
    else:
        sys.exit(__doc__)


if __name__ == "__main__":
    main(sys.argv[1:])
