#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes what the Rust crates know of the C interface, from its description api.json.

  python3 generate.py [--api FILE]           writes the generated files and the documentation of methods
  python3 generate.py --check [--api FILE]   changes nothing; fails if a file differs or a function has no method

cairn-sys/src/bindings.rs        functions, structs and constants of C, and tests of their layout
cairn/src/types.rs               the structs and constants in Rust's names
cairn/tests/support/fields.rs    the fields of these structs by their names, for the conformance test
cairn/src/*.rs                   in a file written by hand, a line `//~ cairn_filter_pose` stands above the method that
                                 calls this function; the method's documentation is written below that line
"""
import argparse
import json
import pathlib
import re
import sys
import textwrap

HERE = pathlib.Path(__file__).resolve().parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE.parent.parent / "src" / "api"))
import bindings_check  # noqa: E402
HEAD = "// SPDX-License-Identifier: BSD-3-Clause\n// Written by generate.py from api.json. Do not edit.\n"
RENAMED = {"cairn_result": "MatchResult"}  # Result is Rust's own
KEYWORDS = {"match", "type", "box", "move", "ref", "loop", "where", "use", "in", "as"}
INTEGERS = {"int32_t": "i32", "uint32_t": "u32", "uint64_t": "u64", "uint8_t": "u8", "size_t": "usize",
            "double": "f64", "char": "c_char", "void": "c_void"}


def camel(name):
    return RENAMED.get(name) or "".join(part.capitalize() for part in name.removeprefix("cairn_").split("_"))


def identifier(name):
    return "r#" + name if name in KEYWORDS else name


def snake(name):
    return name.lower()


class Api:
    def __init__(self, path):
        api = self.json = json.loads(path.read_text())
        self.constants = api["constants"]
        self.enums = api["enums"]
        self.structs = api["structs"]
        self.handles = api["handles"]
        self.callbacks = api["callbacks"]
        self.functions = api["functions"]
        self.struct = {struct["name"]: struct for struct in self.structs}
        self.enum = {enum["name"]: enum for enum in self.enums}
        for enum in self.enums:
            own = enum["name"].upper() + "_"
            names = [value["name"] for value in enum["values"]]
            enum["prefix"] = own if all(name.startswith(own) for name in names) else enum["prefix"]
        # The caller's own copy of such a struct has the layout of C: arrays of it need no conversion.
        self.plain = {struct["name"] for struct in self.structs if all(
            field["role"] in ("value", "sensor") and field["kind"] != "bool" for field in struct["fields"])}

    def safe_structs(self):
        return [struct for struct in self.structs if struct["role"] != "error"]


# cairn-sys ------------------------------------------------------------------------------------------------------------

def doc(text, indent, mark="///"):
    lines = []
    for paragraph in (text or "").strip().split("\n"):
        lines += textwrap.wrap(paragraph, 120 - len(indent) - len(mark) - 1, break_long_words=False,
                               break_on_hyphens=False, subsequent_indent="  " * paragraph.startswith("- ")) or [""]
    return "".join(f"{indent}{mark} {line}".rstrip() + "\n" for line in lines)


def escaped(text):
    """Text in which Markdown sees no markup except code between backticks."""
    parts = re.split(r"(`[^`]*`)", text or "")
    return "".join(part if part.startswith("`") else re.sub(r"([\[\]<*])", r"\\\1", part) for part in parts)


def c_type(declaration):
    """Rust's type of a C parameter, for example of `const double[3]`."""
    declaration = re.sub(r"\[\d*\]$", " *", declaration)
    words = declaration.replace("*", " * ").split()
    pointers = words.count("*")
    base = next(word for word in words if word not in ("const", "*", "struct"))
    result = INTEGERS.get(base, base)
    for level in range(pointers):
        result = ("*const " if words[0] == "const" and level == 0 else "*mut ") + result
    return result


def field_type(field):
    base = INTEGERS.get(field["type"], field["type"])
    return f"[{base}; {field['length']}]" if field["length"] else base


def parameters(function, indent):
    return ",".join(f"\n{indent}{identifier(parameter['name'])}: {c_type(parameter['c'])}"
                    for parameter in function["parameters"])


def sys_bindings(api):
    out = [HEAD, "use std::marker::{PhantomData, PhantomPinned};\nuse std::os::raw::{c_char, c_void};\n"]
    for constant in api.constants:
        out.append("\n" + doc(escaped(constant["doc"]), "") +
                   f"pub const {constant['name']}: {INTEGERS[constant['type']]} = {constant['value']};\n")
    out.append("\n/// A yes or no: 1 or 0. Any other value is refused.\npub type cairn_bool = i32;\n")
    for enum in api.enums:
        out.append("\n" + doc(escaped(enum["doc"]), "") + f"pub type {enum['name']} = {INTEGERS[enum['base']]};\n")
        for value in enum["values"]:
            out.append(doc(escaped(value["doc"]), "") +
                       f"pub const {value['name']}: {enum['name']} = {value['value']};\n")
    for handle in api.handles:
        out.append("\n" + doc(escaped(handle["doc"]), "") + f"#[repr(C)]\npub struct {handle['name']} {{\n"
                   "    _memory: [u8; 0],\n    _marker: PhantomData<(*mut u8, PhantomPinned)>,\n}\n")
    for struct in api.structs:
        out.append("\n" + doc(escaped(struct["doc"]), "") +
                   f"#[repr(C)]\n#[derive(Clone, Copy, Debug)]\npub struct {struct['name']} {{\n")
        for field in struct["fields"]:
            out.append(doc(escaped(field["doc"]), "    ") + f"    pub {field['name']}: {field_type(field)},\n")
        out.append("}\n")
    for callback in api.callbacks:
        returns = "" if callback["returns"]["type"] == "void" else f" -> {c_type(callback['returns']['type'])}"
        out.append("\n" + doc(escaped(callback["doc"]), "") +
                   f"pub type {callback['name']} = Option<unsafe extern \"C\" fn({parameters(callback, '    ')}\n)"
                   f"{returns}>;\n")
    for library in dict.fromkeys(function["library"] for function in api.functions):
        out.append(('\n#[cfg(feature = "sim")]' if library == "cairn_sim" else "") + '\nextern "C" {\n')
        for function in api.functions:
            if function["library"] == library:
                returns = c_type(function["returns"]["c"])
                out.append(doc(escaped(function["doc"]), "    ") + f"    pub fn {function['name']}("
                           f"{parameters(function, '        ')}\n    )" +
                           ("" if returns == "c_void" else f" -> {returns}") + ";\n")
        out.append("}\n")
    out.append("\n#[cfg(test)]\nmod layout {\n    use super::*;\n    use std::mem::{align_of, size_of, MaybeUninit};\n"
               "    use std::ptr::addr_of;\n")
    for struct in api.structs:
        out.append(f"\n    #[test]\n    fn {struct['name']}_is_that_of_the_description() {{\n"
                   f"        assert_eq!(size_of::<{struct['name']}>(), {struct['size']});\n"
                   f"        assert_eq!(align_of::<{struct['name']}>(), {struct['alignment']});\n"
                   f"        let memory = MaybeUninit::<{struct['name']}>::uninit();\n"
                   "        let start = memory.as_ptr();\n")
        for field in struct["fields"]:
            place = f"unsafe {{ addr_of!((*start).{field['name']}) }}"
            out.append(f"        assert_eq!({place} as usize - start as usize, {field['offset']});\n")
        out.append("    }\n")
    out.append("}\n")
    return "".join(out)


# Types of the safe crate ----------------------------------------------------------------------------------------------

ONLY_IN_C = re.compile(  # sentences that say who frees what, or what a pointer may be
    r"[Cc]apacity 0|struct_size|writes at most|`capacity`|Never NULL|destroys it with|frees it with|On an error `\*|"
    r"older or a newer header|`release` \(or|`user` is passed|(user|payload)` stays|Fails only for NULL|longjmp|"
    r"must be NULL if|NULL, the default|NULL and any other|`base` may be NULL|^Each may be NULL|^`place` NULL")
IN_RUST = [(r"; each may be NULL", ""), (r" \(or NULL\)", ""), (r", or NULL\)", ")"), (r"is not NULL", "is given"),
           (r"^NULL, ", ""), (r"\bNULL\b", "`None`"), (r"`\*(\w+)`", r"`\1`")]


class Names:
    """What the names of C are in Rust, for the documentation."""

    def __init__(self, api, methods):
        self.links = {}
        for struct in api.safe_structs():
            self.links[struct["name"]] = camel(struct["name"])
            if struct["init"]:
                self.links[struct["init"]] = camel(struct["name"]) + "::default"
        for handle in api.handles:
            self.links[handle["name"]] = camel(handle["name"])
        for enum in api.enums:
            self.links[enum["name"]] = camel(enum["name"])
            for value in enum["values"]:
                self.links[value["name"]] = camel(enum["name"]) + "::" + value["name"].removeprefix(enum["prefix"])
        self.links["CAIRN_ID_NONE"] = "ID_NONE"
        self.links["cairn_error"] = "Error"
        self.links.update(methods)

    def markdown(self, text):
        """Documentation of C as documentation of Rust: names become links; rules of C's memory are left out."""
        return "\n\n".join(filter(None, map(self.paragraph, re.split(r"\n\s*\n", text or ""))))

    def paragraph(self, text):
        sentences = re.split(r"(?<=[.;:]) (?=[A-Z`])", " ".join(text.split()))
        text = " ".join(sentence for sentence in sentences if not ONLY_IN_C.search(sentence))
        for c, rust in IN_RUST:
            text = re.sub(c, rust, text)
        parts = re.split(r"(`[^`]*`)", text)
        return "".join(self.code(part) if part.startswith("`") else self.prose(part) for part in parts)

    def code(self, part):
        name = part.strip("`")
        return self.link(name) if name in self.links else part

    def link(self, name):
        return f"[`{self.links[name]}`](crate::{self.links[name]})"

    def prose(self, part):
        part = re.sub(r"([\[\]<*])", r"\\\1", part)
        return re.sub(r"\b(cairn_\w+|CAIRN_\w+)", lambda match: self.code(f"`{match.group(0)}`"), part)


def safe_type(api, field):
    if field["type"] == "cairn_bool":
        base = "bool"
    elif field["type"] in INTEGERS:
        base = INTEGERS[field["type"]]
    else:
        base = camel(field["type"])
    return f"[{base}; {field['length']}]" if field["length"] else base


def values(struct):
    return [field for field in struct["fields"] if field["role"] not in ("struct_size", "reserved")]


def to_c(api, field):
    value = f"self.{snake(field['name'])}"
    if field["kind"] == "bool":
        return f"i32::from({value})"
    if field["kind"] == "enum":
        return f"{value}.0"
    return f"{value}.c_value()" if field["kind"] == "struct" else value


def from_c(api, field):
    value = f"c.{field['name']}"
    if field["kind"] == "bool":
        return f"{value} != 0"
    if field["kind"] == "enum":
        return f"{camel(field['type'])}({value})"
    return f"{camel(field['type'])}::from_c(&{value})" if field["kind"] == "struct" else value


def safe_enum(api, names, enum):
    name, base = camel(enum["name"]), INTEGERS[enum["base"]]
    bits = enum["bits"]
    out = ["\n", doc(names.markdown(enum["doc"]), ""),
           "#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]\n#[repr(transparent)]\n"
           f"pub struct {name}(\n    /// The value in C.\n    pub {base},\n);\n\nimpl {name} {{\n"]
    short = {value["name"]: value["name"].removeprefix(enum["prefix"]) for value in enum["values"]}
    for value in enum["values"]:
        out.append(doc(names.markdown(value["doc"]), "    ") +
                   f"    pub const {short[value['name']]}: {name} = {name}({value['value']});\n")
    out.append("}\n\n" f"impl fmt::Debug for {name} {{\n"
               "    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {\n")
    table = ", ".join(f'({value["value"]}, "{short[value["name"]]}")' for value in enum["values"])
    out.append(f"        debug_{'bits' if bits else 'value'}(f, \"{name}\", self.0, &[{table}])\n    }}\n}}\n")
    if bits:
        out.append(f"\nimpl std::ops::BitOr for {name} {{\n    type Output = {name};\n"
                   f"    fn bitor(self, other: {name}) -> {name} {{\n        {name}(self.0 | other.0)\n    }}\n}}\n")
    return "".join(out)


def whole(api, struct):
    """Whether a struct holds no floating-point number, so that equality is total."""
    return all(whole(api, api.struct[field["type"]]) if field["kind"] == "struct" else field["kind"] != "number"
               for field in struct["fields"])


def safe_struct(api, names, struct):
    name, plain = camel(struct["name"]), struct["name"] in api.plain
    out = ["\n", doc(names.markdown(struct["doc"]), ""), "#[derive(Clone, Debug, PartialEq" +
           (", Eq" if whole(api, struct) else "") + (", Copy" if not struct["versioned"] else "") + ")]\n" +
           ("#[repr(C)]\n" if plain else "") + f"pub struct {name} {{\n"]
    for field in values(struct):
        text = names.markdown(field["doc"])
        out.append(doc(text, "    ") + f"    pub {snake(field['name'])}: {safe_type(api, field)},\n")
    out.append(f"}}\n\nimpl {name} {{\n")
    if struct["versioned"]:
        out.append(f"    pub(crate) fn empty_c() -> sys::{struct['name']} {{\n"
                   "        // SAFETY: numbers, for which zero is a value.\n"
                   f"        let mut c: sys::{struct['name']} = unsafe {{ zeroed() }};\n"
                   f"        c.struct_size = size_of::<sys::{struct['name']}>() as u32;\n        c\n    }}\n\n")
    out.append(f"    #[allow(dead_code)]\n    pub(crate) fn from_c(c: &sys::{struct['name']}) -> Self {{\n"
               f"        {name} {{\n" +
               "".join(f"            {snake(field['name'])}: {from_c(api, field)},\n" for field in values(struct)) +
               "        }\n    }\n")
    if struct["role"] == "options" or struct["name"] == "cairn_pose":
        start = (f"        let mut c = Self::empty_c();\n" if struct["versioned"] else
                 f"        // SAFETY: numbers, for which zero is a value.\n"
                 f"        let mut c: sys::{struct['name']} = unsafe {{ zeroed() }};\n")
        out.append(f"\n    pub(crate) fn c_value(&self) -> sys::{struct['name']} {{\n" + start +
                   "".join(f"        c.{field['name']} = {to_c(api, field)};\n" for field in values(struct)) +
                   "        c\n    }\n")
    out.append("}\n")
    if struct["versioned"]:
        out.append(f"\nimpl Default for {name} {{\n" +
                   ("    /// The defaults of the library.\n" if struct["init"] else "    /// Zeros.\n") +
                   "    fn default() -> Self {\n"
                   f"        let {'mut ' if struct['init'] else ''}c = Self::empty_c();\n")
        if struct["init"]:
            out.append("        // SAFETY: the library writes at most the size that it gets. It fails only for NULL.\n"
                       "        unsafe {\n"
                       f"            sys::{struct['init']}(&mut c, size_of::<sys::{struct['name']}>(), "
                       "std::ptr::null_mut());\n        }\n")
        out.append("        Self::from_c(&c)\n    }\n}\n")
    return "".join(out)


def is_sim(item):
    return item["header"] in ("cairn/sim.h", "cairn/fleet.h")


def gated(item, text):
    """Every item of the simulator belongs to the feature `sim`."""
    if not is_sim(item):
        return text
    return re.sub(r"(?m)^((?:///.*\n|#\[.*\n)*)(?=pub struct|impl )", r'#[cfg(feature = "sim")]\n\1', text)


def safe_types(api, names):
    out = [HEAD, "use cairn_sys as sys;\nuse std::fmt;\nuse std::mem::{size_of, zeroed};\n\n"
           "/// Version of the C interface that this crate was made for: 10000 major + 100 minor + patch.\n"
           "pub const VERSION: u32 = sys::CAIRN_VERSION as u32;\n\n"]
    for constant in api.constants:
        if constant["name"] == "CAIRN_ID_NONE":
            out.append(doc(names.markdown(constant["doc"]), "") + "pub const ID_NONE: u64 = sys::CAIRN_ID_NONE;\n")
    out += [gated(enum, safe_enum(api, names, enum)) for enum in api.enums]
    out += [gated(struct, safe_struct(api, names, struct)) for struct in api.safe_structs()]
    out.append("""
fn debug_value<T: PartialEq + fmt::Display>(
    f: &mut fmt::Formatter<'_>, name: &str, value: T, constants: &[(T, &str)],
) -> fmt::Result {
    match constants.iter().find(|constant| constant.0 == value) {
        Some(constant) => write!(f, "{name}::{}", constant.1),
        None => write!(f, "{name}({value})"),
    }
}

fn debug_bits(f: &mut fmt::Formatter<'_>, name: &str, value: u32, constants: &[(u32, &str)]) -> fmt::Result {
    let set = constants.iter().filter(|constant| value & constant.0 != 0).map(|constant| constant.1);
    let set: Vec<&str> = set.collect();
    write!(f, "{name}({})", set.join(" | "))
}

#[cfg(test)]
mod layout {
    use super::*;
    use std::mem::{align_of, MaybeUninit};
    use std::ptr::addr_of;
""")
    for struct in api.safe_structs():
        if struct["name"] in api.plain:
            name = camel(struct["name"])
            out.append("\n" + ('    #[cfg(feature = "sim")]\n' if is_sim(struct) else "") +
                       f"    #[test]\n    fn {struct['name']}_is_that_of_c() {{\n"
                       f"        assert_eq!(size_of::<{name}>(), size_of::<sys::{struct['name']}>());\n"
                       f"        assert_eq!(align_of::<{name}>(), align_of::<sys::{struct['name']}>());\n"
                       f"        let (memory, c) = (MaybeUninit::<{name}>::uninit(), "
                       f"MaybeUninit::<sys::{struct['name']}>::uninit());\n"
                       "        let (start, c) = (memory.as_ptr(), c.as_ptr());\n")
            for field in struct["fields"]:
                out.append("        // SAFETY: only addresses are computed.\n"
                           "        let (rust, other) = unsafe {\n"
                           f"            (addr_of!((*start).{snake(field['name'])}) as usize, "
                           f"addr_of!((*c).{field['name']}) as usize)\n        }};\n"
                           "        assert_eq!(rust - start as usize, other - c as usize);\n")
            out.append("    }\n")
    out.append("}\n")
    return "".join(out)


# Fields for the conformance test --------------------------------------------------------------------------------------

def test_fields(api):
    out = [HEAD, "use super::json::{Fields, Json, Value};\nuse cairn::*;\n"]
    for enum in api.enums:
        name, bits = camel(enum["name"]), enum["bits"]
        table = ", ".join(f'("{value["name"]}", {value["value"]})' for value in enum["values"])
        out.append(f"\nimpl Json for {name} {{\n    fn read(value: &Value) -> Self {{\n"
                   f"        {name}(value.{'bits' if bits else 'constant'}(&[{table}]))\n    }}\n"
                   f"    fn write(&self) -> Value {{\n        Value::from_{'bits' if bits else 'constant'}"
                   f"(self.0, &[{table}])\n    }}\n}}\n")
    for struct in api.safe_structs():
        name = camel(struct["name"])
        read = [field for field in values(struct) if field["repeatable"]]
        out.append(f"\nimpl Fields for {name} {{\n    fn set(&mut self, name: &str, value: &Value) -> bool {{\n"
                   "        match name {\n" +
                   "".join(f'            "{field["name"]}" => self.{snake(field["name"])} = Json::read(value),\n'
                           for field in values(struct)) +
                   "            _ => return false,\n        }\n        true\n    }\n"
                   "    fn get(&self) -> Vec<(String, Value)> {\n        vec![\n" +
                   "".join(f'            ("{field["name"]}".into(), self.{snake(field["name"])}.write()),\n'
                           for field in read) +
                   "        ]\n    }\n}\n")
        if not struct["versioned"]:
            out.append(f"\nimpl super::json::Zero for {name} {{\n    fn zero() -> Self {{\n        {name} {{\n" +
                       "".join(f"            {snake(field['name'])}: super::json::Zero::zero(),\n"
                               for field in values(struct)) + "        }\n    }\n}\n")
        start = "Self::default()" if struct["versioned"] else "<Self as super::json::Zero>::zero()"
        out.append(f"\nimpl Json for {name} {{\n    fn read(value: &Value) -> Self {{\n"
                   f"        value.fields_over({start})\n    }}\n    fn write(&self) -> Value {{\n"
                   "        Value::Object(self.get())\n    }\n}\n")
    for enum in api.enums:
        out.append(f"\nimpl super::json::Zero for {camel(enum['name'])} {{\n    fn zero() -> Self {{\n"
                   f"        {camel(enum['name'])}(0)\n    }}\n}}\n")
    return "".join(out)


# Documentation of methods ---------------------------------------------------------------------------------------------

MARK = re.compile(r"^(\s*)//~ (cairn_\w+)$")


def sources():
    return sorted(path for path in (HERE / "cairn" / "src").glob("*.rs") if path.name != "types.rs")


def find_methods():
    """Rust's path of each function of C that has a method: the function below its mark."""
    methods = {}
    for path in sources():
        owner, waiting = "", []
        for line in path.read_text().split("\n"):
            block = re.match(r"impl(?:<[^>]*>)? (?:\w+ for )?(\w+)", line)
            if block:
                owner = block.group(1) + "::"
            elif line == "}":
                owner = ""
            mark, function = MARK.match(line), re.match(r"\s*pub fn (\w+)|\s*fn (drop)\b", line)
            if mark:
                waiting.append(mark.group(2))
            elif function and waiting:
                methods.update(dict.fromkeys(waiting, owner + (function.group(1) or function.group(2))))
                waiting = []
    return methods


def method_doc(names, function):
    text = names.markdown(function["doc"])
    if function.get("complexity"):
        text += f"\n\nComplexity: {names.markdown(function['complexity']).rstrip('.')}."
    return text


def errors_doc(names, function):
    errors = [(entry["status"], entry["when"]) for entry in function["errors"] if entry["when"] != "NULL"]
    lines = [f"- {names.link(status)}{': ' + names.markdown(when) if when else ''}" for status, when in errors]
    return "# Errors\n\n" + "\n".join(lines) if lines else ""


def documented(api, names, path):
    """The file with the documentation below each mark. Lines between `//~` and `//~ errors` are written by hand."""
    functions = {function["name"]: function for function in api.functions}
    lines, out = path.read_text().split("\n"), []
    while lines:
        line = lines.pop(0)
        out.append(line)
        mark = MARK.match(line)
        if not mark:
            continue
        block = []
        while re.match(r"\s*///|\s*//~( errors)?$", lines[0]):
            block.append(lines.pop(0).strip())
        if mark.group(2) not in functions:
            sys.exit(f"{path}: {mark.group(2)} is not in api.json")
        if re.match(r"\s*fn ", lines[0]):
            continue  # the method of a trait of Rust has the documentation of the trait
        function, indent = functions[mark.group(2)], mark.group(1)
        by_hand = block[block.index("//~"):] if "//~" in block else []
        by_hand = by_hand[:by_hand.index("//~ errors")] if "//~ errors" in by_hand else by_hand
        if by_hand[-1:] == ["///"]:
            by_hand.pop()
        text, errors = method_doc(names, function), errors_doc(names, function)
        if by_hand:
            out.append(doc(text + "\n\n", indent).rstrip("\n") + f"\n{indent}///")
            out += [indent + line for line in by_hand] + [indent + "//~ errors"] * bool(errors)
            out.append(doc("", indent) + doc(errors, indent).rstrip("\n") if errors else "")
        else:
            out.append(doc(text + ("\n\n" + errors if errors else ""), indent).rstrip("\n"))
        if not out[-1]:
            out.pop()
    return "\n".join(out)


