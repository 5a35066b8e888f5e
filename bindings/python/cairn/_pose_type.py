# SPDX-License-Identifier: BSD-3-Clause
"""The type of a pose. cairn.pose, which is public, and _structs, which fills poses from C structs, both need it."""

from __future__ import annotations

from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray


class Pose(NamedTuple):
    """Pose of a frame b in a frame a: p_a = R(quaternion) p_b + position.

    position: (3,), m. quaternion: (4,), w x y z, from b to a.
    """

    position: NDArray[np.float64]
    quaternion: NDArray[np.float64]

    @classmethod
    def identity(cls) -> Pose:
        return cls(np.zeros(3), np.array([1.0, 0.0, 0.0, 0.0]))

    @classmethod
    def of(cls, struct: Any) -> Pose:
        """The pose that a cairn_pose holds."""
        return cls(np.array(list(struct.position)), np.array(list(struct.quaternion)))


PoseLike: TypeAlias = Pose | tuple[ArrayLike, ArrayLike]
"""A pose, or (position, quaternion w x y z)."""

Pose.__module__ = "cairn.pose"  # the public name, which help() and pickle show
