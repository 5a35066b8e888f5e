# SPDX-License-Identifier: BSD-3-Clause
"""Replays the conformance scenarios (tests/conformance) through the public interface of the package, and compares with the
C replayer's output to the last bit.

conformance.py SCENARIOS C_OUTPUT: both are folders, C_OUTPUT is what cairn_conformance wrote with the same library.
"""

import json
import math
import pathlib
import re
import struct
import sys

import cairn
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
API = json.loads((ROOT / "src" / "api" / "api.json").read_text(encoding="utf-8"))
ENUMS = {enum["name"]: enum for enum in API["enums"]}
STRUCTS = {struct["name"]: struct for struct in API["structs"]}
FUNCTIONS = {function["name"]: function for function in API["functions"]}
ONLY_IN_C = {"cairn_last_message", "cairn_sim_last_message"}
BITS = re.compile("x[0-9a-f]{16}")


def python_name(c_name):
    return "".join(part.capitalize() for part in c_name.split("_")[1:])


CONSTANTS = {value["name"]: getattr(cairn, python_name(enum["name"]))(value["value"]) for enum in API["enums"]
             for value in enum["values"]}
CONSTANTS["CAIRN_ID_NONE"] = cairn.ID_NONE


class Aborted(Exception):
    """What the function `aborting` raises."""


# The functions of the scenarios.


def rotation(quaternion):
    w, x, y, z = map(float, quaternion)
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]


def predict_of(name, rows):
    """A named function for Filter.add_custom."""

    def predict(pose, landmark):
        if name == "aborting":
            raise Aborted
        if name == "refusing":
            return None
        d = [float(landmark[i]) - float(pose.position[i]) for i in range(3)]
        if name == "range_only":
            r = math.sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2])
            if r < 0.1:
                return None
            return [r], [[-(d[i] / r) for i in range(3)] + [0.0, 0.0, 0.0]], [[d[i] / r for i in range(3)]]
        R = rotation(pose.quaternion)
        b = [R[0][i] * d[0] + R[1][i] * d[1] + R[2][i] * d[2] for i in range(3)]
        if name == "body_point_ahead" and b[0] < 0:
            if b[0] < -5:
                raise Aborted
            return None
        by_pose = [[-R[0][i], -R[1][i], -R[2][i], R[1][i] * d[2] - R[2][i] * d[1], R[2][i] * d[0] - R[0][i] * d[2],
                    R[0][i] * d[1] - R[1][i] * d[0]] for i in range(rows)]
        by_landmark = [[R[0][i], R[1][i], R[2][i]] for i in range(rows)]
        if name == "wrong_jacobian":
            by_landmark[0][0] = R[0][0] + 0.5
        elif name == "unfinished":
            by_pose[0][0] = math.nan
        elif name not in ("body_point", "body_point_ahead"):
            raise KeyError(f"there is no function {name}")
        return b[:rows], by_pose, by_landmark

    return predict


def place_of(name, rows):
    if name is None:
        return None

    def place(pose, z):
        if name == "aborting":
            raise Aborted
        if name == "refusing":
            return None
        assert name == "body_point", name
        R, v = rotation(pose.quaternion), [float(z[i]) if i < rows else 0.0 for i in range(3)]
        c = [R[i][0] * v[0] + R[i][1] * v[1] + R[i][2] * v[2] for i in range(3)]
        turn = [[0.0, c[2], -c[1]], [-c[2], 0.0, c[0]], [c[1], -c[0], 0.0]]
        return ([float(pose.position[i]) + c[i] for i in range(3)],
                [[1.0 if i == k else 0.0 for k in range(3)] + turn[i] for i in range(3)],
                [R[i][:rows] for i in range(3)])

    return place


# Inputs.


