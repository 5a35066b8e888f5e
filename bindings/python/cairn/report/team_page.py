# SPDX-License-Identifier: BSD-3-Clause
"""The page of a team: the trajectories and maps of its vehicles, or a comparison of the modes."""
from __future__ import annotations

import html
from typing import Any, TYPE_CHECKING

import numpy as np

from . import page, team, team_curves, team_time

if TYPE_CHECKING:
    from .team import Steps
    from .team import TeamComparison
    from .team import TeamRun

CARDS = [("pose_rmse_m", "position error, rms", "m", 1), ("landmark_rmse_m", "landmark error, rms", "m", 1),
         ("pose_anees_per_dof", "consistency of the poses (1 is right)", "", 1),
         ("claimed_improvement", "claimed improvement on one alone", "%", 100),
         ("true_improvement", "true improvement", "%", 100), ("recursion_ms_mean", "time of a recursion", "ms", 1),
         ("vehicles", "vehicles", "", 1), ("landmarks", "landmarks", "", 1)]
COLUMNS = [("claimed", "claimed, %", "{:.1f}"), ("true", "true, %", "{:.1f}"), ("anees", "ANEES / 3", "{:.2f}"),
           ("in_band", "steps in band, %", "{:.0%}"), ("rmse_m", "position, m", "{:.2f}"),
           ("landmark_rmse_m", "landmarks, m", "{:.2f}"), ("recursion_ms", "ms a recursion", "{:.3g}")]


def _cards(summary: dict[str, Any]) -> str:
    shown: list[Any] = []
    for key, name, unit, scale in CARDS:
        value = summary.get(key)
        if isinstance(value, (int, float)):
            shown.append(f'<div class="card"><div class="value">{page.number(scale * value)} <span class="unit">{unit}</span>'
                         f'</div><div class="name">{name}</div></div>')
    return f'<div class="cards">{"".join(shown)}</div>' if shown else ""


def _worlds(steps: Steps, kind: str) -> str:
    return "One world." if steps.runs == 1 else f"{kind} of {steps.runs} worlds."


def _over_time(steps: Steps, features: int, found: list[dict[str, Any]]) -> str:
    """Norms and improvement ratios with one number of features."""
    figures = team_time.norms(steps, features) + team_time.improvements(steps, features)
    return page.section(f"Uncertainty with {features} features{team_time.paper_figure('norm', features)}", figures, found,
                        f"{_worlds(steps, 'Means')} Frobenius norm of the covariance of x and y. The improvement ratio is the "
                        "share by which it is smaller than that of a vehicle by itself. Both are claims: they do not use the truth. "
                        "A click on a mode in the legend shows or hides it.", grid="grid pairs")


def _compared_steps(steps: Steps, found: list[dict[str, Any]]) -> str:
    """All modes over time. The steps of only one mode need one curve for each vehicle."""
    if len(steps.modes) > 1:
        return "".join(_over_time(steps, features, found) for features in steps.features) + _recursions(steps, found)
    return page.section("Uncertainty and cost", team_time.by_vehicle(steps, steps.features[0]), found,
                        "Frobenius norm of the covariance of x and y. A recursion is one step of one vehicle, with its share "
                        "of the packets.", grid="grid pairs")


def _recursions(steps: Steps, found: list[dict[str, Any]]) -> str:
    figures = [figure for features in steps.features
               for figure in team_time.recursions(steps, features, steps.vehicles)]
    return page.section("Time of a recursion", figures, found,
                        f"{_worlds(steps, 'Medians')} One vehicle, one step, with its share of the packets.", grid="grid pairs")


def _of_run(one: TeamRun) -> str:
    found: list[Any] = []
    times = np.concatenate([vehicle["time"] for vehicle in one.vehicles])
    the_map = team_curves.the_map(one)
    if one.scene is None:
        blocks = page.section("The drives and their map", [the_map], found, grid="")
    else:
        world = team_time.world(one.scene, one.scene.features)
        blocks = page.section("The world, the drives and their map", [world, the_map], found, grid="grid pairs")
    blocks += page.section("Errors, and what the filters say of them", team_curves.errors(one), found,
                           "Truth minus estimate of each step, as the vehicle itself knew its pose right after that step.")
    if one.steps is not None:
        blocks += _compared_steps(one.steps, found)
    steps = max(len(vehicle["time"]) for vehicle in one.vehicles)
    lead = f"{len(one.vehicles)} vehicles, {steps} steps, {times.max() - times.min():.1f} s"
    return page.assemble(one.folder, one.name, lead, _cards(one.summary), blocks, page.table([one]), found)


def _comparison_table(comparison: TeamComparison) -> str:
    columns = [column for column in COLUMNS if column[0] in comparison.table]
    head = "".join(f"<th>{title}</th>" for _, title, _ in columns)
    rows: list[Any] = []
    for features in comparison.features:
        for mode in comparison.modes:
            values = [(form, comparison.value(name, features, mode)) for name, _, form in columns]
            cells = "".join(f"<td>{form.format(value) if np.isfinite(value) else '–'}</td>" for form, value in values)
            rows.append(f"<tr><td>{features} features, <code>{html.escape(mode)}</code></td>{cells}</tr>")
    return ('<div class="scroll"><table><thead><tr><th></th>' + head + "</tr></thead><tbody>" + "\n".join(rows)
            + "</tbody></table></div>")


def _of_comparison(comparison: TeamComparison) -> str:
    found: list[Any] = []
    blocks = page.section("Improvement on a vehicle by itself, vehicle 1", team_curves.improvement(comparison), found,
                           "Claimed: by how much the norm of the position’s covariance is smaller. True: by how much the mean "
                           "squared error is. A claim above the truth is overconfidence.")
    blocks += page.section("Consistency, accuracy and cost", team_curves.comparisons(comparison), found)
    worlds = [team_time.world(comparison.scene, features) for features in comparison.drawn_features()
              if ("scene", features) in team_time.PAPER]
    several = comparison.steps is None or comparison.steps.runs > 1
    blocks += page.section("The world", worlds, found, "The first of the worlds." if several else "", grid="grid pairs")
    if comparison.steps is not None:
        blocks += _compared_steps(comparison.steps, found)
    lead = "modes of a team beside each other: " + ", ".join(comparison.modes)
    return page.assemble(comparison.folder, comparison.name, lead, "", blocks, _comparison_table(comparison), found)


def build(one: Any) -> str:
    """The text of the page of a TeamRun or of a TeamComparison."""
    return _of_comparison(one) if isinstance(one, team.TeamComparison) else _of_run(one)
