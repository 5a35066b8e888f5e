# SPDX-License-Identifier: BSD-3-Clause
"""Landmark SLAM: a vehicle's pose and its map, and how far to trust both.

SI units, radians. Body axes: x forward, y left, z up. Quaternions: w x y z. The covariance of a pose is 6 x 6: that of
the pose's error [dp; dtheta] in the axes of the map. Arrays are numpy arrays; their shapes are checked.

Filter, Map, Team, World and Fleet are the handles of the library. Constants are enumerations (Result.NEW), options are
keyword arguments that typed dictionaries describe (FilterOptions), arrays of structs have numpy types (OBSERVATION).
`cairn.lib` has every function of the C headers, and `cairn.ffi` is its cffi object. The library is loaded at the first
use of one of these names, so that cairn.report works without it.
"""

from __future__ import annotations

import enum
import importlib
import re
from typing import TYPE_CHECKING

from . import constants
from ._declarations import VERSION as __version__
from .constants import *
from .layouts import *
from .structs import *

if TYPE_CHECKING:
    from ._frames import observations as observations
    from ._library import ffi as ffi
    from ._library import lib as lib
    from .error import CairnError as CairnError
    from .error import status_name as status_name
    from .filter import Filter as Filter
    from .filter import check_custom as check_custom
    from .fleet import Fleet as Fleet
    from .library import build as build
    from .library import defaults as defaults
    from .library import doubt_text as doubt_text
    from .library import has as has
    from .library import id_none as id_none
    from .library import verdict_text as verdict_text
    from .library import version as version
    from .library import version_number as version_number
    from .map import Map as Map
    from .pose import Pose as Pose
    from .pose import planar_pose as planar_pose
    from .pose import pose_apply as pose_apply
    from .pose import pose_compose as pose_compose
    from .pose import pose_error as pose_error
    from .pose import pose_identity as pose_identity
    from .pose import pose_inverse as pose_inverse
    from .pose import quaternion_exp as quaternion_exp
    from .pose import quaternion_from_euler as quaternion_from_euler
    from .pose import quaternion_log as quaternion_log
    from .pose import quaternion_to_euler as quaternion_to_euler
    from .team import Team as Team
    from .world import World as World
    from .world import world_preset as world_preset

# Where the names are that need the library.
_HOMES = {"_library": ("ffi", "lib"), "_frames": ("observations",), "error": ("CairnError", "status_name"),
          "filter": ("Filter", "check_custom"), "fleet": ("Fleet",), "map": ("Map",), "team": ("Team",),
          "library": ("build", "defaults", "doubt_text", "has", "id_none", "verdict_text", "version", "version_number"),
          "pose": ("Pose", "planar_pose", "pose_apply", "pose_compose", "pose_error", "pose_identity", "pose_inverse",
                   "quaternion_exp", "quaternion_from_euler", "quaternion_log", "quaternion_to_euler"),
          "world": ("World", "world_preset")}
_HOME_OF = {name: home for home, names in _HOMES.items() for name in names}


def _constant(name: str) -> object:
    """A constant by the name that it had in version 0.1: cairn.REJECTED, cairn.ERROR_STATE, cairn.TEAM_JOINT."""
    for kind in vars(constants).values():
        if not (isinstance(kind, type) and issubclass(kind, enum.Enum)) or kind.__module__ != constants.__name__:
            continue
        words = re.findall("[A-Z][a-z]*", kind.__name__)  # the prefix was that of the type or its first word
        prefixes = {"_".join(words).upper() + "_", words[0].upper().removesuffix("S") + "_"}
        if kind.__name__ in ("Status", "Result"):
            prefixes.add("")
        for member in kind:
            if any(name == prefix + member.name for prefix in prefixes):
                return member
    raise AttributeError(f"module 'cairn' has no attribute '{name}'")


def __getattr__(name: str) -> object:
    value: object
    if name in _HOME_OF:
        value = getattr(importlib.import_module(f".{_HOME_OF[name]}", __name__), name)
    elif name.isupper():
        value = _constant(name)
    else:
        raise AttributeError(f"module 'cairn' has no attribute '{name}'")
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *_HOME_OF})
