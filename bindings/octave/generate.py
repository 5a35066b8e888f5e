#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the package for Octave and MATLAB from the description of the C interface (src/api/api.json):

    src/functions.hpp     what cairn_mex.cpp needs: structs, constants, one function for each function of C
    +cairn/*.m            a class for each handle and each set of constants, a function for each other function of C

Files in layer/ are written by hand. Such a file replaces the one that would be generated; a line %METHODS in it stands
for the methods that it does not define, and %DOC NAME for the documentation of a name of C. The other files of
+cairn/+internal are written by hand where they are.

generate.py [--check]     --check: writes nothing, fails if a file would change
"""
import json
import math
import pathlib
import re
import sys
import textwrap

HERE = pathlib.Path(__file__).resolve().parent
WIDTH = 120
MADE = "Written by generate.py from the description of the C interface: do not edit."
LICENCE = "SPDX-License-Identifier: BSD-3-Clause"
# Names that mean something else to Octave: "size" is asked of every object.
RENAMED = {"cairn_map_size": "count"}
# The error parameter replaces them.
ONLY_C = {"cairn_last_message", "cairn_sim_last_message"}
KEYWORDS = ("end", "function", "if", "for", "switch", "case", "return", "persistent", "global")
ABOUT_MEMORY = re.compile(r"struct_size|capacity`|Capacity 0|`\*needed|`release`|`payload`|`user`|destroys it with|"
                          r"frees it with|is not written|may be \[\]|may be 0|Set them by|bytes of|lives? as long|"
                          r"[Nn]ever NULL|"
                          r"^Allocates nothing|^\[\] is allowed")


def camel(name):
    return "".join(word.capitalize() for word in name.removeprefix("cairn_").split("_"))


def short(name):
    return name.removeprefix("cairn_")


def shown(struct):
    return [f for f in struct["fields"] if f["role"] not in ("struct_size", "reserved")]


def square_side(name, length):
    """Rows of the square matrix that an array of fixed length is; 0 if it is none."""
    side = math.isqrt(length)
    return side if "covariance" in name and side > 1 and side * side == length else 0


def dimensions(name, expression):
    """Rows and columns of an array, from the expression for its length."""
    if expression.isdigit():
        side = square_side(name, int(expression))
        return (str(side), str(side)) if side else (expression, "1")
    factors = [factor.strip() for factor in expression.split("*")]
    return factors[0], " * ".join(factors[1:]) or "1"


class Package:
    def __init__(self, api):
        self.api = api
        self.structs = {s["name"]: s for s in api["structs"]}
        self.enums = {e["name"]: e for e in api["enums"]}
        self.handles = {h["name"]: h for h in api["handles"]}
        self.functions = {f["name"]: f for f in api["functions"]}
        for function in api["functions"]:
            for p in function["parameters"]:
                p["name"] += "_" if p["name"] in KEYWORDS else ""
        self.names = {"NULL": "[]", "CAIRN_OK": "success"}
        for enum in api["enums"]:
            self.names[enum["name"]] = f"cairn.{camel(enum['name'])}"
            for value in enum["values"]:
                self.names[value["name"]] = f"cairn.{camel(enum['name'])}.{value['name'][len(enum['prefix']):]}"
        for constant in api["constants"]:
            self.names[constant["name"]] = f"cairn.Constants.{constant['name'].removeprefix('CAIRN_')}"
        for handle in api["handles"]:
            self.names[handle["name"]] = f"cairn.{camel(handle['name'])}"
        for struct in api["structs"]:
            options = f"cairn.{self.options_name(struct)}" if struct["init"] else None
            self.names[struct["name"]] = options or short(struct["name"])
        for function in api["functions"]:
            self.names[function["name"]] = self.public_name(function)
        known = sorted(self.names, key=len, reverse=True)
        self.pattern = re.compile(r"(?<!\w)(?:" + "|".join(map(re.escape, known)) + r")(?!\w)")

    @staticmethod
    def options_name(struct):
        return short(struct["init"]).removesuffix("_init")

    def owner(self, function):
        """The handle whose method a function is; None: it is a function of the package."""
        first = function["parameters"][0] if function["parameters"] else None
        if first and first["role"] == "handle" and function["name"].startswith(first["type"] + "_"):
            return first["type"]
        for handle in self.handles.values():
            if function["name"] in handle["created_by"] and function["name"] == handle["name"] + "_create":
                return handle["name"]
        return None

    def method_name(self, function):
        if function["name"] in RENAMED:
            return RENAMED[function["name"]]
        owner = self.owner(function)
        name = function["name"].removeprefix(owner + "_") if owner else short(function["name"])
        if owner is None:
            return name.removesuffix("_init")
        return {"create": camel(owner), "destroy": "delete"}.get(name, name)

    def public_name(self, function):
        owner, name = self.owner(function), self.method_name(function)
        if owner is None or function["name"].endswith("_create"):
            return f"cairn.{name}"
        return f"cairn.{camel(owner)}.{name}"

    # What goes in and comes out, in the order of C.

    @staticmethod
    def inputs(function):
        return [p for p in function["parameters"] if p["direction"] in ("in", "inout") and p["role"] in
                ("handle", "value", "sensor", "object", "array", "text", "callback")]

    @staticmethod
    def outputs(function):
        results = [p for p in function["parameters"] if p["direction"] in ("out", "inout") and p["role"] in
                   ("created", "object", "array")]
        if not function["fallible"] and function["returns"]["type"] != "void":
            results.append({**function["returns"], "name": "result", "role": "return", "optional": False})
        return results

    def is_options(self, parameter):
        struct = self.structs.get(parameter["type"])
        return bool(struct and struct["init"] and parameter["direction"] == "in")

    def by_name(self, function):
        """Whether the last input is options, which are given as names and values."""
        inputs = self.inputs(function)
        return (bool(inputs) and self.is_options(inputs[-1]) and sum(map(self.is_options, inputs)) == 1)

    # Documentation

    def prose(self, text):
        text = re.sub(r"\\ref\s+", "", text or "")
        text = self.pattern.sub(lambda found: self.names[found.group()], text)
        text = re.sub(r"[;,] each may be \[\]", "", text)
        text = re.sub(r"\s*\(room for `[^)]*\)", "", text)
        # Sentences about memory that C has to care for.
        sentences = re.split(r"(?<=[.)])(\s+)(?=[A-Z`\[])", text)
        kept = ""
        for sentence, space in zip(sentences[::2], [*sentences[1::2], ""], strict=True):
            if not ABOUT_MEMORY.search(sentence):
                kept += sentence + space
        return kept.strip()

    @staticmethod
    def comment(text, indent=0):
        lines = []
        for paragraph in (text or "").split("\n\n"):
            if lines:
                lines.append(" " * indent + "%")
            lines += textwrap.wrap(" ".join(paragraph.split()), WIDTH, initial_indent=" " * indent + "% ",
                                   subsequent_indent=" " * indent + "% ", break_long_words=False,
                                   break_on_hyphens=False)
        return "\n".join(lines) + "\n" if lines else ""

    @staticmethod
    def entry(text, indent):
        """A line of a list."""
        return textwrap.fill(" ".join(text.split()), WIDTH, initial_indent=" " * indent + "%   ",
                             subsequent_indent=" " * indent + "%     ", break_long_words=False,
                             break_on_hyphens=False) + "\n"

    def usage(self, function):
        """The line that says how a function is called."""
        names = [p["name"] for p in self.inputs(function)]
        if function["name"].endswith("_init") and not names:
            names = ["Name, Value, ..."]
        if self.by_name(function):
            names[-1] = "Name, Value, ..."
        owner, name = self.owner(function), self.method_name(function)
        created = function["name"].endswith("_create")
        call = f"cairn.{name}" if owner is None or created else f"{short(owner)}.{name}"
        if owner and not created:
            names = names[1:]
        results = [p["name"] for p in self.outputs(function)]
        left = {0: "", 1: f"{(results or [''])[0]} = "}.get(len(results), f"[{', '.join(results)}] = ")
        return f"{left}{call}({', '.join(names)})"

    def shape_text(self, p):
        """The shape of a value for Octave, for the documentation."""
        if self.is_options(p):
            return f"fields of {self.names[p['type']]}"
        if p["kind"] == "struct":
            names = ", ".join(field["name"] for field in shown(self.structs[p["type"]]))
            return f"struct with a column for each element: {names}" if p["role"] == "array" else f"struct: {names}"
        if p["kind"] in ("handle", "callback"):
            return "function handle" if p["kind"] == "callback" else self.names[p["type"]]
        if p["kind"] == "enum":
            return self.names[p["type"]]
        if p.get("length"):
            rows, columns = dimensions(p["name"], p["length"])
            if "capacity" in p["length"]:
                if p["length"] == "capacity":
                    return "square matrix" if p["type"] == "double" else p["base"].removesuffix("_t")
                return "square matrix" if rows == "capacity" else f"{rows} x n"
            if columns == "1":
                return "vector" if not rows.isdigit() else f"{rows} numbers"
            return f"{rows} x {columns.replace(' ', '')}"
        names = {"double": "number", "uint64_t": "uint64", "cairn_bool": "logical", "char": "text"}
        return names.get(p["type"], "integer")

    def parameter_doc(self, function):
        lines = []
        for p in self.inputs(function) + self.outputs(function):
            if p["role"] in ("handle", "created", "return"):
                continue
            text = f"{p['name']}: {self.shape_text(p)}"
            unit = p.get("unit")
            if unit and unit != "1":
                text += f", {unit}"
            if p["optional"] and p["direction"] == "in":
                text += "; [] or missing: none"
            lines.append(text)
        return lines

    def function_doc(self, function, indent):
        text = self.comment(self.usage(function), indent)
        struct = self.options_struct(function)
        body = self.prose((struct or function)["doc"])
        text += self.comment(body, indent)
        lines = [] if struct else self.parameter_doc(function)
        if lines:
            text += " " * indent + "%\n" + "".join(self.entry(line, indent) for line in lines)
        if struct:
            text += " " * indent + "%\n" + self.fields_doc(struct, indent)
        errors = ["cairn:" + e["status"].removeprefix("CAIRN_ERROR_") +
                  (f" ({self.prose(e['when'])})" if e["when"] else "") for e in function["errors"]]
        if errors:
            text += " " * indent + "%\n" + self.comment("Errors: " + ", ".join(errors) + ".", indent)
        return text

    def options_struct(self, function):
        """The struct whose fields the documentation of a function lists: that of its options."""
        if function["name"].endswith("_init"):
            return next(s for s in self.structs.values() if s["init"] == function["name"])
        return None

    def fields_doc(self, struct, indent):
        text = ""
        for field in shown(struct):
            text += self.entry(f"{field['name']}: {self.prose(field['doc'])}", indent)
        return text

    def doc(self, name, indent):
        if name in self.functions:
            return self.function_doc(self.functions[name], indent)
        if name in self.handles:
            text = self.comment(self.prose(self.handles[name]["doc"]), indent)
            if f"{name}_create" in self.functions:
                text += " " * indent + "%\n" + self.function_doc(self.functions[f"{name}_create"], indent)
            return text
        for group in (self.structs, self.enums):
            if name in group:
                return self.comment(self.prose(group[name]["doc"]), indent)
        sys.exit(f"%DOC {name}: there is no such name")

    # M files

    def arguments(self, function, own_handle):
        """Names of the M function's parameters, and what it passes to cairn_mex."""
        declared, passed, before = [], [], []
        inputs = self.inputs(function)
        for index, p in enumerate(inputs):
            if p["role"] == "handle":
                if index == 0 and own_handle:
                    declared.append("self")
                    passed.append("self.handle")
                else:
                    declared.append(p["name"])
                    passed.append(f"{p['name']}.handle")
            elif index == len(inputs) - 1 and self.by_name(function):
                declared.append("varargin")
                passed.append("cairn.internal.options(varargin)")
            else:
                if p["optional"] and all(q["optional"] for q in inputs[index:]) and not self.by_name(function):
                    before.append(f"if nargin < {len(declared) + 1}, {p['name']} = []; end")
                declared.append(p["name"])
                passed.append(p["name"])
        return declared, passed, before

    def body(self, function, own_handle):
        """The lines of an M function after its documentation, and its declaration."""
        declared, passed, lines = self.arguments(function, own_handle)
        results = [p["name"] for p in self.outputs(function)]
        call = f"cairn_mex({', '.join([chr(39) + short(function['name']) + chr(39), *passed])})"
        if len(call) > WIDTH - 20:
            call = call.replace(", self.handle, ", ", self.handle, ...\n          ", 1)
        if not own_handle:
            lines.append("cairn.internal.library();")
        outputs = self.outputs(function)
        left = {0: "", 1: f"{(results or [''])[0]} = "}.get(len(results), f"[{', '.join(results)}] = ")
        if function["name"].endswith("_create"):
            lines.append(f"self.handle = {call};")
            results = ["self"]
        elif outputs and outputs[0]["kind"] == "handle":
            owner = "[]" if outputs[0]["role"] == "created" else "self"
            lines.append(f"{results[0]} = {self.names[outputs[0]['type']]}({owner}, {call});")
        else:
            lines.append(f"{left}{call};")
        if function["name"].endswith("_init"):
            declared = ["varargin"]
            lines.append(f"{results[0]} = cairn.internal.overlay({results[0]}, varargin, "
                         f"'{self.method_name(function)}');")
        left = {0: "", 1: f"{(results or [''])[0]} = "}.get(len(results), f"[{', '.join(results)}] = ")
        signature = f"function {left}{self.method_name(function)}({', '.join(declared)})"
        return signature, lines

    def m_function(self, function):
        signature, lines = self.body(function, own_handle=False)
        return f"{signature}\n{self.function_doc(function, 0)}\n% {LICENCE}\n% {MADE}\n" + "\n".join(lines) + "\nend\n"

    def method(self, function):
        signature, lines = self.body(function, own_handle=not function["name"].endswith("_create"))
        text = f"    {signature}\n{self.function_doc(function, 6)}"
        return text + "".join(f"      {line}\n" for line in lines) + "    end\n"

    def m_class(self, handle, template):
        methods = [f for f in self.functions.values() if self.owner(f) == handle["name"]
                   and f["name"] != handle["destroy"]]
        if template is None:
            template = (f"classdef {camel(handle['name'])} < cairn.internal.Handle\n  %DOC {handle['name']}\n"
                        "  methods\n    %METHODS\n  end\nend\n")
        by_hand = set(re.findall(r"cairn_mex\('(\w+)'", template))
        rest = [f for f in methods if short(f["name"]) not in by_hand]
        # Octave shows the help of a class for its first method: the constructor.
        rest.sort(key=lambda f: not f["name"].endswith("_create"))
        text = "\n".join(self.method(f) for f in rest)
        template = template.replace("    %METHODS\n", text)
        return self.expand(template).replace("\n  methods", f"\n  % {LICENCE}\n  % {MADE}\n  methods", 1)

    def expand(self, template):
        return re.sub(r"^( *)%DOC (\w+)\n", lambda found: self.doc(found.group(2), len(found.group(1))), template,
                      flags=re.MULTILINE)

    def m_enum(self, enum):
        name = camel(enum["name"])
        text = f"classdef {name}\n" + self.comment(self.prose(enum["doc"]), 2)
        text += "  %\n" + self.comment(f"cairn.{name}.name(VALUE) gives the name of a value.", 2)
        text += f"  % {LICENCE}\n  % {MADE}\n  properties (Constant)\n"
        for value in enum["values"]:
            text += self.comment(self.prose(value["doc"]), 4)
            text += f"    {value['name'][len(enum['prefix']):]} = {value['value']};\n"
        names = ", ".join(f"'{v['name'][len(enum['prefix']):]}'" for v in enum["values"])
        values = ", ".join(str(v["value"]) for v in enum["values"])
        lines = ["values = [" + values + "];",
                 *textwrap.wrap("names = {" + names + "};", WIDTH - 12, break_long_words=False)]
        for i in range(1, len(lines) - 1):
            lines[i] += " ..."
        bits = "true" if enum["bits"] else "false"
        lines.append(f"text = cairn.internal.constant_name(value, values, names, {bits});")
        text += "  end\n\n  methods (Static)\n    function text = name(value)\n"
        text += self.comment("Name of a value" + (", or of a sum of values." if enum["bits"] else "."), 6)
        return text + "".join(f"      {line}\n" for line in lines) + "    end\n  end\nend\n"

    def m_constants(self):
        text = f"classdef Constants\n  % Constants that belong to no set.\n  % {LICENCE}\n  % {MADE}\n"
        text += "  properties (Constant)\n"
        for constant in self.api["constants"]:
            value = constant["value"]
            text += self.comment(self.prose(constant["doc"]), 4)
            if constant["type"] == "uint64_t":
                value = "intmax('uint64')" if int(value) == 2**64 - 1 else f"uint64({value})"
            text += f"    {constant['name'].removeprefix('CAIRN_')} = {value};\n"
        return text + "  end\nend\n"

    def m_files(self):
        """All files of the folder +cairn."""
        layer = {path.name: path.read_text(encoding="utf-8") for path in sorted((HERE / "layer").glob("*.m"))}
        files = {}
        for handle in self.handles.values():
            name = f"{camel(handle['name'])}.m"
            files[name] = self.m_class(handle, layer.pop(name, None))
        for enum in self.enums.values():
            files[f"{camel(enum['name'])}.m"] = self.m_enum(enum)
        files["Constants.m"] = self.m_constants()
        for function in self.functions.values():
            if self.owner(function) is None and function["name"] not in ONLY_C:
                name = f"{self.method_name(function)}.m"
                template = layer.pop(name, None)
                files[name] = self.expand(template) if template else self.m_function(function)
        sonames = " and ".join(library["soname"] for library in self.api["libraries"])
        for name, text in layer.items():
            files[f"+internal/{name}"] = text.replace("@VERSION@", self.api["version"]).replace("@SONAMES@", sonames)
        folded = [name.casefold() for name in files]
        if len(set(folded)) != len(folded):
            sys.exit("two files of +cairn differ only in case, which some file systems do not tell apart")
        return {f"+cairn/{name}": text for name, text in files.items()}

    # C++

    def cpp_struct(self, struct):
        kinds = {"number": "number", "bool": "boolean", "struct": "object"}
        lines = []
        for field in shown(struct):
            length = field["length"] or 1
            constants = object_ = "nullptr"
            if field["kind"] == "enum":
                enum = self.enums[field["type"]]
                kind = "bits" if enum["bits"] else "constant"
                constants = f"&enum_{short(enum['name'])}"
            elif field["kind"] == "integer":
                kind = {"uint64_t": "id", "uint32_t": "uint32", "int32_t": "int32"}[field["base"]]
            else:
                kind = kinds[field["kind"]]
                if kind == "object":
                    object_ = f"&struct_{short(field['type'])}"
            lines.append(f"    {{\"{field['name']}\", Kind::{kind}, offsetof({struct['name']}, {field['name']}), "
                         f"{length}, {square_side(field['name'], length)}, {constants}, {object_}}},\n")
        name = short(struct["name"])
        return (f"constexpr Field fields_{name}[] = {{\n{''.join(lines)}}};\n"
                f"constexpr Struct struct_{name}{{\"{name}\", sizeof({struct['name']}), fields_{name}, "
                f"std::size(fields_{name})}};\n")

    def cpp_tables(self):
        text = ""
        for enum in self.enums.values():
            name = short(enum["name"])
            values = ", ".join(f"{{\"{v['name'][len(enum['prefix']):]}\", {v['name']}}}" for v in enum["values"])
            text += f"constexpr Constant values_{name}[] = {{{values}}};\n"
            text += f"constexpr Enum enum_{name}{{\"{enum['prefix']}\", values_{name}, std::size(values_{name})}};\n"
        for struct in self.structs.values():
            if struct["role"] != "error":
                text += self.cpp_struct(struct)
        for handle in self.handles.values():
            name = short(handle["name"])
            text += (f"constexpr HandleType handle_{name}{{\"{name}\", [](void *handle) {{ {handle['destroy']}("
                     f"static_cast<{handle['name']} *>(handle)); }}}};\n")
        return text + "inline const Struct *const callbacks::pose_type = &struct_pose;\n"

    def cpp_input(self, p, code):
        """The lines that read an input; returns the argument that C gets."""
        name, optional = p["name"], str(p["optional"]).lower()
        if p["role"] == "handle":
            code.append(f"auto *{name} = call.handle<{p['type']}>(\"{name}\", handle_{short(p['type'])});")
            return name
        if p["role"] == "text":
            code.append(f"const std::optional<std::string> {name} = call.text(\"{name}\", {optional});")
            return f"{name} ? {name}->c_str() : nullptr"
        if p["role"] == "callback":
            code.append(f"const mxArray *{name} = call.function(\"{name}\", {optional});")
            return f"{name} ? callbacks::{p['type']} : nullptr"
        if p["role"] in ("value", "sensor"):
            if p["kind"] == "enum":
                code.append(f"const auto {name} = call.constant<{p['type']}>(\"{name}\", enum_{short(p['type'])});")
            else:
                code.append(f"const auto {name} = call.scalar<{p['base']}>(\"{name}\");")
            return name
        if p["role"] == "object":
            struct = self.structs[p["type"]]
            code.append(f"{p['type']} {name}{{}};")
            if struct["init"]:
                code.append(f"call.check({struct['init']}(&{name}, sizeof {name}, &call.error));")
            default = str(p["optional"] or bool(struct["init"])).lower()
            given = f"call.object(\"{name}\", struct_{short(p['type'])}, &{name}, {default})"
            if p["optional"]:
                code.append(f"const bool has_{name} = {given};")
                return f"has_{name} ? &{name} : nullptr"
            code.append(f"{given};")
            return f"&{name}"
        assert p["role"] == "array", p
        if p["kind"] == "struct":
            code.append(f"const auto {name} = call.objects<{p['type']}>(\"{name}\", struct_{short(p['type'])});")
        elif p["length"].isidentifier():
            code.append(f"const auto {name} = call.vector<{p['base']}>(\"{name}\");")
        if p["length"].isidentifier():
            code.append(f"const size_t {p['length']} = {name}.size();")
            return f"{name}.data()"
        rows, columns = dimensions(name, p["length"])
        if p["length"].isdigit():
            code.append(f"double {name}[{p['length']}];")
        else:
            code.append(f"std::vector<double> {name}({p['length']});")
        data = name if p["length"].isdigit() else f"{name}.data()"
        given = f"call.matrix(\"{name}\", {data}, {rows}, {columns}, {optional})"
        if p["optional"]:
            code.append(f"const bool has_{name} = {given};")
            return f"has_{name} ? {data} : nullptr"
        code.append(f"{given};")
        return data

    def cpp_output(self, p, index, before, after, sized):
        """The lines before and after the call; returns the arguments in the first and in the second call."""
        name = p["name"]
        if p["role"] == "created":
            before.append(f"{p['type']} *{name} = nullptr;")
            after.append(f"call.give_owned(handle_{short(p['type'])}, {name});")
            return f"&{name}", f"&{name}"

        def pointer(text):
            return f"call.wanted({index}) ? {text} : nullptr" if p["optional"] else text

        if p["role"] == "object":
            if p["kind"] == "struct":
                if p["direction"] == "out":
                    before.append(f"{p['type']} {name}{{}};")
                    struct = self.structs[p["type"]]
                    if struct["versioned"] and struct["role"] != "options":
                        before.append(f"{name}.struct_size = sizeof {name};")
                    elif struct["versioned"]:
                        before.append(f"call.check({struct['init']}(&{name}, sizeof {name}, &call.error));")
                after.append(f"call.give(write_object(struct_{short(p['type'])}, &{name}, sizeof {name}, 1));")
            else:
                before.append(f"{p['type']} {name}{{}};")
                after.append(f"call.give({self.cpp_scalar(p, name)});")
            argument = pointer(f"&{name}")
            return argument, argument
        length = p["length"]
        rows, columns = dimensions(name, length)
        if length.isdigit():
            before.append(f"double {name}[{length}];")
            after.append(f"call.give(write_matrix({name}, {rows}, {columns}));")
            return pointer(name), pointer(name)
        if "capacity" not in length:  # one for each element of an input
            before.append(f"std::vector<{p['type']}> {name}(call.wanted({index}) ? {length} : 0);")
            after.append(f"call.give(write_objects(struct_{short(p['type'])}, {name}));")
            return pointer(f"{name}.data()"), None
        many = length.replace("capacity", "needed")
        sized.append(f"std::vector<{p['type']}> {name}({many});")
        if p["kind"] == "struct":
            after.append(f"call.give(write_objects(struct_{short(p['type'])}, {name}));")
        elif p["base"] == "uint64_t":
            after.append(f"call.give(write_ids({name}.data(), needed));")
        elif p["base"] == "uint8_t":
            after.append(f"call.give(write_bytes({name}.data(), needed));")
        elif length == "capacity":
            after.append(f"const auto {name}_side = static_cast<size_t>(std::lround(std::sqrt(double(needed))));")
            after.append(f"call.give(write_matrix({name}.data(), {name}_side, {name}_side));")
        elif rows.isdigit():
            after.append(f"call.give(write_columns({name}.data(), {rows}, needed));")
        else:
            after.append(f"call.give(write_matrix({name}.data(), needed, needed));")
        return "nullptr", f"{name}.data()"

    def cpp_scalar(self, p, value):
        if p["kind"] == "text":
            return f"mxCreateString({value})"
        if p["kind"] == "bool":
            return f"mxCreateLogicalScalar({value} != 0)"
        if p["base"] == "uint64_t":
            return f"Call::write_number({value})"
        return f"number(static_cast<double>({value}))"

    def cpp_function(self, function):
        before, sized, after, first, second = [], [], [], [], []
        outputs = self.outputs(function)
        release = None
        for p in function["parameters"]:
            role = p["role"]
            if role in ("count", "error", "struct_size", "capacity", "needed"):
                if role == "needed":
                    before.append("size_t needed = 0;")
                argument = {"count": p["name"], "error": "&call.error", "capacity": "0", "needed": "&needed",
                            "struct_size": f"sizeof {function['parameters'][0]['name']}"}[role]
                first.append(argument)
                second.append("needed" if role == "capacity" else argument)
            elif role == "user":
                types = {q["type"] for q in function["parameters"] if q["name"] in p["callbacks"]}
                lengths = " ".join(q["length"] or "" for c in self.api["callbacks"] if c["name"] in types
                                   for q in c["parameters"])
                found = re.search(r"(cairn_\w+)\.(\w+)", lengths)
                rows = "0"
                if found:
                    struct = next(q for q in function["parameters"] if q["type"] == found.group(1))
                    rows = f"{struct['name']}.{found.group(2)}"
                names = ", ".join(p["callbacks"])
                before.append(f"auto {p['name']} = std::make_unique<Callbacks>({rows}, Functions{{{names}}});")
                none = " && ".join(f"!{name}" for name in p["callbacks"])
                if all(q["optional"] for q in function["parameters"] if q["name"] in p["callbacks"]):
                    before.append(f"if ({none}) {p['name']}.reset();")
                if p["released_by"]:
                    release = p["name"]
                first.append(f"{p['name']}.get()")
            elif role == "release":
                first.append(f"{release} ? Callbacks::release : nullptr")
            else:
                text = again = None
                if p["direction"] in ("in", "inout"):
                    text = again = self.cpp_input(p, before)
                if p["direction"] in ("out", "inout"):
                    index = next(i for i, q in enumerate(outputs) if q is p or q["name"] == p["name"])
                    text, again = self.cpp_output(p, index, before, after, sized)
                first.append(text)
                second.append(again)
        name = function["name"]
        if not function["fallible"]:
            call = f"{name}({', '.join(first)})"
            result = function["returns"]
            if result["kind"] == "handle":
                after.append(f"call.give_lent(handle_{short(result['type'])}, {call});")
            else:
                after.append(f"call.give({self.cpp_scalar(result, call)});")
        else:
            before.append(f"call.check({name}({', '.join(first)}));")
            if sized:
                sized.append(f"call.check({name}({', '.join(second)}));")
            if release:
                after.insert(0, f"{release}.release();")
        body = "".join(f"  {line}\n" for line in before + sized + after)
        return f"inline void run_{short(name)}(Call &call) {{\n{body}}}\n"

    def cpp(self):
        text = f"// {LICENCE}\n// {MADE}\n// clang-format off\n#pragma once\n\n#include \"callbacks.hpp\"\n\n"
        text += "#include <cstddef>\n#include <iterator>\n#include <string_view>\n\nnamespace cairn_octave {\n\n"
        text += f"static_assert(CAIRN_VERSION == {self.api['version_number']}, \"headers of another version\");\n\n"
        text += self.cpp_tables() + "\n"
        bound = [f for f in self.functions.values() if f["returns"]["type"] != "void" and f["name"] not in ONLY_C]
        text += "\n".join(self.cpp_function(f) for f in bound)
        text += ("\nstruct Function {\n  const char *short_name;\n  void (*run)(Call &);\n  int inputs;\n"
                 "  int outputs;\n};\n\n"
                 "inline const std::unordered_map<std::string_view, Function> functions{\n")
        for f in bound:
            method = self.method_name(f)
            text += (f"  {{\"{short(f['name'])}\", {{\"{method}\", run_{short(f['name'])}, {len(self.inputs(f))}, "
                     f"{len(self.outputs(f))}}}}},\n")
        text += "};\n\n}  // namespace cairn_octave\n// clang-format on\n"
        return "".join(self.broken(line) for line in text.splitlines())

    @staticmethod
    def broken(line):
        indent = " " * (len(line) - len(line.lstrip()) + 2)
        lines = textwrap.wrap(line, WIDTH, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False,
                              drop_whitespace=True)
        return "\n".join(lines) + "\n" if len(line) > WIDTH else line + "\n"

    def files(self):
        return {"src/functions.hpp": self.cpp(), **self.m_files()}


def main(arguments):
    if arguments not in ([], ["--check"]):
        sys.exit(__doc__)
    api = json.loads((HERE.parents[1] / "src/api/api.json").read_text(encoding="utf-8"))
    files = Package(api).files()
    there = {str(path.relative_to(HERE)) for path in (HERE / "+cairn").glob("*") if path.is_file()}
    stale = sorted(there - set(files))
    changed = [name for name, text in files.items()
               if not (HERE / name).exists() or (HERE / name).read_text(encoding="utf-8") != text]
    if arguments:
        for name in changed + stale:
            print(f"{name} is not what generate.py writes")
        return 1 if changed or stale else 0
    for name in changed:
        (HERE / name).parent.mkdir(parents=True, exist_ok=True)
        (HERE / name).write_text(files[name], encoding="utf-8")
    for name in stale:
        (HERE / name).unlink()
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
