# SPDX-License-Identifier: BSD-3-Clause
"""The corrected trajectory beside the online one, in plotly's form."""
from __future__ import annotations

from typing import Any, TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from . import thin
from .curves import MOST, base_layout, line
from .trust_curves import BLACK, BLUE, LEGEND, ORANGE

if TYPE_CHECKING:
    from .run import Run
    from .trust import Trust

Array = NDArray[Any]

STYLES: dict[str, dict[str, Any]] = {"online": {"color": ORANGE, "width": 1.4, "dash": "dash"}, "corrected": {"color": BLUE, "width": 1.8}}


def _points(points: Array, name: str, style: dict[str, Any]) -> dict[str, Any]:
    kept = thin.evenly(len(points), MOST)
    return {"type": "scatter", "mode": "lines", "x": thin.significant(points[kept, 0], 7),
            "y": thin.significant(points[kept, 1], 7), "name": name, "line": style, "hoverinfo": "name"}


def _trajectories(trust: Trust) -> dict[str, tuple[Array, Array]]:
    return {name: found for name, found in (("online", trust.online), ("corrected", trust.corrected)) if found is not None}


def from_above(run: Run, trust: Trust) -> dict[str, Any]:
    """True, online and corrected trajectory from above."""
    traces: list[Any] = []
    truth = run.positions("true_")
    if truth is not None:
        traces.append(_points(truth, "true", {"color": BLACK, "width": 1.2}))
    traces += [_points(points, name, STYLES[name]) for name, (_, points) in _trajectories(trust).items()]
    layout = base_layout(420, "y (m)", "x (m)", **LEGEND)
    layout["xaxis"]["exponentformat"] = "none"
    layout["yaxis"].update(scaleanchor="x", scaleratio=1, exponentformat="none")
    return {"title": "From above", "note": "", "data": traces, "layout": layout, "alone": True}


def distances(run: Run, times: Array, points: Array) -> tuple[Array, Array]:
    """Times, and the distances of the poses from the truth of the same time. A pose whose time has no truth is left out."""
    truth, at = run.positions("true_"), run.times()
    after = np.clip(np.searchsorted(at, times), 1, len(at) - 1) if len(at) > 1 else np.zeros(len(times), int)
    nearest = np.where(np.abs(at[after] - times) < np.abs(at[after - 1] - times), after, after - 1) if len(at) > 1 else after
    same = np.abs(at[nearest] - times) <= 1e-6 * np.maximum(1.0, np.abs(times))
    error = np.linalg.norm(points[same] - truth[nearest[same]], axis=1)
    known = np.isfinite(error)
    return times[same][known], error[known]


def errors(run: Run, trust: Trust) -> Any:
    """Distance from the truth over time, or None if there is no truth."""
    if run.positions("true_") is None:
        return None
    traces: list[Any] = []
    notes: list[Any] = []
    for name, (times, points) in _trajectories(trust).items():
        times, error = distances(run, times, points)
        if len(times) == 0:
            continue
        kept = thin.envelope(error, MOST)
        traces.append(line(times[kept], error[kept], STYLES[name]["color"], name, line=STYLES[name]))
        notes.append(f"{name} {np.sqrt(np.mean(error ** 2)):.3g} m")
    if not traces:
        return None
    layout = base_layout(420, "distance from the truth (m)", **LEGEND)
    layout["yaxis"]["rangemode"] = "tozero"
    return {"title": "Position error", "note": "root mean square: " + ", ".join(notes), "data": traces, "layout": layout}


def of_run(run: Run, trust: Trust) -> list[Any]:
    """The figures of the two trajectories. Empty without a corrected one."""
    if trust.corrected is None:
        return []
    return [figure for figure in (from_above(run, trust), errors(run, trust)) if figure]