def decoded(value, names):
    """The Python value of an input."""
    if isinstance(value, list):
        values = [decoded(item, names) for item in value]
        if values and all(isinstance(item, cairn.Doubts) for item in values):
            return cairn.Doubts(sum(values))
        return values
    if isinstance(value, dict):
        fields = {key: decoded(item, names) for key, item in value.items()}
        return cairn.Pose(**{key: np.array(item) for key, item in fields.items()}) \
            if set(fields) == {"position", "quaternion"} else fields
    if not isinstance(value, str):
        return value
    if value.startswith("$"):
        name, *path = value.split(".")
        value = names[name]
        for part in path:
            value = value[int(part)] if isinstance(value, list) else value[part]
        return value if name == value else decoded(value, names)
    if BITS.fullmatch(value):
        return struct.unpack(">d", bytes.fromhex(value[1:]))[0]
    if value.startswith("bytes:"):
        return bytes.fromhex(value[6:])
    if value.startswith("CAIRN_"):
        return CONSTANTS[value]
    if value in ("nan", "inf", "-inf"):
        return float(value)
    return int(value) if value.isdecimal() else value


def frame_of(observations):
    """An array of observations from a list of structs."""
    frame = np.zeros(len(observations or ()), cairn.OBSERVATION)
    for row, observation in zip(frame, observations or ()):
        row["id"] = observation.get("id", 0)
        z, noise = observation.get("z", []), observation.get("covariance", [])
        row["z"][:len(z)] = z
        row["covariance"].reshape(9)[:len(noise)] = noise
    return frame


def square(values):
    """A matrix from a flat list."""
    if values is None:
        return None
    side = math.isqrt(len(values))
    return np.reshape(values, (side, side))


# Outputs.


def member(value, name):
    if isinstance(value, (dict, np.void)):
        return value[name]
    return getattr(value, name)


def bits(value):
    return "nan" if math.isnan(value) else "x" + struct.pack(">d", value).hex()


def encoded_one(kind, value):
    """The JSON value of one output of a C type."""
    if kind == "double":
        return bits(float(value))
    if kind == "cairn_bool":
        return bool(value)
    if kind in ENUMS:
        names = {item["value"]: item["name"] for item in ENUMS[kind]["values"]}
        if ENUMS[kind]["bits"]:
            return [name for number, name in sorted(names.items()) if int(value) & number]
        return names[int(value)]
    if kind == "uint64_t":
        return str(int(value))
    if kind in ("size_t", "uint32_t", "int32_t"):
        return int(value)
    if kind == "char":
        return value
    fields = [field for field in STRUCTS[kind]["fields"] if field["role"] not in ("struct_size", "reserved")
              and not re.fullmatch(r"(.*_)?seconds", field["name"])]
    return {field["name"]: encoded(field["type"], field["length"], member(value, field["name"])) for field in fields}


def encoded(kind, length, value):
    """The JSON value of an output: of one value (length None) or of an array."""
    if length is None:
        return encoded_one(kind, value)
    if kind == "uint8_t":
        return "bytes:" + bytes(value).hex()
    flat = value.reshape(-1) if isinstance(value, np.ndarray) else value
    return [encoded_one(kind, item) for item in flat]


# The functions, by the public interface. `w` holds the inputs; the result holds the outputs, by the names of C.


