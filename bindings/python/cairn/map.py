# SPDX-License-Identifier: BSD-3-Clause
"""Landmarks in one frame, with their joint uncertainty."""
import contextlib

import numpy as np

from . import _structs
from ._handle import Handle
from ._library import ffi, lib
from .error import CairnError, check


class Map(Handle):
    """Landmarks with their estimates and covariances. A filter's maps change with the filter and keep it alive; closing
    the filter closes them too. A copy is independent of the filter, and other maps can be merged into it.

    Queries return arrays with the fields id, observations, position (3, m) and covariance (3 x 3, m^2).
    """

    WHAT = "map"

    def __init__(self, pointer, owner=None):
        """Internal: Filter.map, Filter.local_map and copy() create maps."""
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
        """The landmark with this id. Raises CairnError (CAIRN_ERROR_NOT_FOUND) if there is none."""
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
        """Joint covariance of the positions of the landmarks `ids`: 3n x 3n, m^2, blocks in the order of `ids`."""
        ids = _structs.identifiers("ids", ids)
        matrix = np.zeros((3 * len(ids), 3 * len(ids)))
        needed = ffi.new("size_t *")
        with self._use() as handle:
            check(lib.cairn_map_joint_covariance(handle, ffi.from_buffer("uint64_t *", ids), len(ids),
                                                 _structs.doubles(matrix), matrix.size, needed))
        return matrix

    @property
    def kind(self):
        """"dense" or "sparse": how the filter joins its submaps. Only maps of the same kind can be merged."""
        kind = ffi.new("int32_t *")
        with self._use() as handle:
            check(lib.cairn_map_kind(handle, kind))
        return "sparse" if kind[0] == lib.CAIRN_MAP_SPARSE else "dense"

    def copy(self):
        """An independent map with the same landmarks."""
        copy = ffi.new("cairn_map **")
        with self._use() as handle:
            check(lib.cairn_map_copy(handle, copy))
        return Map(copy[0])

    def merge(self, other, by="id", transform=None, covariance=None, **options):
        """Merges the landmarks of `other` into this map, which must be a copy. Returns a report as a dictionary:
        numbers of common and of added landmarks, T_map_other with its covariance, the joint distance with its rows and
        threshold.

        by: "id", or "geometry" if the ids of the two maps are unrelated; then `merged_ids` tells the new id of each
        landmark. transform: (position, quaternion) that takes points of the other map's frame into this map's frame, if
        it is known beforehand. covariance: of the transform's error [dp; dtheta], 6 x 6; without it the transform is
        exact. The other options are the fields of cairn_merge_options.

        A refused merge raises a CairnError whose attribute `report` holds the report; neither map changes.
        """
        if not isinstance(other, Map):
            raise TypeError(f"other: must be a Map, and is a {type(other).__name__}")
        if transform is None and covariance is not None:
            raise TypeError("covariance: it belongs to `transform`, which is not given")
        if by not in ("id", "geometry"):
            raise ValueError(f"by: must be 'id' or 'geometry', and is {by!r}")
        options["association"] = lib.CAIRN_MERGE_BY_ID if by == "id" else lib.CAIRN_MERGE_BY_GEOMETRY
        if transform is not None:
            options.update(has_transform=1, T_map_other=transform)
            if covariance is not None:
                options["covariance"] = covariance
        settings, report = _structs.new("cairn_merge_options", options), _structs.sized("cairn_merge_report")
        # Always lock in the same order, so that two threads cannot deadlock.
        handles = sorted({id(one): one for one in (self, other)}.values(), key=lambda one: id(one._lock))
        with contextlib.ExitStack() as stack:
            used = {id(one): stack.enter_context(one._use()) for one in handles}
            status = lib.cairn_map_merge(used[id(self)], used[id(other)], settings, report)
            try:
                check(status)
            except CairnError as error:
                error.report = _structs.as_dict(report[0])
                raise
        return _structs.as_dict(report[0])

    def merged_ids(self):
        """The landmarks of the other map after the last merge, by ascending other_id: the fields other_id, id (in this
        map) and common (whether this map held the landmark before). Empty before a merge."""
        with self._use() as handle:
            return _structs.filled("cairn_merged_id", lambda *buffer: lib.cairn_map_merged_ids(handle, *buffer))

    def _query(self, function, *arguments):
        with self._use() as handle:
            return _structs.filled("cairn_landmark", lambda *buffer: function(handle, *arguments, *buffer))
