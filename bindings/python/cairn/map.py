# SPDX-License-Identifier: BSD-3-Clause
"""Landmarks in one frame, with their joint uncertainty."""

from __future__ import annotations

import contextlib
from typing import TYPE_CHECKING, Any, Literal, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _structs
from ._handle import Handle
from ._library import ffi, lib
from ._pose_type import PoseLike
from ._structs import Ids
from .constants import MapForm, MergeBy
from .error import CairnError
from .layouts import LANDMARK

if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .structs import MergeOptions, MergeReport

Array = NDArray[np.float64]
Structs = NDArray[np.void]


class Map(Handle):
    """Landmarks with their estimates and covariances. A filter's maps change with the filter and keep it alive; closing
    the filter closes them too. A copy is independent of the filter, and other maps can be merged into it.

    Queries return arrays of cairn.LANDMARK: the fields id, observations, position (3, m) and covariance (3 x 3, m^2).
    """

    WHAT = "map"

    def __init__(self, pointer: Any, owner: Handle | None = None) -> None:
        """Internal: Filter.map, Filter.local_map, Team.map and copy() create maps."""
        super().__init__(pointer, None if owner is not None else lib.cairn_map_destroy, owner)

    def __len__(self) -> int:
        return int(self._ask("size_t *", lib.cairn_map_size))

    @property
    def size(self) -> int:
        """Number of landmarks."""
        return len(self)

    def landmark(self, id: int) -> np.void:
        """The landmark with this id. Raises CairnError (Status.ERROR_NOT_FOUND) if there is none."""
        result = np.zeros(1, LANDMARK)
        self._call(lib.cairn_map_landmark, _structs.identifier("id", id), _structs.pointer("cairn_landmark *", result))
        return cast(np.void, result[0])

    def landmarks(self) -> Structs:
        """All landmarks, by ascending id."""
        return self._filled("cairn_landmark", lib.cairn_map_landmarks)

    def within(self, centre: ArrayLike, radius: float) -> Structs:
        """Landmarks whose estimate lies within `radius` (m) of `centre` (3, m), nearest first."""
        return self._filled("cairn_landmark", lib.cairn_map_within, _structs.vector("centre", centre, 3), radius)

    def nearest(self, point: ArrayLike, count: int = 1) -> Structs:
        """The `count` landmarks nearest to `point` (3, m), nearest first."""
        return self._filled("cairn_landmark", lib.cairn_map_nearest, _structs.vector("point", point, 3), count)

    def in_box(self, lower: ArrayLike, upper: ArrayLike) -> Structs:
        """Landmarks whose estimate lies in the box between `lower` and `upper` (3 each, m), by ascending id."""
        return self._filled("cairn_landmark", lib.cairn_map_in_box, _structs.vector("lower", lower, 3),
                            _structs.vector("upper", upper, 3))

    def joint_covariance(self, ids: Ids) -> Array:
        """Joint covariance of the positions of the landmarks `ids`: 3n x 3n, m^2, blocks in the order of `ids`."""
        names = _structs.identifiers("ids", ids)
        matrix = np.zeros((3 * len(names), 3 * len(names)))
        self._call(lib.cairn_map_joint_covariance, _structs.pointer("uint64_t *", names), len(names),
                   _structs.doubles(matrix), matrix.size, ffi.new("size_t *"))
        return matrix

    @property
    def form(self) -> MapForm:
        """How the map holds its joint uncertainty: MapForm.DENSE or MapForm.SPARSE."""
        return MapForm(self._ask("cairn_map_form *", lib.cairn_map_kind))

    @property
    def kind(self) -> Literal["dense", "sparse"]:
        """"dense" or "sparse": how the filter joins its submaps. Only maps of the same kind can be merged."""
        return "sparse" if self.form is MapForm.SPARSE else "dense"

    def copy(self) -> Map:
        """An independent map with the same landmarks."""
        return Map(self._ask("cairn_map **", lib.cairn_map_copy))

    def merge(self, other: Map, by: MergeBy | Literal["id", "geometry"] | None = None,
              transform: PoseLike | None = None, **options: Unpack[MergeOptions]) -> MergeReport:
        """Merges the landmarks of `other` into this map, which must be a copy. Returns a report: numbers of common and
        of added landmarks, T_map_other with its covariance, the joint distance with its rows and threshold.

        by: "id", the default, or "geometry" if the ids of the two maps are unrelated; then merged_ids() tells the new
        id of each landmark. transform: (position, quaternion) that takes points of the other map's frame into this map's
        frame, if it is known beforehand; the option `covariance` is that of its error [dp; dtheta], 6 x 6, and without
        it the transform is exact. The other options are those of cairn.MergeOptions.

        A refused merge raises a CairnError whose attribute `report` holds the report; neither map changes.
        """
        if not isinstance(other, Map):  # pyright: ignore[reportUnnecessaryIsInstance]
            raise TypeError(f"other: must be a Map, and is a {type(other).__name__}")
        if transform is None and "covariance" in options and not options.get("has_transform"):
            raise TypeError("covariance: it belongs to `transform`, which is not given")
        if by is not None:
            options["association"] = MergeBy(_structs.constant("by", "MergeBy", by))
        if transform is not None:
            options["has_transform"] = True
            options["T_map_other"] = transform
        settings, report = _structs.new("cairn_merge_options", options), _structs.sized("cairn_merge_report")
        # Always lock in the same order, so that two threads cannot deadlock.
        guards = sorted({id(one._guard): one._guard for one in (self, other)}.values(), key=id)
        with contextlib.ExitStack() as stack:
            for guard in guards:
                stack.enter_context(guard.lock)
            try:
                self._call(lib.cairn_map_merge, other._lend(_itself), settings, report)
            except CairnError as error:
                error.report = cast("MergeReport", _structs.as_dict(report[0]))
                raise
        return cast("MergeReport", _structs.as_dict(report[0]))

    def merged_ids(self) -> Structs:
        """The landmarks of the other map after the last merge, by ascending other_id: an array of cairn.MERGED_ID with
        the fields other_id, id (in this map) and common (whether this map held the landmark before)."""
        return self._filled("cairn_merged_id", lib.cairn_map_merged_ids)


def _itself(handle: Any) -> Any:
    return handle
