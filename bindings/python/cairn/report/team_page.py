# SPDX-License-Identifier: BSD-3-Clause
"""The page of a team: the trajectories and maps of its vehicles, or a comparison of the modes."""
import html

import numpy as np

from . import page, team, team_curves

CARDS = [("pose_rmse_m", "position error, rms", "m", 1), ("landmark_rmse_m", "landmark error, rms", "m", 1),
         ("pose_anees_per_dof", "consistency of the poses (1 is right)", "", 1),
         ("claimed_improvement", "claimed improvement on one alone", "%", 100),
         ("true_improvement", "true improvement", "%", 100), ("recursion_ms_mean", "time of a recursion", "ms", 1),
         ("vehicles", "vehicles", "", 1), ("landmarks", "landmarks", "", 1)]
COLUMNS = [("claimed", "claimed, %", "{:.1f}"), ("true", "true, %", "{:.1f}"), ("anees", "ANEES / 3", "{:.2f}"),
           ("in_band", "steps in band, %", "{:.0%}"), ("rmse_m", "position, m", "{:.2f}"),
           ("landmark_rmse_m", "landmarks, m", "{:.2f}"), ("recursion_ms", "ms a recursion", "{:.3g}")]


def _cards(summary):
    shown = []
    for key, name, unit, scale in CARDS:
        value = summary.get(key)
        if isinstance(value, (int, float)):
            shown.append(f'<div class="card"><div class="value">{page.number(scale * value)} <span class="unit">{unit}</span>'
                         f'</div><div class="name">{name}</div></div>')
    return f'<div class="cards">{"".join(shown)}</div>' if shown else ""


def _section(title, figures, found, note="", grid=True):
    """A section of figures. The figures are added to `found`."""
    blocks = []
    for figure in figures:
        found.append(figure)
        blocks.append(page.plot_block(figure, len(found) - 1))
    body = f'<div class="grid">{"".join(blocks)}</div>' if grid else "".join(blocks)
    return (f"<section><h2>{title}</h2>{body}" + (f'<p class="note">{note}</p>' if note else "") + "</section>") \
        if figures else ""


def _of_run(one):
    found, times = [], np.concatenate([vehicle["time"] for vehicle in one.vehicles])
    blocks = _section("The drives and their map", [team_curves.the_map(one)], found, grid=False)
    blocks += _section("Errors, and what the filters say of them", team_curves.errors(one), found,
                       "Truth minus estimate of each step, as the vehicle itself knew its pose right after that step.")
    steps = max(len(vehicle["time"]) for vehicle in one.vehicles)
    lead = f"{len(one.vehicles)} vehicles, {steps} steps, {times.max() - times.min():.1f} s"
    return page.assemble(one.folder, one.name, lead, _cards(one.summary), blocks, page.table([one]), found)


def _comparison_table(comparison):
    columns = [column for column in COLUMNS if column[0] in comparison.table]
    head = "".join(f"<th>{title}</th>" for _, title, _ in columns)
    rows = []
    for features in comparison.features:
        for mode in comparison.modes:
            values = [(form, comparison.value(name, features, mode)) for name, _, form in columns]
            cells = "".join(f"<td>{form.format(value) if np.isfinite(value) else '–'}</td>" for form, value in values)
            rows.append(f"<tr><td>{features} features, <code>{html.escape(mode)}</code></td>{cells}</tr>")
    return ('<div class="scroll"><table><thead><tr><th></th>' + head + "</tr></thead><tbody>" + "\n".join(rows)
            + "</tbody></table></div>")


def _of_comparison(comparison):
    found = []
    blocks = _section("Improvement on a vehicle by itself, vehicle 1", team_curves.improvement(comparison), found,
                      "Claimed: by how much the norm of the position’s covariance is smaller. True: by how much the mean "
                      "squared error is. A claim above the truth is overconfidence.")
    blocks += _section("Consistency, accuracy and cost", team_curves.comparisons(comparison), found)
    lead = "modes of a team beside each other: " + ", ".join(comparison.modes)
    return page.assemble(comparison.folder, comparison.name, lead, "", blocks, _comparison_table(comparison), found)


def build(one):
    """The text of the page of a TeamRun or of a TeamComparison."""
    return _of_comparison(one) if isinstance(one, team.TeamComparison) else _of_run(one)
