# SPDX-License-Identifier: BSD-3-Clause
"""How far a run can be trusted, in plotly's form: verdict, refusals, learned noise, systematic errors, corrected path."""
from __future__ import annotations

from typing import Any, TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from . import thin, trust
from .curves import MOST, band, base_layout, line

if TYPE_CHECKING:
    from .trust import Health

Array = NDArray[Any]

BLUE, ORANGE, GREEN, BLACK = "#0072b2", "#d55e00", "#009e73", "#1c1b19"  # of Okabe and Ito, for the colour-blind
PALE_BLUE, PALE_ORANGE = "rgba(0,114,178,0.16)", "rgba(213,94,0,0.16)"
VERDICT_COLOURS = [GREEN, "#e69f00", ORANGE]  # of trust.VERDICTS; their height tells them apart as well
REASONS = {"nis": "innovations", "refusals": "refusals", "widened": "widened", "sensor_noise": "sensor noise",
           "motion_noise": "motion noise", "bias": "bias", "jump": "jump", "landmarks": "landmarks contradict",
           "closing": "closing contradicts", "blind": "blind direction", "definite": "covariance"}
LEGEND: dict[str, Any] = {"showlegend": True, "legend": {"orientation": "h", "x": 0, "y": 1, "yanchor": "bottom", "font": {"size": 12}}}
MOST_STATES = 12
PIXELS = 800  # of the time axis, about


def spans(times: Array, held: Array) -> tuple[Array, Array]:
    """Begins and ends of the spans in which a condition holds. A span ends where the next step begins. It is long enough to
    be seen."""
    steps = np.flatnonzero(np.diff(np.concatenate([[False], held, [False]]).astype(int)))
    ends = np.append(times, times[-1] + (times[-1] - times[-2] if len(times) > 1 else 1.0))
    begins, ends, least = ends[steps[0::2]], ends[steps[1::2]], (ends[-1] - ends[0]) / PIXELS
    if len(begins) > PIXELS:  # spans whose gap nobody could see become one
        apart = np.flatnonzero(begins[1:] - ends[:-1] > least)
        begins, ends = begins[np.append(0, apart + 1)], ends[np.append(apart, len(ends) - 1)]
    return begins, np.maximum(ends, begins + least)


def _bars(begins: Array, ends: Array, height: int, colour: str, name: str, width: int = 12) -> dict[str, Any]:
    """Thick horizontal lines at a height, one a span."""
    x = np.stack([begins, ends, np.full(len(begins), np.nan)], axis=1).ravel()
    return {"type": "scatter", "mode": "lines", "x": thin.numbers(x, 3), "y": [height, height, None] * len(begins),
            "name": name, "line": {"color": colour, "width": width}, "hoverinfo": "name+x"}


def verdict(health: Health) -> dict[str, Any]:
    """The verdict over time, and below it a row for each reason that occurs."""
    traces: list[Any] = []
    names: list[Any] = []
    for level in reversed(range(len(trust.VERDICTS))):
        begins, ends = spans(health.times, health.level == level)
        names.append(trust.VERDICTS[level])
        if len(begins):
            traces.append(_bars(begins, ends, len(names), VERDICT_COLOURS[level], trust.VERDICTS[level], 16))
    for word, held in health.reasons.items():
        names.append(REASONS.get(word, word))
        traces.append(_bars(*spans(health.times, held), len(names), "#55524a", names[-1], 8))
    count = len(names)
    layout = base_layout(76 + 26 * count, "")
    layout["yaxis"].update(tickvals=list(range(1, count + 1)), ticktext=names, range=[count + 0.6, 0.4], zeroline=False)
    layout["shapes"] = [{"type": "line", "xref": "paper", "x0": 0, "x1": 1, "y0": 3.5, "y1": 3.5,
                         "line": {"color": "#9a968c", "width": 1}}] if health.reasons else []
    shares = ", ".join(f"{name} {100 * np.mean(health.level == level):.1f} %" for level, name in enumerate(trust.VERDICTS))
    return {"title": "Verdict" + (" and its reasons" if health.reasons else ""),
            "note": f"at the end {trust.VERDICTS[health.level[-1]]}; share of the steps: {shares}", "data": traces,
            "layout": layout}


def _curve(health: Health, name: str, colour: str, label: str, **more: Any) -> dict[str, Any]:
    values = health.column(name)
    kept = thin.envelope(values, MOST)
    return line(health.times[kept], values[kept], colour, label, **more)


def refusals(health: Health) -> Any:
    """Share of refused observations. A triangle marks a step whose pose was widened."""
    share = health.column("refused_share")
    if share is None:
        return None
    kept = thin.envelope(share, MOST)
    traces = [line(health.times[kept], 100 * share[kept], BLUE, "refused")]
    note = f"at most {100 * np.nanmax(share):.3g} %"
    widened = health.column("widened")
    if widened is not None and (widened > 0).any():
        at = np.flatnonzero(widened > 0)
        note += f"; ▼ the pose was widened, in {len(at)} step{'s' if len(at) > 1 else ''}"
        at = at[thin.evenly(len(at), 600)]
        traces.append(line(health.times[at], np.nan_to_num(100 * share[at]), ORANGE, "widened", mode="markers",
                           marker={"size": 9, "symbol": "triangle-down", "color": ORANGE},
                           text=[f"by {amount:.3g}" for amount in widened[at]],
                           hovertemplate="widened %{text}<br>%{x} s<extra></extra>"))
    layout = base_layout(280, "refused (%)", **(LEGEND if len(traces) > 1 else {}))
    layout["yaxis"]["range"] = [-2, max(10.0, 1.1 * 100 * float(np.nanmax(share)))]
    return {"title": "Refused observations of known landmarks", "note": note, "data": traces, "layout": layout}


