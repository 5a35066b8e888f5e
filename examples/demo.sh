#!/usr/bin/env bash
# Builds Cairn and runs it: a rover's log of two laps over rolling ground in, its trajectory and its map out.
# Installs the Debian packages that are missing. Where CAIRN_DATA_DIR holds starry_night.mat, that is run too.
set -euo pipefail
# shellcheck source=../tests/support/setup.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../tests/support/setup.sh"

need_packages cmake=cmake g++=g++ ninja-build=ninja pkgconf=pkg-config libeigen3-dev libnanoflann-dev libmatio-dev

build=$root/build/demo
say "Building the library, the program and the examples in build/demo (a few minutes the first time)"
configure "$build" -DCMAKE_BUILD_TYPE=Release -DCAIRN_BUILD_TESTS=OFF --log-level=WARNING
cmake --build "$build" --parallel "$jobs"

# value KEY [DECIMALS]: a number of the summary, "-" where it has none.
value() {
  local number LC_ALL=C
  number=$(sed -n "s/.*\"$1\": *\([-+.0-9eE]*\).*/\1/p" "$summary" | head -n 1)
  if [[ -n $number ]]; then printf '%.*f' "${2:-0}" "$number"; else printf -- '-'; fi
}

# run_and_tell LOG FOLDER WHAT: runs the program on a log and says in a few lines what came out.
run_and_tell() {
  local log=$1 out=$2 what=$3
  local summary=$out/summary.json
  mkdir -p "$out"
  say "Running: cairn run ${log#"$root"/} --output ${out#"$root"/} --summary json"
  "$build/bin/cairn" run "$log" --output "$out" --summary json >"$summary"
  cat <<END

$what
  read         $(value steps) steps, $(value observations) observations of $(value landmarks) landmarks; $(value rejected) rejected
  pose         $(value pose_rmse_m 2) m and $(value attitude_rmse_deg 2) degrees off (root mean square, online), $(value pose_final_m 2) m at the end
  map          $(value landmark_rmse_m 2) m off (root mean square, at the end)
  consistency  $(value pose_anees_per_dof 2): squared error of the pose over its variance, 1 where the filter is right about itself
  time         $(value step_ms_mean 2) ms a step on average, $(value step_ms_worst 2) ms at worst
  files        ${out#"$root"/}/: $(cd -- "$out" && echo *.csv summary.json)
END
}

say "Writing the log of a drive: build/demo/two_laps.log"
"$build/examples/make_demo_log" >"$build/two_laps.log"
run_and_tell "$build/two_laps.log" "$build/out" "Two laps of a rover over rolling ground, among boulders:"

if [[ -f ${CAIRN_DATA_DIR:-}/starry_night.mat ]]; then
  run_and_tell "$CAIRN_DATA_DIR/starry_night.mat" "$build/out/starry_night" \
    "Starry Night: a stereo head carried over 20 landmarks, measured by motion capture:"
fi
