# SPDX-License-Identifier: BSD-3-Clause
"""The curves of the page of a team, in plotly's form."""
from __future__ import annotations

from typing import Any, TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from . import thin
from .curves import MOST, band, base_layout, line

if TYPE_CHECKING:
    from .team import TeamComparison
    from .team import TeamRun
    from .team import Vehicle

Array = NDArray[Any]

PALETTE = ["#2563a8", "#c8641b", "#1d8a7a", "#7a4fb5", "#b5487e", "#5b7f1e", "#a86a12", "#55524a"]  # vehicles
# Colours of Okabe and Ito, which colour-blind readers can tell apart; each mode has a kind of line and a marker as well.
MODES = {"mono": "#5c5c5c", "eo_diagonal": "#d55e00", "eo_full": "#e69f00", "submaps": "#009e73", "joint": "#0072b2"}
DASHES = {"mono": "solid", "eo_diagonal": "dash", "eo_full": "dashdot", "submaps": "dot", "joint": "solid"}
MARKERS = {"mono": "circle", "eo_diagonal": "x", "eo_full": "diamond", "submaps": "square", "joint": "triangle-up"}
MOST_ELLIPSES = 400  # of one map
LEAST_BAR = -150  # %: a mode that fails must not squeeze the bars of the others
LEGEND: dict[str, Any] = {"showlegend": True, "legend": {"orientation": "h", "x": 0, "y": 1, "yanchor": "bottom", "font": {"size": 12}}}
ERRORS = [("x", "m", 1.0), ("y", "m", 1.0), ("heading", "deg", np.degrees(1.0))]


def colour_of(number: int) -> str:
    return PALETTE[number % len(PALETTE)]


def pale(colour: str, share: float = 0.16) -> str:
    return "rgba({},{},{},{})".format(*(int(colour[i: i + 2], 16) for i in (1, 3, 5)), share)


def points_of(x: Any, y: Any, **more: Any) -> dict[str, Any]:
    return {"type": "scatter", "x": thin.significant(x, 7), "y": thin.significant(y, 7), **more}


def ellipses(marks: Vehicle) -> tuple[Array, Array]:
    """Ellipses of three standard deviations as one line (x, y) with a gap between ellipses. Their axes are the axes of the
    map if the table has no correlation of x and y."""
    turn = np.append(np.linspace(0, 2 * np.pi, 37), np.nan)
    x: list[Any] = []
    y: list[Any] = []
    for i in thin.evenly(len(marks["x"]), MOST_ELLIPSES):
        a, b = marks["sigma3_x"][i], marks["sigma3_y"][i]
        joint = 9 * marks["cov_xy"][i] if "cov_xy" in marks.columns else 0.0
        # The Cholesky factor of the covariance maps the unit circle to the ellipse.
        lean = joint / a if a > 0 else 0.0
        upright = np.sqrt(max(b * b - lean * lean, 0.0))
        x.append(marks["x"][i] + a * np.cos(turn))
        y.append(marks["y"][i] + lean * np.cos(turn) + upright * np.sin(turn))
    return (np.concatenate(x), np.concatenate(y)) if x else (np.zeros(0), np.zeros(0))


