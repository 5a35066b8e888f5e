# SPDX-License-Identifier: BSD-3-Clause
"""The twelve lines of the README: the first scenario for a new replayer."""

from .scenario import Scenario, seen


def first_filter():
    s = Scenario("first_filter", "The example of the README: a rover with a stereo head, wheels, submaps and a map.")
    s.call("cairn_filter_options_init")
    rover = s.call("cairn_filter_create", gives={"filter": "$rover"},
                   options={"submap_landmarks": 60, "max_landmarks": 200})
    s.call("cairn_stereo_head_init")
    s.call("cairn_filter_add_stereo_head", filter=rover, head={"range_sigma": 0.5})
    s.call("cairn_filter_predict_wheels", filter=rover, dt=0.5, left_rad_per_s=1.0, right_rad_per_s=1.1)
    frame = [seen(1, 5.0, 0.1, 0.0), seen(2, 7.5, -0.4, 0.05), seen("18446744073709551614", 4.0, 0.6, -0.1)]
    s.call("cairn_filter_update", filter=rover, sensor=0, observations=frame)
    s.call("cairn_filter_predict_wheels", filter=rover, dt=0.5, left_rad_per_s=1.0, right_rad_per_s=1.1)
    frame = [seen(1, 4.9, 0.09, 0.01), seen(2, 7.3, -0.41, 0.04)]
    s.call("cairn_filter_update", filter=rover, sensor=0, observations=frame)
    s.call("cairn_filter_close_submap", filter=rover)
    s.call("cairn_filter_pose", filter=rover)
    themap = s.call("cairn_filter_map", gives={"return": "$map"}, filter=rover)
    s.call("cairn_map_within", map=themap, centre=[0.0, 0.0, 0.0], radius=30.0)
    s.wrong("ARGUMENT", "cairn_filter_predict_wheels", filter=rover, dt=-1.0, left_rad_per_s=1.0, right_rad_per_s=1.0)
    s.wrong("NOT_FOUND", "cairn_map_landmark", map=themap, id="3")
    return s


SCENARIOS = [first_filter]
