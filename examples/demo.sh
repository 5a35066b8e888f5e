#!/usr/bin/env bash
# Builds Cairn and runs it: a rover's log of two laps over rolling ground in, its trajectory and its map out.
# Installs the Debian packages that are missing. Where CAIRN_DATA_DIR holds starry_night.mat, that is run too.
set -euo pipefail
# shellcheck source=../tests/support/setup.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../tests/support/setup.sh"

need_packages cmake=cmake g++=g++ ninja-build=ninja pkgconf=pkg-config libeigen3-dev libmatio-dev

build=$root/build/demo
say "Building the library and the program in build/demo (a minute or two the first time)"
configure "$build" -DCMAKE_BUILD_TYPE=Release -DCAIRN_BUILD_TESTS=OFF --log-level=WARNING
cmake --build "$build" --parallel "$jobs" --target cairn cairn_program example_make_demo_log
if grep -q '^CAIRN_HWCAPS:BOOL=ON$' "$build/CMakeCache.txt"; then
  cmake --build "$build" --parallel "$jobs" --target cairn_v3
fi

# value FILE KEY: a number of a summary, "-" where it has none.
value() {
  local number
  number=$(sed -n "s/.*\"$2\": *\([-+.0-9eE]*\).*/\1/p" "$1" | head -n 1)
  echo "${number:--}"
}

# run_and_tell LOG FOLDER WHAT: runs the program on a log and says in a few lines what came out.
run_and_tell() {
  local log=$1 out=$2 what=$3
  mkdir -p "$out"
  say "Running: cairn run ${log#"$root"/} --output ${out#"$root"/} --summary json"
  "$build/bin/cairn" run "$log" --output "$out" --summary json >"$out/summary.json"
  local s=$out/summary.json
  cat <<END

$what
  read               $(value "$s" steps) steps, $(value "$s" observations) observations of $(value "$s" landmarks) landmarks; rejected $(value "$s" rejected)
  pose, online       $(value "$s" pose_rmse_m) m root mean square error, $(value "$s" pose_final_m) m at the end
  attitude, online   $(value "$s" attitude_rmse_deg) degrees root mean square error
  map, at the end    $(value "$s" landmark_rmse_m) m root mean square error
  consistency        $(value "$s" pose_anees_per_dof) squared pose error over its own variance, per degree of freedom (1 is right)
  time a step        $(value "$s" step_ms_mean) ms on average, $(value "$s" step_ms_worst) ms at worst
  files              ${out#"$root"/}: $(cd -- "$out" && echo *)
END
}

say "Writing the log of a drive: build/demo/two_laps.log"
"$build/examples/make_demo_log" >"$build/two_laps.log"
run_and_tell "$build/two_laps.log" "$build/out" "Two laps of a rover over rolling ground, among boulders:"

if [[ -f ${CAIRN_DATA_DIR:-}/starry_night.mat ]]; then
  run_and_tell "$CAIRN_DATA_DIR/starry_night.mat" "$build/out/starry_night" \
    "Starry Night: a stereo head carried over 20 landmarks, measured by motion capture:"
fi
