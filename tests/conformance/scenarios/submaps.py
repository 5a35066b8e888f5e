# SPDX-License-Identifier: BSD-3-Clause
"""Submaps: why they are closed, both ways of joining, what a closing reports, and the trajectory."""

from .drive import Drive
from .scenario import Scenario, diagonal, pose
from .sensors import START, ask

CIRCLE = {"speed": 1.2, "rate": 0.12}


def drive_round(s, drive, rover, steps, most=6):
    """Drives on and observes; every eighth frame sees nothing, and its pose is kept."""
    for step in range(steps):
        drive.twist(s, rover, **CIRCLE)
        if step % 8 == 7:
            s.call("cairn_filter_keep_pose", filter=rover)
        else:
            s.call("cairn_filter_update", filter=rover, sensor=0, observations=drive.cartesian(reach=12.0, most=most))


def two_rounds(name, about, join, seed, **options):
    s = Scenario(name, about)
    drive = Drive(seed, landmarks=50, size=20.0)
    rover = s.call("cairn_filter_create", gives={"filter": "$rover"},
                   options={"submap_landmarks": 10, "join": join, "trajectory_poses": 200,
                            "initial_covariance": START,
                            **options})
    s.call("cairn_filter_add_cartesian", filter=rover, cartesian={"sigma": [0.05, 0.05, 0.05]})
    drive_round(s, drive, rover, 60)
    s.call("cairn_filter_last_closing", filter=rover)
    s.call("cairn_filter_local_pose", filter=rover)
    s.call("cairn_filter_base_pose", filter=rover)
    local = s.call("cairn_filter_local_map", gives={"return": "$local"}, filter=rover)
    s.call("cairn_map_landmarks", map=local)
    s.call("cairn_filter_close_submap", filter=rover)
    s.call("cairn_filter_last_closing", filter=rover)
    s.call("cairn_filter_submap_count", filter=rover)
    s.call("cairn_filter_submap", filter=rover, index=0)
    s.call("cairn_filter_trajectory_range", filter=rover)
    s.call("cairn_filter_trajectory", filter=rover, first="40")
    themap = s.call("cairn_filter_map", gives={"return": "$map"}, filter=rover)
    s.call("cairn_map_kind", map=themap)
    s.call("cairn_map_size", map=themap)
    s.call("cairn_map_nearest", map=themap, point=[0.0, 0.0, 0.0], count=3)
    ask(s, rover)
    s.wrong("NOT_FOUND", "cairn_filter_submap", filter=rover, index=1000)
    s.wrong("STATE", "cairn_filter_close_submap", filter=rover)
    s.wrong("NOT_FOUND", "cairn_filter_trajectory", filter=rover, first="1000")
    return s


def dense():
    return two_rounds("submaps_dense", "Two rounds of a circle in submaps that are joined densely.",
                      "CAIRN_JOIN_DENSE", 5,
                      max_landmarks=100)


def sparse():
    return two_rounds("submaps_sparse",
                      "Two rounds of a circle in submaps that are joined sparsely, with a robust loss.",
                      "CAIRN_JOIN_SPARSE", 6, join_loss="CAIRN_LOSS_HUBER", join_loss_width=2.0)


def limits():
    s = Scenario("submap_limits",
                 "Each limit closes a submap; an absolute position does, too. The pose's sigma needs noise.")
    for limit, value in ("distance", 4.0), ("extent", 9.0), ("sigma", 0.2):
        drive = Drive(7)
        rover = s.call("cairn_filter_create", gives={"filter": f"${limit}"},
                       options={"submap_landmarks": 40, f"submap_{limit}": value, "join": "CAIRN_JOIN_AUTO"})
        s.call("cairn_filter_add_cartesian", filter=rover, cartesian={"sigma": [0.5, 0.5, 0.5]})
        s.call("cairn_filter_set_twist_noise", filter=rover, noise={"velocity_sigma": [0.15, 0.15, 0.15]})
        s.call("cairn_filter_last_closing", filter=rover)
        for _ in range(7):
            drive.twist(s, rover, 1.0, 0.05)
            s.call("cairn_filter_update", filter=rover, sensor=0,
                   observations=drive.cartesian(reach=8.9, most=2, sigma=0.5))
        s.call("cairn_filter_update", filter=rover, sensor=0,
               observations=drive.cartesian(reach=20.0, most=20, sigma=0.5))
        s.call("cairn_filter_last_closing", filter=rover)
    rover = s.call("cairn_filter_create", gives={"filter": "$fixed"}, options={"submap_landmarks": 40,
                   "initial_covariance": START, "initial_pose": drive.pose()})
    s.call("cairn_filter_add_cartesian", filter=rover, cartesian={})
    s.call("cairn_filter_update", filter=rover, sensor=0, observations=drive.cartesian(reach=20.0, most=5))
    s.call("cairn_filter_update_position", filter=rover, position=drive.pose()["position"],
           covariance=diagonal(1.0, 1.0, 1.0))
    s.call("cairn_filter_last_closing", filter=rover)
    return s


def full():
    s = Scenario("submap_full",
                 "A map without room: a closing fails, and the submap stays open. Poses that were dropped.")
    drive = Drive(8, landmarks=60, size=15.0)
    rover = s.call("cairn_filter_create", gives={"filter": "$rover"},
                   options={"submap_landmarks": 8, "max_landmarks": 12, "join": "CAIRN_JOIN_DENSE",
                            "trajectory_poses": 4})
    s.call("cairn_filter_add_cartesian", filter=rover, cartesian={})
    for _ in range(12):
        drive.twist(s, rover, 1.5, 0.02)
        s.call("cairn_filter_update", filter=rover, sensor=0, observations=drive.cartesian(most=5))
    s.call("cairn_filter_last_closing", filter=rover)
    s.wrong("CAPACITY", "cairn_filter_trajectory", filter=rover, first="0")
    s.call("cairn_filter_trajectory", filter=rover, first="9")
    return s


def wrong_states():
    s = Scenario("submap_wrong", "Calls that a single map without a trajectory refuses.")
    rover = s.call("cairn_filter_create", gives={"filter": "$rover"}, options={"initial_pose": pose(1.0)})
    s.wrong("STATE", "cairn_filter_close_submap", filter=rover)
    s.wrong("STATE", "cairn_filter_keep_pose", filter=rover)
    s.wrong("STATE", "cairn_filter_trajectory_range", filter=rover)
    s.wrong("STATE", "cairn_filter_trajectory", filter=rover, first="0")
    s.call("cairn_filter_base_pose", filter=rover)
    s.call("cairn_filter_local_pose", filter=rover)
    return s


SCENARIOS = [dense, sparse, limits, full, wrong_states]
