# SPDX-License-Identifier: BSD-3-Clause
"""Fewer points that look the same."""
import numpy as np


def envelope(values, most):
    """Indices that keep the lowest and the highest value of each of most/2 stretches: no peak is lost."""
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


def evenly(count, most):
    """Indices of at most so many, evenly spread, first and last among them."""
    if count <= most:
        return np.arange(count)
    return np.unique(np.linspace(0, count - 1, most).round().astype(int))


def worst_and_evenly(badness, most):
    """Indices of at most so many: a quarter the worst ones, the others an even pick; ascending."""
    count = len(badness)
    if count <= most:
        return np.arange(count)
    worst = np.argsort(-badness, kind="stable")[: most // 4]
    rest = np.setdiff1d(np.arange(count), worst)
    return np.sort(np.concatenate([worst, rest[evenly(len(rest), most - len(worst))]]))


def numbers(values, digits):
    """A list for JSON, rounded; null where a value is no number."""
    rounded = np.round(np.asarray(values, dtype=float), digits)
    return [value if np.isfinite(value) else None for value in rounded.tolist()]


def significant(values, digits=4):
    """The same with so many significant digits, for values of any size."""
    return [float(f"{value:.{digits}g}") if np.isfinite(value) else None for value in np.asarray(values, dtype=float)]
