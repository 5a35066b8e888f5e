#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Compares the speed of two builds in turns, and prints the ratio new / old of each figure.

  compare_builds.py OLD NEW [--rounds N] [--landmarks N] [--association PROGRAM]

OLD and NEW are build folders with bin/cairn and lib/. In each round both builds run once, in an order that changes from
round to round. A ratio is taken within one round; the table shows the median over the rounds (default 9) and the
smallest and largest ratio. --association names the program `association` of a benchmark build, which then runs with the
libraries of either folder.
"""
import argparse
import csv
import json
import os
import pathlib
import statistics
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent


def run(build, words):
    """The standard output of a command, run with the libraries of a build folder."""
    environment = dict(os.environ, LD_LIBRARY_PATH=str(build / "lib"))
    return subprocess.run(words, env=environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=True, text=True).stdout


def second_half(build, log, options):
    """Mean step of the second half of a log, ms."""
    out = run(build, [str(build / "bin/cairn"), "run", str(log), "--summary", "json", "--quiet", *options])
    return json.loads(out)["step_ms_second_half"]


def closings(build, work, landmarks):
    """Time of all closings of a traverse, ms."""
    folder = work / "traverse"
    run(build, [str(build / "bin/cairn"), "simulate", "mars", "--course", "traverse", "--join", "sparse", "--landmarks",
                str(landmarks), "--output", str(folder), "--quiet"])
    with open(folder / "submaps.csv", newline="") as file:
        return 1e3 * sum(float(row["seconds"]) for row in csv.DictReader(file))


def association(build, program):
    """Median association of a frame of 20 against 1,000 landmarks, ms."""
    return json.loads(run(build, [str(program)]))["association_ms"]["median"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("old", type=pathlib.Path)
    parser.add_argument("new", type=pathlib.Path)
    parser.add_argument("--rounds", type=int, default=9)
    parser.add_argument("--landmarks", type=int, default=10000, help="of the traverse; 0: without it")
    parser.add_argument("--association", type=pathlib.Path)
    a = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        log = work / "log.txt"
        with open(log, "w") as out:
            subprocess.run([sys.executable, HERE / "make_log.py", "354", "400", "1"], stdout=out, check=True)
        figures = {
            "second-half step, 354 landmarks, single map": lambda b: second_half(b, log, ["--single-map"]),
            "second-half step, 354 landmarks, submaps of 60": lambda b: second_half(
                b, log, ["--join", "sparse", "--submap-landmarks", "60"]),
        }
        if a.landmarks:
            figures[f"closings of a traverse, {a.landmarks} landmarks"] = lambda b: closings(b, work, a.landmarks)
        if a.association:
            figures["joint association, 20 against 1,000"] = lambda b: association(b, a.association.resolve())
        builds = {"old": a.old.resolve(), "new": a.new.resolve()}
        print(f"{'figure':48} {'old ms':>9} {'new ms':>9} {'ratio':>7} {'least':>7} {'most':>7}")
        for name, figure in figures.items():
            values = {"old": [], "new": []}
            for round_number in range(a.rounds):
                order = ("old", "new") if round_number % 2 == 0 else ("new", "old")
                for which in order:
                    values[which].append(figure(builds[which]))
            ratios = [new / old for new, old in zip(values["new"], values["old"])]
            print(f"{name:48} {statistics.median(values['old']):9.3f} {statistics.median(values['new']):9.3f} "
                  f"{statistics.median(ratios):7.3f} {min(ratios):7.3f} {max(ratios):7.3f}", flush=True)


if __name__ == "__main__":
    main()
