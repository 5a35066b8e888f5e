# SPDX-License-Identifier: BSD-3-Clause
"""The data of the page's 3-D scene: the objects, and which of them are shown at each stop of the slider."""
from __future__ import annotations

from typing import Any, TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from . import shapes, thin

if TYPE_CHECKING:
    from .run import Run

Array = NDArray[Any]

MOST_ELLIPSOIDS = 150
MOST_LANDMARKS = 20000
MOST_POINTS = 4000     # of a trajectory
MOST_OUTLINES = 1000
MOST_STOPS = 240
TERRAIN_SIDE = 140     # largest number of grid lines in each direction
COVARIANCE = ["cov_xx_m2", "cov_xy_m2", "cov_xz_m2", "cov_xy_m2", "cov_yy_m2", "cov_yz_m2", "cov_xz_m2", "cov_yz_m2",
              "cov_zz_m2"]


def terrain(table: Any) -> Any:
    """Regular grid, thinned: x (n), y (m), z (m x n)."""
    if table is None or len(table["x"]) == 0:
        return None
    xs, ys = np.unique(table["x"]), np.unique(table["y"])
    if len(xs) * len(ys) != len(table["z"]) or len(xs) < 2 or len(ys) < 2:
        return None
    order = np.lexsort((table["x"], table["y"]))
    heights = table["z"][order].reshape(len(ys), len(xs))
    across, along = thin.evenly(len(xs), TERRAIN_SIDE), thin.evenly(len(ys), TERRAIN_SIDE)
    heights = heights[np.ix_(along, across)]
    return {"x": thin.numbers(xs[across], 2), "y": thin.numbers(ys[along], 2),
            "z": [thin.numbers(row, 3) for row in heights]}


def _columns(points: Array, digits: int = 3) -> dict[str, Any]:
    return {axis: thin.numbers(points[:, i], digits) for i, axis in enumerate("xyz")}


class Landmarks:
    """The map, in the order in which the landmarks were first seen."""

    def __init__(self, run: Run) -> None:
        table = run.landmarks or {"id": np.zeros(0, np.uint64), "x_m": np.zeros(0), "y_m": np.zeros(0), "z_m": np.zeros(0)}
        first = np.array([run.observations.first_step.get(int(i), 0) for i in table["id"]], dtype=float)
        order = np.argsort(first, kind="stable")
        self.count = len(order)
        self.first = first[order]
        self.ids = table["id"][order]
        self.points = np.stack([table[f"{axis}_m"] for axis in "xyz"], axis=1)[order]
        self.where = {int(i): k for k, i in enumerate(self.ids)}
        self.truth = self.covariances = None
        if "true_x_m" in table and not np.isnan(table["true_x_m"]).all():
            self.truth = np.stack([table[f"true_{axis}_m"] for axis in "xyz"], axis=1)[order]
        if all(name in table for name in COVARIANCE) and self.count:
            self.covariances = np.stack([table[name] for name in COVARIANCE], axis=1)[order].reshape(-1, 3, 3)


def outlines(run: Run, landmarks: Landmarks) -> list[Any]:
    """The outline of each submap from above: (submap, step, points, landmark rows)."""
    if run.submaps is None:
        return []
    drawn: list[Any] = []
    since = run.trajectory["step"][0]
    positions = run.positions()
    for submap, step in zip(run.submaps["submap"].tolist(), run.submaps["step"]):
        rows = [landmarks.where[i] for i in run.members.get(submap, []) if i in landmarks.where]
        points = landmarks.points[rows]
        if len(rows) < 3:  # too few for an outline: the trajectory in the submap is added
            driven = (run.trajectory["step"] >= since) & (run.trajectory["step"] <= step)
            points = np.vstack([points, positions[driven]])
        drawn.append((submap, float(step), shapes.outline(points), rows))
        since = step
    return drawn


