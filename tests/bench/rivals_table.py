# SPDX-License-Identifier: BSD-3-Clause
"""Prints the table of rivals.sh: rivals_table.py FOLDER LOGS.

FOLDER/<log>.ours and FOLDER/<log>.mrpt hold one JSON object for each round.
"""
import json
import pathlib
import statistics
import sys


def rounds(path):
    return [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []


def median(values):
    return statistics.median(values) if values else None


def cell(value, digits=3):
    return "-" if value is None else f"{value:.{digits}f}"


def row(folder, log):
    ours, rival = rounds(folder / f"{log}.ours"), rounds(folder / f"{log}.mrpt")

    def ours_of(key, kind="median"):
        return [one[key][kind] for one in ours]

    step = ours_of("step_ms_second_half")
    return [str(ours[0]["landmarks"]), str(ours[0]["n"]), cell(median([one["m"] for one in ours]), 1),
            cell(median(step)), cell(median(ours_of("dsyrk_ms"))), cell(median(ours_of("ratio")), 2),
            cell(median(ours_of("ratio", "mean")), 2), cell(median([one["step_ms_median"] for one in rival]), 1),
            cell(median([r["step_ms_median"] / mine for r, mine in zip(rival, step)]), 0),
            str(max(one["heap_allocations"] for one in ours))]


def main():
    folder, logs = pathlib.Path(sys.argv[1]), int(sys.argv[2])
    first = rounds(folder / "0.ours")[0]
    rival = rounds(folder / "0.mrpt")
    print(f"{first['program']} built for {first['build']}; OpenBLAS kernels for {first['blas_core']}"
          + (f"; {rival[0]['program']}" if rival else ""))
    print("Steps of the second half, milliseconds of processor time; medians over the rounds.")
    head = ["landmarks", "n", "m", "step", "dsyrk", "step/dsyrk", "of means", "MRPT", "MRPT/step", "allocations"]
    for line in [head] + [row(folder, log) for log in range(logs)]:
        print("".join(f"{field:>{max(10, len(name) + 2)}}" for field, name in zip(line, head)))


main()
