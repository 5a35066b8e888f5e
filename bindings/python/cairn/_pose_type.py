# SPDX-License-Identifier: BSD-3-Clause
"""The type of a pose. cairn.pose, which is public, and _structs, which fills poses from C structs, both need it."""
import typing

import numpy as np


class Pose(typing.NamedTuple):
    """Pose of a frame b in a frame a: p_a = R(quaternion) p_b + position.

    position: (3,), m. quaternion: (4,), w x y z, from b to a.
    """

    position: np.ndarray
    quaternion: np.ndarray

    @classmethod
    def identity(cls):
        return cls(np.zeros(3), np.array([1.0, 0.0, 0.0, 0.0]))

    @classmethod
    def of(cls, struct):
        """The pose that a cairn_pose holds."""
        return cls(np.array(list(struct.position)), np.array(list(struct.quaternion)))


Pose.__module__ = "cairn.pose"  # the public name, which help() and pickle show
