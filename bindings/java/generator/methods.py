# SPDX-License-Identifier: BSD-3-Clause
"""Java sources of the functions: native methods, and methods that call them."""
import re

from data import HEAD
from names import RECORDS, camel

JAVA_C = {"double": "double", "int32_t": "int", "uint32_t": "int", "uint64_t": "long", "size_t": "long", "void": "void"}
ARRAYS = {"double": ("double[]", "Doubles"), "uint64_t": ("long[]", "Longs"), "uint8_t": ("byte[]", "Bytes")}
IMPORTS = "import java.util.List;\nimport java.util.Objects;\n\n"


def signature(function):
    def of(item):
        pointer = item.get("pointers", 0) or "[" in item["c"] or "*" in item["c"] or item["kind"] == "callback"
        return "long" if pointer else JAVA_C[item["base"]]
    arguments = ", ".join(f"{of(p)} {camel(p['name'])}" for p in function["parameters"])
    return f"  static native {of(function['returns'])} {function['name']}({arguments});\n"


def native_class(library):
    return "CairnNative" if library == "cairn" else "CairnSimNative"


def natives_source(library, functions, first):
    java = native_class(library["name"])
    tells = any(f["name"] == "cairn_version_number" for f in functions)
    before = "" if library is first else f"    {native_class(first['name'])}.need();\n"
    return HEAD + f"""/** The functions of {library['soname']}. Pointers and sizes are long: this package needs a 64-bit Java. */
final class {java} {{
  private static final String PROBLEM = Library.bind({java}.class, "{library['soname']}", {str(tells).lower()});

  private {java}() {{}}

  /** Throws if the library is missing or has another version. */
  static void need() {{
{before}    Library.need(PROBLEM);
  }}

""" + "\n".join(signature(f) for f in functions) + "}\n"


