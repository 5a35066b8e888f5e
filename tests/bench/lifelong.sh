#!/usr/bin/env bash
# A vehicle that runs for a long time in a known place: laps, standing still with and without closings, a drive through
# one square kilometre. Prints one row of a table a world: nothing but the number of submaps may grow with the steps.
#
#   tests/bench/lifelong.sh [--steps N] [--year] [--program LIFELONG]
#
# N is 1,000,000 by default. --year drives through the square kilometre for a simulated year, in steps of ten seconds.
# Without --program the script builds into build/bench first.
set -euo pipefail
# shellcheck source=../support/setup.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../support/setup.sh"

steps=1000000
year=false
lifelong=""
while (($# > 0)); do
  case $1 in
    --steps) steps=${2:?} && shift 2 ;;
    --year) year=true && shift ;;
    --program) lifelong=${2:?} && shift 2 ;;
    -h | --help) sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}" && exit 0 ;;
    *) fail "unknown option $1" ;;
  esac
done
if [[ -z $lifelong ]]; then
  bench_program
  cmake --build "$root/build/bench" --parallel "$jobs" --target lifelong >&2
  lifelong=$root/build/bench/bench/lifelong
fi
need_packages python3 >&2

in_square=$steps
if $year; then in_square=3153600; fi
{
  "$lifelong" laps "$steps" sparse
  "$lifelong" laps "$((steps / 5))" sparse
  "$lifelong" laps "$((steps / 5))" dense
  "$lifelong" stand "$steps" sparse
  "$lifelong" stand_open "$steps" sparse
  "$lifelong" square "$in_square" sparse
} | python3 -c '
import json, sys

columns = [("world", "world"), ("join", "joining"), ("steps", "steps"), ("submaps", "submaps"),
           ("closing_ms_100_to_200", "closings 100-200, ms"), ("closing_ms_last_100", "last 100, ms"),
           ("step_ms_mean", "step, ms"), ("step_ms_p9999", "99.99 %, ms"), ("step_ms_worst", "worst, ms"),
           ("rss_mib_tenth", "MiB at a tenth"), ("rss_mib", "MiB"), ("pose_rmse_m", "pose, m"),
           ("pose_nees_per_dof", "NEES/6"), ("landmark_rmse_m", "map, m")]
print("| " + " | ".join(title for _, title in columns) + " |")
print("|" + "---|" * len(columns))
for line in sys.stdin:
    row = json.loads(line)
    print("| " + " | ".join(str(row[key]) for key, _ in columns) + " |", flush=True)'
