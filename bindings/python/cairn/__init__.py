# SPDX-License-Identifier: BSD-3-Clause
"""Landmark SLAM: a vehicle's pose and its map, and how far to trust both.

SI units, radians. Body axes: x forward, y left, z up. Quaternions: w x y z. The covariance of a pose is 6 x 6: that of
the pose's error [dp; dtheta] in the axes of the map. Arrays are numpy arrays; their shapes are checked.

Filter, Map, Team, World, Fleet, Pose and CairnError are the Python layer. `cairn.lib` has every function and constant
of the C headers, and `cairn.ffi` is its cffi object. Constants are also here without their prefix: cairn.NEW is
lib.CAIRN_RESULT_NEW. The library is loaded at the first use of one of these names, so that cairn.report works without it.
"""
import importlib

__version__ = "0.2.0"
__all__ = ["CairnError", "Filter", "Fleet", "Map", "Pose", "Team", "World", "ffi", "lib", "planar_pose", "pose_compose",
           "pose_error", "pose_inverse", "quaternion_from_euler", "quaternion_to_euler", "version"]

_HOMES = {"CairnError": "error", "Filter": "filter", "Fleet": "fleet", "Map": "map", "Team": "team", "World": "world",
          "ffi": "_library", "lib": "_library", "Pose": "pose", "planar_pose": "pose", "pose_compose": "pose",
          "pose_error": "pose", "pose_inverse": "pose", "quaternion_from_euler": "pose", "quaternion_to_euler": "pose"}


def version():
    """Version of the loaded library, for example "0.2.0"."""
    from ._library import ffi, lib
    return ffi.string(lib.cairn_version()).decode()


def __getattr__(name):
    if name in _HOMES:
        value = getattr(importlib.import_module(f".{_HOMES[name]}", __name__), name)
    elif name.isupper():
        value = getattr(importlib.import_module("._library", __name__).lib, f"CAIRN_{name}")
    else:
        raise AttributeError(f"module 'cairn' has no attribute '{name}'")
    globals()[name] = value
    return value


def __dir__():
    return sorted(set(globals()) | set(__all__))
