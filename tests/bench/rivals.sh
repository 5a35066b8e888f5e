#!/usr/bin/env bash
# Runs the library, one BLAS dsyrk of the same size and, if it is installed, MRPT's EKF-SLAM alternately over the same
# logs. Prints a table of medians and of ratios from the same round. Builds into build/bench first.
#
#   tests/bench/rivals.sh [--rounds R] [--mrpt-samples K] [--landmarks "N ..."] [LOG ...]
#
# Without a log the script makes its own logs, one for each number of landmarks. --mrpt-samples ends the run of MRPT
# after K steps of the second half (0: never). Without it MRPT takes minutes.
set -euo pipefail
# shellcheck source=../support/setup.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../support/setup.sh"

rounds=3
mrpt_samples=10
sizes=(60 100 200 354)
logs=()
while (($# > 0)); do
  case $1 in
    --rounds) rounds=${2:?} && shift 2 ;;
    --mrpt-samples) mrpt_samples=${2:?} && shift 2 ;;
    --landmarks) read -r -a sizes <<<"${2:?}" && shift 2 ;;
    -h | --help) sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}" && exit 0 ;;
    -*) fail "unknown option $1" ;;
    *) logs+=("$1") && shift ;;
  esac
done

say "Build (build/bench)" >&2
{
  need_packages cmake=cmake g++=g++ ninja-build=ninja pkgconf=pkg-config libeigen3-dev libnanoflann-dev libmatio-dev \
    libbenchmark-dev libopenblas-dev
  configure "$root/build/bench" --preset bench
  cmake --build "$root/build/bench" --parallel "$jobs"
} >&2
programs=$root/build/bench/bench
rival=$programs/mrpt_rival
[[ -x $rival ]] || say "MRPT is not here (Debian: libmrpt-dev): its columns stay empty" >&2

work=$(mktemp -d)
trap 'rm -rf -- "$work"' EXIT
if ((${#logs[@]} == 0)); then
  for size in "${sizes[@]}"; do
    python3 "$root/tests/bench/make_log.py" "$size" 400 1 >"$work/$size landmarks.txt"
    logs+=("$work/$size landmarks.txt")
  done
fi

# OpenBLAS must pick its kernels for the processor, whatever the environment says.
blas=(env -u OPENBLAS_CORETYPE -u OPENBLAS_L2_SIZE OPENBLAS_NUM_THREADS=1)
mrpt_options=()
if ((mrpt_samples > 0)); then mrpt_options=(--second-half-samples "$mrpt_samples"); fi
for ((i = 0; i < ${#logs[@]}; ++i)); do
  for ((round = 1; round <= rounds; ++round)); do
    say "${logs[i]}: round $round of $rounds" >&2
    "${blas[@]}" "$programs/step_ratio" "${logs[i]}" >>"$work/$i.ours"
    if [[ -x $rival ]]; then "$rival" "${logs[i]}" "${mrpt_options[@]}" >>"$work/$i.mrpt"; fi
  done
done
python3 "$root/tests/bench/rivals_table.py" "$work" "${#logs[@]}"
