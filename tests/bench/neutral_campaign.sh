#!/usr/bin/env bash
# Accuracy and consistency over many logs: runs the program cairn on each with both error states. Prints the means, and
# the share of steps at which the NEES of the pose, averaged over the runs, lies in its 95 % band.
#
#   tests/bench/neutral_campaign.sh [--seeds M] [--landmarks N] [--steps S] [--program CAIRN] [LOGS|GENERATOR]
#
# LOGS is a folder of neutral logs (*.txt). GENERATOR is a program that writes a log to stdout. It is called as
# GENERATOR LANDMARKS STEPS SEED for seeds 1 to M; the default is make_log.py in the folder of this script. Without
# --program the script builds into build/bench first.
set -euo pipefail
# shellcheck source=../support/setup.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../support/setup.sh"

seeds=20
landmarks=100
steps=400
program=""
source=$root/tests/bench/make_log.py
while (($# > 0)); do
  case $1 in
    --seeds) seeds=${2:?} && shift 2 ;;
    --landmarks) landmarks=${2:?} && shift 2 ;;
    --steps) steps=${2:?} && shift 2 ;;
    --program) program=${2:?} && shift 2 ;;
    -h | --help) sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}" && exit 0 ;;
    -*) fail "unknown option $1" ;;
    *) source=$1 && shift ;;
  esac
done

[[ -n $program ]] || bench_program

work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
logs=()
if [[ -d $source ]]; then
  for log in "$source"/*.txt; do
    if [[ -f $log ]]; then logs+=("$log"); fi
  done
  ((${#logs[@]} > 0)) || fail "no *.txt in $source"
else
  [[ -f $source ]] || fail "$source is neither a folder nor a program"
  call=("$(realpath -- "$source")")
  if [[ $source == *.py ]]; then call=(python3 "$source"); fi
  for ((seed = 1; seed <= seeds; ++seed)); do
    "${call[@]}" "$landmarks" "$steps" "$seed" >"$work/$seed.txt"
    logs+=("$work/$seed.txt")
  done
fi

for error in invariant standard; do
  for ((i = 0; i < ${#logs[@]}; ++i)); do
    output=$work/$error/$i
    mkdir -p -- "$output"
    "$program" run "${logs[i]}" --single-map --error "$error" --quiet --summary json --output "$output" \
      >"$output/summary.json"
  done
done
python3 "$root/tests/bench/campaign.py" "$work/invariant" "$work/standard"
