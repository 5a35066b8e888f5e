# SPDX-License-Identifier: BSD-3-Clause
"""Ellipsoids and outlines."""
from __future__ import annotations

import functools
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]


@functools.lru_cache(maxsize=None)
def sphere() -> tuple[Array, Array]:
    """Vertices and triangles of a unit sphere: an icosahedron, split once, with 42 vertices and 80 triangles."""
    golden = (1 + 5 ** 0.5) / 2
    vertices = [v for a in (-1, 1) for b in (-golden, golden) for v in ((0, a, b), (a, b, 0), (b, 0, a))]
    vertices = np.array(vertices) / np.hypot(1, golden)
    near = np.linalg.norm(vertices[:, None] - vertices[None], axis=2) < 1.1
    triangles = [(i, j, k) for i in range(12) for j in range(i + 1, 12) for k in range(j + 1, 12)
                 if near[i, j] and near[j, k] and near[i, k]]
    points: list[Any] = list(vertices)
    index: dict[tuple[int, int], int] = {}
    split: list[tuple[int, int, int]] = []

    def middle(i: int, j: int) -> int:
        key = (min(i, j), max(i, j))
        if key not in index:
            point: Array = points[i] + points[j]
            index[key] = len(points)
            points.append(point / np.linalg.norm(point))
        return index[key]

    for i, j, k in triangles:
        a, b, c = middle(i, j), middle(j, k), middle(k, i)
        split += [(i, a, c), (j, a, b), (k, b, c), (a, b, c)]
    return np.array(points), np.array(split)


def ellipsoid(centre: Array, covariance: Array, sigmas: float = 3.0) -> Array:
    """Vertices (42 x 3) of the ellipsoid of a given number of standard deviations."""
    variances, axes = np.linalg.eigh(covariance)
    lengths = sigmas * np.sqrt(np.maximum(variances, 0.0))
    vertices: Array = centre + (sphere()[0] * lengths) @ axes.T
    return vertices


def outline(points: Array) -> Array:
    """Convex hull seen from above, (n x 3). It is closed: the last point repeats the first."""
    points = np.unique(np.asarray(points, dtype=float), axis=0)
    if len(points) > 2:
        def chain(ordered: Array) -> list[Array]:
            kept: list[Array] = []
            for point in ordered:
                while len(kept) > 1:
                    a, b = kept[-1] - kept[-2], point - kept[-2]
                    if a[0] * b[1] - a[1] * b[0] > 0:
                        break
                    kept.pop()
                kept.append(point)
            return kept[:-1]

        points = np.array(chain(points) + chain(points[::-1]))
    return np.vstack([points, points[:1]]) if len(points) else points.reshape(0, 3)
