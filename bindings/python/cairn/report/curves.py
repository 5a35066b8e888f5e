# SPDX-License-Identifier: BSD-3-Clause
"""The curves of the page in plotly's form: {"data": [...], "layout": {...}}."""
from __future__ import annotations

from typing import Any, TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from . import thin

if TYPE_CHECKING:
    from .run import Run

Array = NDArray[Any]

MOST = 2400  # points of a curve
COLOURS = {"only": "#2563a8", "standard": "#c8641b", "submaps": "#2563a8"}
BANDS = {"only": "rgba(37,99,168,0.16)", "standard": "rgba(200,100,27,0.14)", "submaps": "rgba(37,99,168,0.18)"}
AXIS = {"gridcolor": "#e8e6e1", "zerolinecolor": "#cfccc4", "linecolor": "#cfccc4", "ticks": "outside", "ticklen": 4,
        "tickcolor": "#cfccc4", "automargin": True}
ERRORS = [("x", "error_x_m", "sigma3_x_m", "m", 1.0), ("y", "error_y_m", "sigma3_y_m", "m", 1.0),
          ("z", "error_z_m", "sigma3_z_m", "m", 1.0),
          ("roll: about the map's x", "error_dtheta_x_rad", "sigma3_dtheta_x_rad", "deg", np.degrees(1.0)),
          ("pitch: about the map's y", "error_dtheta_y_rad", "sigma3_dtheta_y_rad", "deg", np.degrees(1.0)),
          ("yaw: about the map's z", "error_dtheta_z_rad", "sigma3_dtheta_z_rad", "deg", np.degrees(1.0))]


def key_of(runs: list[Run], run: Run) -> str:
    return "only" if len(runs) == 1 else run.name


def base_layout(height: int, y_title: str, x_title: str = "time (s)", **more: Any) -> dict[str, Any]:
    layout: dict[str, Any] = {"height": height, "margin": {"l": 56, "r": 16, "t": 12, "b": 44}, "paper_bgcolor": "#ffffff",
              "plot_bgcolor": "#ffffff", "font": {"family": "system-ui, sans-serif", "size": 12, "color": "#33312c"},
              "xaxis": {**AXIS, "title": {"text": x_title}}, "yaxis": {**AXIS, "title": {"text": y_title}},
              "hovermode": "closest", "showlegend": False}
    layout.update(more)
    return layout


def line(x: Array, y: Array, colour: str, name: str, **more: Any) -> dict[str, Any]:
    trace: dict[str, Any] = {"type": "scatter", "mode": "lines", "x": thin.numbers(x, 3), "y": thin.significant(y, 5), "name": name,
             "line": {"color": colour, "width": 1.4}}
    trace.update(more)
    return trace


def band(x: Array, low: Array, high: Array, fill: str, name: str) -> dict[str, Any]:
    """The area between two curves."""
    return {"type": "scatter", "mode": "lines", "x": thin.numbers(np.concatenate([x, x[::-1]]), 3),
            "y": thin.significant(np.concatenate([high, low[::-1]]), 4), "fill": "toself", "fillcolor": fill,
            "line": {"width": 0}, "hoverinfo": "skip", "name": name}


def errors(runs: list[Run]) -> list[Any]:
    """One figure for each of the six errors with its 3-sigma band. Empty if there is no truth."""
    figures: list[Any] = []
    for title, error_name, sigma_name, unit, scale in ERRORS:
        bands: list[Any] = []
        lines: list[Any] = []
        inside: list[Any] = []
        for run in runs:
            error, sigma = run.trajectory.get(error_name), run.trajectory.get(sigma_name)
            if error is None or np.isnan(error).all():
                continue
            if not np.nan_to_num(error).any() and (sigma is None or not np.nan_to_num(sigma).any()):
                continue  # z, roll and pitch of a planar vehicle
            key, times = key_of(runs, run), run.times()
            label = "" if key == "only" else f"{key}: "
            if sigma is not None and not np.isnan(sigma).all():
                kept = thin.envelope(sigma, MOST)
                bands.append(band(times[kept], -scale * sigma[kept], scale * sigma[kept], BANDS[key], f"{label}3 σ"))
                judged = np.isfinite(error) & (sigma > 0)
                if judged.any():
                    share = np.count_nonzero(np.abs(error[judged]) <= sigma[judged]) / np.count_nonzero(judged)
                    inside.append(f"{label}{100 * share:.1f} % inside 3 σ")
            kept = thin.envelope(error, MOST)
            lines.append(line(times[kept], scale * error[kept], COLOURS[key], f"{label}error"))
        if lines:
            figures.append({"title": title, "note": " · ".join(inside), "data": bands + lines,
                            "layout": base_layout(230, unit)})
    return figures