def the_map(team: TeamRun) -> dict[str, Any]:
    """The plane from above: trajectories and landmarks with their 3-sigma ellipses."""
    traces: list[Any] = []
    truth = False
    for at, vehicle in enumerate(team.vehicles):
        colour = colour_of(at)
        kept = thin.evenly(len(vehicle["x"]), MOST)
        if np.isfinite(vehicle.error("x")).any():
            traces.append(points_of(vehicle["true_x"][kept], vehicle["true_y"][kept], mode="lines", hoverinfo="skip",
                                  name="true trajectories", legendgroup="truth", showlegend=not truth,
                                  line={"color": "#1c1b19", "width": 1}))
            truth = True
        traces.append(points_of(vehicle["x"][kept], vehicle["y"][kept], mode="lines", name=f"vehicle {vehicle.number}",
                              line={"color": colour, "width": 1.6}))
    maps = team.maps[:1] if team.one_map() else team.maps
    for at, marks in enumerate(maps):
        colour = "#1c1b19" if len(maps) == 1 else colour_of(at)
        of = "" if len(maps) == 1 else f" of vehicle {marks.number}"
        x, y = ellipses(marks)
        traces.append(points_of(x, y, mode="lines", fill="toself", fillcolor=pale(colour, 0.14), hoverinfo="skip",
                              name=f"3 σ{of}", line={"color": colour, "width": 0.8}))
        traces.append(points_of(marks["x"], marks["y"], mode="markers", name=f"landmarks{of}",
                              text=[f"landmark {i}" for i in marks["id"]], hovertemplate="%{text}<br>%{x}, %{y} m<extra></extra>",
                              marker={"size": 5, "color": colour}))
    known = [marks for marks in maps if "true_x" in marks.columns and np.isfinite(marks["true_x"]).any()]
    for at, marks in enumerate(known):
        traces.append(points_of(marks["true_x"], marks["true_y"], mode="markers", name="true landmarks", legendgroup="marks",
                              showlegend=at == 0, hoverinfo="skip",
                              marker={"size": 7, "symbol": "x-thin", "line": {"width": 1.4, "color": "#1d8a3a"}}))
    layout = base_layout(620, "y (m)", "x (m)", **LEGEND)
    layout["xaxis"]["exponentformat"] = "none"
    layout["yaxis"].update(scaleanchor="x", scaleratio=1, exponentformat="none")
    note = "" if not maps else "Ellipses: 3 σ." if "cov_xy" in maps[0].columns else "Ellipses: 3 σ along x and y."
    if len(team.maps) > 1 and len(maps) == 1:
        note += " All vehicles hold the same map; it is drawn once."
    if len(maps) > 0 and len(maps[0]["x"]) > MOST_ELLIPSES:
        note += f" They are drawn for {MOST_ELLIPSES} of {len(maps[0]['x'])} landmarks, evenly chosen."
    return {"title": "From above", "note": note, "data": traces, "layout": layout, "alone": True}


