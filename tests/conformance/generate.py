#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""generate.py API_JSON OUTPUT: writes the C replayer's dispatch over all functions from api.json.

It uses nothing but api.json: what it cannot find there, no binding can."""

import json
import re
import sys

# Called by the replayer itself after each failed call (README.md): the error parameter replaces them.
LAST_MESSAGE = {"cairn": "cairn_last_message", "cairn_sim": "cairn_sim_last_message"}


class Generator:
    def __init__(self, api):
        self.api = api
        self.structs = {struct["name"]: struct for struct in api["structs"] if struct["role"] != "error"}
        self.destroy = {handle["name"]: handle["destroy"] for handle in api["handles"]}
        self.lines = []

    def put(self, *lines):
        self.lines += lines

    # --- values ---

    def writer(self, what):
        """A C++ expression: a function that turns a value of this type into JSON."""
        kind, name = what["kind"], what["type"]
        if kind == "struct":
            return f"write_{name}"
        if kind == "enum":
            bits = next(enum["bits"] for enum in self.api["enums"] if enum["name"] == name)
            return f"[](auto v) {{ return write_{'bits' if bits else 'constant'}(v, names_of_{name}); }}"
        if kind == "number":
            return "write_double"
        if kind == "bool":
            return "write_bool"
        if what["base"] == "uint64_t":
            return "write_unsigned"
        return "[](auto v) { return write_integer(static_cast<int64_t>(v)); }"

    def written(self, what, value, length=None):
        """A C++ expression: the JSON of a value, or of a list of this length."""
        if length is None:
            return f"({self.writer(what)})({value})"
        if what["base"] == "uint8_t":
            return f"write_bytes({value}, {length})"
        return f"write_list({value}, {length}, {self.writer(what)})"

    def constants(self):
        for enum in self.api["enums"]:
            self.put(f"const Constants names_of_{enum['name']} = {{")
            self.put(*(f'    {{{value["value"]}, "{value["name"]}"}},' for value in enum["values"]), "};")

    def all_constants(self):
        self.put("const std::map<std::string, int64_t>& all_constants() {",
                 "  static const std::map<std::string, int64_t> all = {")
        for enum in self.api["enums"]:
            self.put(*(f'      {{"{value["name"]}", {value["value"]}}},' for value in enum["values"]))
        self.put("  };", "  return all;", "}", "",
                 "const char* status_text(cairn_status status) { return names_of_cairn_status.at(status); }", "")

    def declare_struct(self, name):
        self.put(f"void defaults({name}& value);", f"void read(const json& from, {name}& to);",
                 f"json write_{name}(const {name}& value);")

    def define_struct(self, struct):
        name = struct["name"]
        fields = [f for f in struct["fields"] if f["role"] not in ("struct_size", "reserved")]
        self.put(f"void defaults({name}& value) {{")
        if struct["init"]:
            self.put("  cairn_error error = {};", "  error.struct_size = sizeof error;",
                     f"  if ({struct['init']}(&value, sizeof value, &error) != CAIRN_OK) throw Failure(error.message);")
        else:
            self.put("  value = {};")
            if struct["versioned"]:
                self.put("  value.struct_size = sizeof value;")
        self.put("}", "", f"void read(const json& from, {name}& to) {{",
                 "  for (const auto& [key, value] : from.items()) {")
        for field in fields:
            self.put(f'    if (key == "{field["name"]}") {{', f"      read(value, to.{field['name']});",
                     "      continue;", "    }")
        self.put(f'    throw Failure("{name} has no field " + key);', "  }", "}", "",
                 f"json write_{name}(const {name}& value) {{", "  json to = json::object();")
        for field in fields:
            if not re.fullmatch(r"(.*_)?seconds", field["name"]):
                self.put(f'  to["{field["name"]}"] = '
                         f'{self.written(field, "value." + field["name"], field["length"])};')
        self.put("  return to;", "}", "")

    # --- functions ---

    def define_function(self, function):
        self.put(f"void call_{function['name']}(Call& call) {{")
        inputs, arguments, outputs, sizes = [], [], [], {}
        parameters = function["parameters"]
        two_steps = any(p["role"] == "needed" for p in parameters)
        for p in parameters:
            getattr(self, "parameter_" + p["role"])(p, function, inputs, arguments, outputs, sizes)
        # Lengths of lists first: another parameter may be the length.
        self.put(*(line for rank in ("list", "size", "check", "room") for kind, line in inputs if kind == rank))
        call = f"{function['name']}({', '.join(arguments)})"
        if function["fallible"]:
            message = LAST_MESSAGE[function["library"]] + "()"
            if two_steps:
                self.put("  size_t needed = 0, capacity = 0;", f"  cairn_status status = {call};",
                         "  if (status == CAIRN_OK && needed > 0) {",
                         "    capacity = needed;",
                         *(f"    {line}" for kind, line in inputs if kind == "resize"),
                         f"    status = {call};", "  }", f"  if (!call.finish(status, {message})) return;")
            else:
                self.put(f"  if (!call.finish({call}, {message})) return;")
        elif function["returns"]["kind"] == "void":
            self.put(f"  {call};")
        else:
            self.put(f"  const auto result = {call};", f"  {self.returned(function['returns'])}")
        self.put(*(f"  {output}" for output in outputs))
        self.put("}", "")

    def returned(self, returns):
        if returns["kind"] == "handle":
            return 'call.give_lent("return", result);'
        if returns["kind"] == "text":
            return 'call.give("return", result);'
        return f'call.give("return", {self.written(returns, "result")});'

    def parameter_handle(self, p, function, inputs, arguments, outputs, sizes):
        inputs.append(("list", f'  {p["type"]}* {p["name"]} = call.handle<{p["type"]}>("{p["name"]}");'))
        arguments.append(p["name"])
        if function["destroys"]:
            outputs.append(f"call.destroyed({p['name']});")

    def parameter_created(self, p, function, inputs, arguments, outputs, sizes):
        inputs.append(("list", f"  {p['type']}* {p['name']} = nullptr;"))
        arguments.append("&" + p["name"])
        destroy = self.destroy[p["type"]]
        outputs.append(f'call.give_created("{p["name"]}", {p["name"]}, '
                       f'[](void* h) {{ {destroy}(static_cast<{p["type"]}*>(h)); }});')

    def parameter_value(self, p, function, inputs, arguments, outputs, sizes):
        inputs.append(("list", f'  const auto {p["name"]} = call.value<{p["type"]}>("{p["name"]}");'))
        arguments.append(p["name"])

    parameter_sensor = parameter_value

    def parameter_text(self, p, function, inputs, arguments, outputs, sizes):
        inputs.append(("list", f'  const std::string {p["name"]} = call.text("{p["name"]}");'))
        arguments.append(p["name"] + ".c_str()")

    def parameter_object(self, p, function, inputs, arguments, outputs, sizes):
        name, kind = p["name"], p["type"]
        if p["direction"] == "out":
            inputs.append(("list", f"  {kind} {name} = {{}};"))
            if kind in self.structs and not self.init_of(function, kind):
                inputs.append(("list", f"  defaults({name});"))
            arguments.append("&" + name)
            outputs.append(f'call.give("{name}", {self.written(p, name)});')
            return
        optional = "true" if p["optional"] else "false"
        inputs.append(("list", f'  auto {name} = call.object<{kind}>("{name}", {optional});'))
        arguments.append(f"{name} ? &*{name} : nullptr")
        if p["direction"] == "inout":
            outputs.append(f'call.give("{name}", {self.written(p, "*" + name)});')

    def init_of(self, function, kind):
        return self.structs[kind]["init"] == function["name"]

    def parameter_array(self, p, function, inputs, arguments, outputs, sizes):
        name, kind, length = p["name"], p["type"], p["length"]
        if p["direction"] == "in":
            optional = "true" if p["optional"] else "false"
            inputs.append(("list", f'  const auto {name} = call.list<{kind}>("{name}", {optional});'))
            arguments.append(f"data_of({name})")
            if length.isidentifier() and length not in sizes:
                sizes[length] = name
                inputs.append(("size", f"  const size_t {length} = {name} ? {name}->size() : 0;"))
            else:
                inputs.append(("check", f'  if ({name}) call.expect_size("{name}", {name}->size(), {length});'))
        elif "capacity" in length:
            inputs.append(("room", f"  std::vector<{kind}> {name};"))
            inputs.append(("resize", f"{name}.resize({length});"))
            arguments.append(f"{name}.data()")
            outputs.append(f'call.give("{name}", {self.written(p, name + ".data()", name + ".size()")});')
        else:
            inputs.append(("room", f"  std::vector<{kind}> {name}({length});"))
            arguments.append(f"{name}.data()")
            outputs.append(f'call.give("{name}", {self.written(p, name + ".data()", name + ".size()")});')

    def parameter_count(self, p, function, inputs, arguments, outputs, sizes):
        arguments.append(p["name"])

    parameter_capacity = parameter_count

    def parameter_needed(self, p, function, inputs, arguments, outputs, sizes):
        arguments.append("&needed")

    def parameter_struct_size(self, p, function, inputs, arguments, outputs, sizes):
        structs = [q for q in function["parameters"] if q["kind"] == "struct" and q["role"] != "error"]
        arguments.append(f"sizeof {structs[0]['name']}")

    def parameter_callback(self, p, function, inputs, arguments, outputs, sizes):
        getter = p["type"].removeprefix("cairn_").removeprefix("custom_").removesuffix("_fn")
        inputs.append(("list", f'  const auto {p["name"]} = call.{getter}("{p["name"]}");'))
        arguments.append(p["name"])

    def parameter_user(self, p, function, inputs, arguments, outputs, sizes):
        arguments.append("call.payload()")

    def parameter_release(self, p, function, inputs, arguments, outputs, sizes):
        arguments.append("call.release()")

    def parameter_error(self, p, function, inputs, arguments, outputs, sizes):
        arguments.append("&call.error")

    # --- the file ---

    def text(self):
        self.put("/* Written by tests/conformance/generate.py from api.json. */")
        self.put(*(f"#include <{header['name']}>" for header in self.api["headers"]))
        self.put("", "namespace conformance {")
        for name in self.structs:
            self.put(f"void defaults({name}& value);", f"void read(const nlohmann::json& from, {name}& to);")
        self.lines.insert(1, "#include <nlohmann/json_fwd.hpp>")
        self.put("}", '#include "call.hpp"', "", "namespace conformance {", "namespace {", "")
        self.constants()
        self.put("", "} // namespace", "")
        self.all_constants()
        for name in self.structs:
            self.put(f"json write_{name}(const {name}& value);")
        for struct in self.structs.values():
            self.define_struct(struct)
        self.put("namespace {", "")
        functions = [f for f in self.api["functions"] if f["name"] not in LAST_MESSAGE.values()]
        for function in functions:
            self.define_function(function)
        self.put("} // namespace", "", "const std::map<std::string, Function>& functions() {",
                 "  static const std::map<std::string, Function> all = {")
        self.put(*(f'      {{"{f["name"]}", call_{f["name"]}}},' for f in functions))
        self.put("  };", "  return all;", "}", "", "} // namespace conformance", "")
        return "\n".join(self.lines)


def main(api, output):
    with open(api, encoding="utf-8") as file:
        text = Generator(json.load(file)).text()
    with open(output, "w", encoding="utf-8") as file:
        file.write(text)


if __name__ == "__main__":
    main(*sys.argv[1:])
