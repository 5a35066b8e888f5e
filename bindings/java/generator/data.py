# SPDX-License-Identifier: BSD-3-Clause
"""Java sources of the data of the interface: constants, enums, structs, layouts."""
from names import camel

HEAD = "// SPDX-License-Identifier: BSD-3-Clause\n// Generated from api.json by generate.py.\npackage org.cairnslam;\n\n"


def enum_source(names, docs, enum, methods):
    java = names.class_of(enum["name"])
    out = HEAD
    if enum["bits"]:
        out += "import java.util.Collections;\nimport java.util.EnumSet;\nimport java.util.Set;\n\n"
    out += docs.comment(docs.sentence(enum["doc"])) + f'@CName("{enum["name"]}")\npublic enum {java} {{\n'
    for value in enum["values"]:
        out += docs.comment(docs.sentence(value["doc"] or value["name"]), indent=2)
        out += f'  @CName("{value["name"]}")\n  {names.constant(enum, value)}({value["value"]}),\n\n'
    out += ("  /** A value of a newer library, which this package has no name for. The library cannot be given it. */\n"
            "  UNRECOGNISED(Integer.MIN_VALUE);\n\n  private final int code;\n\n"
            f"  {java}(int code) {{\n    this.code = code;\n  }}\n\n"
            "  /**\n   * The number that C uses.\n   *\n   * @return the number\n   */\n"
            "  public int code() {\n    return code;\n  }\n\n"
            "  /**\n   * The constant of a number that C uses.\n   *\n   * @param code the number\n"
            "   * @return the constant, or {@link #UNRECOGNISED}\n   */\n"
            f"  public static {java} of(int code) {{\n    return switch (code) {{\n")
    for value in enum["values"]:
        out += f"      case {value['value']} -> {names.constant(enum, value)};\n"
    out += ("      default -> UNRECOGNISED;\n    };\n  }\n\n"
            "  int argument() {\n    if (this == UNRECOGNISED) {\n"
            f'      throw new IllegalArgumentException("{java}.UNRECOGNISED is no argument");\n    }}\n'
            "    return code;\n  }\n")
    if enum["bits"]:
        out += (f"\n  static Set<{java}> setOf(int bits) {{\n    final Set<{java}> set = EnumSet.noneOf({java}.class);\n"
                f"    for ({java} value : values()) {{\n      if (value != UNRECOGNISED && (bits & value.code) != 0) {{\n"
                "        set.add(value);\n        bits &= ~value.code;\n      }\n    }\n"
                "    if (bits != 0) {\n      set.add(UNRECOGNISED);\n    }\n"
                "    return Collections.unmodifiableSet(set);\n  }\n")
    return out + methods + "}\n"


def field_type(names, field):
    if field["kind"] == "enum":
        java = names.class_of(field["type"])
        return f"java.util.Set<{java}>" if names.enums[field["type"]]["bits"] else java
    if field["kind"] == "struct":
        return names.class_of(field["type"])
    if field["kind"] == "number":
        return "double[]" if field["length"] else "double"
    return {"bool": "boolean"}.get(field["kind"]) or ("int" if field["base"] == "int32_t" else "long")


def getter(names, field):
    at, java = field["offset"], names.class_of(field["type"])
    if field["kind"] == "enum":
        return f"{java}.{'setOf' if names.enums[field['type']]['bits'] else 'of'}(getInt({at}))"
    if field["kind"] == "struct":
        return f"new {java}(memory, offset + {at})"
    if field["kind"] == "number":
        return f"getDoubles({at}, {field['length']})" if field["length"] else f"getDouble({at})"
    if field["kind"] == "bool":
        return f"getInt({at}) != 0"
    return {"int32_t": f"getInt({at})", "uint32_t": f"Integer.toUnsignedLong(getInt({at}))"}.get(
        field["base"], f"getLong({at})")


