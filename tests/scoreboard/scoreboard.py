#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs every recording of a folder through Cairn with one setting for each kind of vehicle, beside odometry alone and
the smoothers of GTSAM, and prints one table in Markdown. tests/scoreboard.sh calls it."""
import argparse
import os
import platform
import sys

import recordings
import runs
import settings

COLUMNS = ("recording", "steps", "odometry", "online", "corrected", "map", "ANEES", "refused", "verdict", "time",
           "iSAM2", "iSAM2 map", "batch", "batch map", "map to batch", "iSAM2 and batch time")

PREFACE = """# Scoreboard {{#scoreboard}}

{version}, {machine}. This command wrote the page:

```sh
bash tests/scoreboard.sh{option} > docs/scoreboard.md
```

Every recording of a kind is run with the same options of `cairn run`. Those of the cars are one of six sets that were
tried on these drives: two widths of the loss, three least disparities. Errors are root mean squares of positions in
metres against the truth, with nothing aligned. *odometry*: motions without observations.
*online*: each pose as it was estimated directly after its step. *corrected*: the same poses as they are known at the
end of the run ([trajectory](trajectory.md)). *map*: landmarks at the end, where their truth is known. *ANEES*: for each
degree of freedom, 1 for a consistent filter. *refused*: observations that the filter refused. *verdict*: that of the
filter at the end of the run. *time*: of all steps, in the library, by a clock that also counts what else the machine
did. For robots, errors and ANEES are means over the robots, the map is a mean over their maps, and the time is that of
all of them.

*iSAM2* and *batch* are those of GTSAM in the same run (`tests/scoreboard/smoothers.py`). The poses of iSAM2 are online
estimates; its map, and all of the batch, are those of the whole recording. Stereo observations have a Cauchy loss,
those of robots a Huber loss, planar logs none. The batch of the robots starts at Cairn's online poses, all others at
odometry or at iSAM2's poses. *map to batch*: between Cairn's landmarks and those of the batch.
"""


def number(value, form="{:.3g}"):
    return "" if value is None else form.format(value)


def row(name, kind, arguments):
    """One line of the table, and notes on what it lacks."""
    path, notes = os.path.join(arguments.data, name), []
    figures, beside, reckoned = {}, {}, None
    try:
        figures = runs.cairn(arguments.program, path, kind)
    except runs.Failure as failure:
        notes.append(f"{name}: {failure}")
    try:
        reckoned = runs.odometry_error(arguments.program, path, kind)
    except (runs.Failure, OSError, ValueError) as failure:
        notes.append(f"{name}: odometry alone: {failure}")
    if arguments.with_gtsam:
        try:
            beside = runs.smoothers(path, kind, figures)
        except (RuntimeError, ValueError, OSError) as error:
            notes.append(f"{name}: GTSAM: {str(error).strip().splitlines()[0]}")
        if "isam2_reason" in beside:
            notes.append(f"{name}: iSAM2: {beside['isam2_reason']}")
    refused = figures.get("rejected")
    if refused is not None and "observations" in figures:
        refused = f"{refused} of {figures['observations']}"
    spent = figures.get("filter_seconds")
    beside_map = runs.distance_to_batch(figures, beside.get("landmarks", {}))
    times = [number(beside.get(key), "{:.2g} s") for key in ("isam2_s", "batch_s")]
    cells = [name.removesuffix("_sync_KLT.mat"), number(figures.get("steps"), "{}"), number(reckoned),
             number(figures.get("pose_rmse_m")), number(figures.get("pose_rmse_corrected_m")),
             number(figures.get("landmark_rmse_m")), number(figures.get("pose_anees_per_dof")), number(refused, "{}"),
             str(figures.get("verdict", "")), number(spent, "{:.2g} s"), number(beside.get("isam2")),
             number(beside.get("isam2_map")), number(beside.get("batch")), number(beside.get("batch_map")),
             number(beside_map), ", ".join(time for time in times if time)]
    return cells, notes


def line(cells):
    return "| " + " | ".join(cells) + " |"


def say(text):
    print(text, file=sys.stderr, flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True, help="the program cairn")
    parser.add_argument("--data", required=True, help="the folder of the recordings")
    parser.add_argument("--with-gtsam", action="store_true", help="beside iSAM2 and a batch of GTSAM")
    parser.add_argument("recordings", nargs="*", help="run only these; default: all")
    arguments = parser.parse_args()
    known = [name for kind in settings.KINDS for name in kind.recordings]
    for name in arguments.recordings:
        if name not in known:
            sys.exit(f"scoreboard: there is no recording '{name}'; it runs {', '.join(known)}")
    try:
        version = runs.program(arguments.program, "--version").strip()
    except (OSError, runs.Failure) as error:
        sys.exit(f"scoreboard: {arguments.program}: {error}")

    tables, notes, hashes = [], [], []
    for kind in settings.KINDS:
        for name in kind.recordings:
            if arguments.recordings and name not in arguments.recordings:
                continue
            path = os.path.join(arguments.data, name)
            if not os.path.exists(path):
                notes.append(f"{name}: skipped, it is not in the folder of the recordings")
                continue
            say(f"{name} ...")
            hashes.append((name, recordings.sha256(path)))
            cells, lacking = row(name, kind, arguments)
            say(line(cells))
            tables.append(cells)
            notes += lacking
    if not arguments.with_gtsam:
        notes.append("iSAM2 and batch were not run: --with-gtsam was not given")

    option = "".join(" " + word for word in (["--with-gtsam"] if arguments.with_gtsam else []) + arguments.recordings)
    print(PREFACE.format(option=option, version=version, machine=f"{platform.machine()}, {os.cpu_count()} processors"))
    print(line(COLUMNS))
    print(line(["---"] * len(COLUMNS)))
    for cells in tables:
        print(line(cells))
    print("\n## Settings\n")
    for kind in settings.KINDS:
        print(f"- {kind.name}: `{' '.join(['cairn run RECORDING', *kind.options])}`")
    if notes:
        print("\n## What is missing\n")
        for note in notes:
            print(f"- {note}")
    print("\n## Recordings\n\nSHA-256 of a file; of a folder, that of the lines \"name hash\" of its files.\n\n```")
    for name, digest in hashes:
        print(f"{digest}  {name}")
    print("```")


if __name__ == "__main__":
    main()
