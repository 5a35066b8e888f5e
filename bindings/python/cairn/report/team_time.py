# SPDX-License-Identifier: BSD-3-Clause
"""The world of simulated boats, and a team beside vehicles without a team over time, in plotly's form."""
from __future__ import annotations

from typing import Any, TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from . import thin
from .curves import MOST, base_layout
from .team_curves import DASHES, LEGEND, MODES, colour_of, points_of

if TYPE_CHECKING:
    from .team import Scene
    from .team import Steps

Array = NDArray[Any]

PAPER = {("scene", 10): 2, ("norm", 6): 3, ("scene", 40): 4, ("norm", 10): 5, ("norm", 40): 6, ("time", 10): 7}
CLAIMS = {6: 50, 10: 40, 40: 30}  # improvement that the cooperative paper claims, %
MEDIAN_OF = 11  # steps
BESIDE = 1.6  # an axis of times reaches this many times as high as the largest median
SEA, LAND = "#e8f1f8", "#e3dac4"
NAMED = 4  # boats that have names of their own in the legend of the world


def paper_figure(kind: str, features: int) -> str:
    """" (Figure 2 of the cooperative paper)", or nothing if the paper has no such figure."""
    number = PAPER.get((kind, features))
    return "" if number is None else f" (Figure {number} of the cooperative paper)"


def ordered(modes: list[str]) -> list[str]:
    """The modes in the order of the legend."""
    return [mode for mode in MODES if mode in modes] + [mode for mode in modes if mode not in MODES]


def circle_points(x: float, y: float, radius: float) -> tuple[Array, Array]:
    turn = np.linspace(0, 2 * np.pi, 145)
    return x + radius * np.cos(turn), y + radius * np.sin(turn)


def sea(scene: Scene) -> tuple[tuple[float, float], tuple[float, float]]:
    """West and east end, south and north end of the square, m."""
    half = np.abs(scene.points("coast")[0]).max()
    return (-half, half), (-half, half)


def reach(scene: Scene) -> float:
    """Half the side of a square about the origin that holds the sea and the radars' circles, m."""
    far = max(abs(centre) + radius for boat in scene.boats
              for x, y, radius in [scene.circle("radar", boat)] for centre in (x, y))
    return 1.03 * max(float(far), float(np.abs(scene.points("coast")[0]).max()))


def world(scene: Scene, features: int) -> dict[str, Any]:
    """The square from above: coast line, the first `features` features, courses, and the radars' circles at the start."""
    x, y = scene.points("coast")
    (west, east), (south, north) = sea(scene)
    area = {"mode": "lines", "fill": "toself", "line": {"width": 0}, "hoverinfo": "skip", "showlegend": False}
    traces = [points_of([west, east, east, west], [south, south, north, north], fillcolor=SEA, name="sea", **area),
              points_of(np.append(x, [east, west]), np.append(y, [north, north]), fillcolor=LAND, name="land", **area),
              points_of(x, y, mode="lines", hoverinfo="skip", name="coast line", line={"color": "#7a6a45", "width": 1.4})]
    for at, boat in enumerate(scene.boats):
        colour, (cx, cy, radius) = colour_of(at), scene.circle("radar", boat)
        few = len(scene.boats) <= NAMED
        for kind, points, style in (("radar", circle_points(cx, cy, radius), {"width": 1.2, "dash": "dash"}),
                                    ("course", circle_points(*scene.circle("course", boat)), {"width": 1.6})):
            traces.append(points_of(*points, mode="lines", hoverinfo="skip", name=f"{kind} {boat}" if few else f"{kind}s",
                                  legendgroup=f"{kind} {boat}" if few else kind, showlegend=few or at == 0,
                                  line={"color": colour, **style}))
        drive = scene.points("drive", boat)
        kept = thin.evenly(len(drive[0]), MOST)
        traces.append(points_of(drive[0][kept], drive[1][kept], mode="lines", hoverinfo="skip", name="true drives",
                              legendgroup="drives", showlegend=at == 0, line={"color": "#1c1b19", "width": 1}))
        traces.append(points_of([cx], [cy], mode="markers", name="starts", legendgroup="starts", showlegend=at == 0,
                              hovertemplate=f"start of vehicle {boat}<br>%{{x}}, %{{y}} m<extra></extra>",
                              marker={"size": 9, "symbol": "triangle-right", "color": colour}))
    x, y = (values[:features] for values in scene.points("feature"))
    traces.append(points_of(x, y, mode="markers", name="features", text=[f"feature {i + 1}" for i in range(len(x))],
                          hovertemplate="%{text}<br>%{x}, %{y} m<extra></extra>",
                          marker={"size": 8, "symbol": "star", "color": "#1c1b19"}))
    bound = float(reach(scene))
    layout = base_layout(620, "north (m)", "east (m)", **LEGEND)
    layout["xaxis"].update(range=[-bound, bound], exponentformat="none")
    layout["yaxis"].update(range=[-bound, bound], exponentformat="none", scaleanchor="x", scaleratio=1)
    return {"title": f"The world with {features} features" + paper_figure("scene", features),
            "note": "Dashed circles: the range of the radars at the start. Drag a rectangle to look closer.", "data": traces,
            "layout": layout, "alone": True}


def _mode_line(times: Array, values: Array, mode: str, **more: Any) -> dict[str, Any]:
    kept = thin.envelope(values, MOST)
    trace = {"type": "scatter", "mode": "lines", "x": thin.numbers(times[kept], 3), "y": thin.significant(values[kept], 5),
             "name": mode, "legendgroup": mode,
             "line": {"color": MODES.get(mode, "#55524a"), "width": 1.8, "dash": DASHES.get(mode, "solid")}}
    trace.update(more)
    return trace


