# SPDX-License-Identifier: BSD-3-Clause
"""What the names of the C interface become in Java."""
import re

KEYWORDS = set("abstract assert boolean break byte case catch char class const continue default do double else enum "
               "extends final finally float for goto if implements import instanceof int interface long native new "
               "package private protected public return short static strictfp super switch synchronized this throw "
               "throws transient try void volatile while hashCode toString getClass notify wait clone".split())
CLASSES = {"cairn_map": "CairnMap"}  # java.util has a Map
# Functions without a handle whose name does not say which class they belong to.
HOMES = {"cairn_status_name": "cairn_status", "cairn_doubt_text": "cairn_doubts", "cairn_verdict_text": "cairn_verdict"}
METHODS = {"cairn_status_name": "cName"}  # every enum has a name() of its own
# Results of more than one value.
RECORDS = {("pose", "covariance"): "PoseEstimate", ("base", "ids"): "Submap",
           ("errors", "covariance"): "SystematicErrors", ("first", "end"): "TrajectoryRange",
           ("roll", "pitch", "yaw"): "EulerAngles", ("lower", "upper"): "Extent"}


def camel(name):
    first, *rest = name.split("_")
    word = first.lower() + "".join(part[:1].upper() + part[1:] for part in rest)
    return word + "_" if word in KEYWORDS else word


def pascal(name):
    return "".join(part[:1].upper() + part[1:] for part in name.split("_"))


class Names:
    """Where everything of api.json is found in Java."""

    def __init__(self, api):
        self.api = api
        self.enums = {e["name"]: e for e in api["enums"]}
        self.structs = {s["name"]: s for s in api["structs"]}
        self.handles = {h["name"]: h for h in api["handles"]}
        self.callbacks = {c["name"]: c for c in api["callbacks"]}
        self.functions = {f["name"]: f for f in api["functions"]}
        self.constants = {c["name"]: c for c in api["constants"]}
        self.values = {v["name"]: (e, v) for e in api["enums"] for v in e["values"]}
        self.fields = {f["name"] for s in api["structs"] for f in s["fields"]}
        self.parameters = {p["name"] for f in api["functions"] for p in f["parameters"]}

    def class_of(self, name):
        if name in CLASSES:
            return CLASSES[name]
        if name in self.callbacks:
            return pascal(name.removeprefix("cairn_").removesuffix("_fn"))
        if name in self.enums and self.enums[name]["bits"]:
            return pascal(name.removeprefix("cairn_").removesuffix("s"))
        return pascal(name.removeprefix("cairn_"))

    def constant(self, enum, value):
        """CAIRN_ENCODER_PER_FRAME of cairn_encoder: PER_FRAME."""
        own = enum["name"].upper() + "_"
        prefix = own if all(v["name"].startswith(own) for v in enum["values"]) else enum["prefix"]
        return value["name"].removeprefix(prefix)

    def home(self, function):
        """The type that a function belongs to, or "quaternion" or "cairn"; and the name of the method."""
        name = function["name"]
        home = HOMES.get(name)
        handle = next((p["type"] for p in function["parameters"] if p["role"] in ("handle", "created")), None)
        if home is None and handle and name.startswith(handle + "_"):
            home = handle
        if home is None:
            homes = [t for t in (*self.structs, *self.handles) if name.startswith(t + "_")]
            home = max(homes, key=len, default=None)
        if home is None:
            home = "cairn_quaternion" if name.startswith("cairn_quaternion_") else "cairn"
        prefix = home if name.startswith(home + "_") else "_".join(name.split("_")[:2])
        prefix = prefix if name not in ("cairn_id_none", "cairn_version_number") and home != "cairn" else "cairn"
        return home, METHODS.get(name) or camel(name.removeprefix(prefix + "_"))

    def java_home(self, home):
        if home == "cairn":
            return "Cairn"
        return "Quaternion" if home == "cairn_quaternion" else self.class_of(home)

    def link(self, name):
        """The target of a link of Javadoc, or None: nothing of the interface."""
        if name in self.values:
            enum, value = self.values[name]
            return f"{self.class_of(enum['name'])}#{self.constant(enum, value)}"
        if name == "CAIRN_ID_NONE":
            return "CairnId#NONE"
        if name in self.constants:
            return f"Cairn#{name.removeprefix('CAIRN_')}"
        if name in ("cairn_error", "cairn_last_message", "cairn_sim_last_message"):
            return "CairnException"
        if name in self.structs or name in self.enums or name in self.handles:
            return self.class_of(name)
        if name in self.callbacks:
            return None if name == "cairn_release_fn" else self.class_of(name)
        if name in self.functions:
            if name.endswith("_init"):
                return self.class_of(name.removesuffix("_init"))
            if name.endswith("_create"):
                return self.class_of(name.removesuffix("_create"))
            if name.endswith("_destroy"):
                return "Handle#close"
            home, method = self.home(self.functions[name])
            return f"{self.java_home(home)}#{method}"
        return None