def table():
    def returned(function, *names):
        return lambda w: {"return": function(*(w[name] for name in names))}

    def method(owner, name, *inputs, gives=()):
        """A method whose parameters and results have the order of C."""

        def call(w):
            result = getattr(w[owner], name)(*(w[key] for key in inputs))
            if not gives:
                return {}
            return dict(zip(gives, result)) if len(gives) > 1 else {gives[0]: result}

        return call

    def report(name, *inputs, owner="filter", gives="report"):
        return lambda w: {gives: getattr(w[owner], name)(*(w[key] for key in inputs))}

    def value(name, gives, owner="filter"):
        return lambda w: {gives: getattr(w[owner], name)}

    def adding(verb, struct_name):
        return lambda w: {"sensor": getattr(w["filter"], verb)(**w[struct_name])}

    def options(verb, key, *inputs, owner="filter"):
        def call(w):
            getattr(w[owner], verb)(*(w[name] for name in inputs), **w[key])
            return {}

        return call

    def estimate(name, owner="filter"):
        def call(w):
            position, quaternion, covariance = getattr(w[owner], name)(*([w["vehicle"]] if owner == "team" else []))
            return {"pose": cairn.Pose(position, quaternion), "covariance": covariance}

        return call

    def closing(owner):
        def call(w):
            w[owner].close()
            return {}

        return call

    def match(name, *inputs):
        return lambda w: {"match": getattr(w["filter"], name)(*(w.get(key) for key in inputs))}

    def custom(w, verb, *more):
        rows = w["custom"].get("rows", 3)
        return verb(predict_of(w["predict"], rows), place_of(w.get("place"), rows), *more, **w["custom"])

    def update_linear(w):
        rows, ids = len(w["residual"]), w.get("landmarks", [])
        by_pose, by_landmarks = w.get("jacobian_pose"), w.get("jacobian_landmarks", [])
        return {"match": w["filter"].update_linear(
            w["residual"], square(w["covariance"]), None if by_pose is None else np.reshape(by_pose, (rows, 6)), ids,
            np.reshape(np.array(by_landmarks, float), (rows, 3 * len(ids))))}

    def systematic(w):
        return {"errors": w["filter"].systematic_errors(), "covariance": w["filter"].systematic_covariance()}

    def squared(w, *names):
        return {**w, **{name: square(w.get(name)) for name in names}}

    def with_square(call, *names):
        return lambda w: call(squared(w, *names))

    def nothing(call):
        def run(w):
            call(w)
            return {}

        return run

    def preset(w):
        made, submap_landmarks = cairn.world_preset(w["preset"], **w.get("options", {}))
        return {"options": made, "submap_landmarks": submap_landmarks}

    def team_create(w):
        own = {**cairn.defaults(cairn.FilterOptions), **w["filter"]}
        return {"team": cairn.Team(filter=own, radar=w["radar"], **w["options"])}

    calls = {
        "cairn_status_name": returned(cairn.status_name, "status"),
        "cairn_version": returned(cairn.version), "cairn_version_number": returned(cairn.version_number),
        "cairn_has": lambda w: {"return": cairn.has(w["feature"]) if w.get("feature") is not None else False},
        "cairn_build": returned(cairn.build), "cairn_id_none": returned(cairn.id_none),
        "cairn_verdict_text": returned(cairn.verdict_text, "verdict"),
        "cairn_doubt_text": returned(cairn.doubt_text, "reason"),
        "cairn_pose_identity": lambda w: {"pose": cairn.pose_identity()},
        "cairn_pose_compose": lambda w: {"result": cairn.pose_compose(w["T_a_b"], w["T_b_c"])},
        "cairn_pose_inverse": lambda w: {"result": cairn.pose_inverse(w["T_a_b"])},
        "cairn_pose_apply": lambda w: {"point_a": cairn.pose_apply(w["T_a_b"], w["point_b"])},
        "cairn_pose_error": lambda w: {"difference": cairn.pose_error(w["truth"], w["estimate"])},
        "cairn_quaternion_from_euler":
            lambda w: {"quaternion": cairn.quaternion_from_euler(w["roll"], w["pitch"], w["yaw"])},
        "cairn_quaternion_to_euler":
            lambda w: dict(zip(("roll", "pitch", "yaw"), cairn.quaternion_to_euler(w["quaternion"]))),
        "cairn_quaternion_exp": lambda w: {"quaternion": cairn.quaternion_exp(w["rotation_vector"])},
        "cairn_quaternion_log": lambda w: {"rotation_vector": cairn.quaternion_log(w["quaternion"])},
        "cairn_map_size": lambda w: {"count": len(w["map"])},
        "cairn_map_landmark": method("map", "landmark", "id", gives=["landmark"]),
        "cairn_map_landmarks": method("map", "landmarks", gives=["landmarks"]),
        "cairn_map_within": method("map", "within", "centre", "radius", gives=["landmarks"]),
        "cairn_map_nearest": method("map", "nearest", "point", "count", gives=["landmarks"]),
        "cairn_map_in_box": method("map", "in_box", "lower", "upper", gives=["landmarks"]),
        "cairn_map_joint_covariance": method("map", "joint_covariance", "ids", gives=["matrix"]),
        "cairn_map_kind": value("form", "kind", owner="map"),
        "cairn_map_copy": method("map", "copy", gives=["copy"]),
        "cairn_map_destroy": closing("map"),
        "cairn_map_merge": lambda w: {"report": w["map"].merge(w["other"], **w.get("options", {}))},
        "cairn_map_merged_ids": method("map", "merged_ids", gives=["merged"]),
        "cairn_custom_check": lambda w: {"worst": custom(w, cairn.check_custom, w["pose"], w["landmark"])},
        "cairn_filter_required_bytes": lambda w: {"bytes": cairn.Filter.required_bytes(**w["options"])},
        "cairn_filter_create": lambda w: {"filter": cairn.Filter(**w["options"])},
        "cairn_filter_destroy": closing("filter"),
        "cairn_filter_set_log": nothing(lambda w: w["filter"].set_log(w.get("log"))),
        "cairn_filter_add_stereo_head": adding("add_stereo_head", "head"),
        "cairn_filter_add_stereo_camera": adding("add_stereo_camera", "camera"),
        "cairn_filter_add_range_bearing": adding("add_range_bearing", "radar"),
        "cairn_filter_add_cartesian": adding("add_cartesian", "cartesian"),
        "cairn_filter_add_custom": lambda w: {"sensor": custom(w, w["filter"].add_custom)},
        "cairn_filter_point_head": method("filter", "point_head", "sensor", "pan", "stick"),
        "cairn_filter_set_loss": method("filter", "set_loss", "sensor", "loss", "width"),
        "cairn_filter_set_view": method("filter", "set_view", "sensor", "lower", "upper"),
        "cairn_filter_set_wheels": options("set_wheels", "wheels"),
        "cairn_filter_set_twist_noise": options("set_twist_noise", "noise"),
        "cairn_filter_calibrate_sensor": options("calibrate_sensor", "calibration", "sensor"),
        "cairn_filter_predict_wheels": method("filter", "predict_wheels", "dt", "left_rad_per_s", "right_rad_per_s"),
        "cairn_filter_predict_wheels_gyro":
            method("filter", "predict_wheels_gyro", "dt", "left_rad_per_s", "right_rad_per_s", "rate"),
        "cairn_filter_predict_twist": method("filter", "predict_twist", "dt", "velocity", "rate"),
        "cairn_filter_predict_increment":
            with_square(method("filter", "predict_increment", "T_before_after", "covariance"), "covariance"),
        "cairn_filter_update": lambda w: {"matches": w["filter"].update(w["sensor"], frame_of(w.get("observations")))},
        "cairn_filter_update_linear": update_linear,
        "cairn_filter_update_position":
            with_square(match("update_position", "position", "covariance", "lever_arm"), "covariance"),
        "cairn_filter_update_attitude": with_square(match("update_attitude", "quaternion", "covariance"), "covariance"),
        "cairn_filter_update_heading": match("update_heading", "heading", "sigma"),
        "cairn_filter_remove_landmark": method("filter", "remove_landmark", "id"),
        "cairn_filter_merge_landmarks": match("merge_landmarks", "id", "other"),
        "cairn_filter_split_landmark":
            with_square(method("filter", "split_landmark", "id", "fresh", "covariance"), "covariance"),
        "cairn_filter_close_submap": method("filter", "close_submap"),
        "cairn_filter_last_closing": report("last_closing"), "cairn_filter_last_update": report("last_update"),
        "cairn_filter_pose": estimate("pose"), "cairn_filter_local_pose": estimate("local_pose"),
        "cairn_filter_base_pose": estimate("base_pose"),
        "cairn_filter_submap_count": value("submap_count", "count"),
        "cairn_filter_submap": method("filter", "submap", "index", gives=["base", "ids"]),
        "cairn_filter_joint_covariance": method("filter", "joint_covariance", "ids", gives=["matrix"]),
        "cairn_filter_map": value("map", "return"), "cairn_filter_local_map": value("local_map", "return"),
        "cairn_filter_pose_nees": method("filter", "pose_nees", "truth", gives=["nees"]),
        "cairn_filter_audit": method("filter", "audit", gives=["min_pivot"]),
        "cairn_filter_health": report("health", gives="health"),
        "cairn_filter_sensor_health": report("sensor_health", "sensor", gives="health"),
        "cairn_filter_systematic_errors": systematic,
        "cairn_filter_keep_pose": method("filter", "keep_pose", gives=["number"]),
        "cairn_filter_trajectory_range": method("filter", "trajectory_range", gives=["first", "end"]),
        "cairn_filter_trajectory": method("filter", "trajectory", "first", gives=["poses"]),
        "cairn_team_create": team_create, "cairn_team_destroy": closing("team"),
        "cairn_team_add": nothing(lambda w: w["team"].add(w["vehicle"], w.get("start"), square(w.get("covariance")))),
        "cairn_team_remove": method("team", "remove", "vehicle"),
        "cairn_team_members": method("team", "members", gives=["vehicles"]),
        "cairn_team_predict_increment":
            with_square(method("team", "predict_increment", "T_before_after", "covariance"), "covariance"),
        "cairn_team_predict_twist": nothing(lambda w: w["team"].predict_twist(w["dt"], w["velocity"], w["rate"],
                                                                              **w.get("noise", {}))),
        "cairn_team_observe": nothing(lambda w: w["team"].observe(w["time"], frame_of(w.get("landmarks")),
                                                                  frame_of(w.get("vehicles")))),
        "cairn_team_decisions": method("team", "decisions", gives=["matches"]),
        "cairn_team_leave": method("team", "leave"), "cairn_team_ask": method("team", "ask"),
        "cairn_team_take_packet": lambda w: {"packet": w["team"].take_packet() or b""},
        "cairn_team_receive": method("team", "receive", "packet", gives=["result"]),
        "cairn_team_pose": estimate("pose", owner="team"),
        "cairn_team_pose_nees": method("team", "pose_nees", "truth", gives=["nees"]),
        "cairn_team_map": value("map", "return", owner="team"),
        "cairn_team_score": method("team", "score", "truth"),
        "cairn_team_last_report": report("report", owner="team"),
        "cairn_world_options_preset": preset,
        "cairn_world_create": lambda w: {"world": cairn.World(**w["options"])},
        "cairn_world_destroy": closing("world"),
        "cairn_world_motions": method("world", "motions", gives=["motions"]),
        "cairn_world_observations": method("world", "observations", gives=["observations"]),
        "cairn_world_most_observations": value("most_observations", "count", owner="world"),
        "cairn_world_head": report("head", owner="world", gives="head"),
        "cairn_world_wheels": report("wheels", owner="world", gives="wheels"),
        "cairn_world_pose": method("world", "pose", "time", gives=["pose"]),
        "cairn_world_contacts": method("world", "contacts", "time", gives=["points"]),
        "cairn_world_height": method("world", "height", "x", "y", gives=["height"]),
        "cairn_world_extent": method("world", "extent", gives=["lower", "upper"]),
        "cairn_world_landmark": method("world", "landmark", "id", gives=["position"]),
        "cairn_world_landmarks": method("world", "landmarks", gives=["positions"]),
        "cairn_fleet_create": lambda w: {"fleet": cairn.Fleet(**w["options"])},
        "cairn_fleet_destroy": closing("fleet"),
        "cairn_fleet_vehicles": method("fleet", "vehicles", gives=["vehicles"]),
        "cairn_fleet_seen_features": method("fleet", "seen_features", "vehicle", gives=["features"]),
        "cairn_fleet_seen_vehicles": method("fleet", "seen_vehicles", "vehicle", gives=["vehicles"]),
        "cairn_fleet_features": method("fleet", "features", gives=["positions"]),
        "cairn_fleet_coast": method("fleet", "coast", gives=["points"]),
    }
    for kind in ("world", "fleet"):
        calls[f"cairn_{kind}_rewind"] = method(kind, "rewind")
        calls[f"cairn_{kind}_steps"] = lambda w, kind=kind: {"steps": len(w[kind])}

    def world_next(w):
        step = w["world"].next()
        step.motion_count, step.observation_count = len(step.motions), len(step.observations)
        return {"step": step}

    def fleet_next(w):
        step = w["fleet"].next()
        step.vehicle_count = len(step.vehicles)
        return {"step": step}

    calls["cairn_world_next"], calls["cairn_fleet_next"] = world_next, fleet_next
    for described in API["structs"]:
        if described["init"]:
            first = FUNCTIONS[described["init"]]["parameters"][0]["name"]
            calls[described["init"]] = (lambda w, kind=getattr(cairn, python_name(described["name"])), first=first:
                                        {first: cairn.defaults(kind)})
    return calls


