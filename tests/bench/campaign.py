# SPDX-License-Identifier: BSD-3-Clause
"""Prints the table of neutral_campaign.sh: campaign.py FOLDER..., one for each kind of run.

Each folder holds one folder for each run, with the summary.json and trajectory.csv of the program.
"""
import csv
import json
import math
import pathlib
import statistics
import sys

POSE_DIMENSION = 6
KEYS = ("landmark_rmse_m", "pose_rmse_m", "pose_anees_per_dof", "nis_per_dof")


def chi_square_quantile(probability, dof):
    """Wilson and Hilferty's approximation: better than 0.1 % at the dozens of degrees of freedom of a campaign."""
    z = statistics.NormalDist().inv_cdf(probability)
    return dof * (1.0 - 2.0 / (9.0 * dof) + z * math.sqrt(2.0 / (9.0 * dof))) ** 3


def read_nees(path):
    """NEES by step. Steps without a NEES are left out: the first pose is known exactly."""
    with path.open(newline="") as file:
        values = {int(row["step"]): row["nees"] for row in csv.DictReader(file)}
    return {step: float(text) for step, text in values.items() if text}


def share_in_band(runs):
    """Share of the common steps of all runs at which the sum of the NEES lies in its two-sided 95 % band."""
    steps = set.intersection(*(set(run) for run in runs))
    if not steps:
        return None
    dof = POSE_DIMENSION * len(runs)
    low, high = chi_square_quantile(0.025, dof), chi_square_quantile(0.975, dof)
    inside = sum(low <= sum(run[step] for run in runs) <= high for step in steps)
    return inside / len(steps)


def main():
    print(f"{'error':>10}{'runs':>6}" + "".join(f"{key:>20}" for key in KEYS) + f"{'steps in 95 % band':>20}")
    for folder in map(pathlib.Path, sys.argv[1:]):
        runs = [run for run in sorted(folder.iterdir()) if run.is_dir()]
        summaries = [json.loads((run / "summary.json").read_text()) for run in runs]
        line = f"{folder.name:>10}{len(runs):>6}"
        for key in KEYS:
            values = [summary[key] for summary in summaries if key in summary]
            line += f"{statistics.fmean(values):>20.4f}" if values else f"{'-':>20}"
        share = share_in_band([read_nees(run / "trajectory.csv") for run in runs])
        print(line + (f"{'-':>20}" if share is None else f"{100.0 * share:>18.1f} %"))


main()
