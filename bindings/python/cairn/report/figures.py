# SPDX-License-Identifier: BSD-3-Clause
"""Figures 5 to 13 of section 4 of the Mars paper, drawn by matplotlib from the two runs of a comparison."""
from __future__ import annotations

import importlib
import io
import os
from collections.abc import Iterator
from typing import Any

import numpy as np

from . import scene
from .run import ReportError

matplotlib: Any = importlib.import_module("matplotlib")
matplotlib.use("Agg", force=True)
pyplot: Any = importlib.import_module("matplotlib.pyplot")
ticker: Any = importlib.import_module("matplotlib.ticker")

TRUTH, ESTIMATE, MARK, SEEN = "#d63f8f", "#1f4fd0", "#2e9b3d", "#d02626"  # the colours of the paper: pink, blue, green, red
SIDES = {"standard": "#c8641b", "submaps": "#2563a8"}
STYLE: dict[Any, Any] = {
    "font.size": 9, "axes.grid": True, "grid.color": "#e4e1da", "axes.edgecolor": "#9a968c", "axes.titlesize": 10,
    "legend.fontsize": 8, "legend.framealpha": 0.9, "svg.hashsalt": "cairn", "savefig.facecolor": "white"}
CAPTIONS = {
    5: "Figure 5: the terrain and the rover's true trajectory",
    6: "Figure 6: true and estimated trajectory, standard EKF-SLAM",
    7: "Figure 7: position error, standard EKF-SLAM",
    8: "Figure 8: attitude error, standard EKF-SLAM",
    9: "Figure 9: true and estimated trajectory, EKF-SLAM with submaps",
    10: "Figure 10: position error, EKF-SLAM with submaps",
    11: "Figure 11: attitude error, EKF-SLAM with submaps",
    12: "Figure 12: standard deviation of the rover's position and azimuth in the open submap",
    13: "Figure 13: landmarks in the state of the filter"}


def _terrain(axes: Any, table: Any) -> None:
    ground = scene.terrain(table)
    if ground is None:
        return
    x, y = np.meshgrid(np.array(ground["x"], float), np.array(ground["y"], float))
    z = np.array(ground["z"], dtype=float)
    axes.plot_surface(x, y, z, cmap="copper", alpha=0.55, linewidth=0, antialiased=False, rasterized=True, rcount=80,
                      ccount=80)


def _flatten(axes: Any) -> None:
    """Axes x and y have the same scale. Heights are drawn five times as tall, and more on flat ground."""
    axes.set_xlabel("x (m)", labelpad=6)
    axes.set_ylabel("y (m)", labelpad=6)
    axes.set_zlabel("z (m)", labelpad=-2)
    axes.zaxis.set_major_locator(ticker.MaxNLocator(4))
    axes.tick_params(axis="z", pad=1)
    low, high = zip(axes.get_xlim3d(), axes.get_ylim3d(), axes.get_zlim3d())
    size = np.array(high) - np.array(low)
    axes.set_box_aspect((size[0], size[1], max(size[2] * 5, 0.25 * max(size[:2]))), zoom=1.05)
    axes.figure.subplots_adjust(left=0.06, right=0.98, bottom=0.04, top=1.0)
    axes.view_init(elev=38, azim=-120)


def terrain_and_truth(run: Any) -> Any:
    figure = pyplot.figure(figsize=(6.4, 4.6))
    axes = figure.add_subplot(projection="3d")
    _terrain(axes, run.terrain)
    truth = run.positions("true_")
    path = run.positions() if truth is None else truth
    lift = 0.3  # so that the ground does not hide the line
    axes.plot(path[:, 0], path[:, 1], path[:, 2] + lift, color=TRUTH, linewidth=2, zorder=10,
              label="true trajectory" if truth is not None else "estimated trajectory (no truth)")
    axes.legend(loc="upper left")
    _flatten(axes)
    return figure


def trajectories(run: Any) -> Any:
    figure = pyplot.figure(figsize=(6.4, 4.6))
    axes = figure.add_subplot(projection="3d")
    truth, estimate = run.positions("true_"), run.positions()
    if truth is not None:
        axes.plot(*truth.T, color=TRUTH, linewidth=1.6, label="true trajectory")
    axes.plot(*estimate.T, "--", color=ESTIMATE, linewidth=1.4, label="estimated trajectory")
    marks = scene.Landmarks(run)
    if marks.truth is not None:
        axes.plot(*marks.truth.T, "o", color=MARK, markersize=5, fillstyle="none", alpha=0.8, label="landmarks (true)")
    if marks.count:
        axes.plot(*marks.points.T, "*", color=SEEN, markersize=4, alpha=0.7, label="landmarks (estimated)")
    axes.legend(loc="upper left")
    _flatten(axes)
    return figure


def _three(times: Any, values: Any, names: Any, unit: Any, bound: Any, sigmas: Any = None) -> Any:
    """Three curves, one below the other, each with the paper's bound."""
    figure, rows = pyplot.subplots(3, 1, sharex=True, figsize=(6.4, 4.6))
    for row, value, name, at in zip(rows, values.T, names, range(3)):
        if sigmas is not None:
            row.fill_between(times, -sigmas[:, at], sigmas[:, at], color="#dfe7f1", linewidth=0)
        row.plot(times, value, color=ESTIMATE, linewidth=1.0)
        row.set_ylabel(f"{name} ({unit})")
        if bound is not None:
            for side in (-bound, bound):
                row.axhline(side, color=SEEN, linestyle=":", linewidth=1.0)
    if bound is not None:
        shaded = "" if sigmas is None else "shaded: 3 σ; "
        rows[0].set_title(f"{shaded}dotted: the paper's bound, ±{bound:g} {unit}", loc="right", fontsize=8,
                          color="#6d6a62")
    rows[-1].set_xlabel("time (s)")
    figure.align_ylabels(rows)
    figure.tight_layout()
    return figure


