#!/usr/bin/env bash
# Runs the program cairn over long traverses and prints how time, memory and error grow with the number of landmarks.
#
#   tests/bench/traverse.sh [--landmarks "N ..."] [--closed] [--program CAIRN] [-- OPTION...]
#
# The default is 10000, 30000 and 100000 landmarks with sparse joining. --closed makes the traverse return to its start.
# Options after -- are passed to 'cairn simulate mars'. Without --program the script builds into build/bench first. Time
# is the time in the filter (steps and closings, without the simulation). Memory is that of the whole process, from the
# kernel.
set -euo pipefail
# shellcheck source=../support/setup.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../support/setup.sh"

sizes=(10000 30000 100000)
program=""
options=(--course traverse --join sparse)
while (($# > 0)); do
  case $1 in
    --landmarks) read -r -a sizes <<<"${2:?}" && shift 2 ;;
    --closed) options+=(--closed) && shift ;;
    --program) program=${2:?} && shift 2 ;;
    -h | --help) sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}" && exit 0 ;;
    --) shift && options+=("$@") && break ;;
    *) fail "unknown option $1" ;;
  esac
done

need_packages time=/usr/bin/time python3 >&2
[[ -n $program ]] || bench_program

work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
done_ones=()
for size in "${sizes[@]}"; do
  say "cairn simulate mars ${options[*]} --landmarks $size" >&2
  if /usr/bin/time -f '%M' -o "$work/$size.kib" \
    "$program" simulate mars "${options[@]}" --landmarks "$size" --summary json >"$work/$size.json"; then
    done_ones+=("$size")
  fi
done
((${#done_ones[@]} > 0)) || fail "no run finished"
echo "$("$program" --version): cairn simulate mars ${options[*]}"
python3 "$root/tests/bench/traverse_table.py" "$work" "${done_ones[@]}"
((${#done_ones[@]} == ${#sizes[@]})) || fail "only ${#done_ones[@]} of ${#sizes[@]} runs finished: see above"
