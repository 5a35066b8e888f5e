# SPDX-License-Identifier: BSD-3-Clause
"""Sensors of the caller's own: answers, no answers, and calls that a callback aborts."""

from .drive import Drive
from .scenario import Scenario, pose, seen
from .sensors import START, ask

HERE = pose(1.0, -2.0, 0.5, (0.8, 0.0, 0.0, 0.6))
LANDMARK = [4.0, 1.0, 0.25]


def checks():
    s = Scenario("custom_check", "Jacobians of callbacks are compared with differences; a wrong one is found.")
    s.call("cairn_custom_check", tolerance=1e-5, custom={}, predict="body_point", place="body_point", pose=HERE,
           landmark=LANDMARK)
    s.call("cairn_custom_check", tolerance=1e-5, custom={"rows": 1}, predict="range_only", pose=HERE,
           landmark=LANDMARK)
    s.call("cairn_custom_check", tolerance=1e-5, custom={}, predict="wrong_jacobian", pose=HERE, landmark=LANDMARK)
    s.wrong("ARGUMENT", "cairn_custom_check", custom={}, predict="refusing", pose=HERE, landmark=LANDMARK)
    s.wrong("ARGUMENT", "cairn_custom_check", custom={}, predict="body_point", place="refusing", pose=HERE,
            landmark=LANDMARK)
    s.wrong("CALLBACK", "cairn_custom_check", custom={}, predict="aborting", pose=HERE, landmark=LANDMARK)
    s.wrong("CALLBACK", "cairn_custom_check", custom={}, predict="body_point", place="aborting", pose=HERE,
            landmark=LANDMARK)
    s.wrong("ARGUMENT", "cairn_custom_check", custom={"rows": 0}, predict="body_point", pose=HERE, landmark=LANDMARK)
    return s


def points():
    s = Scenario("custom_points",
                 "A custom sensor of points, and one of ranges that places nothing. Both kinds of answers.")
    drive = Drive(21)
    rover = s.call("cairn_filter_create", gives={"filter": "$rover"}, options={"initial_covariance": START})
    s.call("cairn_filter_add_custom", filter=rover, custom={"sigma": [0.05, 0.05, 0.05], "relative": True},
           predict="body_point", place="body_point")
    s.call("cairn_filter_add_custom", filter=rover, custom={"rows": 1, "sigma": [0.1, 1.0, 1.0]},
           predict="range_only")
    s.call("cairn_filter_add_custom", filter=rover, custom={"sigma": [0.05, 0.05, 0.05]}, predict="body_point_ahead",
           place="refusing")
    for step in range(5):
        drive.twist(s, rover, 1.0, 0.1)
        s.call("cairn_filter_update", filter=rover, sensor=0, observations=drive.cartesian())
        if step == 0:
            continue  # ranges to landmarks that were placed just now say nothing about the pose
        ranges = [seen(o["id"], round(sum(v * v for v in o["z"]) ** 0.5, 4)) for o in drive.cartesian(most=4)]
        s.call("cairn_filter_update", filter=rover, sensor=1, observations=ranges)
    s.call("cairn_filter_set_loss", filter=rover, sensor=1, loss="CAIRN_LOSS_HUBER", width=2.0)
    s.call("cairn_filter_update", filter=rover, sensor=1, observations=ranges)
    # A landmark that a sensor of ranges has not seen placed, and one that the third sensor cannot place.
    s.call("cairn_filter_update", filter=rover, sensor=1, observations=[seen(500, 4.0)])
    s.call("cairn_filter_update", filter=rover, sensor=2, observations=[seen(500, 4.0, 0.0, 0.0)])
    ask(s, rover)
    return s


def planar_points():
    s = Scenario("custom_planar", "A custom sensor of two rows on a planar vehicle; its values are no angles.")
    drive = Drive(22, heights=False)
    rover = s.call("cairn_filter_create", gives={"filter": "$rover"}, options={"vehicle": "CAIRN_VEHICLE_PLANAR"})
    s.call("cairn_filter_add_custom", filter=rover, custom={"rows": 2, "sigma": [0.05, 0.05, 1.0], "angle_mask": 0},
           predict="body_point", place="body_point")
    for _ in range(5):
        drive.twist(s, rover, 1.0, 0.1)
        s.call("cairn_filter_update", filter=rover, sensor=0, observations=drive.cartesian(rows=2))
    ask(s, rover)
    return s


def aborting():
    s = Scenario("custom_aborting",
                 "Callbacks abort: the whole call fails, and the filter goes on as if it had not been made.")
    rover = s.call("cairn_filter_create", gives={"filter": "$rover"}, options={"initial_covariance": START})
    s.call("cairn_filter_add_custom", filter=rover, custom={"sigma": [0.05, 0.05, 0.05]}, predict="body_point_ahead",
           place="body_point")
    s.call("cairn_filter_add_custom", filter=rover, custom={}, predict="body_point", place="aborting")
    s.call("cairn_filter_add_custom", filter=rover, custom={}, predict="unfinished", place="body_point")
    s.call("cairn_filter_add_custom", filter=rover, custom={}, predict="aborting", place="body_point")
    s.call("cairn_filter_add_custom", filter=rover, custom={}, predict="refusing", place="refusing")
    frame = [seen(1, 5.0, 1.0, 0.0), seen(2, 2.0, -1.0, 0.5), seen(3, 9.0, 0.0, 1.0)]
    s.call("cairn_filter_update", filter=rover, sensor=0, observations=frame)
    s.call("cairn_filter_predict_twist", filter=rover, dt=1.0, velocity=[4.0, 0.0, 0.0], rate=[0.0, 0.0, 0.0])
    # Landmark 2 is behind the vehicle now, by less than 5 m: it is not visible, and only its observation is refused.
    s.call("cairn_filter_update", filter=rover, sensor=0,
           observations=[seen(1, 1.02, 1.0, 0.0), seen(2, -2.0, -1.0, 0.5), seen(3, 5.01, 0.02, 1.0)])
    s.call("cairn_filter_update", filter=rover, sensor=2, observations=[seen(1, 1.0, 1.0, 0.0)])
    s.call("cairn_filter_update", filter=rover, sensor=4,
           observations=[seen(3, 5.0, 0.0, 1.0), seen(9, 1.0, 0.0, 0.0)])
    s.call("cairn_filter_pose", filter=rover)
    s.wrong("CALLBACK", "cairn_filter_update", filter=rover, sensor=3, observations=[seen(3, 5.0, 0.0, 1.0)])
    s.wrong("CALLBACK", "cairn_filter_update", filter=rover, sensor=1, observations=[seen(3, 5.0, 0.0, 1.0),
                                                                                   seen(4, 3.0, 0.0, 0.0)])
    s.call("cairn_filter_pose", filter=rover)
    s.call("cairn_filter_predict_twist", filter=rover, dt=1.0, velocity=[4.0, 0.0, 0.0], rate=[0.0, 0.0, 0.0])
    s.call("cairn_filter_update", filter=rover, sensor=0, observations=[seen(3, 1.0, 0.02, 1.0)])
    s.wrong("CALLBACK", "cairn_filter_update", filter=rover, sensor=0,
            observations=[seen(3, 1.0, 0.02, 1.0), seen(2, -6.0, -1.0, 0.5)])
    ask(s, rover)
    themap = s.call("cairn_filter_map", gives={"return": "$map"}, filter=rover)
    s.call("cairn_map_landmarks", map=themap)
    return s


SCENARIOS = [checks, points, planar_points, aborting]
