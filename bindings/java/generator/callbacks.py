# SPDX-License-Identifier: BSD-3-Clause
"""Java sources of the callbacks: what a user implements, what C calls, and the way from one to the other."""
import re

from data import HEAD
from methods import JAVA_C
from names import camel


def user_parameters(names, callback):
    return [p for p in callback["parameters"] if p["role"] != "user"]


def java_type(names, p):
    if p["kind"] == "text":
        return "String"
    return names.class_of(p["type"]) if p["kind"] == "struct" else "double[]"


def method_name(names, callback):
    return camel(callback["name"].removeprefix("cairn_").removesuffix("_fn").split("_")[-1])


def answers(callback):
    return callback["returns"]["role"] == "answer"


def user_interface(names, docs, callback):
    java = names.class_of(callback["name"])
    inputs = user_parameters(names, callback)
    tags = []
    for p in inputs:
        words = docs.measure(p)
        if p["role"] == "array":
            words.insert(0, docs.inline(f"{p['length']} values"))
        tags.append(f"@param {camel(p['name'])} {'; '.join(words) or 'see above'}"
                    + ("; written by this method" if p["direction"] == "out" else ""))
    text = [docs.inline(part) for part in docs.sentence(callback["doc"]).split("\n\n")]
    if answers(callback):
        text.append("What it throws aborts the call that runs it. The call throws the same exception, and the handle stays "
                    "as before, bit for bit. The arrays are copies.")
        tags.append("@return true for C's 1, false for C's 0: " + docs.inline(callback["returns"]["doc"]))
    else:
        text.append("What it throws goes to the handler of uncaught exceptions of the thread. The call goes on.")
    result = "boolean" if answers(callback) else "void"
    arguments = ", ".join(f"{java_type(names, p)} {camel(p['name'])}" for p in inputs)
    return (HEAD + docs.comment(text) + f"@FunctionalInterface\npublic interface {java} {{\n"
            + docs.comment(text, tags, 2) + f"  {result} {method_name(names, callback)}({arguments});\n}}\n")


def thunk(names, callback):
    """What C calls."""
    def native(p):
        return "long" if p["pointers"] or "*" in p["c"] or "[" in p["c"] else JAVA_C[p["base"]]
    arguments = ", ".join(f"{native(p)} {camel(p['name'])}" for p in callback["parameters"])
    java = names.class_of(callback["name"]) if callback["name"] != "cairn_release_fn" else "Release"
    result = JAVA_C[callback["returns"].get("base") or callback["returns"]["type"]]
    return java, arguments, result


def bridge(names, callback):
    """The static method that C calls, by the thunk: finds the user's function, converts, catches."""
    java, arguments, result = thunk(names, callback)
    user = next(camel(p["name"]) for p in callback["parameters"] if p["role"] == "user")
    if java == "Release":
        return (f"  private static void release({arguments}) {{\n    Registration.release({user});\n  }}\n\n")
    out = f"  private static {result} {java[0].lower() + java[1:]}({arguments}) {{\n    try {{\n"
    out += f"      final Registration registration = Registration.of({user});\n"
    passed, written = [], []
    for p in user_parameters(names, callback):
        name = camel(p["name"])
        if p["kind"] == "text":
            passed.append(f"Call.text({name})")
        elif p["kind"] == "struct":
            struct = names.class_of(p["type"])
            passed.append(f"new {struct}(Memory.copyOf({name}, {struct}.TYPE.size()), 0)")
        else:
            length = re.sub(r"cairn_(\w+)\.(\w+)", lambda m: f"(int) registration.{camel(m[1])}().{camel(m[2])}()",
                            p["length"])
            out += f"      final double[] {name}Values = Registration.{'room' if p['direction'] == 'out' else 'read'}("
            out += f"{length});\n" if p["direction"] == "out" else f"{name}, {length});\n"
            passed.append(f"{name}Values")
            if p["direction"] == "out":
                written.append(f"        Registration.write({name}, {name}Values);\n")
    call = f"registration.{java[0].lower() + java[1:]}().{method_name(names, callback)}(\n          " + ", ".join(passed)
    if answers(callback):
        out += f"      if ({call})) {{\n" + "".join(written) + "        return 1;\n      }\n      return 0;\n"
        out += "    } catch (Throwable thrown) {\n      Call.thrown(thrown);\n      return -1;\n    }\n  }\n\n"
    else:
        out += f"      {call});\n    }} catch (Throwable thrown) {{\n      Registration.uncaught(thrown);\n    }}\n  }}\n\n"
    return out


def bridges_source(names):
    out = HEAD + "import com.sun.jna.Callback;\nimport com.sun.jna.CallbackReference;\nimport com.sun.jna.Pointer;\n\n"
    out += "/** The functions that C calls. There is one for each type of callback; `user` says whose it is. */\n"
    out += "final class Bridges {\n"
    for callback in names.api["callbacks"]:
        java, arguments, result = thunk(names, callback)
        field = java[0].lower() + java[1:]
        constant = re.sub(r"(?<!^)(?=[A-Z])", "_", java).upper()
        out += f"  /** Called by JNA. */\n  interface {java}Thunk extends Callback {{\n    {result} callback({arguments});\n  }}\n\n"
        out += f"  private static final {java}Thunk {constant}_THUNK = Bridges::{field};\n\n"
        out += f"  /** The address for C. */\n  static final long {constant} = address({constant}_THUNK);\n\n"
    out += ("  private Bridges() {}\n\n  private static long address(Callback callback) {\n"
            "    return Pointer.nativeValue(CallbackReference.getFunctionPointer(callback));\n  }\n\n")
    out += "".join(bridge(names, callback) for callback in names.api["callbacks"])
    return out.rstrip() + "\n}\n"
