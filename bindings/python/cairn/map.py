# SPDX-License-Identifier: BSD-3-Clause
"""Landmarks in one frame, with their joint uncertainty."""
import numpy as np

from . import _structs
from ._handle import Handle
from ._library import ffi, lib
from .error import check


class Map(Handle):
    """Landmarks, by estimate and covariance. A filter's maps follow the filter and keep it alive; once the filter is
    closed they are too. A copy stands on its own.

    Queries give arrays with the fields id, observations, position (3, m) and covariance (3 x 3, m^2).
    """

    WHAT = "map"

    def __init__(self, pointer, owner=None):
        """Not for callers: Filter.map, Filter.local_map and copy() make maps."""
        super().__init__(pointer, None if owner is not None else lib.cairn_map_destroy, owner)

    def __len__(self):
        count = ffi.new("size_t *")
        with self._use() as handle:
            check(lib.cairn_map_size(handle, count))
        return count[0]

    @property
    def size(self):
        """Number of landmarks."""
        return len(self)

    def landmark(self, id):
        """One landmark by its id; CairnError (CAIRN_ERROR_NOT_FOUND) where there is none."""
        number = _structs.identifiers("id", [id])
        result = np.zeros(1, _structs.dtype("cairn_landmark"))
        with self._use() as handle:
            check(lib.cairn_map_landmark(handle, int(number[0]), ffi.from_buffer("cairn_landmark *", result)))
        return result[0]

    def landmarks(self):
        """All landmarks, by ascending id."""
        return self._query(lib.cairn_map_landmarks)

    def within(self, centre, radius):
        """Landmarks whose estimate lies within `radius` (m) of `centre` (3, m), nearest first."""
        centre = _structs.array("centre", centre, (3,))
        return self._query(lib.cairn_map_within, _structs.doubles(centre), radius)

    def nearest(self, point, count=1):
        """The `count` landmarks nearest to `point` (3, m), nearest first."""
        point = _structs.array("point", point, (3,))
        return self._query(lib.cairn_map_nearest, _structs.doubles(point), count)

    def in_box(self, lower, upper):
        """Landmarks whose estimate lies in the box between `lower` and `upper` (3 each, m), by ascending id."""
        lower, upper = _structs.array("lower", lower, (3,)), _structs.array("upper", upper, (3,))
        return self._query(lib.cairn_map_in_box, _structs.doubles(lower), _structs.doubles(upper))

    def joint_covariance(self, ids):
        """Joint covariance of the positions of chosen landmarks: 3n x 3n, m^2, blocks in the order of `ids`."""
        ids = _structs.identifiers("ids", ids)
        matrix = np.zeros((3 * len(ids), 3 * len(ids)))
        needed = ffi.new("size_t *")
        with self._use() as handle:
            check(lib.cairn_map_joint_covariance(handle, ffi.from_buffer("uint64_t *", ids), len(ids),
                                                 _structs.doubles(matrix), matrix.size, needed))
        return matrix

    def _query(self, function, *arguments):
        with self._use() as handle:
            return _structs.filled("cairn_landmark", lambda *buffer: function(handle, *arguments, *buffer))