def hide_submaps(traces: list[Any]) -> None:
    """The large saw teeth of submaps appear on demand: the paper has no submaps, and they would squeeze the other curves."""
    for trace in traces:
        if trace["name"] == "submaps" and len(traces) > 2:
            trace["visible"] = "legendonly"


def norms(steps: Steps, features: int) -> list[dict[str, Any]]:
    """For each vehicle the norm of its position's covariance over time, in each mode."""
    figures: list[Any] = []
    for vehicle in steps.vehicles:
        traces = [_mode_line(*steps.curve("norm_m2", features, mode, vehicle), mode) for mode in ordered(steps.modes)]
        traces = [trace for trace in traces if trace["x"]]
        hide_submaps(traces)
        if traces:
            layout = base_layout(300, "norm of the covariance (m²)", **LEGEND)
            layout["yaxis"]["rangemode"] = "tozero"
            figures.append({"title": f"vehicle {vehicle}: claimed uncertainty of its position", "note": "",
                            "data": traces, "layout": layout})
    return figures


def improvements(steps: Steps, features: int) -> list[Any]:
    """For each vehicle the improvement ratio over time. Empty without steps of the mode mono to compare with."""
    figures: list[Any] = []
    for vehicle in steps.vehicles:
        traces: list[Any] = []
        for mode in ordered(steps.modes):
            times, ratio = steps.improvement(features, mode, vehicle)
            if mode != "mono" and len(times):
                traces.append(_mode_line(times, ratio, mode))
        hide_submaps(traces)
        if not traces:
            continue
        layout, note = base_layout(300, "improvement ratio (%)", **LEGEND), ""
        if features in CLAIMS:
            layout["shapes"] = [{"type": "line", "xref": "paper", "x0": 0, "x1": 1, "y0": CLAIMS[features],
                                 "y1": CLAIMS[features], "line": {"color": "#1c1b19", "width": 1.2, "dash": "dot"}}]
            note = f"dotted: the cooperative paper says about {CLAIMS[features]} %"
        figures.append({"title": f"vehicle {vehicle}: claimed improvement on a vehicle by itself", "note": note,
                        "data": traces, "layout": layout})
    return figures


def by_vehicle(steps: Steps, features: int) -> list[dict[str, Any]]:
    """Norm and time of all vehicles, for steps of only one mode."""
    figures: list[dict[str, Any]] = []
    mode = steps.modes[0]
    for column, title, y_title, note in (
            ("norm_m2", "Claimed uncertainty of the position", "norm of the covariance (m²)", ""),
            ("recursion_ms", "Time of a recursion", "time of a recursion (ms)", f"median of {MEDIAN_OF} steps")):
        traces: list[Any] = []
        for at, vehicle in enumerate(steps.vehicles):
            times, values = steps.curve(column, features, mode, vehicle)
            if len(times):
                traces.append(_mode_line(times, smooth(values) if column == "recursion_ms" else values, mode))
                traces[-1].update(name=f"vehicle {vehicle}", legendgroup=f"vehicle {vehicle}",
                                  line={"color": colour_of(at), "width": 1.4})
        layout = base_layout(340, y_title, **LEGEND)
        layout["yaxis"]["rangemode"] = "tozero"
        figures.append({"title": title, "note": note, "data": traces, "layout": layout})
    return figures


def paper_boat(steps: Steps) -> int:
    """The boat whose times the paper shows: b, the second."""
    return steps.vehicles[min(1, len(steps.vehicles) - 1)]


def smooth(values: Array) -> Array:
    """The median of the MEDIAN_OF steps around each step; at the ends of those that there are."""
    half = MEDIAN_OF // 2
    return np.array([np.median(values[max(0, i - half): i + half + 1]) for i in range(len(values))])


def top_of(columns: list[Array]) -> tuple[float, int]:
    """Upper end of an axis for times, which single interrupted steps do not stretch, and the number of steps beyond it."""
    top = BESIDE * max(smooth(column).max() for column in columns)
    return float(top), int((np.concatenate(columns) > top).sum())


def below(values: Array, top: float) -> Array:
    """The values up to `top`; others become NaN, a gap in a curve."""
    return np.where(values <= top, values, np.nan)


def recursions(steps: Steps, features: int, vehicles: list[int]) -> list[dict[str, Any]]:
    """The time of a recursion over time of each of these vehicles."""
    figures: list[Any] = []
    for vehicle in vehicles:
        found = [(mode, *steps.curve("recursion_ms", features, mode, vehicle)) for mode in ordered(steps.modes)]
        found = [(mode, times, taken) for mode, times, taken in found if len(times)]
        if not found:
            continue
        top, beyond = top_of([taken for _, _, taken in found])
        traces: list[Any] = []
        for mode, times, taken in found:
            traces.append(_mode_line(times, below(taken, top), mode, showlegend=False, opacity=0.3, hoverinfo="skip"))
            traces[-1]["line"] = {"color": traces[-1]["line"]["color"], "width": 1}
            traces.append(_mode_line(times, smooth(taken), mode))
        layout = base_layout(300, "time of a recursion (ms)", **LEGEND)
        layout["yaxis"]["range"] = [0, top]
        note = f"strong: median of {MEDIAN_OF} steps; pale: each step"
        if beyond:
            note += f"; {beyond} step{' is' if beyond == 1 else 's are'} beyond the axis and not drawn"
        figure = paper_figure("time", features) if vehicle == paper_boat(steps) else ""
        figures.append({"title": f"vehicle {vehicle}, {features} features{figure}", "note": note,
                        "data": traces, "layout": layout})
    return figures
