# SPDX-License-Identifier: BSD-3-Clause
"""Poses, and conversions from and to Euler angles."""
import math

import numpy as np

from . import _structs
from ._library import ffi, lib
from ._pose_type import Pose
from .error import check


def planar_pose(x, y, heading):
    """Pose of a vehicle in the plane z = 0: m, m, rad."""
    return Pose(np.array([x, y, 0.0]), np.array([math.cos(heading / 2), 0.0, 0.0, math.sin(heading / 2)]))


def pose_compose(T_a_b, T_b_c):
    """T_a_c = T_a_b T_b_c. Poses are (position, quaternion)."""
    result = ffi.new("cairn_pose *")
    check(lib.cairn_pose_compose(_structs.new_pose("T_a_b", T_a_b), _structs.new_pose("T_b_c", T_b_c), result))
    return Pose.of(result)


def pose_inverse(T_a_b):
    """T_b_a, the inverse of T_a_b."""
    result = ffi.new("cairn_pose *")
    check(lib.cairn_pose_inverse(_structs.new_pose("T_a_b", T_a_b), result))
    return Pose.of(result)


def pose_error(truth, estimate):
    """Error [dp; dtheta] of an estimated pose, (6,), m and rad, in the axes of frame a."""
    error = np.zeros(6)
    check(lib.cairn_pose_error(_structs.new_pose("truth", truth), _structs.new_pose("estimate", estimate),
                               _structs.doubles(error)))
    return error


def quaternion_from_euler(roll, pitch, yaw):
    """Quaternion w x y z, (4,), of R = Rz(yaw) Ry(pitch) Rx(roll); rad."""
    quaternion = np.zeros(4)
    check(lib.cairn_quaternion_from_euler(roll, pitch, yaw, _structs.doubles(quaternion)))
    return quaternion


def quaternion_to_euler(quaternion):
    """Roll, pitch and yaw, rad, of a quaternion w x y z, (4,)."""
    quaternion = _structs.array("quaternion", quaternion, (4,))
    angles = ffi.new("double[3]")
    check(lib.cairn_quaternion_to_euler(_structs.doubles(quaternion), angles, angles + 1, angles + 2))
    return tuple(angles)
