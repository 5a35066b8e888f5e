# SPDX-License-Identifier: BSD-3-Clause
"""Prints the table of traverse.sh: traverse_table.py FOLDER SIZE...

FOLDER/<size>.json is the summary of a run, FOLDER/<size>.kib the largest memory of its process.
"""
import json
import math
import pathlib
import sys

COLUMNS = [("landmarks", "landmarks", "{:.0f}"), ("steps", "steps", "{:.0f}"), ("submaps", "submaps", "{:.0f}"),
           ("filter s", "filter_seconds", "{:.1f}"), ("ms/step", "step_ms_mean", "{:.3f}"),
           ("2nd half", "step_ms_second_half", "{:.3f}"), ("closing worst ms", "closing_ms_worst", "{:.0f}"),
           ("peak MiB", "peak", "{:.0f}"), ("pose end m", "pose_end_m", "{:.1f}"),
           ("map rms m", "landmark_rmse_m", "{:.1f}"), ("ANEES/6", "pose_anees_per_dof", "{:.2f}")]


def exponent(runs, key):
    """Slope of the least-squares line through the logarithms."""
    points = [(math.log(run["landmarks"]), math.log(run[key])) for run in runs]
    x_mean, y_mean = (sum(values) / len(points) for values in zip(*points))
    return (sum((x - x_mean) * (y - y_mean) for x, y in points)
            / sum((x - x_mean) ** 2 for x, _ in points))


def main():
    folder, runs = pathlib.Path(sys.argv[1]), []
    for size in sys.argv[2:]:
        run = json.loads((folder / f"{size}.json").read_text())
        run["peak"] = int((folder / f"{size}.kib").read_text().split()[-1]) / 1024
        runs.append(run)
    for row in [[head for head, _, _ in COLUMNS]] + [[form.format(run[key]) for _, key, form in COLUMNS] for run in runs]:
        print("".join(f"{field:>{len(head) + 3}}" for field, (head, _, _) in zip(row, COLUMNS)))
    if len({run["landmarks"] for run in runs}) > 1:
        for name, key in (("time of the filter", "filter_seconds"), ("memory", "peak")):
            print(f"{name} grows with the number of landmarks to the power {exponent(runs, key):.2f}")


main()
