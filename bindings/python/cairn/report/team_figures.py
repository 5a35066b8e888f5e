# SPDX-License-Identifier: BSD-3-Clause
"""Figures 2 to 7 of the cooperative paper, drawn by matplotlib from a comparison of the modes or from one run."""
from __future__ import annotations

import functools
from collections.abc import Callable, Iterator
from typing import Any, TYPE_CHECKING

import numpy as np

from . import team_time
from .figures import pyplot, write_figures
from .run import ReportError
from .team_curves import MODES, colour_of

if TYPE_CHECKING:
    from .team import Scene
    from .team import Steps

DASHES = {"mono": "-", "eo_diagonal": (0, (5, 2)), "eo_full": (0, (5, 2, 1, 2)), "submaps": ":", "joint": "-"}
LABELS = {"mono": "alone (mono)", "eo_diagonal": "together (eo_diagonal)", "eo_full": "together (eo_full)",
          "submaps": "together (submaps)", "joint": "together (joint)"}
SHOWN = ("mono", "eo_diagonal", "eo_full", "joint")  # in a comparison; the paper has no figure of submaps


def shown_modes(steps: Steps) -> list[str]:
    return [mode for mode in team_time.ordered(steps.modes) if mode in SHOWN or len(steps.modes) <= 2]


def _line_of(mode: str) -> dict[str, Any]:
    return {"color": MODES.get(mode, "#55524a"), "linestyle": DASHES.get(mode, "-"), "linewidth": 1.3}


def _boat(axes: Any, scene: Scene, boat: int, colour: str, size: int) -> None:
    """A triangle at the start of a boat, with the bow ahead: boats turn to the left around the centre of their course."""
    x, y, _ = scene.circle("radar", boat)
    cx, cy, _ = scene.circle("course", boat)
    heading = np.degrees(np.arctan2(y - cy, x - cx)) + 90
    axes.plot(x, y, color=colour, marker=(3, 0, heading - 90), markersize=size, linestyle="none", zorder=6)


def _closer(axes: Any, scene: Scene, boat: int, colour: str) -> None:
    """Course and true drive of one boat, and the boat at its start."""
    axes.plot(*team_time.circle_points(*scene.circle("course", boat)), color=colour, linewidth=1.3)
    axes.plot(*scene.points("drive", boat), color="#1c1b19", linewidth=0.8)
    _boat(axes, scene, boat, colour, 10)
    axes.set_aspect("equal")
    axes.margins(0.1)
    axes.grid(False)
    axes.tick_params(labelsize=7)
    axes.set_title(f"boat {boat} (m); triangle: start;\nblack: the true drive", fontsize=8)


def world(scene: Scene, features: int) -> Any:
    """Coast line, features, courses, and the radars' circles at the start. A window looks closer at the second boat."""
    figure = pyplot.figure(figsize=(8.4, 5.4))
    cells = figure.add_gridspec(2, 2, width_ratios=(1.9, 1), height_ratios=(1, 1))
    axes, inset, words = figure.add_subplot(cells[:, 0]), figure.add_subplot(cells[0, 1]), figure.add_subplot(cells[1, 1])
    axes.grid(False)
    x, y = (values / 1000 for values in scene.points("coast"))
    (west, east), (south, north) = team_time.sea(scene)
    axes.fill_between([west / 1000, east / 1000], south / 1000, north / 1000, color=team_time.SEA, linewidth=0)
    axes.fill_between(x, y, north / 1000, color=team_time.LAND, linewidth=0)
    axes.plot(x, y, color="#7a6a45", linewidth=1.2, label="coast line")
    x, y = (values[:features] / 1000 for values in scene.points("feature"))
    axes.plot(x, y, "*", color="#1c1b19", markersize=7, label=f"{features} features")
    for at, boat in enumerate(scene.boats):
        colour = colour_of(at)
        cx, cy, radius = (value / 1000 for value in scene.circle("radar", boat))
        axes.plot(*team_time.circle_points(cx, cy, radius), "--", color=colour, linewidth=1.0,
                  label=f"radar of boat {boat} at the start")
        axes.plot(*(v / 1000 for v in team_time.circle_points(*scene.circle("course", boat))), color=colour, linewidth=1.3,
                  label=f"course of boat {boat}")
    bound = team_time.reach(scene) / 1000
    axes.set(xlim=(-bound, bound), ylim=(-bound, bound), aspect="equal", xlabel="east (km)", ylabel="north (km)")
    at = min(1, len(scene.boats) - 1)
    boat, colour = scene.boats[at], colour_of(at)
    _closer(inset, scene, boat, colour)
    (left, right), (low, high) = (np.array(ends) / 1000 for ends in (inset.get_xlim(), inset.get_ylim()))
    axes.plot([left, right, right, left, left], [low, low, high, high, low], color="#6d6a62", linewidth=0.8)
    words.axis("off")
    words.legend(*axes.get_legend_handles_labels(), loc="center", frameon=False)
    figure.tight_layout()
    return figure