def learned_noise(health: Health) -> Any:
    """Factors on the stated standard deviations that explain the innovations, with two of their own standard deviations."""
    bands: list[Any] = []
    lines: list[Any] = []
    notes: list[str] = []
    top = 2.0
    for name, label, colour, fill in (("motion_scale", "motion", BLUE, PALE_BLUE),
                                      ("sensor_scale", "sensors", ORANGE, PALE_ORANGE)):
        scale, sigma = health.column(name), health.column(name + "_sigma")
        if scale is None:
            continue
        top = max(top, 1.3 * float(np.nanmax(scale)))
        known = np.isfinite(scale) & (np.isfinite(sigma) if sigma is not None else True)
        last = np.flatnonzero(np.isfinite(scale))[-1]
        notes.append(f"{label} at the end {scale[last]:.3g}")
        if sigma is not None and known.any():
            at = np.flatnonzero(known)[thin.evenly(int(known.sum()), MOST)]
            bands.append(band(health.times[at], np.maximum(scale[at] - 2 * sigma[at], 0), scale[at] + 2 * sigma[at], fill,
                              f"{label}: 2 σ"))
            if np.isfinite(sigma[last]):
                notes[-1] += f" ± {sigma[last]:.2g}"
        lines.append(_curve(health, name, colour, label, line={"color": colour, "width": 1.6,
                                                               "dash": "solid" if label == "motion" else "dash"}))
    if not lines:
        return None
    layout = base_layout(280, "factor", **LEGEND)
    layout["yaxis"]["range"] = [0, top]  # at the start the bands are wide
    layout["shapes"] = [_level(1)]
    return {"title": "Learned noise", "note": "factor on the stated standard deviation, 1 as stated; " + "; ".join(notes),
            "data": bands + lines, "layout": layout}


def _level(height: int) -> dict[str, Any]:
    return {"type": "line", "xref": "paper", "x0": 0, "x1": 1, "y0": height, "y1": height, "layer": "below",
            "line": {"color": "#9a968c", "width": 1, "dash": "dot"}}


def recent_innovations(health: Health) -> Any:
    """NIS of a window for each row, with its band."""
    value, low, high = (health.column(name) for name in ("nis_per_row", "nis_lower", "nis_upper"))
    if value is None or low is None or high is None:
        return None
    known = np.isfinite(value) & np.isfinite(low) & np.isfinite(high)
    if not known.any():
        return None
    at = np.flatnonzero(known)[thin.evenly(int(known.sum()), MOST)]
    inside = np.count_nonzero(known & (value >= low) & (value <= high)) / np.count_nonzero(known)
    return {"title": "Recent innovations (NIS for each row)", "note": f"{100 * inside:.1f} % of the steps in the band; 1 is "
            "expected", "data": [band(health.times[at], low[at], high[at], PALE_BLUE, "band"),
                                 _curve(health, "nis_per_row", BLUE, "NIS")], "layout": base_layout(280, "NIS / rows")}


def contradictions(health: Health) -> Any:
    """Bias and jump of the pose in their own standard deviations."""
    traces = [_curve(health, name, colour, label, line={"color": colour, "width": 1.4, "dash": dash})
              for name, label, colour, dash in (("bias_sigmas", "bias of the corrections", BLUE, "solid"),
                                                ("jump_sigmas", "jump of the pose", ORANGE, "dash"))
              if health.column(name) is not None]
    if not traces:
        return None
    layout = base_layout(280, "standard deviations", **LEGEND)
    layout["yaxis"]["rangemode"] = "tozero"
    return {"title": "Bias and jump of the pose", "note": "in standard deviations of the value itself", "data": traces,
            "layout": layout}


def persistence(health: Health) -> Any:
    values = health.column("persistence")
    if values is None:
        return None
    layout = base_layout(280, "correlation")
    layout["yaxis"]["range"] = [-1.05, 1.05]
    layout["shapes"] = [_level(0)]
    return {"title": "Persistence", "note": "correlation of a landmark's innovations, one sighting and the next; 0: independent errors",
            "data": [_curve(health, "persistence", BLUE, "correlation")], "layout": layout}


def of_health(health: Health) -> list[Any]:
    """The figures besides the verdict."""
    made = [refusals(health), learned_noise(health), recent_innovations(health), contradictions(health), persistence(health)]
    return [figure for figure in made if figure]


def systematic(states: list[Any]) -> list[Any]:
    """Each estimated systematic error in its 3-sigma band."""
    figures: list[Any] = []
    for name, unit, times, value, sigma in states[:MOST_STATES]:
        at = thin.evenly(len(times), MOST)
        data = [band(times[at], value[at] - 3 * sigma[at], value[at] + 3 * sigma[at], PALE_BLUE, "3 σ")]
        at = thin.envelope(value, MOST)
        data.append(line(times[at], value[at], BLUE, name))
        layout = base_layout(230, unit or "(no unit)")
        layout["shapes"] = [_level(0)]
        figures.append({"title": name, "note": f"at the end {value[-1]:.3g} ± {3 * sigma[-1]:.2g} {unit} (3 σ)".rstrip(),
                        "data": data, "layout": layout})
    return figures
