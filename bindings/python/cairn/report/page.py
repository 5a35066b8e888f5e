# SPDX-License-Identifier: BSD-3-Clause
"""Builds the page: one file that contains everything."""
from __future__ import annotations

import base64
import html
import importlib
import json
import os
import re
from typing import Any, TYPE_CHECKING

from . import curves, path_curves, scene, trust, trust_curves
from .._declarations import VERSION
from .run import ReportError

if TYPE_CHECKING:
    from .run import Run

HERE = os.path.dirname(os.path.abspath(__file__))
MEANINGS = {
    "steps": "steps of the run", "landmarks": "landmarks in the map at the end",
    "observations": "observations given to the filter", "rejected": "observations that it refused",
    "submaps": "submaps closed", "seconds": "time of the whole run, s", "filter_seconds": "time spent in the filter, s",
    "step_ms_mean": "time of a step, mean, ms", "step_ms_second_half": "the same in the second half of the run, ms",
    "step_ms_p99": "99 % of the steps take less, ms", "step_ms_worst": "slowest step, ms",
    "closing_ms_worst": "slowest closing of a submap, ms", "peak_rss_mib": "largest memory of the process, MiB",
    "pose_rmse_m": "position error, root mean square, online, m", "pose_final_m": "position error at the end, m",
    "pose_max_m": "largest position error, m", "pose_axis_max_m": "the same along any one axis, m",
    "pose_end_m": "position error once the last submap is closed, m",
    "attitude_rmse_deg": "attitude error, root mean square, degrees",
    "attitude_final_deg": "attitude error at the end, degrees",
    "attitude_axis_max_deg": "largest attitude error about any one axis, degrees",
    "attitude_end_deg": "attitude error once the last submap is closed, degrees",
    "filter_landmarks_max": "landmarks in the filter's state, at most",
    "filter_landmarks_mean": "landmarks in the filter's state, mean over the steps",
    "filter_landmarks_rms": "the same, root mean square: the cost depends on it",
    "landmark_rmse_m": "landmarks' error at the end, root mean square, m",
    "pose_anees_per_dof": "squared pose error over its variance: 1 for a consistent filter",
    "nis_per_dof": "squared innovation over its variance: 1 if the noise is as assumed",
    "wrong_pairings": "observations paired with the wrong landmark", "paired": "observations paired without an id",
    "verdict": "verdict on the filter at the end", "verdict_good_share": "share of the steps judged good",
    "verdict_doubtful_share": "share of the steps judged doubtful", "verdict_lost_share": "share of the steps judged lost",
    "refused_share": "share of the observations of known landmarks that were refused",
    "widenings": "how often the pose was widened because most of what was seen contradicted it",
    "motion_noise_scale": "factor on the stated noise of the motion that explains the innovations",
    "motion_noise_scale_sigma": "its standard deviation",
    "sensor_noise_scale": "factor on the stated noise of the sensors that explains the innovations",
    "sensor_noise_scale_sigma": "its standard deviation",
    "error_correlation": "correlation of a landmark’s innovations, one sighting and the next",
    "vehicles": "vehicles of the team", "recursion_ms_mean": "time of one vehicle's step, its share of the packets in it, ms",
    "claimed_improvement": "by how much the covariance of the first vehicle is smaller than without the team",
    "true_improvement": "by how much its mean squared error is smaller than without the team"}
CARDS = [("verdict", "verdict at the end", ""), ("verdict_good_share", "of the steps judged good", "%"),
         ("pose_rmse_m", "position error, rms", "m"), ("landmark_rmse_m", "landmark error, rms", "m"),
         ("attitude_rmse_deg", "attitude error, rms", "°"), ("pose_anees_per_dof", "consistency of the pose (1 is right)", ""),
         ("step_ms_mean", "time of a step", "ms"),
         ("landmarks", "landmarks", ""), ("submaps", "submaps", "")]
FIGURE_SECTION = "The Mars paper’s figures"


def number(value: Any) -> str:
    """A number in readable form."""
    if isinstance(value, str):
        return html.escape(value)
    if isinstance(value, int) or (abs(value) >= 1000 and value == round(value)):
        return f"{int(value):,}".replace(",", "\u202f")
    return f"{value:.4g}"


def meaning(key: str) -> str:
    vehicle = re.fullmatch(r"vehicle_(\d+)_(.*)", key)
    return f"vehicle {vehicle[1]}: {MEANINGS.get(vehicle[2], '')}" if vehicle else MEANINGS.get(key, "")


