# SPDX-License-Identifier: BSD-3-Clause
"""Maps: queries, copies, merging by ids and by geometry."""

from .drive import Drive
from .scenario import Scenario, diagonal, pose
from .sensors import START

FIELD = 23  # seed of the landmarks that all rovers of these scenarios see


def survey(s, name, steps, x=0.0, numbered=0, **options):
    """A rover that starts at x, where its map begins. Its ids are those of the field plus `numbered`."""
    drive = Drive(FIELD, landmarks=40, size=14.0)
    drive.random.seed(100 + steps + int(x))
    drive.x = x
    rover = s.call("cairn_filter_create", gives={"filter": name}, options={"initial_covariance": START, **options})
    s.call("cairn_filter_add_cartesian", filter=rover, cartesian={"sigma": [0.05, 0.05, 0.05]})
    for step in range(steps):
        drive.twist(s, rover, 1.0, 0.15)
        frame = drive.cartesian(reach=9.0, most=6)
        s.call("cairn_filter_update", filter=rover, sensor=0,
               observations=[{**o, "id": str(int(o["id"]) + numbered)} for o in frame])
        if "submap_landmarks" in options and step in (steps // 2, steps - 1):
            s.call("cairn_filter_close_submap", filter=rover)
    return rover


def map_of(s, rover, name):
    return s.call("cairn_filter_map", gives={"return": name}, filter=rover)


def copy_of(s, themap, name):
    return s.call("cairn_map_copy", gives={"copy": name}, map=themap)


def queries():
    s = Scenario("map_queries", "Queries of a map by id, by place and in a box; a copy outlives its filter.")
    rover = survey(s, "$rover", 8)
    themap = map_of(s, rover, "$map")
    s.call("cairn_map_size", map=themap)
    s.call("cairn_map_landmarks", map=themap)
    s.call("cairn_map_within", map=themap, centre=[2.0, 1.0, 0.5], radius=5.0)
    s.call("cairn_map_within", map=themap, centre=[200.0, 1.0, 0.5], radius=0.0)
    s.call("cairn_map_nearest", map=themap, point=[2.0, 1.0, 0.5], count=2)
    s.call("cairn_map_nearest", map=themap, point=[2.0, 1.0, 0.5], count=0)
    s.call("cairn_map_in_box", map=themap, lower=[-3.0, -3.0, -3.0], upper=[6.0, 6.0, 3.0])
    s.call("cairn_map_merged_ids", map=themap)
    s.wrong("NOT_FOUND", "cairn_map_landmark", map=themap, id="1000")
    s.wrong("ARGUMENT", "cairn_map_within", map=themap, centre=[0.0, 0.0, 0.0], radius=-1.0)
    s.wrong("ARGUMENT", "cairn_map_within", map=themap, centre=["nan", 0.0, 0.0], radius=1.0)
    s.wrong("ARGUMENT", "cairn_map_nearest", map=themap, point=[0.0, "inf", 0.0], count=1)
    s.wrong("ARGUMENT", "cairn_map_in_box", map=themap, lower=[1.0, 0.0, 0.0], upper=[0.0, 1.0, 1.0])
    s.wrong("NOT_FOUND", "cairn_map_joint_covariance", map=themap, ids=["1000"])
    kept = copy_of(s, themap, "$kept")
    s.call("cairn_filter_destroy", filter=rover)
    s.call("cairn_map_size", map=kept)
    s.call("cairn_map_kind", map=kept)
    s.call("cairn_map_landmarks", map=kept)
    s.call("cairn_map_destroy", map=kept)
    return s


def merge(name, about, **options):
    s = Scenario(name, about)
    west = survey(s, "$west", 12, **options)
    east = survey(s, "$east", 14, x=2.0, **options)
    merged = copy_of(s, map_of(s, west, "$west_map"), "$merged")
    other = map_of(s, east, "$east_map")
    s.call("cairn_map_merge", map=merged, other=other)
    s.call("cairn_map_merged_ids", map=merged)
    s.call("cairn_map_landmarks", map=merged)
    s.wrong("STATE", "cairn_map_merge", map=merged, other=other)  # the data would count twice
    s.wrong("STATE", "cairn_map_merge", map="$west_map", other=other)
    s.wrong("ARGUMENT", "cairn_map_merge", map=merged, other=merged)
    return s


def merge_dense():
    return merge("merge_dense", "Two dense maps of rovers that started at different places are merged by ids.")


def merge_sparse():
    return merge("merge_sparse", "Two sparse maps are merged by ids.", submap_landmarks=40, join="CAIRN_JOIN_SPARSE")


def merge_geometry():
    s = Scenario("merge_geometry",
                 "Maps whose ids say nothing are merged by geometry, and by a transform that is known.")
    west = survey(s, "$west", 16)
    east = survey(s, "$east", 18, x=2.0, numbered=1000)
    far = survey(s, "$far", 3, x=2.0, numbered=2000)
    west_map = map_of(s, west, "$west_map")
    merged = copy_of(s, west_map, "$merged")
    options = {"association": "CAIRN_MERGE_BY_GEOMETRY", "max_tilt": 0.2}
    s.call("cairn_map_merge", map=merged, other=map_of(s, east, "$east_map"), options=options)
    s.call("cairn_map_merged_ids", map=merged)
    known = copy_of(s, west_map, "$known")
    s.call("cairn_map_merge", map=known, other=map_of(s, far, "$far_map"),
           options={"association": "CAIRN_MERGE_BY_GEOMETRY", "has_transform": True, "T_map_other": pose(2.0),
                    "covariance": diagonal(0.01, 0.01, 0.01, 1e-4, 1e-4, 1e-4)})
    s.call("cairn_map_landmarks", map=known)
    return s


def merge_wrong():
    s = Scenario("merge_wrong",
                 "Merges that are refused: no common landmark, no room, kinds that differ, options out of range.")
    west = survey(s, "$west", 8)
    east = survey(s, "$east", 9, x=2.0)
    alien = survey(s, "$alien", 6, x=2.0, numbered=1000)
    sparse = survey(s, "$sparse", 7, submap_landmarks=40, join="CAIRN_JOIN_SPARSE")
    empty = s.call("cairn_filter_create", gives={"filter": "$empty"}, options={})
    merged = copy_of(s, map_of(s, west, "$west_map"), "$merged")
    east_map = map_of(s, east, "$east_map")
    s.wrong("NOT_FOUND", "cairn_map_merge", map=merged, other=map_of(s, alien, "$alien_map"))
    s.wrong("NOT_FOUND", "cairn_map_merge", map=merged, other=map_of(s, empty, "$empty_map"))
    s.wrong("STATE", "cairn_map_merge", map=merged, other=map_of(s, sparse, "$sparse_map"))
    s.wrong("CAPACITY", "cairn_map_merge", map=merged, other=east_map, options={"max_landmarks": "5"})
    s.wrong("ARGUMENT", "cairn_map_merge", map=merged, other=east_map, options={"gate_probability": 0.0})
    s.wrong("ARGUMENT", "cairn_map_merge", map=merged, other=east_map, options={"joint_gate_probability": 1.5})
    s.wrong("ARGUMENT", "cairn_map_merge", map=merged, other=east_map, options={"max_tilt": -0.1})
    s.wrong("ARGUMENT", "cairn_map_merge", map=merged, other=east_map,
            options={"has_transform": True, "covariance": diagonal(-1.0, 1.0, 1.0, 1.0, 1.0, 1.0)})
    # The transform is wrong by 3 m and said to be known exactly.
    s.wrong("NUMERICAL", "cairn_map_merge", map=merged, other=east_map,
            options={"has_transform": True, "T_map_other": pose(5.0)})
    s.call("cairn_map_landmarks", map=merged)
    return s


SCENARIOS = [queries, merge_dense, merge_sparse, merge_geometry, merge_wrong]
