# SPDX-License-Identifier: BSD-3-Clause
"""Picks fewer points whose curve looks the same."""
from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]


def envelope(values: Array, most: int) -> Array:
    """Indices of the lowest and the highest value of each of most/2 intervals, so that no peak is lost."""
    count = len(values)
    if count <= most:
        return np.arange(count)
    edges = np.linspace(0, count, most // 2 + 1).astype(int)
    known = np.where(np.isnan(values), 0.0, values)
    kept = {0, count - 1}
    for begin, end in zip(edges[:-1], edges[1:]):
        kept.add(begin + int(np.argmin(known[begin:end])))
        kept.add(begin + int(np.argmax(known[begin:end])))
    return np.array(sorted(kept))


def evenly(count: int, most: int) -> Array:
    """Indices of at most `most` values, evenly spread. The first and the last are among them."""
    if count <= most:
        return np.arange(count)
    return np.unique(np.linspace(0, count - 1, most).round().astype(int))


def worst_and_evenly(badness: Array, most: int) -> Array:
    """Indices of at most `most` values, ascending: a quarter are the worst ones, the others are evenly spread."""
    count = len(badness)
    if count <= most:
        return np.arange(count)
    worst = np.argsort(-badness, kind="stable")[: most // 4]
    rest = np.setdiff1d(np.arange(count), worst)
    return np.sort(np.concatenate([worst, rest[evenly(len(rest), most - len(worst))]]))


def numbers(values: Any, digits: int) -> list[Any]:
    """A rounded list for JSON. A value that is not a number becomes null."""
    rounded = np.round(np.asarray(values, dtype=float), digits)
    return [value if np.isfinite(value) else None for value in rounded.tolist()]


def significant(values: Any, digits: int = 4) -> list[Any]:
    """The same with a given number of significant digits, for values of any size."""
    return [float(f"{value:.{digits}g}") if np.isfinite(value) else None for value in np.asarray(values, dtype=float)]