def table(runs: list[Any]) -> str:
    keys = [key for key in MEANINGS if any(key in run.summary for run in runs)]
    keys += sorted({key for run in runs for key in run.summary} - set(MEANINGS))
    if not keys:
        return '<p class="note">There is no summary.json.</p>'
    names = [""] if len(runs) == 1 else [run.name for run in runs]
    head = "".join(f"<th>{html.escape(name)}</th>" for name in names)
    rows: list[Any] = []
    for key in keys:
        cells = "".join(f"<td>{number(run.summary[key]) if key in run.summary else '–'}</td>" for run in runs)
        rows.append(f'<tr><td><code>{html.escape(key)}</code></td>{cells}'
                    f'<td class="meaning">{html.escape(meaning(key))}</td></tr>')
    refused = [reason for run in runs for reason in run.observations.refused]
    for reason in sorted(set(refused)):
        cells = "".join(f"<td>{number(run.observations.refused.get(reason, 0))}</td>" for run in runs)
        rows.append(f'<tr><td><code>rejected: {html.escape(reason)}</code></td>{cells}<td class="meaning"></td></tr>')
    return ('<div class="scroll"><table><thead><tr><th></th>' + head + "<th></th></tr></thead><tbody>"
            + "\n".join(rows) + "</tbody></table></div>")


def cards(runs: list[Run]) -> str:
    main = runs[-1]
    shown: list[str] = []
    for key, name, unit in CARDS:
        if key not in main.summary or (key == "submaps" and not main.summary[key]):
            continue
        scale = 100 if unit == "%" else 1  # shares
        rival = ""
        if len(runs) > 1 and key in runs[0].summary and key != "submaps":
            rival = f'<div class="rival">{number(scale * runs[0].summary[key])} {html.escape(runs[0].name)}</div>'
        shown.append(f'<div class="card"><div class="value">{number(scale * main.summary[key])} <span class="unit">{unit}</span></div>'
                     f'<div class="name">{name}</div>{rival}</div>')
    return f'<div class="cards">{"".join(shown)}</div>' if shown else ""


def keys(runs: list[Run]) -> str:
    """The legend of the curves."""
    shown: list[Any] = []
    for run in runs:
        key = curves.key_of(runs, run)
        label = "" if key == "only" else f"{html.escape(key)}: "
        shown.append(f'<span><i style="background:{curves.COLOURS[key]}"></i>{label}error</span>'
                     f'<span><i class="area" style="background:{curves.BANDS[key]}"></i>{label}3σ band</span>')
    return f'<div class="keys">{"".join(shown)}</div>'


def plot_block(curve: dict[str, Any], at: int) -> str:
    note = f'<p class="note">{html.escape(curve["note"])}</p>' if curve["note"] else ""
    return (f'<div><h3>{html.escape(curve["title"])}</h3>{note}'
            f'<div id="curve{at}" class="plot" style="height:{curve["layout"]["height"]}px"></div></div>')


def section(title: str, figures: list[Any], found: list[Any], note: str = "", grid: str = "grid",
            kind: str = "") -> str:
    """A section of figures, one below the other or in a grid of the style `grid`. The figures are added to `found`."""
    if not figures:
        return ""
    blocks: list[Any] = []
    for figure in figures:
        found.append(figure)
        blocks.append(plot_block(figure, len(found) - 1))
    body = f'<div class="{grid}">{"".join(blocks)}</div>' if grid else "".join(blocks)
    note = f'<p class="note">{note}</p>' if note else ""
    attribute = f' class="{kind}"' if kind else ""
    return f"<section{attribute}><h2>{title}</h2>{body}{note}</section>"


def trust_sections(run: Run, label: str, found: list[Any]) -> Any:
    """What the run says of itself: verdict, systematic errors, corrected trajectory. Each appears if its file is there."""
    known = trust.Trust(run.folder, run.start)
    blocks: list[str] = []
    if known.health is not None:
        blocks.append(section(f"Trust{label}", [trust_curves.verdict(known.health)], found, grid="", kind="trust"))
        blocks.append(section(f"What the verdict rests on{label}", trust_curves.of_health(known.health), found, kind="trust"))
    rest = known.systematic[trust_curves.MOST_STATES:]
    note = "Estimate and its 3 σ band."
    if rest:
        note += " Not drawn: " + ", ".join(html.escape(state[0]) for state in rest) + "."
    blocks.append(section(f"Systematic errors that the filter estimates{label}", trust_curves.systematic(known.systematic),
                          found, note, kind="trust"))
    blocks.append(section(f"Corrected and online trajectory{label}", path_curves.of_run(run, known), found,
                          "Online: each pose as known right after its step. Corrected: the poses of all kept steps as known "
                          "at the end.", grid="grid pairs", kind="trust"))
    return [block for block in blocks if block]