CALLS = table()


def outputs(name, gives):
    """The JSON form of the outputs of a call; handles stay as they are."""
    function = FUNCTIONS[name]
    result = {}
    kinds = {parameter["name"]: parameter for parameter in function["parameters"]}
    for key, value in gives.items():
        described = function["returns"] if key == "return" else kinds[key]
        if isinstance(value, (cairn.Filter, cairn.Map, cairn.Team, cairn.World, cairn.Fleet)):
            result[key] = value
        else:
            result[key] = encoded(described["type"], described.get("length"), value)
    return result


def replay_call(call, expected, names, created, lines):
    """What a call gives, in the form of a replayer's output."""
    told = {"call": call["call"]}
    if call["call"] not in CALLS:
        raise KeyError(f"no method of the package is known for {call['call']}")
    inputs = {key: decoded(value, names) for key, value in call.get("with", {}).items()}
    if call["call"] == "cairn_filter_set_log" and "log" in inputs:
        inputs["log"] = lines.append
    try:
        gives = outputs(call["call"], CALLS[call["call"]](inputs))
    except cairn.CairnError as error:
        told.update(status=error.name, message=error.message)
    except StopIteration as stop:
        told.update(status=stop.__cause__.name, message=stop.__cause__.message)
    except Aborted:
        if expected.get("status") == "CAIRN_ERROR_CALLBACK":
            told.update(status=expected["status"], message=expected["message"])
    else:
        for key, name in call.get("gives", {}).items():
            if isinstance(name, str) and name.startswith("$"):
                names[name] = gives[key]
                if isinstance(gives[key], cairn.Filter | cairn.Map | cairn.Team | cairn.World | cairn.Fleet):
                    created.append(gives[key])
                    gives[key] = name
        if gives:
            told["gives"] = {key: value for key, value in gives.items()}
    if lines:
        told["log"] = lines[:]
        lines.clear()
    return told


