# SPDX-License-Identifier: BSD-3-Clause
"""Poses, and conversions from and to Euler angles and rotation vectors."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _structs
from ._library import ffi, lib
from ._pose_type import Pose, PoseLike
from .error import call

__all__ = ["Pose", "PoseLike", "planar_pose", "pose_apply", "pose_compose", "pose_error", "pose_identity", "pose_inverse",
           "quaternion_exp", "quaternion_from_euler", "quaternion_log", "quaternion_to_euler"]

Array = NDArray[np.float64]


def planar_pose(x: float, y: float, heading: float) -> Pose:
    """Pose of a vehicle in the plane z = 0: m, m, rad."""
    return Pose(np.array([x, y, 0.0]), np.array([math.cos(heading / 2), 0.0, 0.0, math.sin(heading / 2)]))


def pose_identity() -> Pose:
    """The identity."""
    result = ffi.new("cairn_pose *")
    call(lib.cairn_pose_identity, result)
    return Pose.of(result)


def pose_compose(T_a_b: PoseLike, T_b_c: PoseLike) -> Pose:
    """T_a_c = T_a_b T_b_c. Poses are (position, quaternion)."""
    result = ffi.new("cairn_pose *")
    call(lib.cairn_pose_compose, _structs.new_pose("T_a_b", T_a_b), _structs.new_pose("T_b_c", T_b_c), result)
    return Pose.of(result)


def pose_inverse(T_a_b: PoseLike) -> Pose:
    """T_b_a, the inverse of T_a_b."""
    result = ffi.new("cairn_pose *")
    call(lib.cairn_pose_inverse, _structs.new_pose("T_a_b", T_a_b), result)
    return Pose.of(result)


def pose_apply(T_a_b: PoseLike, point_b: ArrayLike) -> Array:
    """The point (3, m) in frame a of a point (3, m) in frame b."""
    point_a = np.zeros(3)
    call(lib.cairn_pose_apply, _structs.new_pose("T_a_b", T_a_b), _structs.vector("point_b", point_b, 3),
         _structs.doubles(point_a))
    return point_a


def pose_error(truth: PoseLike, estimate: PoseLike) -> Array:
    """Error [dp; dtheta] of an estimated pose, (6,), m and rad, in the axes of frame a."""
    difference = np.zeros(6)
    call(lib.cairn_pose_error, _structs.new_pose("truth", truth), _structs.new_pose("estimate", estimate),
         _structs.doubles(difference))
    return difference


def quaternion_from_euler(roll: float, pitch: float, yaw: float) -> Array:
    """Quaternion w x y z, (4,), of R = Rz(yaw) Ry(pitch) Rx(roll); rad."""
    quaternion = np.zeros(4)
    call(lib.cairn_quaternion_from_euler, roll, pitch, yaw, _structs.doubles(quaternion))
    return quaternion


def quaternion_to_euler(quaternion: ArrayLike) -> tuple[float, float, float]:
    """Roll, pitch and yaw, rad, of a quaternion w x y z, (4,)."""
    angles = ffi.new("double[3]")
    call(lib.cairn_quaternion_to_euler, _structs.vector("quaternion", quaternion, 4), angles, angles + 1, angles + 2)
    roll, pitch, yaw = angles
    return roll, pitch, yaw


def quaternion_exp(rotation_vector: ArrayLike) -> Array:
    """Quaternion w x y z, (4,), of a rotation vector (3): axis times angle, rad."""
    quaternion = np.zeros(4)
    call(lib.cairn_quaternion_exp, _structs.vector("rotation_vector", rotation_vector, 3), _structs.doubles(quaternion))
    return quaternion


def quaternion_log(quaternion: ArrayLike) -> Array:
    """Rotation vector (3), rad, of a quaternion w x y z, (4,). Its length is at most pi."""
    rotation_vector = np.zeros(3)
    call(lib.cairn_quaternion_log, _structs.vector("quaternion", quaternion, 4), _structs.doubles(rotation_vector))
    return rotation_vector