def run_scene(run: Run) -> dict[str, Any]:
    """The objects of one run. Entries that are added over time are in order of time, each with its step."""
    steps, positions, truth = run.trajectory["step"], run.positions(), run.positions("true_")
    kept = thin.evenly(len(steps), MOST_POINTS)
    landmarks = Landmarks(run)
    marks = thin.evenly(landmarks.count, MOST_LANDMARKS)
    scene: dict[str, Any] = {"name": run.name, "estimate": _columns(positions[kept]), "steps": thin.numbers(steps[kept], 0),
             "times": thin.numbers(run.times()[kept], 3),
             "truth": None if truth is None else _columns(truth[kept]),
             "landmarks": {**_columns(landmarks.points[marks]), "id": [str(i) for i in landmarks.ids[marks]],
                           "step": thin.numbers(landmarks.first[marks], 0)},
             "trueLandmarks": None, "ellipsoids": None, "outlines": None,
             "counts": {"landmarks": landmarks.count, "landmarksDrawn": len(marks), "ellipsoids": 0, "submaps": 0}}
    if landmarks.truth is not None:
        scene["trueLandmarks"] = _columns(landmarks.truth[marks])
    if landmarks.covariances is not None:
        badness = np.trace(landmarks.covariances, axis1=1, axis2=2)
        chosen = [i for i in thin.worst_and_evenly(badness, MOST_ELLIPSOIDS) if np.isfinite(badness[i])]
        triangles = shapes.sphere()[1]
        vertices = [shapes.ellipsoid(landmarks.points[i], landmarks.covariances[i]) for i in chosen]
        if vertices:
            faces = np.vstack([triangles + len(shapes.sphere()[0]) * n for n in range(len(chosen))])
            scene["ellipsoids"] = {**_columns(np.vstack(vertices)), "faces": [column.tolist() for column in faces.T],
                                   "facesEach": len(triangles), "step": thin.numbers(landmarks.first[chosen], 0)}
        scene["counts"]["ellipsoids"] = len(chosen)
    drawn = outlines(run, landmarks)
    if drawn:
        scene["counts"]["submaps"] = len(drawn)
        kept = thin.evenly(len(drawn), MOST_OUTLINES)
        row_of_mark = {row: k for k, row in enumerate(marks.tolist())}
        scene["outlines"] = [{**_columns(drawn[i][2], 2), "submap": int(drawn[i][0]), "step": drawn[i][1],
                              "landmarks": [row_of_mark[row] for row in drawn[i][3] if row in row_of_mark]} for i in kept]
    return scene


def stops(run: Run) -> list[float]:
    """Steps at which the slider stops: after each of several closings, or evenly spread. The last step is always a stop."""
    steps = run.trajectory["step"]
    closings = [step for step in run.closing_steps() if steps[0] <= step <= steps[-1]]
    if len(closings) > 1:
        chosen = [closings[i] for i in thin.evenly(len(closings), MOST_STOPS)]
    else:
        chosen = steps[thin.evenly(len(steps), min(MOST_STOPS, 101))][1:]
    return sorted({float(step) for step in chosen} | {float(steps[-1])})


def exaggeration(scenes: list[dict[str, Any]], ground: Any) -> dict[str, float]:
    """Extent of the scene, and the factor by which heights are exaggerated so that flat ground shows some relief."""
    def span(axis: str) -> float:
        found = [value for scene in scenes for value in scene["estimate"][axis] + scene["landmarks"][axis]
                 if value is not None]
        if ground:
            found += ground[axis] if axis != "z" else [v for row in ground["z"] for v in row if v is not None]
        extent: float = max(found) - min(found)
        return extent

    x, y, z = max(span("x"), 1e-9), max(span("y"), 1e-9), max(span("z"), 1e-9)
    widest = max(x, y)
    times = 1.0
    for candidate in (2.0, 5.0, 10.0, 20.0):
        if z * times / widest < 0.08:
            times = candidate
    nearer = min(1.7, widest / np.sqrt(x * y))  # without this a long narrow scene would look small
    return {"x": nearer * x / widest, "y": nearer * y / widest, "z": nearer * max(z * times / widest, 0.02),
            "times": times}


def build(runs: list[Run]) -> dict[str, Any]:
    """The scene of one run or of two. The last run has the stops of the slider and the submaps."""
    main = runs[-1]
    first, closings = Landmarks(main).first, sorted(main.closing_steps())
    ground = next((found for found in (terrain(run.terrain) for run in reversed(runs)) if found), None)
    scenes = [run_scene(run) for run in runs]
    return {"runs": scenes, "terrain": ground, "aspect": exaggeration(scenes, ground),
            "stops": [{"step": step, "time": round(float(main.time_of_steps(step)), 2) if main.timed else None,
                       "landmarks": int(np.searchsorted(first, step, "right")),
                       "submaps": int(np.searchsorted(closings, step, "right"))} for step in stops(main)]}