def errors(team: TeamRun) -> list[Any]:
    """Errors of x, y and heading of each vehicle with their 3-sigma bands. Empty if there is no truth."""
    figures: list[Any] = []
    for at, vehicle in enumerate(team.vehicles):
        for name, unit, scale in ERRORS:
            error, sigma, times = vehicle.error(name), vehicle[f"sigma3_{name}"], vehicle["time"]
            if np.isnan(error).all():
                continue
            judged = np.isfinite(error) & (sigma > 0)
            note = ""
            if judged.any():
                note = f"{100 * np.mean(np.abs(error[judged]) <= sigma[judged]):.1f} % inside 3 σ"
            kept = thin.envelope(sigma, MOST // 2)
            traces = [band(times[kept], -scale * sigma[kept], scale * sigma[kept], pale(colour_of(at)), "3 σ")]
            kept = thin.envelope(error, MOST // 2)
            traces.append(line(times[kept], scale * error[kept], colour_of(at), "error"))
            figures.append({"title": f"vehicle {vehicle.number}: {name}", "note": note, "data": traces,
                            "layout": base_layout(210, unit)})
    return figures


def _bars(comparison: TeamComparison, features: int, bounds: list[float]) -> dict[str, Any]:
    modes = [mode for mode in comparison.modes if mode != "mono"]  # the reference of the comparison
    claimed, true = ([comparison.value(column, features, mode) for mode in modes]
                     for column in ("claimed", "true"))
    paper = max(comparison.value("paper", features, mode) for mode in comparison.modes)
    traces: list[Any] = []
    for name, values, colour in (("claimed", claimed, "#9fc0e0"), ("true", true, "#2563a8")):
        text = [f"{value:.0f}" if np.isfinite(value) else "" for value in values]
        traces.append({"type": "bar", "x": modes, "y": thin.significant(np.maximum(values, LEAST_BAR)), "name": name,
                       "marker": {"color": colour}, "text": text, "textposition": "outside", "cliponaxis": False,
                       "textfont": {"size": 11}, "hovertemplate": "%{x}: %{text} %<extra>" + name + "</extra>"})
    layout = base_layout(330, "improvement (%)", "", barmode="group", bargap=0.3, **LEGEND)
    layout["xaxis"].update(type="category", tickangle=0, tickfont={"size": 10})
    layout["yaxis"].update(range=bounds)
    note = ""
    if np.isfinite(paper):
        layout["shapes"] = [{"type": "line", "xref": "paper", "x0": 0, "x1": 1, "y0": paper, "y1": paper,
                             "line": {"color": "#b3261e", "width": 1.4, "dash": "dash"}}]
        note = f"dashed: the cooperative paper claims {paper:g} %"
    if min([0.0, *claimed, *true]) < LEAST_BAR:
        note += f"; bars are cut at {LEAST_BAR} %"
    return {"title": f"{features} features", "note": note, "data": traces, "layout": layout, "alone": True}


def improvement(comparison: TeamComparison) -> list[dict[str, Any]]:
    """Claimed and true improvement over a vehicle without a team: one figure for each number of features, all on the same
    scale."""
    shown = np.concatenate([comparison.table[name] for name in ("claimed", "true", "paper")])
    low, high = max(np.nanmin(np.append(shown, 0.0)), LEAST_BAR), np.nanmax(np.append(shown, 10.0))
    room = 0.12 * (high - low)
    return [_bars(comparison, features, [float(low - room if low < 0 else 0.0), float(high + room)])
            for features in comparison.features]


def _by_features(comparison: TeamComparison, column: str, title: str, y_title: str, note: str,
                 log: bool = False) -> dict[str, Any]:
    traces: list[Any] = []
    for mode in comparison.modes:
        values = np.array([comparison.value(column, features, mode) for features in comparison.features])
        colour = MODES.get(mode, "#55524a")
        traces.append({"type": "scatter", "mode": "lines+markers", "x": [str(f) for f in comparison.features],
                       "y": thin.significant(values), "name": mode, "line": {"color": colour, "width": 1.6, "dash": DASHES.get(mode, "solid")},
                       "marker": {"color": colour, "size": 8, "symbol": MARKERS.get(mode, "circle")}})
    layout = base_layout(330, y_title, "features", **LEGEND)
    layout["xaxis"]["type"] = "category"
    if log:
        layout["yaxis"].update(type="log", dtick=1, exponentformat="none")
    return {"title": title, "note": note, "data": traces, "layout": layout, "alone": True}


def consistency(comparison: TeamComparison) -> dict[str, Any]:
    """ANEES over its degrees of freedom, with the band in which the mean of this number of runs lies."""
    low, high = (float(comparison.table[name][0]) for name in ("band_low", "band_high"))
    figure = _by_features(comparison, "anees", "Consistency: ANEES / 3", "ANEES / 3",
                          f"1 is right, more is overconfident; shaded: {low:.2f} to {high:.2f}, where the mean of a "
                          "consistent filter over the runs lies at 95 % of the steps")
    figure["layout"]["shapes"] = [
        {"type": "rect", "xref": "paper", "x0": 0, "x1": 1, "y0": low, "y1": high, "line": {"width": 0},
         "fillcolor": "rgba(37,99,168,0.13)", "layer": "below"},
        {"type": "line", "xref": "paper", "x0": 0, "x1": 1, "y0": 1, "y1": 1, "layer": "below",
         "line": {"color": "#9a968c", "width": 1}}]
    return figure


def comparisons(comparison: TeamComparison) -> list[dict[str, Any]]:
    return [consistency(comparison),
            _by_features(comparison, "rmse_m", "Position error", "m", "root mean square of vehicle 1, online"),
            _by_features(comparison, "recursion_ms", "Time of a recursion", "ms",
                         "one vehicle, one step, its share of the packets in it", log=True)]