def position_error(run: Any, bound: Any) -> Any:
    truth = run.positions("true_")
    if truth is None:
        return None
    columns = [run.trajectory.get(f"sigma3_{axis}_m") for axis in "xyz"]
    sigmas = None if any(sigma is None for sigma in columns) else np.stack(columns, axis=1)
    return _three(run.times(), truth - run.positions(), "xyz", "m", bound, sigmas=sigmas)


def attitude_error(run: Any, bound: Any) -> Any:
    error = run.euler_error()
    if error is None:
        return None
    return _three(run.times(), np.degrees(error), ("roll", "pitch", "yaw"), "°", bound)


def local_deviation(run: Any) -> Any:
    """Figure of the local position and azimuth. None if the run did not write them."""
    columns = [run.trajectory.get(name) for name in ("local_sigma_x_m", "local_sigma_y_m", "local_sigma_dtheta_z_rad")]
    if any(column is None for column in columns):
        return None
    values = np.stack([columns[0], columns[1], np.degrees(columns[2])], axis=1)
    figure, rows = pyplot.subplots(3, 1, sharex=True, figsize=(6.4, 4.6))
    for row, value, name in zip(rows, values.T, ("σ of x (m)", "σ of y (m)", "σ of azimuth (°)")):
        for step in run.closing_steps():
            row.axvline(run.time_of_steps(step), color="#d8d4ca", linewidth=0.6)
        row.plot(run.times(), value, color=ESTIMATE, linewidth=1.0)
        row.set_ylabel(name)
        row.set_ylim(bottom=0)
    rows[0].set_title("upright lines: a submap was closed", loc="right", fontsize=8, color="#6d6a62")
    rows[-1].set_xlabel("time (s)")
    figure.align_ylabels(rows)
    figure.tight_layout()
    return figure


def held(runs: Any) -> Any:
    counts = {run: run.held_landmarks() for run in runs}
    if not any(counts.values()):
        return None
    figure, axes = pyplot.subplots(figsize=(6.4, 4.2))
    for run in runs:
        if counts[run]:
            axes.step(*counts[run], where="post", linewidth=1.3, color=SIDES.get(run.name, ESTIMATE),
                      label={"standard": "standard EKF-SLAM", "submaps": "SLAM with submaps"}.get(run.name, run.name))
    axes.set_xlabel("time (s)")
    axes.set_ylabel("landmarks")
    axes.set_ylim(bottom=0)
    axes.legend()
    figure.tight_layout()
    return figure


def draw(runs: Any) -> Any:
    """(number, function that draws it) of each figure that these runs have. A single run is standard or has submaps."""
    sides = {run.name: run for run in runs} if len(runs) > 1 else {
        "submaps" if runs[0].submaps is not None and len(runs[0].submaps["step"]) else "standard": runs[0]}
    standard, submaps = sides.get("standard"), sides.get("submaps")
    yield 5, lambda: terrain_and_truth(runs[-1])
    if standard:
        yield 6, lambda: trajectories(standard)
        yield 7, lambda: position_error(standard, 1.0)
        yield 8, lambda: attitude_error(standard, 0.5)
    if submaps:
        yield 9, lambda: trajectories(submaps)
        yield 10, lambda: position_error(submaps, 1.0)
        yield 11, lambda: attitude_error(submaps, 0.5)
        yield 12, lambda: local_deviation(submaps)
    yield 13, lambda: held(runs)


def _rendered(drawn: Iterator[Any], kind: str) -> Iterator[Any]:
    with pyplot.rc_context(STYLE):
        for number, make in drawn:
            figure = make()
            if figure is None:
                continue
            content = io.BytesIO()
            figure.savefig(content, format=kind, dpi=130, metadata={"Date": None} if kind == "svg" else None)
            pyplot.close(figure)
            yield number, content.getvalue()


def for_page(runs: Any) -> Any:
    """(caption, media type, bytes) of each figure."""
    return [(CAPTIONS[number], "image/png", content) for number, content in _rendered(draw(runs), "png")]


def write_figures(drawn: Iterator[Any], folder: str, kind: str, name: str) -> list[Any]:
    """Writes name_05.png and so on; returns their paths. `drawn` gives numbers and the functions that draw."""
    os.makedirs(folder, exist_ok=True)
    paths: list[Any] = []
    for number, content in _rendered(drawn, kind):
        paths.append(os.path.join(folder, f"{name}_{number:02d}.{kind}"))
        with open(paths[-1], "wb") as file:
            file.write(content)
    return paths


def write(runs: Any, folder: Any, kind: Any) -> Any:
    """Writes figure_05.png and so on; returns their paths."""
    paths = write_figures(draw(runs), folder, kind, "figure")
    if not paths:
        raise ReportError("there is nothing to draw: name a folder that 'cairn simulate mars --output' wrote")
    return paths