def nis(runs: list[Run]) -> Any:
    """Normalised innovation squared (NIS) over its degrees of freedom, with its 95 % band."""
    traces: list[Any] = []
    notes: list[str] = []
    for run in runs:
        table = run.timing
        if table is None or not {"nis", "nis_rows", "nis_lower", "nis_upper"} <= set(table):
            continue
        judged = np.isfinite(table["nis"]) & (table["nis_rows"] > 0)
        if not judged.any():
            continue
        key = key_of(runs, run)
        label = "" if key == "only" else f"{key}: "
        rows, times = table["nis_rows"][judged], run.time_of_steps(table["step"][judged])
        value, low, high = (table[name][judged] / rows for name in ("nis", "nis_lower", "nis_upper"))
        share = np.count_nonzero((value >= low) & (value <= high)) / len(value)
        notes.append(f"{label}{100 * share:.1f} % of the updates inside (95 % are expected), mean {value.mean():.3f} "
                     "(1 is expected)")
        kept = thin.evenly(len(value), MOST)
        traces.insert(0, band(times[kept], low[kept], high[kept], BANDS[key], f"{label}95 % band"))
        kept = thin.envelope(value, MOST)
        traces.append(line(times[kept], value[kept], COLOURS[key], f"{label}NIS", mode="markers",
                           marker={"size": 3, "color": COLOURS[key]}))
    if not traces:
        return None
    return {"title": "Innovations (NIS over degrees of freedom)", "note": " · ".join(notes), "data": traces,
            "layout": base_layout(280, "NIS / dof")}


def step_time(runs: list[Run]) -> Any:
    """Time of each step on a logarithmic axis. Closings are marked."""
    traces: list[Any] = []
    notes: list[Any] = []
    least: list[Any] = []
    most: list[Any] = []
    for run in runs:
        table = run.timing
        if table is None or "step_ms" not in table or len(table["step_ms"]) == 0:
            continue
        key = key_of(runs, run)
        label = "" if key == "only" else f"{key}: "
        taken, times = table["step_ms"], run.time_of_steps(table["step"])
        kept = thin.envelope(taken, MOST)
        traces.append(line(times[kept], taken[kept], COLOURS[key], f"{label}step", opacity=0.9))
        least.append(np.quantile(taken, 0.02))  # a step without observations takes almost no time
        most.append(taken.max())
        note = f"{label}median {np.median(taken):.3g} ms, worst {taken.max():.3g} ms"
        closings = np.isin(table["step"], run.closing_steps())
        if closings.any():
            shown = np.flatnonzero(closings)[thin.envelope(taken[closings], 600)]
            traces.append(line(times[shown], taken[shown], "#b3261e", f"{label}a submap was closed", mode="markers",
                               marker={"size": 6, "symbol": "triangle-down", "color": "#b3261e"}))
            note += f", {int(closings.sum())} closing{'s' if closings.sum() > 1 else ''} ▼"
        notes.append(note)
    if not traces:
        return None
    layout = base_layout(280, "ms")
    low, high = max(min(least), 1e-4) / 1.5, max(most + [2e-4]) * 1.5
    layout["yaxis"].update(type="log", dtick="D2" if high / low < 100 else 1, exponentformat="none",
                           range=[float(np.log10(low)), float(np.log10(high))])
    return {"title": "Time of a step", "note": " · ".join(notes), "data": traces, "layout": layout}


def held(runs: list[Run]) -> Any:
    """Landmarks in the state of the filter."""
    traces: list[Any] = []
    for run in runs:
        counts = run.held_landmarks()
        if counts is None:
            continue
        key, (times, count) = key_of(runs, run), counts
        kept = thin.envelope(count, MOST)
        traces.append(line(times[kept], count[kept], COLOURS[key], "landmarks" if key == "only" else key))
    if not traces:
        return None
    note = "the cost of a step grows with the square of this number"
    if any(run.closing_steps() for run in runs):
        note += "; each submap starts anew"
    return {"title": "Landmarks in the filter's state", "note": note, "data": traces, "layout": base_layout(280, "landmarks")}
