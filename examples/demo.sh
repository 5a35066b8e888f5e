#!/usr/bin/env bash
# Builds Cairn and simulates a rover on Mars. Standard EKF-SLAM and submaps run through the same world. The script
# prints the Mars paper's Table 2 beside the measured figures and makes a page for a browser. Then it runs two recorded
# logs, the second one if CAIRN_DATA_DIR holds starry_night.mat. It installs missing Debian packages. The Python
# packages for the page come from the Python package index and are installed into build/demo/venv.
set -euo pipefail
# shellcheck source=../tests/support/setup.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../tests/support/setup.sh"

# Only starry_night.mat needs libmatio, which needs HDF5.
recording=${CAIRN_DATA_DIR:-}/starry_night.mat
packages=("cmake=cmake" "g++=g++" "ninja-build=ninja" libeigen3-dev libnanoflann-dev python3 python3-venv)
matio=OFF
if [[ -f $recording ]]; then
  packages+=("pkgconf=pkg-config" libmatio-dev)
  matio=ON
fi
need_packages "${packages[@]}"

# One build of the library, which runs on every processor: an installation has a second one.
build=$root/build/demo
say "Building the library, the program and an example in build/demo (some minutes the first time)"
configure "$build" -DCMAKE_BUILD_TYPE=Release -DCAIRN_HWCAPS=OFF -DCAIRN_MATIO=$matio -DCAIRN_BUILD_TESTS=OFF \
  -DCAIRN_BUILD_EXAMPLES=ON --log-level=WARNING
cmake --build "$build" --parallel "$jobs" --target cairn_program example_make_demo_log

# show COMMAND WORD...: prints a command as it could be typed in the project's folder, then runs it.
show() {
  say "${*//"$root/"/}"
  "$@"
}

mars=$build/mars
rm -rf -- "$mars" # pages and files of another build would only mislead
show "$build/bin/cairn" simulate mars --compare --output "$mars" --quiet
cat <<END

The paper's noise hardly asks for a filter. The same rover with an odometry a hundred times worse, two rounds,
mean of ten worlds:
END
show "$build/bin/cairn" simulate mars --preset row4 --compare --runs 10 --quiet

# value KEY [DECIMALS]: a number of the summary, "-" if it has none.
value() {
  local number LC_ALL=C
  number=$(sed -n "s/.*\"$1\": *\([-+.0-9eE]*\).*/\1/p" "$summary" | head -n 1)
  if [[ -n $number ]]; then printf '%.*f' "${2:-0}" "$number"; else printf -- '-'; fi
}

# run_and_tell LOG FOLDER WHAT: runs the program on a log and prints the result in a few lines.
run_and_tell() {
  local log=$1 out=$2 what=$3 summary=$2/summary.json
  say "build/demo/bin/cairn run ${log#"$root/"} --output ${out#"$root/"}"
  "$build/bin/cairn" run "$log" --output "$out" --quiet >"$build/run.txt"
  cat <<END

$what
  read         $(value steps) steps, $(value observations) observations of $(value landmarks) landmarks; $(value rejected) rejected
  pose         $(value pose_rmse_m 2) m and $(value attitude_rmse_deg 2) degrees off (root mean square, online), $(value pose_end_m 2) m at the end
  map          $(value landmark_rmse_m 2) m off (root mean square, at the end); $(value submaps) submaps
  consistency  $(value pose_anees_per_dof 2): squared error of the pose over its variance, 1 where the filter is right about itself
  time         $(value step_ms_mean 2) ms a step on average, $(value step_ms_worst 2) ms at worst
END
}

"$build/examples/make_demo_log" >"$build/two_laps.log"
run_and_tell "$build/two_laps.log" "$build/two_laps" "A recorded log, as your own might be: two laps of a rover among boulders."
if [[ -f $recording ]]; then
  run_and_tell "$recording" "$build/starry_night" \
    "Starry Night: a stereo head carried over 20 landmarks, measured by motion capture."
fi

python=$build/venv/bin/python3
if ! "$python" -c 'import plotly, numpy, matplotlib' 2>/dev/null; then
  say "Fetching plotly, numpy and matplotlib from the Python package index, into build/demo/venv"
  rm -rf -- "$build/venv"
  /usr/bin/python3 -m venv "$build/venv" || fail "no virtual environment in build/demo/venv: see above"
  "$python" -m pip install --quiet --disable-pip-version-check --retries 2 \
    --constraint "$root/tests/python/constraints.txt" plotly numpy matplotlib </dev/null ||
    fail "the page takes plotly, numpy and matplotlib, and pip could not fetch them (no network?): see above. All else is
done: build/demo/mars holds the results as CSV files, and with these packages from elsewhere
'python3 -m cairn.report build/demo/mars' makes the page"
fi
say "PYTHONPATH=bindings/python build/demo/venv/bin/python3 -m cairn.report build/demo/mars"
PYTHONPATH=$root/bindings/python PYTHONDONTWRITEBYTECODE=1 "$python" -m cairn.report "$mars"
printf '\nOpen it in a browser: file://%s\n' "$mars/report.html"
