# SPDX-License-Identifier: BSD-3-Clause
"""Frames of observations as the library takes them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._structs import Ids, array, identifiers
from .layouts import OBSERVATION


def observations(ids: Ids, z: ArrayLike | None = None,
                 covariance: ArrayLike | None = None) -> NDArray[np.void]:
    """An array of cairn.OBSERVATION from n ids, n x rows values and their noise (n x rows x rows; None: that of the
    sensor). `ids` may also be a complete array of observations; then z and covariance must be None."""
    if z is None:
        frame: Any = ids
        if type(frame) is not np.ndarray or frame.dtype != OBSERVATION or frame.ndim != 1 or covariance is not None:
            raise TypeError("z is missing: only an array of observations can be given without z")
        complete: NDArray[np.void] = np.ascontiguousarray(frame)
        return complete
    names = identifiers("ids", ids)
    count = len(names)
    values = array("z", np.zeros((0, 3)) if count == 0 and np.size(z) == 0 else z, (count, None))
    rows = values.shape[1]
    if not 1 <= rows <= 3:
        raise ValueError(f"z: must have 1 to 3 values per observation, and has {rows}")
    made: NDArray[np.void] = np.zeros(count, OBSERVATION)
    made["id"] = names
    made["z"][:, :rows] = values
    if covariance is not None:
        packed = array("covariance", covariance, (count, rows, rows)).reshape(count, rows * rows)
        made["covariance"].reshape(count, 9)[:, : rows * rows] = packed
    return made
