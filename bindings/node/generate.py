#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the low level of the npm package from api.json: generate.py API_JSON FOLDER

FOLDER/facts.ts gets constants, types of constants, and what the loader must know; FOLDER/api.ts gets structs, the
signatures of all functions, and the classes with a method for each function. Nothing is copied by hand, the comments
that an editor shows included. Rules for names: cairn_filter_predict_wheels is Filter.predictWheels, max_landmarks is
maxLandmarks, CAIRN_JOIN_SPARSE is Join.Sparse. Names that begin with a capital letter (T_body_camera) stay.
"""
import json
import re
import sys
import textwrap
from pathlib import Path

HEAD = "// SPDX-License-Identifier: BSD-3-Clause\n// Written by generate.py from api.json. Do not edit.\n"
CLASS_NAMES = {"cairn_map": "LandmarkMap"}  # Map belongs to JavaScript
RESERVED = {"new", "this", "function", "var", "in", "delete", "default", "class", "m", "h"}
INTEGERS = {"int32_t": "Int32", "uint32_t": "Uint32", "size_t": "Size", "uint64_t": "Uint64"}


def pascal(name):
    return "".join(word[:1].upper() + word[1:].lower() for word in name.split("_") if word)


def camel(name):
    if not name[0].islower():
        return name
    words = name.split("_")
    result = words[0] + "".join(word[:1].upper() + word[1:] for word in words[1:])
    return result + "_" if result in RESERVED else result


def bare(name):
    return name.removeprefix("cairn_")


def type_name(name):
    return CLASS_NAMES.get(name) or pascal(bare(name))


def quoted(text):
    return "'" + text.replace("\\", "\\\\").replace("'", "\\'") + "'"


def comment(text, indent="", tags=()):
    """A TSDoc comment. Braces, @ and > of C mean something to TSDoc; only tags may use them."""
    lines = []
    for paragraph in text.split("\n\n"):
        paragraph = re.sub(r"([{}@<>])", r"\\\1", " ".join(paragraph.split())).replace("*/", "*\\/")
        lines += textwrap.wrap(paragraph, 110) + [""]
    lines = lines[:-1]
    for tag in tags:
        lines += textwrap.wrap(tag.replace("*/", "*\\/"), 110)
    if len(lines) == 1:
        return f"{indent}/** {lines[0]} */\n"
    return f"{indent}/**\n" + "".join(f"{indent} * {line}".rstrip() + "\n" for line in lines) + f"{indent} */\n"


class Generator:
    def __init__(self, api):
        self.api = api
        self.structs = {s["name"]: s for s in api["structs"]}
        self.handles = {h["name"]: h for h in api["handles"]}
        self.callbacks = {c["name"]: c for c in api["callbacks"]}
        self.functions = {f["name"]: f for f in api["functions"]}
        self.read, self.written = set(), set()  # structs that come out, and that go in
        for user in api["functions"] + api["callbacks"]:
            for p in user["parameters"]:
                if p["kind"] == "struct" and p["role"] in ("object", "array"):
                    # What a callback gets in comes out of the library.
                    out = p["direction"] != "in" or user in api["callbacks"]
                    self.need(p["base"], self.read if out else self.written)
                    if p["direction"] == "inout":
                        self.need(p["base"], self.written)

    def need(self, name, names):
        names.add(name)
        for field in self.structs[name]["fields"]:
            if field["kind"] == "struct":
                self.need(field["base"], names)

    # --- facts.ts -----------------------------------------------------------------------------------------------

    def facts(self):
        out = [HEAD, "\n"]
        for c in self.api["constants"]:
            value = f"{c['value']}n" if c["type"] == "uint64_t" else str(c["value"])
            out.append(comment(c["doc"]) + f"export const {bare(c['name'].lower()).upper()} = {value};\n\n")
        for e in self.api["enums"]:
            out.append(comment(e["doc"]) + f"export enum {type_name(e['name'])} {{\n")
            for v in e["values"]:
                out.append(comment(v["doc"], "  "))
                out.append(f"  {pascal(v['name'].removeprefix(e['prefix']))} = {v['value']},\n")
            out.append("}\n\n")
        error = self.structs["cairn_error"]
        out.append("/** The layout of the struct that says why a call failed.\n * @internal */\n")
        out.append(f"export const ERROR = {{ size: {error['size']}")
        for field in error["fields"]:
            out.append(f", {camel(field['name'])}: {{ offset: {field['offset']}, size: {field['size']} }}")
        out.append(" } as const;\n\n")
        out.append("/** What the loader must know.\n * @internal */\n")
        out.append(f"export const API = {{ version: {quoted(self.api['version'])}, "
                   f"versionNumber: {self.api['version_number']} }} as const;\n\n")
        out.append("/** The libraries.\n * @internal */\nexport const LIBRARIES = {\n")
        for library in self.api["libraries"]:
            out.append(f"  {library['name']}: {{ soname: {quoted(library['soname'])} }},\n")
        out.append("} as const;\n")
        return "".join(out)

    # --- types --------------------------------------------------------------------------------------------------

    def scalar_type(self, kind, base, name):
        if kind == "bool":
            return "boolean"
        if kind == "enum":
            return type_name(name)
        return "bigint" if base == "uint64_t" else "number"

    def field_type(self, field, output):
        if field["kind"] == "struct":
            return type_name(field["base"]) + ("" if output else "Input")
        if field["length"]:
            return "Float64Array" if output else "Numbers"
        return self.scalar_type(field["kind"], field["base"], field["type"])

    @staticmethod
    def visible(struct):
        return [f for f in struct["fields"] if f["role"] not in ("struct_size", "reserved")]

    @staticmethod
    def optional(struct, field):
        """Options have defaults. Of other structs only a field of which zeros mean "none" may be missing."""
        return struct["init"] is not None or (field["length"] and "all zero:" in field["doc"])

    def field_comment(self, field):
        facts = [f"unit: {field['unit']}" for _ in [0] if field.get("unit") and field["unit"] != "1"]
        facts += [f"range: {field['range']}" for _ in [0] if field["range"]]
        return comment(field["doc"] + (f" ({'; '.join(facts)})" if facts else ""), "  ")

    def struct(self, struct):
        name = type_name(struct["name"])
        fields = self.visible(struct)
        out = []
        if struct["name"] in self.read:
            out.append(comment(struct["doc"]) + f"export interface {name} {{\n")
            for f in fields:
                out.append(self.field_comment(f) + f"  {camel(f['name'])}: {self.field_type(f, True)};\n")
            out.append("}\n\n")
            out.append(f"function read{name}(m: Memory, at: number): {name} {{\n  return {{\n")
            for f in fields:
                out.append(f"    {camel(f['name'])}: {self.read_field(f)},\n")
            out.append("  };\n}\n\n")
        if struct["name"] in self.written:
            out.append(comment(struct["doc"]) + f"export interface {name}Input {{\n")
            for f in fields:
                mark = "?" if self.optional(struct, f) else ""
                more = " | undefined" if mark else ""
                out.append(self.field_comment(f) +
                           f"  readonly {camel(f['name'])}{mark}: {self.field_type(f, False)}{more};\n")
            out.append("}\n\n")
            out.append(self.writer(struct, name, fields))
        return "".join(out)

    def read_field(self, field):
        at = f"at + {field['offset']}" if field["offset"] else "at"
        if field["kind"] == "struct":
            return f"read{type_name(field['base'])}(m, {at})"
        if field["length"]:
            return f"m.doubles({at}, {field['length']})"
        return self.read_scalar(field["kind"], field["base"], at)

    def read_scalar(self, kind, base, at):
        if kind == "bool":
            return f"m.int32({at}) !== 0"
        if kind == "number":
            return f"m.double({at})"
        return f"m.{INTEGERS[base].lower()}({at})"

    def writer(self, struct, name, fields):
        required = [f for f in fields if not self.optional(struct, f)]
        out = [f"function write{name}(m: Memory, at: number, o: {name}Input): void {{\n"]
        if required:
            out.append("  let seen = 0;\n")
        out.append("  for (const key in o) {\n    switch (key) {\n")
        for f in fields:
            key = camel(f["name"])
            at = f"at + {f['offset']}" if f["offset"] else "at"
            value = f"o.{key}"
            if f["kind"] == "struct":
                put = f"putStruct(m, {at}, write{type_name(f['base'])}, {value}, '{key}')"
            elif f["length"]:
                put = f"putDoubles(m, {at}, {value}, {f['length']}, '{key}')"
            elif f["kind"] == "number":
                put = f"putDouble(m, {at}, {value}, '{key}')"
            elif f["kind"] == "bool":
                put = f"putBool(m, {at}, {value}, '{key}')"
            else:
                put = f"put{INTEGERS[f['base']]}(m, {at}, {value}, '{key}')"
            out.append(f"      case '{key}':\n")
            if self.optional(struct, f):
                out.append(f"        if ({value} !== undefined) {put};\n")
            else:
                out.append(f"        {put};\n        seen |= {1 << required.index(f)};\n")
            out.append("        break;\n")
        out.append(f"      default:\n        unknownField('{name}', key);\n    }}\n  }}\n")
        if required:
            mask = (1 << len(required)) - 1
            names = ", ".join(quoted(camel(f["name"])) for f in required)
            out.append(f"  if (seen !== {mask}) missingField(seen, [{names}]);\n")
        out.append("}\n\n")
        return "".join(out)

    # --- signatures ---------------------------------------------------------------------------------------------

    @staticmethod
    def native_type(p):
        if p["role"] == "text":
            return "str"
        if p["pointers"] or p["kind"] in ("handle", "callback", "void"):
            return "void *"
        return p["base"]

    def native_result(self, f):
        returns = f["returns"]
        if returns["kind"] == "void":
            return "void", "unknown"
        if returns["kind"] == "text":
            return "str", "string"
        if returns["kind"] == "handle":
            return "void *", "bigint | null"
        return returns["base"], "number | bigint" if returns["base"] == "uint64_t" else "number"

    def table(self, library):
        out = [f"function bind_{library}() {{\n"
               f"  const library = load(LIBRARIES.{library}.soname);\n  return {{\n"]
        for f in self.api["functions"]:
            if f["library"] != library:
                continue
            native, result = self.native_result(f)
            types = ", ".join(quoted(self.native_type(p)) for p in f["parameters"])
            out.append(f"    {f['name']}: library.bind<{result}>({quoted(f['name'])}, {quoted(native)}, [{types}]),\n")
        out.append("  };\n}\n\n")
        return "".join(out)

    def native(self, f):
        return f"{'C' if f['library'] == 'cairn' else 'sim()'}.{f['name']}"

    # --- callbacks ----------------------------------------------------------------------------------------------

    def callback(self, c):
        name = pascal(bare(c["name"]).removesuffix("_fn"))
        answers = c["returns"]["role"] == "answer"
        shown = [p for p in c["parameters"] if p["role"] != "user"]
        user = next(p for p in c["parameters"] if p["role"] == "user" or p["base"] == "void")
        shown = [p for p in shown if p is not user]

        def kind(p):
            if p["kind"] == "struct":
                return type_name(p["base"])
            return "string" if p["kind"] == "text" else "Float64Array"

        doc = re.sub(r"\s*0: .*", "", c["returns"]["doc"]) if not answers else (
            "\\@returns true: all values are written. false: there is none, so the observation is refused. What it "
            "throws aborts the whole call, which throws it again and changes nothing.")
        out = [comment(c["doc"], "", [f"@param {camel(p['name'])} - {p.get('doc', '')}" for p in shown] +
                       [doc.replace("\\@", "@")] * answers)]
        parameters = ", ".join(f"{camel(p['name'])}: {kind(p)}" for p in shown)
        out.append(f"export type {name} = ({parameters}) => {'boolean' if answers else 'void'};\n\n")
        natives = ", ".join(quoted("str" if p["kind"] == "text" else "void *") for p in c["parameters"])
        result = c["returns"]["type"]
        out.append(f"const pointer{name} = callback({quoted(result)}, [{natives}], "
                   f"({', '.join('$' + camel(p['name']) for p in c['parameters'])}) =>\n")
        out.append(f"  {'answer' if answers else '{ notify'}(${camel(user['name'])}, (entry) => {{\n")
        after = []
        for p in shown:
            local = camel(p["name"])
            if p["kind"] == "struct":
                out.append(f"    const {local} = read{type_name(p['base'])}(copyIn(${local}, "
                           f"{self.structs[p['base']]['size']}), 0);\n")
            elif p["kind"] == "text":
                out.append(f"    const {local} = String(${local});\n")
            else:
                length = re.sub(r"\w+\.(\w+)", lambda match: f"entry.field('{match[1]}')", p["length"])
                if p["direction"] == "in":
                    out.append(f"    const {local} = copyIn(${local}, 8 * {length}).doubles(0, {length});\n")
                else:
                    out.append(f"    const {local} = new Float64Array({length}).fill(NaN);\n")
                    after.append(f"    if (seen) copyOut(${local}, {local});\n")
        call = f"(entry.function({quoted(c['name'])}) as {name})({', '.join(camel(p['name']) for p in shown)})"
        if answers:
            out.append(f"    const seen = yes({call});\n" + "".join(after) + "    return seen;\n")
        else:
            out.append(f"    {call};\n")
        out.append("  }),\n);\n\n" if answers else "  }); },\n);\n\n")
        return "".join(out)

    # --- functions ----------------------------------------------------------------------------------------------

    def plan(self, f):
        """What a function takes and gives in TypeScript, and how: arguments, preparation, native arguments, results."""
        arguments, prepare, natives, results, asks = [], [], [], [], []
        counts = {}  # count parameter -> the argument whose length it is
        for p in f["parameters"]:
            if p["role"] == "array" and p["direction"] == "in" and p["length"] in {
                    q["name"] for q in f["parameters"] if q["role"] == "count"}:
                counts.setdefault(p["length"], p)
        entry = None
        for p in f["parameters"]:
            name, local, role = camel(p["name"]), "$" + camel(p["name"]), p["role"]
            if role == "error":
                natives.append("m.error")
            elif role == "handle":
                if p is f["parameters"][0] and f["parameters"][0]["kind"] == "handle":
                    natives.append("h.pointer")
                else:
                    arguments.append((p, name, type_name(p["base"]), False))
                    natives.append(f"handleOf({name}, {type_name(p['base'])}, '{name}').pointer")
            elif role in ("value", "sensor"):
                kind = self.scalar_type(p["kind"], p["base"], p["type"])
                arguments.append((p, name, kind, False))
                if p["kind"] == "number":
                    natives.append(f"double({name}, '{name}')")
                else:
                    natives.append(f"{INTEGERS[p['base']][0].lower() + INTEGERS[p['base']][1:]}({name}, '{name}')")
            elif role == "text":
                arguments.append((p, name, "string", False))
                natives.append(f"text({name}, '{name}')")
            elif role == "count":
                natives.append(f"$n_{camel(counts[p['name']]['name'])}")
            elif role in ("created", "object", "array", "needed"):
                if p["direction"] == "in":
                    self.plan_input(f, p, name, local, arguments, prepare, natives, counts)
                else:
                    self.plan_output(f, p, name, local, arguments, prepare, natives, results, asks)
            elif role == "capacity":
                natives.append(("0", "needed"))
            elif role == "struct_size":
                natives.append(str(self.structs[f["parameters"][0]["base"]]["size"]))
            elif role == "callback":
                callback = pascal(bare(p["base"]).removesuffix("_fn"))
                arguments.append((p, name, callback, p["optional"]))
                missing = f"{name} === null || {name} === undefined"
                natives.append(f"{missing} ? null : pointer{callback}()" if p["optional"] else f"pointer{callback}()")
            elif role == "user":
                entry = p
                natives.append("entry === null ? null : entry.id")
            elif role == "release":
                natives.append("entry === null ? null : pointerRelease()")
        if entry is not None:
            functions = ", ".join(
                f"{q['base']}: {camel(q['name'])}" for q in f["parameters"] if q["role"] == "callback")
            described = next((q for q in f["parameters"] if q["kind"] == "struct" and q["role"] == "object"
                              and self.structs[q["base"]]["init"]), None)
            fields = "{}"
            if described:
                used = {match for q in f["parameters"] if q["role"] == "callback"
                        for r in self.callbacks[q["base"]]["parameters"]
                        for match in re.findall(described["base"] + r"\.(\w+)", r["length"] or "")}
                offsets = {x["name"]: x["offset"] for x in self.structs[described["base"]]["fields"]}
                fields = "{ " + ", ".join(
                    f"{x}: m.uint32(${camel(described['name'])} + {offsets[x]})" for x in sorted(used)) + " }"
            owner = "this, h" if f["parameters"][0]["role"] == "handle" else "null, thrown"
            prepare.append(f"entry = hold({owner}, {{ {functions} }}, {fields});")
        return arguments, prepare, natives, results, asks, entry

    def plan_input(self, f, p, name, local, arguments, prepare, natives, counts):
        optional = p["optional"] or (p["kind"] == "struct" and self.structs[p["base"]]["role"] == "options"
                                     and p["role"] == "object")
        guard = f"{name} === null || {name} === undefined ? null : " if p["optional"] else ""
        where = f"{local} === null ? null : m.address({local})" if p["optional"] else f"m.address({local})"
        if p["kind"] == "struct" and p["role"] == "object":
            struct = self.structs[p["base"]]
            kind = type_name(p["base"]) + "Input"
            arguments.append((p, name, kind, optional))
            if struct["init"]:
                init = self.functions[struct["init"]]
                prepare.append(f"const {local} = {guard}writeOptions(m, {struct['size']}, {self.native(init)}, "
                               f"write{type_name(p['base'])}, {name}, '{name}');")
            else:
                prepare.append(f"const {local} = {guard}writeStruct(m, {struct['size']}, write{type_name(p['base'])}, "
                               f"{name}, '{name}');")
        elif p["kind"] == "struct":
            struct = self.structs[p["base"]]
            arguments.append((p, name, f"readonly {type_name(p['base'])}Input[]", optional))
            prepare.append(f"const $n_{name} = count({name}, '{name}');")
            prepare.append(f"const {local} = writeStructs(m, {struct['size']}, write{type_name(p['base'])}, "
                           f"{name}, '{name}');")
        else:
            kinds = {"double": ("Numbers", "Doubles"), "uint64_t": ("BigInts", "Uint64s"),
                     "uint8_t": ("Bytes", "Bytes")}
            kind, put = kinds[p["base"]]
            arguments.append((p, name, kind, optional))
            if p["length"] in counts and counts[p["length"]] is p:
                prepare.append(f"const $n_{name} = count({name}, '{name}');")
            length = re.sub(r"[a-z_]+", lambda match: "$n_" + camel(counts[match[0]]["name"]), p["length"])
            prepare.append(f"const {local} = {guard}in{put}(m, {name}, {length}, '{name}');")
            where = f"m.pass({local})"
        natives.append(where)

    def plan_output(self, f, p, name, local, arguments, prepare, natives, results, asks):
        capacity = next((q["name"] for q in f["parameters"] if q["role"] == "capacity"), None)
        if p["role"] == "needed":
            asks.append(p)
            prepare.append(f"const {local} = m.alloc(8);")
            natives.append(f"m.address({local})")
        elif p["role"] == "created":
            prepare.append(f"const {local} = m.alloc(8);")
            natives.append(f"m.address({local})")
            results.append((p, name, type_name(p["base"]), f"m.uint64({local})"))
        elif p["role"] == "array" and capacity and re.search(rf"\b{capacity}\b", p["length"]):
            length = re.sub(rf"\b{capacity}\b", "needed", p["length"])
            if p["kind"] == "struct":
                struct, kind = self.structs[p["base"]], type_name(p["base"])
                asks.append(f"const {local} = fresh({struct['size']} * {length});")
                results.append((p, name, f"{kind}[]", f"readStructs({local}, 0, {struct['size']}, read{kind}, needed)"))
                natives.append(("null", f"{local}.u8"))
            else:
                kind = {"double": "Float64Array", "uint64_t": "BigUint64Array", "uint8_t": "Uint8Array"}[p["base"]]
                asks.append(f"const {local} = new {kind}(room({length}, {kind}.BYTES_PER_ELEMENT));")
                results.append((p, name, kind, local))
                natives.append(("null", local))
        elif p["role"] == "array" and p["kind"] == "struct":
            struct, kind = self.structs[p["base"]], type_name(p["base"])
            source = next(q for q in f["parameters"] if q["role"] == "array" and q["direction"] == "in"
                          and q["length"] == p["length"])
            length = "$n_" + camel(source["name"])
            prepare.append(f"const {local} = m.alloc({struct['size']} * {length});")
            natives.append(f"m.address({local})")
            results.append((p, name, f"{kind}[]", f"readStructs(m, {local}, {struct['size']}, read{kind}, {length})"))
        elif p["role"] == "array":
            prepare.append(f"const {local} = m.alloc({8 * int(p['length'])});")
            natives.append(f"m.address({local})")
            results.append((p, name, "Float64Array", f"m.doubles({local}, {p['length']})"))
        elif p["kind"] == "struct":
            struct, kind = self.structs[p["base"]], type_name(p["base"])
            if p["direction"] == "inout":
                arguments.append((p, name, kind + "Input", True))
                init = self.functions[struct["init"]]
                prepare.append(f"const {local} = writeOptions(m, {struct['size']}, {self.native(init)}, "
                               f"write{kind}, {name}, '{name}');")
            else:
                prepare.append(f"const {local} = m.alloc({struct['size']});")
                if struct["versioned"] and not f["name"] == struct["init"]:
                    prepare.append(f"m.setUint32({local}, {struct['size']});")
            natives.append(f"m.address({local})")
            results.append((p, name, kind, f"read{kind}(m, {local})"))
        else:
            prepare.append(f"const {local} = m.alloc(8);")
            natives.append(f"m.address({local})")
            results.append((p, name, self.scalar_type(p["kind"], p["base"], p["type"]),
                            self.read_scalar(p["kind"], p["base"], local)))

    def result(self, results):
        if not results:
            return "void", None
        if len(results) == 1:
            return results[0][2], results[0][3]
        return ("{ " + "; ".join(f"{name}: {kind}" for _, name, kind, _ in results) + " }",
                "{ " + ", ".join(f"{name}: {value}" for _, name, _, value in results) + " }")

    def documentation(self, f, arguments, results, indent, asynchronous=False):
        tags = []
        for p, name, _, _ in arguments:
            facts = [f"unit: {p['unit']}" for _ in [0] if p.get("unit") and p["unit"] != "1"]
            facts += [f"range: {p['range']}" for _ in [0] if p["range"]]
            if facts:
                tags.append(f"@param {name} - {re.sub(r'([<>{}])', chr(92) * 2 + r'1', '; '.join(facts))}")
        for e in f["errors"]:
            when = re.sub(r"([<>{}@])", r"\\\1", e["when"])
            tags.append(f"@throws CairnError {e['status']}{': ' + when if when else ''}")
        doc = f["doc"]
        if asynchronous:
            doc = f"Like {camel(self.member(f))}, in a thread of its own: the event loop goes on.\n\n" + doc
        if f["complexity"] and f["complexity"] != "O(1)":
            doc += f"\n\nComplexity: {f['complexity']}."
        return comment(doc, indent, tags)

    def member(self, f):
        handle = self.handle_of(f)
        return bare(f["name"])[len(bare(handle)) + 1:] if handle else bare(f["name"])

    def handle_of(self, f):
        """The class of which a function is a method."""
        if f["parameters"] and f["parameters"][0]["role"] == "handle":
            return f["parameters"][0]["base"]
        return None

    def body(self, f, asynchronous, indent, creates=None):
        arguments, prepare, natives, results, asks, entry = self.plan(f)
        method = self.handle_of(f)
        changes = method and f["parameters"][0].get("changes")
        others = [p for p in f["parameters"][1:] if p["role"] == "handle"]
        out = []
        if method:
            more = "".join(f", handleOf({camel(p['name'])}, {type_name(p['base'])}, '{camel(p['name'])}')"
                           for p in others)
            out.append(f"const h = enter(this, {str(bool(changes)).lower()}{more});")
        elif entry:
            out.append("const thrown: Thrown = { thrown: null };")
        out.append(f"const m = acquire({str(asynchronous).lower()});")
        if entry:
            out.append("let entry: Entry | null = null;")
        out.append("try {")
        out += ["  " + line for line in prepare]
        owner = "h" if method else "thrown" if entry else "null"

        def call(choice):
            chosen = ", ".join(n[choice] if isinstance(n, tuple) else n for n in natives)
            if asynchronous:
                return f"  check(await callAsync({self.native(f)}, [{chosen}]), m, {owner});"
            return f"  check({self.native(f)}({chosen}), m, {owner});"

        if asks:
            needed = next(a for a in asks if isinstance(a, dict))
            out.append(call(0))
            out.append(f"  const needed = m.size(${camel(needed['name'])});")
            out += ["  " + a for a in asks if not isinstance(a, dict)]
        out.append(call(1))
        if entry and entry["released_by"]:
            out.append("  entry?.keep();")
        kind, value = self.result(results)
        if creates:
            destroy = self.functions[self.handles[creates]["destroy"]]
            value = f"new Handle({value}, {self.native(destroy)}, '{bare(creates)}')"
            kind = "Handle"
        elif results and results[0][0]["role"] == "created":
            base = results[0][0]["base"]
            destroy = self.functions[self.handles[base]["destroy"]]
            value = f"new {type_name(base)}(new Handle({value}, {self.native(destroy)}, '{bare(base)}'))"
        if value:
            out.append(f"  return {value};")
        out.append("} finally {")
        if entry:
            out.append("  entry?.settle();")
        out.append("  release(m);")
        if method:
            more = "".join(f", handleOf({camel(p['name'])}, {type_name(p['base'])}, '{camel(p['name'])}')"
                           for p in others)
            out.append(f"  leave(this, {str(bool(changes)).lower()}{more});")
        out.append("}")
        return arguments, results, kind, "".join(indent + line + "\n" for line in out)

    @staticmethod
    def signature(arguments):
        shown = []
        for index, (p, name, kind, optional) in enumerate(arguments):
            last = all(more[3] for more in arguments[index:])
            if not optional:
                shown.append(f"{name}: {kind}")
            elif p["optional"]:
                shown.append(f"{name}?: {kind} | null" if last else f"{name}: {kind} | null | undefined")
            else:
                shown.append(f"{name}: {kind} = {{}}" if last else f"{name}: {kind}")
        return ", ".join(shown)

    def simple(self, f, arguments_of):
        """The expression of a function that cannot fail."""
        returns = f["returns"]
        value = f"{self.native(f)}({', '.join(arguments_of)})"
        if returns["base"] == "uint64_t":
            value = f"BigInt({value})"
        if returns["kind"] == "bool":
            value = f"{value} !== 0"
        return value

    def free_function(self, f):
        name = bare(f["name"])
        if f["name"].endswith("_last_message"):
            return ""  # the message of a thread, for C: here the error has it
        name = camel(name.removesuffix("_init") + "_defaults" if name.endswith("_init") else name)
        if f["fallible"]:
            arguments, results, kind, body = self.body(f, False, "  ")
            return (self.documentation(f, arguments, results, "") +
                    f"export function {name}({self.signature(arguments)}): {kind} {{\n{body}}}\n\n")
        arguments, _, natives, _, _, _ = self.plan(f)
        returns = f["returns"]
        kind = {"text": "string", "bool": "boolean"}.get(returns["kind"]) or self.scalar_type(
            returns["kind"], returns["base"], returns["type"])
        return (self.documentation(f, arguments, [], "") +
                f"export function {name}({self.signature(arguments)}): {kind} {{\n"
                f"  return {self.simple(f, natives)};\n}}\n\n")

    def handle_class(self, handle):
        name = type_name(handle["name"])
        creators = [self.functions[n] for n in handle["created_by"]]
        creator = next((f for f in creators if not self.handle_of(f)), None)
        out = []
        if creator:
            arguments, _, _, body = self.body(creator, False, "  ", creates=handle["name"])
            out.append(f"function create{name}({self.signature(arguments)}): Handle {{\n{body}}}\n\n")
        out.append(comment(handle["doc"]) + f"export class {name} extends NativeObject {{\n")
        if creator:
            out.append(self.documentation(creator, arguments, [], "  "))
            passed = ", ".join(a[1] for a in arguments)
            out.append(f"  constructor({self.signature(arguments)}) {{\n    super(create{name}({passed}));\n  }}\n\n")
        methods = [f for f in self.api["functions"] if self.handle_of(f) == handle["name"] and not f["destroys"]]
        for f in methods:
            member = camel(self.member(f))
            if f["returns"]["kind"] == "handle":
                lent = type_name(f["returns"]["type"])
                out.append(self.documentation(f, [], [], "  "))
                out.append(f"  get {member}(): {lent} {{\n"
                           f"    return lend(this, '{member}', {self.native(f)}, (handle) => new {lent}(handle));\n"
                           "  }\n\n")
                continue
            for asynchronous in (False, True):
                if asynchronous and f["complexity"] == "O(1)":
                    continue
                arguments, results, kind, body = self.body(f, asynchronous, "    ")
                signature = self.signature(arguments)
                out.append(self.documentation(f, arguments, results, "  ", asynchronous))
                head = f"async {member}Async({signature}): Promise<{kind}>" if asynchronous else \
                    f"{member}({signature}): {kind}"
                out.append(f"  {head} {{\n{body}  }}\n\n")
        names = {camel(self.member(f)) for f in methods}
        if {"next", "rewind", "steps"} <= names:
            step = type_name(next(p["base"] for f in methods if self.member(f) == "next" for p in f["parameters"]
                                  if p["kind"] == "struct" and p["role"] == "object"))
            out.append("  /** All steps, from the first one: it rewinds, and then calls next. */\n"
                       f"  *[Symbol.iterator](): Generator<{step}, void, undefined> {{\n    this.rewind();\n"
                       "    for (let left = this.steps(); left > 0; left -= 1) yield this.next();\n  }\n\n")
        out[-1] = out[-1].rstrip("\n") + "\n"
        out.append("}\n\n")
        return "".join(out)

    def interface(self):
        body = []
        for struct in self.api["structs"]:
            if struct["role"] != "error":
                body.append(self.struct(struct))
        for library in self.api["libraries"]:
            body.append(self.table(library["name"]))
        body.append("const C = bind_cairn();\n\n"
                    "// The simulation is a library of its own, which not every machine has.\n"
                    "let loadedSim: ReturnType<typeof bind_cairn_sim> | null = null;\n"
                    "function sim(): ReturnType<typeof bind_cairn_sim> {\n"
                    "  return (loadedSim ??= bind_cairn_sim());\n}\n\n")
        for c in self.api["callbacks"]:
            if c["parameters"] and any(p["base"] == "void" for p in c["parameters"]) and len(c["parameters"]) > 1:
                body.append(self.callback(c))
        for handle in self.api["handles"]:
            body.append(self.handle_class(handle))
        for f in self.api["functions"]:
            if not self.handle_of(f) and not f["destroys"] and not any(p["role"] == "created" for p in f["parameters"]):
                body.append(self.free_function(f))
        text = "".join(body)
        out = [HEAD, "\n"]
        modules = {
            "./call": ["Thrown", "callAsync", "check"],
            "./callbacks": ["Entry", "answer", "callback", "copyIn", "copyOut", "hold", "notify",
                            "pointerRelease", "yes"],
            "./facts": [type_name(e["name"]) for e in self.api["enums"]] + ["LIBRARIES"],
            "./handle": ["Handle", "NativeObject", "enter", "handleOf", "leave", "lend"],
            "./load": ["load"],
            "./memory": ["Memory", "acquire", "fresh", "release", "room"],
            "./values": ["BigInts", "Bytes", "Numbers", "count", "double", "inBytes", "inDoubles", "inUint64s", "int32",
                         "missingField", "putBool", "putDouble", "putDoubles", "putInt32", "putStruct", "putUint32",
                         "putUint64", "readStructs", "size", "text", "uint32", "uint64", "unknownField", "writeOptions",
                         "writeStruct", "writeStructs"],
        }
        types = {"BigInts", "Bytes", "Numbers", "Entry", "Thrown", "Memory"} | {
            type_name(e["name"]) for e in self.api["enums"]}
        for module, names in modules.items():
            used = [n for n in names if re.search(rf"\b{n}\b", re.sub(r"/\*\*.*?\*/", "", text, flags=re.S))]
            shown = ", ".join(("type " if n in types else "") + n for n in used)
            out.append("\n".join(textwrap.wrap(f"import {{ {shown} }} from '{module}.js';", 118,
                                               subsequent_indent="  ")) + "\n")
        return "".join(out) + "\n" + text.rstrip("\n") + "\n"


def main(arguments):
    if len(arguments) != 2:
        sys.exit(__doc__)
    api = json.loads(Path(arguments[0]).read_text(encoding="utf-8"))
    if api["format"] != 1:
        sys.exit(f"{arguments[0]}: format {api['format']} is unknown")
    folder = Path(arguments[1])
    generator = Generator(api)
    (folder / "facts.ts").write_text(generator.facts(), encoding="utf-8")
    (folder / "api.ts").write_text(generator.interface(), encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