def implemented(api, methods):
    """The names of C that a user of the safe crate has, read from its sources: functions that a method is marked with
    and calls, fields of public structs, constants."""
    code = "\n".join(path.read_text() for path in (HERE / "cairn" / "src").glob("*.rs"))
    names = {name for name in set(methods) | {struct["init"] for struct in api.structs if struct["init"]}
             if re.search(rf"\bsys::{name}\b", code)}
    for struct in api.safe_structs():
        body = re.search(rf"pub struct {camel(struct['name'])} {{(.*?)\n}}", code, re.DOTALL)
        fields = set(re.findall(r"^    pub (\w+):", body.group(1), re.MULTILINE)) if body else set()
        names |= {f"{struct['name']}.{field['name']}" for field in struct["fields"] if snake(field["name"]) in fields}
    for enum in api.enums:
        constants = set(re.findall(rf"pub const (\w+): {camel(enum['name'])} =", code))
        names |= {value["name"] for value in enum["values"] if value["name"].removeprefix(enum["prefix"]) in constants}
    # An Error has the fields of cairn_error as methods. The parts of the version are those of the package.
    names |= {"cairn_error.status", "cairn_error.message"}
    raw = (HERE / "cairn-sys" / "src" / "bindings.rs").read_text()
    return names | {constant["name"] for constant in api.constants if f"pub const {constant['name']}:" in raw}


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("--api", type=pathlib.Path, default=HERE.parent.parent / "src" / "api" / "api.json")
    arguments.add_argument("--check", action="store_true")
    arguments = arguments.parse_args()
    api = Api(arguments.api)
    methods = find_methods()
    names = Names(api, methods)
    files = {HERE / "cairn-sys/src/bindings.rs": sys_bindings(api),
             HERE / "cairn/src/types.rs": safe_types(api, names),
             HERE / "cairn/tests/support/fields.rs": test_fields(api)}
    files.update({path: documented(api, names, path) for path in sources()})
    differing = [path for path, text in files.items() if not path.exists() or path.read_text() != text]
    have = implemented(api, methods)
    missing = bindings_check.missing(api.json, have) + bindings_check.unknown(api.json, have)
    for crate in ("cairn-sys", "cairn"):
        manifest = HERE / crate / "Cargo.toml"
        if f'\nversion = "{api.json["version"]}"\n' not in manifest.read_text():
            sys.exit(f"{manifest}: the version of the package is not {api.json['version']}, that of the interface")
    if arguments.check:
        for path in differing:
            print(f"{path.relative_to(HERE)} is not what generate.py writes", file=sys.stderr)
        for name in missing:
            print(f"the crate lacks {name}", file=sys.stderr)
        required = bindings_check.required(api.json)
        print(f"{len(required)} names of functions, fields and constants, of which {len(missing)} are missing; "
              f"{len(files)} files, of which {len(differing)} differ")
        sys.exit(1 if differing or missing else 0)
    for path in differing:
        path.write_text(files[path])
        print(f"wrote {path.relative_to(HERE)}")
    if missing:
        print("missing:", *missing)


main()
