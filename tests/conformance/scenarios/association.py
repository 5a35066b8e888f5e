# SPDX-License-Identifier: BSD-3-Clause
"""Landmarks without ids, landmarks that are deferred or missed, and frames that contradict the pose."""

from .drive import Drive
from .scenario import Scenario, seen
from .sensors import START, ask


def without_ids(frame):
    """Observations whose ids say nothing."""
    return [{**observation, "id": str(n)} for n, observation in enumerate(frame)]


def unknown(name, about, kind, **options):
    s = Scenario(name, about)
    drive = Drive(11, landmarks=30, size=15.0)
    rover = s.call("cairn_filter_create", gives={"filter": "$rover"},
                   options={"association": kind, "initial_covariance": START, **options})
    s.call("cairn_filter_add_cartesian", filter=rover, cartesian={"sigma": [0.05, 0.05, 0.05]})
    for _ in range(10):
        drive.twist(s, rover, 1.0, 0.1)
        s.call("cairn_filter_update", filter=rover, sensor=0, observations=without_ids(drive.cartesian(reach=10.0)))
    # Two observations at one place, and one between known and new: what is paired is decided by the association.
    frame = drive.cartesian(reach=10.0)
    twin = [round(value + 0.11, 4) for value in frame[0]["z"]]
    far = [round(value + 0.28, 4) for value in frame[1]["z"]]
    s.call("cairn_filter_update", filter=rover, sensor=0,
           observations=without_ids(frame + [seen(0, *twin), seen(0, *far)]))
    # Each passes its own gate, but they do not go together.
    drive.twist(s, rover, 1.0, 0.1)
    frame = drive.cartesian(reach=10.0, sigma=0.0)
    for n, observation in enumerate(frame):
        signs = (-1) ** n, (-1) ** (n // 2), (-1) ** (n // 3)
        observation["z"] = [round(value + 0.12 * sign, 4) for value, sign in zip(observation["z"], signs)]
    s.call("cairn_filter_update", filter=rover, sensor=0, observations=without_ids(frame))
    ask(s, rover)
    themap = s.call("cairn_filter_map", gives={"return": "$map"}, filter=rover)
    s.call("cairn_map_landmarks", map=themap)
    return s


def nearest():
    return unknown("association_nearest", "Nearest neighbours by likelihood.", "CAIRN_ASSOCIATION_NEAREST",
                   association_distance="CAIRN_DISTANCE_LIKELIHOOD", new_probability=0.999)


def joint():
    return unknown("association_joint", "Jointly compatible pairs.", "CAIRN_ASSOCIATION_JOINT",
                   association_distance="CAIRN_DISTANCE_MAHALANOBIS", association_nodes=500)


def deferred():
    s = Scenario("deferred", "Landmarks that count after two sightings, and landmarks that are missed and removed.")
    drive = Drive(12, landmarks=25, size=12.0)
    rover = s.call("cairn_filter_create", gives={"filter": "$rover"},
                   options={"association": "CAIRN_ASSOCIATION_KNOWN", "deferred_sightings": 2, "deferred_frames": 3,
                            "missed_frames": 2, "initial_covariance": START})
    s.call("cairn_filter_add_cartesian", filter=rover, cartesian={"sigma": [0.05, 0.05, 0.05]})
    s.call("cairn_filter_set_view", filter=rover, sensor=0, lower=[-9.0, -9.0, -9.0], upper=[9.0, 9.0, 9.0])
    themap = s.call("cairn_filter_map", gives={"return": "$map"}, filter=rover)
    gone = None
    for step in range(6):
        drive.twist(s, rover, 0.5, 0.05)
        frame = drive.cartesian(reach=12.0, most=12)
        gone = gone or frame[0]["id"]
        s.call("cairn_filter_update", filter=rover, sensor=0,
               observations=[o for o in frame if step < 3 or o["id"] != gone])
        s.call("cairn_filter_last_update", filter=rover)
        s.call("cairn_map_size", map=themap)
    return s


def slip():
    s = Scenario("slip", "A vehicle slips: most of a frame contradicts its pose, and the motion is widened.")
    drive = Drive(13, landmarks=8, size=9.0)  # a landmark is a witness after ten observations
    rover = s.call("cairn_filter_create", gives={"filter": "$rover"}, options={"initial_covariance": START})
    s.call("cairn_filter_set_log", filter=rover, log="collect")
    s.call("cairn_filter_add_cartesian", filter=rover, cartesian={"sigma": [0.05, 0.05, 0.05]})
    for step in range(18):
        drive.twist(s, rover, 0.2, 0.1)
        if step == 14:
            drive.x, drive.y = drive.x + 2.5, drive.y - 1.5
        frame = drive.cartesian(reach=15.0, most=8)
        if step == 14:
            frame.append(seen(99, 3.0, 1.0, 0.0))
        s.call("cairn_filter_update", filter=rover, sensor=0, observations=frame)
        if step > 12:
            s.call("cairn_filter_last_update", filter=rover)
    ask(s, rover)
    # One landmark alone contradicts the rest, then half of a frame.
    drive.twist(s, rover, 1.0, 0.1)
    frame = drive.cartesian(reach=15.0, most=8)
    frame[0]["z"][1] += 3.0
    s.call("cairn_filter_update", filter=rover, sensor=0, observations=frame)
    drive.twist(s, rover, 1.0, 0.1)
    frame = drive.cartesian(reach=15.0, most=8)
    for observation in frame:
        observation["z"] = [round(value + 0.19, 4) for value in observation["z"]]
    frame.append(seen(98, 3.0, 1.0, 0.0))
    s.call("cairn_filter_update", filter=rover, sensor=0, observations=frame)
    ask(s, rover)
    return s


SCENARIOS = [nearest, joint, deferred, slip]
