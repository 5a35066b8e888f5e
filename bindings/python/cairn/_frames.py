# SPDX-License-Identifier: BSD-3-Clause
"""Frames of observations as the library takes them. An update costs some microseconds, so a filter keeps memory for the
frames that are given as ids and values, and fills it in without new arrays."""

from __future__ import annotations

import itertools
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._library import ffi
from ._structs import FLOAT64, INT64, UINT64, array, identifiers
from .layouts import OBSERVATION

_from_buffer = ffi.from_buffer
_FRAME = ffi.typeof("cairn_observation *")
_KEPT = 256  # longest frame whose memory is kept
_SHORT = 64


def _values(z: ArrayLike, count: int) -> NDArray[np.float64]:
    """n x rows values of n observations."""
    if type(z) is np.ndarray and z.dtype is FLOAT64 and z.ndim == 2 and len(z) == count:
        values: NDArray[np.float64] = z
    elif type(z) is list and count and {type(row) for row in z} <= {list, tuple} and len(set(map(len, z))) == 1:  # type: ignore[arg-type]
        try:  # much faster than numpy's own reading of nested lists
            values = np.fromiter(itertools.chain.from_iterable(z), FLOAT64).reshape(len(z), len(z[0]))  # type: ignore[arg-type]
        except (TypeError, ValueError):
            values = array("z", z, (count, None))  # it says what is wrong
    else:
        values = array("z", np.zeros((0, 3)) if count == 0 and np.size(z) == 0 else z, (count, None))
    if len(values) != count:
        values = array("z", z, (count, None))
    if not 1 <= values.shape[1] <= 3:
        raise ValueError(f"z: must have 1 to 3 values per observation, and has {values.shape[1]}")
    return values


def _names(ids: Any) -> NDArray[Any] | list[int]:
    """n landmark ids, checked, in a form that numpy converts to uint64 exactly."""
    if type(ids) is np.ndarray and ids.ndim == 1:
        if ids.dtype is UINT64 or (ids.dtype is INT64 and len(ids) < _SHORT and min(ids.tolist(), default=0) >= 0):
            return ids  # the minimum of a short list is faster than numpy's
    elif type(ids) is list and {*map(type, ids)} == {int} and 0 <= min(ids) and max(ids) < 1 << 64:
        return ids
    return identifiers("ids", ids)


class Memory:
    """Memory for a frame of `count` observations."""

    def __init__(self, count: int) -> None:
        self.frame = np.zeros(count, OBSERVATION)
        self.pointer = _from_buffer(_FRAME, self.frame)
        self.ids, self.z = self.frame["id"], self.frame["z"]
        self.noise = self.frame["covariance"].reshape(count, 9)  # zero: the sensor's noise
        self.noisy = False

    def fill(self, ids: NDArray[Any] | list[int], z: NDArray[np.float64], covariance: ArrayLike | None) -> None:
        rows = z.shape[1]
        if covariance is not None or self.noisy:
            self.noise[...] = 0
            self.noisy = covariance is not None
        if covariance is not None:
            noise = array("covariance", covariance, (len(ids), rows, rows))
            self.noise[:, : rows * rows] = noise.reshape(len(ids), rows * rows)
        if rows == 3:
            self.z[...] = z
        else:
            self.z[...] = 0
            self.z[:, :rows] = z
        self.ids[...] = ids


class Frames:
    """The memory for the frames of one filter. Its lock protects it."""

    def __init__(self) -> None:
        self._kept: dict[int, Memory] = {}

    def of(self, ids: Any, z: ArrayLike | None, covariance: ArrayLike | None) -> tuple[Any, int]:
        """Pointer to a frame, which lives until the next call, and its length. The frame is given as an array of
        observations, or as n ids, n x rows values and their noise (n x rows x rows, or None)."""
        if z is None:
            frame = complete(ids, covariance)
            return _from_buffer(_FRAME, frame), len(frame)
        names = _names(ids)
        count = len(names)
        memory = self._kept.get(count)
        if memory is None:
            memory = Memory(count)
            if count <= _KEPT:
                self._kept[count] = memory
        memory.fill(names, _values(z, count), covariance)
        return memory.pointer, count


def complete(frame: Any, covariance: Any) -> NDArray[Any]:
    """A complete array of observations."""
    if type(frame) is not np.ndarray or frame.dtype != OBSERVATION or frame.ndim != 1 or covariance is not None:
        raise TypeError("z is missing: only an array of observations can be given without z")
    return frame if frame.flags.c_contiguous else np.ascontiguousarray(frame)


def observations(ids: Any, z: ArrayLike | None = None, covariance: ArrayLike | None = None) -> NDArray[Any]:
    """An array of observations (cairn.OBSERVATION) from n ids, n x rows values and their noise (n x rows x rows, or
    None). `ids` may also be a complete array of observations; then z and covariance must be None."""
    if z is None:
        return complete(ids, covariance)
    names = _names(ids)
    memory = Memory(len(names))
    memory.fill(names, _values(z, len(names)), covariance)
    return memory.frame