def setter(field, name):
    at = field["offset"]
    if field["kind"] == "enum":
        return f"putInt({at}, {name}.argument())"
    if field["kind"] == "struct":
        return f"this.{name}().set({name})"
    if field["kind"] == "number":
        return f'putDoubles({at}, {name}, {field["length"]}, "{name}")' if field["length"] else f"putDouble({at}, {name})"
    if field["kind"] == "bool":
        return f"putInt({at}, {name} ? 1 : 0)"
    return {"int32_t": f"putInt({at}, {name})", "uint32_t": f'putInt({at}, Check.unsigned({name}, "{name}"))'}.get(
        field["base"], f"putLong({at}, {name})")


def given_by_callers(names):
    """Structs that a caller fills: their fields have setters."""
    given = {p["type"] for f in names.api["functions"] for p in f["parameters"]
             if p["kind"] == "struct" and p["direction"] != "out"}
    given |= {s["name"] for s in names.api["structs"] if s["role"] == "options"}
    return given | {f["type"] for s in names.api["structs"] if s["name"] in given for f in s["fields"]
                    if f["kind"] == "struct"}


def field_source(names, docs, struct, field, given):
    name, java = camel(field["name"]), field_type(names, field)
    about = [docs.inline(docs.sentence(field["doc"] or field["name"].replace("_", " ")))]
    measure = docs.measure(field)
    if field["length"]:
        measure.insert(0, f"{field['length']} values")
    if field["base"] == "uint64_t":
        measure.append("all 64 bits count: see {@link CairnId}")
    tags = "; ".join(measure) or "the value"
    mark = f'  @CName("{struct["name"]}.{field["name"]}")\n'
    out = docs.comment(about, [f"@return {tags}"], 2) + mark
    out += f"  public {java} {name}() {{\n    return {getter(names, field)};\n  }}\n\n"
    if field["kind"] == "enum":
        out += docs.comment([f"The number of {{@link #{name}()}}, which a newer library may have no constant for."],
                            ["@return the number"], 2)
        out += f"  public int {name}Code() {{\n    return getInt({field['offset']});\n  }}\n\n"
    if field["length"]:
        out += docs.comment([f"One value of {{@link #{name}()}}, without an array."],
                            [f"@param index in [0, {field['length']})", "@return the value"], 2)
        out += (f"  public double {name}At(int index) {{\n"
                f"    return getDoubleOf({field['offset']}, {field['length']}, index);\n  }}\n\n")
    if given and not (field["kind"] == "enum" and names.enums[field["type"]]["bits"]):
        argument = java.replace("[]", "...")
        out += docs.comment(about, [f"@param {name} {tags}", "@return this"], 2) + mark
        out += (f"  public {names.class_of(struct['name'])} {name}({argument} {name}) {{\n    {setter(field, name)};\n"
                "    return this;\n  }\n\n")
    return out


