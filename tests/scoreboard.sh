#!/usr/bin/env bash
# Runs every recording in CAIRN_DATA_DIR through the program cairn, with one setting for each kind of vehicle, and
# prints one table in Markdown: errors, consistency, refused observations, verdict and time, beside odometry alone.
# Recordings may be named; without names all are run.
#
#   CAIRN_DATA_DIR=DIR bash tests/scoreboard.sh [--with-gtsam] [RECORDING ...] > docs/scoreboard.md
#
# --with-gtsam also runs iSAM2 and a batch. GTSAM is installed by pip into a virtual environment, build/gtsam.
# CAIRN_PROGRAM is the program; without it the script builds one into build/bench. Progress goes to stderr.
set -euo pipefail
# shellcheck source=support/setup.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/support/setup.sh"

options=()
with_gtsam=false
recordings=()
while (($# > 0)); do
  case $1 in
    --with-gtsam) with_gtsam=true && options+=(--with-gtsam) && shift ;;
    -h | --help) sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}" && exit 0 ;;
    -*) fail "unknown option $1" ;;
    *) recordings+=("$1") && shift ;;
  esac
done
[[ -n ${CAIRN_DATA_DIR:-} ]] || fail "set CAIRN_DATA_DIR to the folder of the recordings"
[[ -d $CAIRN_DATA_DIR ]] || fail "CAIRN_DATA_DIR: there is no folder $CAIRN_DATA_DIR"

program=${CAIRN_PROGRAM:-}
if [[ -z $program ]]; then bench_program; fi

python=/usr/bin/python3
if $with_gtsam; then
  python=$root/build/gtsam/bin/python
  if ! "$python" -c 'import gtsam, scipy' 2>/dev/null; then
    say "GTSAM (build/gtsam)" >&2
    /usr/bin/python3 -m venv "$root/build/gtsam" >&2 ||
      fail "python3 makes no virtual environment (Debian: python3-venv)"
    "$root/build/gtsam/bin/pip" install --quiet gtsam scipy numpy >&2
  fi
fi
exec "$python" -B "$root/tests/scoreboard/scoreboard.py" --program "$program" --data "$CAIRN_DATA_DIR" "${options[@]}" \
  "${recordings[@]}"