class Method:
    """One function as a method. `receiver` is the parameter that `this` stands for."""

    def __init__(self, names, docs, function):
        self.names, self.docs, self.f = names, docs, function
        self.home, self.name = names.home(function)
        self.native = f"{native_class(function['library'])}.{function['name']}"
        self.params = [p for p in function["parameters"] if p["role"] != "error"]
        self.receiver = next((p for p in self.params if p["type"] == self.home and p["role"] in
                              ("handle", "object", "value") and p["direction"] != "out"), None)
        self.inputs, self.before, self.inside, self.second, self.after = [], [], [], [], []
        self.arguments, self.first_arguments, self.outputs, self.fills = [], [], [], None
        self.sized = any(p["role"] == "needed" for p in self.params)
        self.counts = {p["name"] for p in self.params if p["role"] == "count"}
        for p in self.params:
            self.add(p)

    def add(self, p):
        name, at = camel(p["name"]), camel(p["name"]) + "At"
        self.zero = None
        argument = getattr(self, "add_" + p["role"])(p, name, at)
        self.arguments.append(argument)
        self.first_arguments.append(self.zero or argument)

    def needed_input(self, p, name, java):
        self.inputs.append((java, name, p))
        if not p["optional"]:
            self.before.append(f'Objects.requireNonNull({name}, "{name}");')

    def add_handle(self, p, name, at):
        if p is self.receiver:
            return "address()"
        self.needed_input(p, name, self.names.class_of(p["type"]))
        return f"{name}.address()"

    def add_created(self, p, name, at):
        self.inside.append(f"final Call.Block {at} = call.longs(1);")
        owned = self.receiver is not None
        java = self.names.class_of(p["type"])
        self.outputs.append((java if owned else "long", f"new {java}({at}.getLong())" if owned else f"{at}.getLong()", p))
        return f"{at}.address"

    def add_value(self, p, name, at):
        if p is self.receiver:
            return "argument()"
        if p["kind"] == "enum":
            self.needed_input(p, name, self.names.class_of(p["type"]))
            return f"{name}.argument()"
        if p["kind"] == "bool":
            self.inputs.append(("boolean", name, p))
            return f"{name} ? 1 : 0"
        java = {"double": "double", "int32_t": "int"}.get(p["base"], "long")
        self.inputs.append((java, name, p))
        return {"size_t": f'Check.notNegative({name}, "{name}")', "uint32_t": f'Check.unsigned({name}, "{name}")'}.get(
            p["base"], name)

    add_sensor = add_value

    def add_text(self, p, name, at):
        self.needed_input(p, name, "String")
        self.inside.append(f"final Call.Block {at} = call.in({name});")
        return f"{at}.address"

    def add_object(self, p, name, at):
        java = self.names.class_of(p["type"])
        if p["direction"] == "out":
            if p["kind"] == "struct":
                self.inside += [f"final {java} {name} = new {java}();", f"final Call.Block {at} = call.out({name});"]
                self.outputs.append((java, f"{at}.to({name})", p))
            else:
                self.inside.append(f"final Call.Block {at} = call.longs(1);")
                java, value = {"enum": (java, f"{java}.of({at}.getInt())"),
                               "bool": ("boolean", f"{at}.getInt() != 0"),
                               "number": ("double", f"{at}.getDouble()")}.get(p["kind"]) or {
                    "int32_t": ("int", f"{at}.getInt()"),
                    "uint32_t": ("long", f"Integer.toUnsignedLong({at}.getInt())")}.get(
                    p["base"], ("long", f"{at}.getLong()"))
                self.outputs.append((java, value, p))
            return f"{at}.address"
        if p is self.receiver:
            self.inside.append(f"final Call.Block {at} = call.in(this);")
            if p["direction"] == "inout":
                self.after.append(f"{at}.to(this);")
        else:
            self.needed_input(p, name, java)
            self.inside.append(f"final Call.Block {at} = call.in({name});")
        return f"{at}.address"

    def expression(self, length):
        return re.sub(r"[a-z_]+", lambda word: camel(word.group()), length)

    def add_array(self, p, name, at):
        if p["direction"] == "out":
            return self.add_output_array(p, name, at)
        if p["kind"] == "struct":
            java = self.names.class_of(p["type"])
            self.needed_input(p, name, f"List<{java}>")
            self.inside.append(f'final Call.Block {at} = call.in({name}, {java}.TYPE, {camel(p["length"])}, "{name}");')
        else:
            java = ARRAYS[p["base"]][0]
            self.needed_input(p, name, java)
            if p["length"] not in self.counts or self.counted(p["length"]) is not p:
                guard = f"if ({name} != null) " if p["optional"] else ""
                line = f'Check.length({name}.length, {self.expression(p["length"])}, "{name}");'
                self.before.append(f"{guard[:-1]} {{\n  {line}\n}}" if guard else line)
            self.inside.append(f"final Call.Block {at} = call.in({name});")
        return f"{at}.address"

    def counted(self, count):
        """The input whose length is this count."""
        return next(p for p in self.params if p["direction"] == "in" and p["length"] == count)

    def add_output_array(self, p, name, at):
        if p["length"] in self.counts:
            java = self.names.class_of(p["type"])
            self.fills = (f"StructArray<{java}>", name, p)
            self.before.append(f"if ({name} != null) {{\n  Check.length({name}.size(), "
                               f'{self.expression(p["length"])}, "{name}");\n}}')
            self.inside.append(f'final Call.Block {at} = call.out({name}, {java}.TYPE, "{name}");')
            self.after.append(f"if ({name} != null) {{\n  {at}.to({name});\n}}")
            return f"{at}.address"
        lines = self.second if self.sized and "capacity" in p["length"] else self.inside
        length = self.expression(p["length"])
        if lines is self.second:
            self.zero = "0"
            length = f"Math.toIntExact({length})" if length == "capacity" else f"Math.toIntExact({length})"
        if p["kind"] == "struct":
            java = self.names.class_of(p["type"])
            lines += [f"final StructArray<{java}> {name} = StructArray.forResult({java}.TYPE, {length});",
                      f'final Call.Block {at} = call.out({name}, {java}.TYPE, "{name}");']
            self.outputs.append((f"StructArray<{java}>", f"{at}.to({name})", p))
        else:
            java, word = ARRAYS[p["base"]]
            room = {"Doubles": "doubles", "Longs": "longs", "Bytes": "room"}[word]
            lines.append(f"final Call.Block {at} = call.{room}({length});")
            self.outputs.append((java, f"{at}.get{word}({length})", p))
        return f"{at}.address"

    def add_count(self, p, name, at):
        source = self.counted(p["name"])
        size = "size()" if source["kind"] == "struct" else "length"
        self.before.append(f"final int {name} = {camel(source['name'])}.{size};")
        return name

    def add_capacity(self, p, name, at):
        self.zero = "0"
        return name

    def add_needed(self, p, name, at):
        self.inside.append(f"final Call.Block {at} = call.longs(1);")
        self.needed = at
        return f"{at}.address"

    def call(self, arguments):
        call = f"{self.native}({', '.join(arguments + ['call.error()'] * self.f['fallible'])})"
        return f"call.check({call});" if self.f["fallible"] else call

    def result(self):
        returns = self.f["returns"]
        if not self.f["fallible"]:
            call = self.call(self.arguments)
            if returns["kind"] == "handle":
                return self.names.class_of(returns["type"]), f"new {self.names.class_of(returns['type'])}({call}, this)"
            return {"text": ("String", f"Call.text({call})"), "bool": ("boolean", f"{call} != 0")}.get(
                returns["kind"]) or (("long", f"Integer.toUnsignedLong({call})") if returns["base"] == "uint32_t"
                                     else ("long", call))
        if len(self.outputs) > 1:
            record = RECORDS[tuple(p["name"] for _, _, p in self.outputs)]
            return record, f"new {record}({', '.join(value for _, value, _ in self.outputs)})"
        return self.outputs[0][:2] if self.outputs else ("void", "")

    def locks(self):
        handles = [("this" if p is self.receiver else camel(p["name"]), str(bool(p.get("changes"))).lower())
                   for p in self.params if p["role"] == "handle"]
        return f"call.lock({', '.join(x for pair in handles for x in pair)});" if handles else None

    def tags(self, inputs, returns):
        tags = []
        for java, name, p in inputs:
            words = self.docs.measure(p)
            if p["kind"] == "handle":
                words.insert(0, "the other handle" if self.receiver else "the handle")
            elif p["role"] == "sensor":
                words.insert(0, "the number of the sensor")
            elif p["role"] == "array":
                words.insert(0, f"{p['length']} values" if p["kind"] != "struct" else "an array or a list")
            if p["optional"]:
                words.append("may be null")
            tags.append(f"@param {name} {'; '.join(words) or 'see above'}")
        if returns != "void":
            words = []
            for _, _, p in self.outputs:
                measure = self.docs.measure(p)
                words.append(f"<code>{camel(p['name'])}</code>" + (f" ({'; '.join(measure)})" if measure else ""))
            tags.append(f"@return {', '.join(words) or 'the result'}")
        for error in self.f["errors"]:
            tags.append(f"@throws CairnException {{@link Status#{error['status'].removeprefix('CAIRN_')}}}: "
                        + self.docs.inline(error["when"] or "see above"))
        # One tag for all statuses: Javadoc lists an exception once.
        throws = [t for t in tags if t.startswith("@throws")]
        tags = [t for t in tags if not t.startswith("@throws")]
        if throws:
            tags.append("; ".join([throws[0]] + [t.removeprefix("@throws CairnException ") for t in throws[1:]]))
        return tags

    def head(self, visibility, static, returns, inputs):
        arguments = []
        for i, (java, name, p) in enumerate(inputs):
            last = i == len(inputs) - 1 and java.endswith("[]") and not p["optional"]
            arguments.append(f"{java.replace('[]', '...') if last else java} {name}")
        return f"  {visibility}{static}{returns} {self.name}({', '.join(arguments)}) {{\n"

    def source(self):
        returns, value = self.result()
        self.docs.receiver = self.receiver["name"] if self.receiver else None
        inside = self.inside[:]
        lock = self.locks()
        inside = ([lock] if lock else []) + inside
        if self.sized:
            inside += [self.call(self.first_arguments), f"final long capacity = {self.needed}.getLong();", *self.second]
        if self.f["fallible"]:
            inside.append(self.call(self.arguments))
        inside += self.after + ([f"return {value};"] if value else [])
        static = "" if self.receiver else "static "
        visibility = "public "
        if self.outputs and self.outputs[0][2]["role"] == "created" and not self.receiver:
            visibility = ""
        lines = self.before[:]
        if self.home not in self.names.handles or static:
            lines.insert(0, f"{self.native.split('.')[0]}.need();")
        if any("call." in line or "Call.Block" in line for line in inside) or lock:
            lines += ["try (Call call = new Call()) {", *(f"  {part}" for line in inside for part in line.split("\n")), "}"]
        else:
            lines += inside
        body = "".join(f"    {part}\n" for line in lines for part in line.split("\n")) + "  }\n\n"
        inputs = self.inputs + ([self.fills] if self.fills else [])
        mark = f'  @CName("{self.f["name"]}")\n'
        marked = visibility and not self.fills
        out = self.docs.comment(self.docs.sentence(self.f["doc"]), self.tags(inputs, returns), 2)
        out += (mark if marked else "") + self.head(visibility, static, returns, inputs) + body
        return out + (self.overloads(returns, static, mark) if visibility else "")

    def overloads(self, returns, static, mark):
        if self.fills:
            java, name, p = self.fills
            struct = self.names.class_of(p["type"])
            doc = self.docs.comment(self.docs.sentence(self.f["doc"]), self.tags(self.inputs, returns), 2)
            doc = doc.replace("   */", f"   * @return <code>{name}</code>\n   */").replace(
                "   * @throws", "   * @throws")
            passed = ", ".join(n for _, n, _ in self.inputs)
            source = camel(self.counted(p["length"])["name"])
            return (doc + mark + self.head("public ", static, java, self.inputs)
                    + f"    final {java} {name} = StructArray.forResult({struct}.TYPE, {source}.size());\n"
                    f"    {self.name}({passed}, {name});\n    return {name};\n  }}\n\n")
        kept = self.inputs[:]
        while kept and kept[-1][2]["optional"]:
            kept.pop()
        if len(kept) == len(self.inputs):
            return ""
        passed = ", ".join([n for _, n, _ in kept] + ["null"] * (len(self.inputs) - len(kept)))
        left_out = ", ".join(f"<code>{n}</code>" for _, n, _ in self.inputs[len(kept):])
        doc = self.docs.comment([f"The same without {left_out}.", self.docs.inline(self.docs.sentence(self.f["doc"]))],
                                self.tags(kept, returns), 2)
        return (doc + self.head("public ", static, returns, kept)
                + f"    {'' if returns == 'void' else 'return '}{self.name}({passed});\n  }}\n\n")


def by_hand(function):
    """Functions with callbacks, and those that end a handle or make options: constructors and Handle.close."""
    return (any(p["role"] == "callback" for p in function["parameters"]) or function["destroys"]
            or function["name"].endswith(("_init", "_last_message")))


def records(names, docs):
    """The classes of results of more than one value."""
    sources = {}
    for function in names.api["functions"]:
        if by_hand(function):
            continue
        method = Method(names, docs, function)
        java, _ = method.result()
        if len(method.outputs) < 2 or java in sources:
            continue
        tags = [f"@param {camel(p['name'])} {'; '.join(docs.measure(p)) or 'as the method that returns this says'}"
                for _, _, p in method.outputs]
        parts = ", ".join(f"{kind} {camel(p['name'])}" for kind, _, p in method.outputs)
        where = "{@link " + names.link(function["name"]) + "}"
        sources[java] = (HEAD + docs.comment([f"What {where} and methods like it return."], tags)
                         + f"public record {java}({parts}) {{}}\n")
    return sources
