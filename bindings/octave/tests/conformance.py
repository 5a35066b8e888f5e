#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Replays the conformance scenarios through the package and compares with the output of the C replayer, bit for bit.

conformance.py write SCENARIOS WORK    writes WORK/replay_NAME.m for each scenario: its calls in the language of Octave
conformance.py compare SCENARIOS WORK C_OUTPUT
                                       compares WORK/NAME.out, what these files printed, with C_OUTPUT/NAME.json;
                                       WORK/constants.out holds the constants of the package (tests/constants.m)

The calls that it writes are those of a user of the package: methods, functions and options by name. It knows which by
generate.py, which wrote the package. Values come back as text (tests/recorder.m), and are turned here into what
tests/conformance/README.md asks for.
"""
import importlib.util
import json
import pathlib
import re
import struct
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]


def module(path):
    spec = importlib.util.spec_from_file_location(path.stem, path)
    loaded = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(loaded)
    return loaded


generate = module(HERE.parent / "generate.py")
bindings_check = module(ROOT / "src/api/bindings_check.py")
package = generate.Package(json.loads((ROOT / "src/api/api.json").read_text(encoding="utf-8")))
SEEN = set(generate.ONLY_C)  # names of C that the package was seen to have
CONSTANTS = {value["name"]: value["value"] for enum in package.enums.values() for value in enum["values"]}


# Values of a scenario as expressions of Octave.


def name_of(text):
    """$motions.0.velocity: the column 1 of the field velocity."""
    head, *path = text[1:].split(".")
    expression, column = f"names.{head}", None
    for part in path:
        if part.isdigit():
            column = int(part) + 1
        else:
            expression += f".{part}"
    return expression if column is None else f"{expression}(:, {column})"


def number(value):
    if isinstance(value, str):
        if value.startswith("$"):
            return name_of(value)
        if value.startswith("x"):
            return f"hex2num('{value[1:]}')"
        return {"nan": "NaN", "inf": "Inf", "-inf": "-Inf"}[value]
    return repr(value)


def identifier(value):
    return name_of(value) if value.startswith("$") else f"0x{int(value):016X}u64"


def constant(value):
    """Constants by their names in the scenario, in all the ways in which the package takes them."""
    if isinstance(value, list):
        return " + ".join(str(CONSTANTS[name]) for name in value) or "0"
    return name_of(value) if value.startswith("$") else f"'{value}'"


def matrix(values, rows, columns):
    if isinstance(values, str):
        return name_of(values)
    lines = [" ".join(number(v) for v in values[row * columns:(row + 1) * columns]) for row in range(rows)]
    return f"reshape([{'; '.join(lines)}], {rows}, {columns})"


def scalar(p, value):
    if isinstance(value, str) and value.startswith("$"):
        return name_of(value)
    kind = p["kind"]
    if kind == "enum":
        return constant(value)
    if kind == "bool":
        return "true" if value else "false"
    if kind == "text":
        return "'" + value.replace("'", "''") + "'"
    if p["base"] == "uint64_t":
        return identifier(value)
    return number(value)


def field(f, value):
    if f["kind"] == "struct":
        return an_object(package.structs[f["type"]], value)
    if not f["length"]:
        return scalar(f, value)
    side = generate.square_side(f["name"], f["length"])
    return matrix(value, side or f["length"], side or 1)


def an_object(struct, value):
    if isinstance(value, str):
        return name_of(value)
    fields = {f["name"]: f for f in struct["fields"]}
    return "struct(" + ", ".join(f"'{key}', {field(fields[key], v)}" for key, v in value.items()) + ")"


def columns(struct, values):
    """A list of structs: one struct, whose fields have a column for each."""
    if isinstance(values, str):
        return name_of(values)
    fields = {f["name"]: f for f in struct["fields"]}
    used = [key for key in fields if any(key in value for value in values)]
    parts = []
    for key in used:
        f = fields[key]
        length = f["length"] or 1
        side = generate.square_side(key, length)
        if not f["length"]:
            expression = "[" + " ".join(scalar(f, value.get(key, "0")) for value in values) + "]"
        elif side:
            pages = [matrix(value.get(key, [0.0] * length), side, side) for value in values]
            expression = f"cat(3, {', '.join(pages)})"
        else:
            expression = "[" + " ".join(matrix(value.get(key, [0.0] * length), length, 1) for value in values) + "]"
        parts.append(f"'{key}', {expression}")
    return f"struct({', '.join(parts)})" if parts else "[]"


def lengths(function, given):
    """The counts of a call, from the arrays whose length they are."""
    counts = {}
    for p in package.inputs(function):
        if p["role"] == "array" and p["length"].isidentifier() and not isinstance(given.get(p["name"], []), str):
            counts[p["length"]] = len(given.get(p["name"], []))
    return counts


def argument(p, given, counts):
    name = p["name"].rstrip("_")
    if name not in given:
        return "[]"
    value = given[name]
    if p["role"] == "handle":
        return name_of(value)
    if p["role"] == "callback":
        if value == "collect":
            return "record.log"
        rows = next(f for f in package.structs["cairn_custom"]["fields"] if f["name"] == "rows")
        return f"functions.{p['name']}_{value}({given['custom'].get('rows', rows['default'])})"
    if p["role"] == "object":
        return an_object(package.structs[p["type"]], value)
    if p["role"] != "array":
        return scalar(p, value)
    if isinstance(value, str) and value.startswith("$"):
        return name_of(value)
    if p["kind"] == "struct":
        return columns(package.structs[p["type"]], value)
    if p["base"] == "uint8_t":
        data = bytes.fromhex(value.removeprefix("bytes:"))
        return "uint8([" + " ".join(map(str, data)) + "])"
    if p["base"] == "uint64_t":
        return "[" + " ".join(map(identifier, value)) + "]" if value else "zeros(1, 0, 'uint64')"
    rows, width = (eval(text, {}, dict(counts)) for text in generate.dimensions(p["name"], p["length"]))
    return matrix(value, rows, width)


def names_and_values(struct, value):
    if isinstance(value, str):
        return [name_of(value)]
    fields = {f["name"]: f for f in struct["fields"]}
    return [text for key, v in value.items() for text in (f"'{key}'", field(fields[key], v))]


def the_call(call):
    """What a user writes for a call of C, and the names of what it gives."""
    function = package.functions[call["call"]]
    given = call.get("with", {})
    inputs, counts = package.inputs(function), lengths(function, given)
    arguments = [argument(p, given, counts) for p in inputs]
    if package.by_name(function):
        value = given.get(inputs[-1]["name"])
        arguments[-1:] = names_and_values(package.structs[inputs[-1]["type"]], value) if value is not None else []
    while arguments and arguments[-1] == "[]" and inputs[len(arguments) - 1]["optional"]:
        arguments.pop()
    if package.owner(function) and not function["name"].endswith("_create"):
        text = f"{arguments[0]}.{package.method_name(function)}({', '.join(arguments[1:])})"
    else:
        text = f"cairn.{package.method_name(function)}({', '.join(arguments)})"
    return text, [p["name"].rstrip("_") if p["role"] != "return" else "return" for p in package.outputs(function)]


def write(scenarios, work):
    for path in sorted(scenarios.glob("*.json")):
        scenario = json.loads(path.read_text(encoding="utf-8"))
        lines = [f"function replay_{path.stem}(record)", "names = struct();", "created = {};"]
        lines.append("functions = callbacks();")
        for call in scenario["calls"]:
            text, outputs = the_call(call)
            variables = [f"out_{name}" for name in outputs]
            left = f"[{', '.join(variables)}] = " if variables else ""
            lines += ["record.call();", "try", f"  {left}{text};"]
            lines += [f"  record.give('{name}', out_{name});" for name in outputs]
            for name, value in call.get("gives", {}).items():
                if isinstance(value, str) and value.startswith("$"):
                    lines.append(f"  names.{value[1:]} = out_{name};")
            created = [p["name"] for p in package.outputs(package.functions[call["call"]]) if p["role"] == "created"]
            lines += [f"  created{{end + 1}} = out_{name};" for name in created]
            lines += ["catch problem", "  record.fail(problem);", "end"]
        lines += ["for i = numel(created):-1:1", "  created{i}.close();", "end", "end"]
        (work / f"replay_{path.stem}.m").write_text("\n".join(lines) + "\n", encoding="utf-8")


# What Octave printed, as the output of a replayer.


def bits(hexadecimal):
    value = struct.unpack(">d", bytes.fromhex(hexadecimal))[0]
    return "nan" if value != value else f"x{hexadecimal}"


def transposed(values, rows, width):
    """Row-major from column-major."""
    return [values[column * rows + row] for row in range(rows) for column in range(width)]


def shown_scalar(p, values):
    value = values[0]
    kind, base = p["kind"], p.get("base")
    if kind == "bool":
        return value == "1"
    if kind == "enum":
        enum = package.enums[p["type"]]
        code = int(struct.unpack(">d", bytes.fromhex(value))[0])
        if enum["bits"]:
            return [v["name"] for v in enum["values"] if code & v["value"]]
        return next((v["name"] for v in enum["values"] if v["value"] == code), code)
    if base == "uint64_t":
        return str(int(value, 16))
    if p["kind"] == "integer":
        return int(struct.unpack(">d", bytes.fromhex(value))[0])
    return bits(value)


def shown_objects(struct_, value, count):
    """The elements of a struct whose fields have columns."""
    objects = [{} for _ in range(count)]
    names = [f["name"] for f in generate.shown(struct_)]
    SEEN.update(f"{struct_['name']}.{name}" for name in value)
    assert sorted(value) == sorted(names), (struct_["name"], sorted(value))
    for f in struct_["fields"]:
        if f["name"] not in value:
            continue
        if not f["repeatable"]:
            continue
        if f["kind"] == "struct":
            parts = shown_objects(package.structs[f["type"]], value[f["name"]], count)
        else:
            length = f["length"] or 1
            side = generate.square_side(f["name"], length)
            dims, values = value[f["name"]]["dims"], value[f["name"]]["values"]
            assert len(values) == length * count, (f["name"], dims)
            if side:
                assert dims[:2] == [side, side], dims
            elif length > 1:
                assert dims == [length, count], dims
            slices = [values[i * length:(i + 1) * length] for i in range(count)]
            if not f["length"]:
                parts = [shown_scalar(f, part) for part in slices]
            else:
                parts = [list(map(bits, transposed(part, side, side) if side else part)) for part in slices]
        for target, part in zip(objects, parts, strict=True):
            target[f["name"]] = part
    return objects


def count_of(struct_, value):
    first = generate.shown(struct_)[0]
    if first["kind"] == "struct":
        return count_of(package.structs[first["type"]], value[first["name"]])
    return len(value[first["name"]]["values"]) // (first["length"] or 1)


def shown_output(p, value):
    if p["kind"] == "text":
        return value["text"]
    if p["kind"] == "struct":
        struct_ = package.structs[p["type"]]
        if p["role"] == "array":
            return shown_objects(struct_, value, count_of(struct_, value))
        return shown_objects(struct_, value, 1)[0]
    values = value["values"]
    if p["role"] != "array":
        return shown_scalar(p, values)
    if p["base"] == "uint8_t":
        return "bytes:" + "".join(f"{int(v):02x}" for v in values)
    if p["base"] == "uint64_t":
        return [str(int(value, 16)) for value in values]
    rows, width = value["dims"]
    expected = generate.dimensions(p["name"], p["length"])
    if expected[0].isdigit() and "capacity" in p["length"]:
        assert rows == int(expected[0])
        return list(map(bits, values))  # a column for each point
    if p["length"].isdigit():
        assert [rows, width] == list(map(int, expected)), (p["name"], value["dims"])
    return list(map(bits, transposed(values, rows, width)))


def names_back(call, out):
    """Handles are shown by the names that the scenario gives them."""
    return call.get("gives", {}).get(out)


def element(call, lines):
    function = package.functions[call["call"]]
    result = {"call": call["call"]}
    gives = {}
    outputs = {p["name"].rstrip("_") if p["role"] != "return" else "return": p for p in package.outputs(function)}
    for line in lines:
        if line["what"] == "fail":
            SEEN.update(("cairn_error.status", "cairn_error.message"))
            result["status"], result["message"] = "CAIRN_ERROR_" + line["id"].removeprefix("cairn:"), line["message"]
            if line["id"] == "replay:aborting":  # the callback's own error
                result["status"], result["message"] = call.get("status"), call.get("message")
        elif line["what"] == "log":
            result.setdefault("log", []).append(line["line"])
        elif outputs[line["name"]]["kind"] == "handle":
            gives[line["name"]] = names_back(call, line["name"])
        else:
            gives[line["name"]] = shown_output(outputs[line["name"]], line["value"])
    if gives and "status" not in result:
        result["gives"] = gives
    return result


def constants(work):
    """The constants of the package, by their names in C; those with another value are left out."""
    names = {there: here for here, there in package.names.items() if here.startswith("CAIRN_")}
    values = {**CONSTANTS, **{c["name"]: int(c["value"]) for c in package.api["constants"]}}
    for line in (work / "constants.out").read_text(encoding="utf-8").splitlines():
        name, value = line.split()
        if values.get(names.get(name)) == int(value):
            yield names[name]
        else:
            print(f"{name} is {value}, which is not its value in C")


def compare(scenarios, work, of_c):
    wrong = calls = 0
    SEEN.update(constants(work))
    for path in sorted(scenarios.glob("*.json")):
        scenario = json.loads(path.read_text(encoding="utf-8"))
        reference = json.loads((of_c / path.name).read_text(encoding="utf-8"))
        groups = []
        for line in (work / f"{path.stem}.out").read_text(encoding="utf-8").splitlines():
            line = json.loads(line)
            if line["what"] == "call":
                groups.append([])
            else:
                groups[-1].append(line)
        if len(groups) != len(scenario["calls"]):
            sys.exit(f"{path.name}: {len(groups)} of {len(scenario['calls'])} calls were replayed")
        together = zip(scenario["calls"], groups, reference["calls"], strict=True)
        for index, (call, lines, expected) in enumerate(together):
            calls += 1
            SEEN.add(call["call"])
            got = element(call, lines)
            if got != expected:
                wrong += 1
                if wrong <= 20:
                    print(f"{path.name}, call {index}\n  C:      {json.dumps(expected)[:600]}\n"
                          f"  Octave: {json.dumps(got)[:600]}")
    missing = bindings_check.missing(package.api, SEEN)
    for name in missing:
        print(f"the package lacks {name}")
    print(f"{calls} calls, {wrong} differ; {len(bindings_check.required(package.api)) - len(missing)} names of the "
          f"interface, {len(missing)} missing")
    return 1 if wrong or missing else 0


if __name__ == "__main__":
    if sys.argv[1:2] == ["write"] and len(sys.argv) == 4:
        write(*map(pathlib.Path, sys.argv[2:]))
    elif sys.argv[1:2] == ["compare"] and len(sys.argv) == 5:
        sys.exit(compare(*map(pathlib.Path, sys.argv[2:])))
    else:
        sys.exit(__doc__)
