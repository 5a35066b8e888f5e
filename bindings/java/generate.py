#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Writes the Java sources that follow from the description of the C interface.

    generate.py API_JSON FOLDER     (FOLDER: the root of Java sources; the package's folder is made in it)

Generated are: the native methods, the layouts of structs, constants, enums, and the methods of all functions that no
callback makes special. A file that has not changed keeps its time.
"""
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent / "generator"))
sys.dont_write_bytecode = True

import callbacks  # noqa: E402  (the folder of this module must be known first)
import data  # noqa: E402
import methods  # noqa: E402
from docs import Docs  # noqa: E402
from names import Names  # noqa: E402


def calls_class(names, docs, handle, body):
    java = names.class_of(handle["name"]) + "Calls"
    return (data.HEAD + methods.IMPORTS + docs.comment(docs.sentence(handle["doc"]))
            + f"abstract class {java} extends Handle {{\n"
            f"  {java}(long address) {{\n    super(address, {native_of(names, handle)}::{handle['destroy']});\n  }}\n\n"
            f"  {java}(long address, Handle owner) {{\n    super(address, owner);\n  }}\n\n" + body.rstrip() + "\n}\n")


def native_of(names, item):
    header = next(h for h in names.api["headers"] if h["name"] == item["header"])
    return methods.native_class(header["library"])


def static_class(java, doc, body):
    return (data.HEAD + methods.IMPORTS + f"/** {doc} */\npublic final class {java} {{\n" + body
            + f"  private {java}() {{}}\n}}\n")


def sources(api):
    names = Names(api)
    docs = Docs(names)
    bodies = {}
    for function in api["functions"]:
        if not methods.by_hand(function):
            method = methods.Method(names, docs, function)
            bodies[method.home] = bodies.get(method.home, "") + method.source()
    files = {"ErrorLayout": data.layout_source(names), "CairnId": data.ids_source(docs, api)}
    for enum in api["enums"]:
        files[names.class_of(enum["name"])] = data.enum_source(names, docs, enum,
                                                               "\n" * (enum["name"] in bodies)
                                                               + bodies.pop(enum["name"], "").rstrip("\n")
                                                               + "\n" * (enum["name"] in names.enums))
    given = data.given_by_callers(names)
    for struct in api["structs"]:
        if struct["role"] != "error":
            files[names.class_of(struct["name"])] = data.struct_source(
                names, docs, struct, struct["name"] in given, bodies.pop(struct["name"], ""), native_of(names, struct))
    for handle in api["handles"]:
        files[names.class_of(handle["name"]) + "Calls"] = calls_class(names, docs, handle, bodies.pop(handle["name"]))
    files["Quaternion"] = static_class("Quaternion", "Rotations as quaternions w, x, y, z, and what they are made of.",
                                       bodies.pop("cairn_quaternion"))
    files["Cairn"] = static_class("Cairn", "The version of the library, and what it offers.",
                                  data.constants_source(docs, api) + bodies.pop("cairn"))
    assert not bodies, f"no class for {list(bodies)}"
    for library in api["libraries"]:
        files[methods.native_class(library["name"])] = methods.natives_source(
            library, [f for f in api["functions"] if f["library"] == library["name"]], api["libraries"][0])
    files.update(methods.records(names, docs))
    for callback in api["callbacks"]:
        if callback["name"] != "cairn_release_fn":
            files[names.class_of(callback["name"])] = callbacks.user_interface(names, docs, callback)
    files["Bridges"] = callbacks.bridges_source(names)
    return files


def main(arguments):
    if len(arguments) != 2:
        sys.exit(__doc__)
    with open(arguments[0], encoding="utf-8") as file:
        api = json.load(file)
    folder = pathlib.Path(arguments[1]) / "org" / "cairnslam"
    folder.mkdir(parents=True, exist_ok=True)
    files = {f"{name}.java": text for name, text in sources(api).items()}
    for old in folder.glob("*.java"):
        if old.name not in files:
            old.unlink()
    for name, text in files.items():
        path = folder / name
        if not path.exists() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