def norms(steps: Steps, features: int) -> Any:
    """For two boats: above the norm of the position's covariance, below the improvement ratio."""
    vehicles = steps.vehicles[:2]
    figure, cells = pyplot.subplots(2, len(vehicles), sharex=True, sharey="row", squeeze=False, figsize=(7.2, 5.4))
    for at, vehicle in enumerate(vehicles):
        above, below = cells[:, at]
        above.set_title(f"boat {vehicle}")
        for mode in shown_modes(steps):
            above.plot(*steps.curve("norm_m2", features, mode, vehicle), label=LABELS.get(mode, mode), **_line_of(mode))
            if mode != "mono":
                below.plot(*steps.improvement(features, mode, vehicle), **_line_of(mode))
        if features in team_time.CLAIMS:
            below.axhline(team_time.CLAIMS[features], color="#1c1b19", linewidth=1.0, linestyle=(0, (1, 2)),
                          label="the paper's figure")
        below.set_xlabel("time (s)")
    cells[0, 0].set_ylabel("norm of the position's\ncovariance (m²)")
    cells[1, 0].set_ylabel("improvement ratio (%)")
    cells[0, 0].set_ylim(bottom=0)
    handles, labels = ([*first, *second] for first, second in zip(cells[0, 0].get_legend_handles_labels(),
                                                       cells[1, 0].get_legend_handles_labels()))
    figure.legend(handles, labels, loc="upper center", ncols=3, frameon=False)
    figure.text(0.995, 0.005, "one world" if steps.runs == 1 else f"means of {steps.runs} worlds", ha="right", va="bottom",
                fontsize=7, color="#6d6a62")
    figure.align_ylabels(cells[:, 0])
    figure.tight_layout(rect=(0, 0.01, 1, 0.92))
    return figure


def recursion(steps: Steps, features: int) -> Any:
    """The time of a recursion of the second boat."""
    vehicle = team_time.paper_boat(steps)
    figure, axes = pyplot.subplots(figsize=(6.4, 4.0))
    found = [(mode, *steps.curve("recursion_ms", features, mode, vehicle)) for mode in shown_modes(steps)]
    top, _ = team_time.top_of([taken for _, _, taken in found])
    for mode, times, taken in found:
        axes.plot(times, team_time.below(taken, top), color=MODES.get(mode, "#55524a"), linewidth=0.6, alpha=0.35)
        axes.plot(times, team_time.smooth(taken), label=LABELS.get(mode, mode), **_line_of(mode))
    axes.set_ylim(0, top)
    axes.set(xlabel="time (s)", ylabel="time of a recursion (ms)")
    worlds = "" if steps.runs == 1 else f"; medians of {steps.runs} worlds"
    axes.set_title(f"boat {vehicle}; strong: median of {team_time.MEDIAN_OF} steps; pale: each step{worlds}", loc="right",
                   fontsize=8, color="#6d6a62")
    axes.legend(ncols=2, loc="upper left")
    figure.tight_layout()
    return figure


def draw(one: Any) -> Iterator[Any]:
    """(number, function that draws it) of each figure for which the folder has the data."""
    for (kind, features), number in sorted(team_time.PAPER.items(), key=lambda entry: entry[1]):
        if kind == "scene":
            if one.scene is not None and features in one.drawn_features():
                yield number, functools.partial(world, one.scene, features)
        elif one.steps is not None and features in one.steps.features and one.steps.compares():
            make: Callable[..., Any] = norms if kind == "norm" else recursion
            yield number, functools.partial(make, one.steps, features)


def write(one: Any, folder: str, kind: str) -> Any:
    """Writes usv_figure_02.png and so on; returns their paths."""
    paths = write_figures(draw(one), folder, kind, "usv_figure")
    if not paths:
        raise ReportError("there is nothing to draw: the cooperative paper's figures need what 'cairn simulate usv --compare "
                          "--output' writes, or a run with 6, 10 or 40 features")
    return paths