def replay(scenario, output):
    """The differences to the C replayer's output."""
    names, created, lines, differences = {}, [], [], []
    if len(scenario["calls"]) != len(output["calls"]):
        return [f"{scenario['name']}: {len(scenario['calls'])} calls, and {len(output['calls'])} of the C replayer"]
    for number, (call, expected) in enumerate(zip(scenario["calls"], output["calls"])):
        try:
            told = replay_call(call, expected, names, created, lines)
        except Exception as error:  # noqa: BLE001
            told = f"{type(error).__name__}: {error}"
        if told != expected:
            differences.append(f"{scenario['name']}, call {number}, {json.dumps(call)[:300]}:\n  C      {json.dumps(expected)}\n"
                               f"  Python {json.dumps(told, default=repr)}")
    for handle in reversed(created):
        handle.close()
    return differences


def main():
    scenarios, output = map(pathlib.Path, sys.argv[1:3])
    missing = set(FUNCTIONS) - set(CALLS) - ONLY_IN_C
    if missing:
        sys.exit(f"functions that the package lacks: {', '.join(sorted(missing))}")
    files = sorted(scenarios.glob("*.json"))
    calls, differences, used = 0, [], set()
    for file in files:
        scenario = json.loads(file.read_text(encoding="utf-8"))
        calls += len(scenario["calls"])
        used |= {call["call"] for call in scenario["calls"]}
        differences += replay(scenario, json.loads((output / file.name).read_text(encoding="utf-8")))
    if not files:
        sys.exit(f"{scenarios} holds no scenarios")
    for difference in differences[:20]:
        print(difference)
    print(f"{len(files)} scenarios, {calls} calls of {len(used)} functions: {len(differences)} differ from C")
    sys.exit(bool(differences))


if __name__ == "__main__":
    main()
