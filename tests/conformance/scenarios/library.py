# SPDX-License-Identifier: BSD-3-Clause
"""Functions about the library itself, names of constants, and the defaults of all options."""

from .scenario import Scenario

STATUSES = ["OK", "ERROR_ARGUMENT", "ERROR_BUFFER", "ERROR_CAPACITY", "ERROR_NOT_FOUND", "ERROR_NUMERICAL",
            "ERROR_MEMORY",
            "ERROR_STATE", "ERROR_INTERNAL", "ERROR_CALLBACK"]
FEATURES = ["sparse", "teams", "trajectory", "systematic", "robust", "health", "errors", "time travel", ""]
DOUBTS = ["NIS", "REFUSALS", "WIDENED", "SENSOR_NOISE", "MOTION_NOISE", "BIAS", "JUMP", "LANDMARKS", "CLOSING",
          "BLIND",
          "DEFINITE"]
OPTIONS = ["filter_options", "stereo_head", "stereo_camera", "range_bearing", "cartesian", "custom", "wheels",
           "twist_noise",
           "calibration", "merge_options", "team_options", "world_options", "fleet_options"]


def library():
    s = Scenario("library", "The version of the library, its features, and the texts of constants.")
    s.call("cairn_version", gives={"return": "$version"})
    s.call("cairn_version_number", gives={"return": "$number"})
    s.call("cairn_build", gives={"return": "$build"})
    s.call("cairn_id_none")
    for feature in FEATURES:
        s.call("cairn_has", feature=feature)
    for status in STATUSES:
        s.call("cairn_status_name", status="CAIRN_" + status)
    for verdict in "GOOD", "DOUBTFUL", "LOST":
        s.call("cairn_verdict_text", verdict="CAIRN_VERDICT_" + verdict)
    for doubt in DOUBTS:
        s.call("cairn_doubt_text", reason=["CAIRN_DOUBT_" + doubt])
    return s


def defaults():
    s = Scenario("defaults", "The defaults of all options.")
    for options in OPTIONS:
        s.call(f"cairn_{options}_init")
    return s


SCENARIOS = [library, defaults]
