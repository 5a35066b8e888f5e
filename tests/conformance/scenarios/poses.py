# SPDX-License-Identifier: BSD-3-Clause
"""Poses and quaternions: functions without a handle."""

from .scenario import Scenario, pose

TURNED = pose(1.0, -2.0, 0.5, (0.8, 0.0, 0.0, 0.6))
TILTED = pose(-3.25, 0.125, 7.0, (0.5, 0.5, -0.5, 0.5))


def poses():
    s = Scenario("pose", "Poses are composed, inverted, applied and compared; quaternions come from angles and back.")
    s.call("cairn_pose_identity")
    s.call("cairn_pose_compose", T_a_b=TURNED, T_b_c=TILTED)
    s.call("cairn_pose_inverse", T_a_b=TURNED)
    s.call("cairn_pose_apply", T_a_b=TILTED, point_b=[0.1, 0.2, -0.3])
    s.call("cairn_pose_error", truth=TURNED, estimate=pose(1.1, -2.0, 0.4, (0.6, 0.0, 0.0, 0.8)))
    s.call("cairn_quaternion_from_euler", gives={"quaternion": "$attitude"}, roll=0.1, pitch=-0.4, yaw=2.5)
    s.call("cairn_quaternion_to_euler", quaternion="$attitude")
    s.call("cairn_quaternion_log", gives={"rotation_vector": "$turn"}, quaternion="$attitude")
    s.call("cairn_quaternion_exp", rotation_vector="$turn")
    s.call("cairn_quaternion_exp", rotation_vector=[1e-9, 0.0, -1e-9])
    # A quaternion is normalised; at a pitch of 90 degrees roll is 0 by definition.
    s.call("cairn_quaternion_to_euler", quaternion=[1.0, 0.0, 1.0, 0.0])
    return s


def wrong_poses():
    s = Scenario("pose_wrong",
                 "What functions of poses refuse: quaternions that are zero, values that are not finite.")
    s.wrong("ARGUMENT", "cairn_pose_compose", T_a_b=TURNED, T_b_c=pose(quaternion=(0.0, 0.0, 0.0, 0.0)))
    s.wrong("ARGUMENT", "cairn_pose_compose", T_a_b=pose("nan"), T_b_c=TILTED)
    s.wrong("ARGUMENT", "cairn_pose_inverse", T_a_b=pose(quaternion=(1.0, "inf", 0.0, 0.0)))
    s.wrong("ARGUMENT", "cairn_pose_apply", T_a_b=TURNED, point_b=[0.0, "-inf", 0.0])
    s.wrong("ARGUMENT", "cairn_pose_error", truth=pose(quaternion=(0.0, 0.0, 0.0, 0.0)), estimate=TURNED)
    s.wrong("ARGUMENT", "cairn_quaternion_from_euler", roll="nan", pitch=0.0, yaw=0.0)
    s.wrong("ARGUMENT", "cairn_quaternion_to_euler", quaternion=[0.0, 0.0, 0.0, 0.0])
    s.wrong("ARGUMENT", "cairn_quaternion_log", quaternion=[0.0, 0.0, "nan", 1.0])
    s.wrong("ARGUMENT", "cairn_quaternion_exp", rotation_vector=["inf", 0.0, 0.0])
    return s


SCENARIOS = [poses, wrong_poses]