def sections(runs: list[Run], pictures: Any) -> Any:
    """HTML of the sections below the scene, and the curves in them."""
    found: list[Any] = []
    blocks: list[str] = []
    for run in runs:
        blocks += trust_sections(run, "" if len(runs) == 1 else f": {html.escape(run.name)}", found)

    def place(curve: dict[str, Any]) -> str:
        found.append(curve)
        return plot_block(curve, len(found) - 1)

    errors = curves.errors(runs)
    if errors:
        blocks.append(f'<section><h2>Errors, and what the filter says of them</h2>{keys(runs)}<div class="grid">'
                      + "".join(place(curve) for curve in errors)
                      + '</div><p class="note">Truth minus estimate of each step, as known right after that step. Attitude: '
                      "rotation vector in the map’s axes.</p></section>")
    others = [curve for curve in (curves.nis(runs), curves.step_time(runs), curves.held(runs)) if curve]
    if others:
        blocks.append('<section><h2>Consistency and cost</h2><div class="grid">' + "".join(map(place, others))
                      + "</div></section>")
    if pictures:
        shown = "".join(f'<figure><img alt="{html.escape(caption)}" src="data:{kind};base64,'
                        f'{base64.b64encode(content).decode()}"><figcaption>{html.escape(caption)}</figcaption></figure>'
                        for caption, kind, content in pictures)
        blocks.append(f'<section><h2>{FIGURE_SECTION}</h2><div class="grid">{shown}</div></section>')
    return "\n".join(blocks), found


def plotly_source() -> Any:
    try:
        plotly: Any = importlib.import_module("plotly.offline")
    except ImportError as error:
        raise ReportError(f"the page needs plotly ({error}): pip install 'cairn[report]'") from None
    return plotly.get_plotlyjs().replace("</script", "<\\/script")


def lead_of(run: Run) -> str:
    times = run.times()
    lead = f"{len(times)} steps"
    if run.timed:
        lead += f", {times[-1] - times[0]:.1f} s"
    return lead + (f"; times count from {run.start:.3f} s" if run.start else "")


def build(folder: str, runs: list[Run], pictures: Any = ()) -> str:
    """The text of the page of one run or of two."""
    title = os.path.basename(os.path.abspath(folder))
    title = f"{title}: submaps beside one standard map" if len(runs) > 1 else title
    main = runs[-1]
    blocks, found = sections(runs, pictures)
    if not main.timed:
        for curve in found:
            axis = curve["layout"]["xaxis"]["title"]
            axis["text"] = "step" if axis["text"] == "time (s)" else axis["text"]
    return assemble(folder, title, lead_of(main), cards(runs), blocks, table(runs), found,
                    scene.build(runs))


def assemble(folder: str, title: str, lead: str, cards_html: str, blocks: str, table_html: str, found: list[Any],
             built_scene: Any = None) -> str:
    """The text of the page from its parts. `found` are the curves in the blocks."""
    data = {"scene": built_scene,
            "curves": [{"data": curve["data"], "layout": curve["layout"], "alone": bool(curve.get("alone"))}
                       for curve in found]}
    text = json.dumps(data, separators=(",", ":"), allow_nan=False).replace("<", "\\u003c")
    parts = {"TITLE": html.escape(title), "LEAD": html.escape(lead), "CARDS": cards_html,
             "SCENE": asset("scene.html") if built_scene else "", "SECTIONS": blocks, "TABLE": table_html,
             "VERSION": VERSION, "FOLDER": html.escape(folder), "STYLE": asset("page.css"),
             "SCRIPT": (asset("scene.js") if built_scene else "") + asset("page.js"), "DATA": text,
             "PLOTLY": plotly_source()}
    pieces = asset("page.html").split("@")
    return "".join(parts[piece] if i % 2 else piece for i, piece in enumerate(pieces))


def asset(name: str) -> str:
    with open(os.path.join(HERE, name), encoding="utf-8") as file:
        return file.read()