def struct_source(names, docs, struct, given, methods, native):
    java, size = names.class_of(struct["name"]), struct["size"]
    visible = [f for f in struct["fields"] if f["role"] not in ("struct_size", "reserved")]
    out = HEAD + "import java.util.Objects;\n\n" * bool(methods)
    out += docs.comment(docs.sentence(struct["doc"])) + f'@CName("{struct["name"]}")\n'
    out += f"public final class {java} extends Struct {{\n"
    out += f"  static final StructType<{java}> TYPE = new StructType<>({java}.class, {size}, {java}::new);\n\n"
    if struct["init"]:
        out += "  /** Has the library's defaults. */\n" + f'  @CName("{struct["init"]}")\n  public {java}() {{\n'
        out += f"    this(Memory.heap({size}), 0);\n    {native}.need();\n    try (Call call = new Call()) {{\n"
        out += "      final Call.Block block = call.out(this);\n"
        out += f"      call.check({native}.{struct['init']}(block.address, {size}, call.error()));\n"
        out += "      block.to(this);\n    }\n  }\n\n"
    else:
        out += f"  /** All values are zero. */\n  public {java}() {{\n    this(Memory.heap({size}), 0);\n"
        if struct["versioned"]:
            out += f"    putInt({next(f['offset'] for f in struct['fields'] if f['role'] == 'struct_size')}, {size});\n"
        out += "  }\n\n"
    out += f"  {java}(Memory memory, int offset) {{\n    super(memory, offset);\n  }}\n\n"
    out += f"  @Override\n  StructType<{java}> type() {{\n    return TYPE;\n  }}\n\n"
    out += docs.comment(["A struct of its own with the same values."], ["@return the copy"], 2)
    out += (f"  public {java} copy() {{\n    final {java} copy = new {java}(Memory.heap({size}), 0);\n"
            "    copy.set(this);\n    return copy;\n  }\n\n")
    if not struct["versioned"]:
        out += docs.comment(["Makes an array outside the Java heap, which the library uses without a copy. All is zero."],
                            ["@param size the number of structs", "@return the array"], 2)
        out += (f"  public static StructArray<{java}> array(int size) {{\n"
                "    return StructArray.direct(TYPE, size);\n  }\n\n")
    for field in visible:
        out += field_source(names, docs, struct, field, given)
    out += methods
    shown = [f'"{camel(f["name"])}", ' + (f"Long.toUnsignedString({camel(f['name'])}())" if f["base"] == "uint64_t"
                                        else f"{camel(f['name'])}()") for f in visible]
    out += "  @Override\n  public String toString() {\n    return text(\n        " + ",\n        ".join(shown)
    return out + ");\n  }\n}\n"


def layout_source(names):
    """Of cairn_error, which every call brings and no user sees."""
    error = next(s for s in names.api["structs"] if s["role"] == "error")
    out = HEAD + "/** The layout of cairn_error. */\nfinal class ErrorLayout {\n"
    out += f"  static final int SIZE = {error['size']};\n"
    for field in error["fields"]:
        out += f"  static final int {field['name'].upper()} = {field['offset']};\n"
    return out + "\n  private ErrorLayout() {}\n}\n"


def constants_source(docs, api):
    out = (f'  /** The version of this package and of the library that it needs. */\n'
           f'  public static final String VERSION_TEXT = "{api["version"]}";\n\n')
    for constant in api["constants"]:
        if constant["type"] == "int32_t":
            out += docs.comment(docs.sentence(constant["doc"]), indent=2) + f'  @CName("{constant["name"]}")\n'
            out += f"  public static final int {constant['name'].removeprefix('CAIRN_')} = {constant['value']};\n\n"
    return out


def ids_source(docs, api):
    none = next(c for c in api["constants"] if c["name"] == "CAIRN_ID_NONE")
    return HEAD + """/**
 * Ids of landmarks and vehicles, and other numbers of 64 bits without a sign. Java has no such type: they are a
 * {@code long}, of which all 64 bits count. An id beyond 2^63 is a negative {@code long}. Compare ids by {@code ==};
 * print, read and order them by the methods of this class.
 */
public final class CairnId {
""" + docs.comment(docs.sentence(none["doc"]), indent=2) + f'''  @CName("{none["name"]}")
  public static final long NONE = Long.parseUnsignedLong("{none["value"]}");

  private CairnId() {{}}

  /**
   * The decimal digits of an id.
   *
   * @param id the id
   * @return digits without a sign
   */
  public static String toString(long id) {{
    return Long.toUnsignedString(id);
  }}

  /**
   * Reads an id.
   *
   * @param digits decimal digits, at most 2^64 - 1
   * @return the id
   * @throws NumberFormatException if these are no such digits
   */
  public static long parse(String digits) {{
    return Long.parseUnsignedLong(digits);
  }}

  /**
   * Orders ids.
   *
   * @param id an id
   * @param other another one
   * @return negative, 0 or positive, as the first one is smaller, equal or larger
   */
  public static int compare(long id, long other) {{
    return Long.compareUnsigned(id, other);
  }}
}}
'''
