#!/usr/bin/env bash
# The whole check, as CI runs it: builds everything, runs all tests, runs them again under sanitizers, builds the
# documentation, looks at the scripts. Installs the Debian packages that are missing. Ends at the first failure.
set -euo pipefail
# shellcheck source=support/setup.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/support/setup.sh"

steps=()
step=""
step_start=0
finish_step() {
  if [[ -n $step ]]; then steps+=("$(printf '%4d s  %s' $((SECONDS - step_start)) "$step")"); fi
}
begin() {
  finish_step
  step=$1
  step_start=$SECONDS
  say "$step"
}
all_done=false
sanitized=""  # process of the sanitized build
summary() {
  if [[ -n $sanitized ]]; then kill -- "-$sanitized" 2>/dev/null || true; fi
  finish_step
  say "Summary"
  printf '%s\n' "${steps[@]}"
  if $all_done; then
    echo "All checks passed in $SECONDS s."
  else  # by a failure or by a signal, which leaves no status to go by
    echo "FAILED: $step"
  fi
}
trap summary EXIT

begin "Packages"
need_packages cmake=cmake g++=g++ ninja-build=ninja pkgconf=pkg-config libeigen3-dev libnanoflann-dev libmatio-dev \
  libcmocka-dev doctest-dev nlohmann-json3-dev python3 python3-cffi python3-numpy python3-clang-14 \
  doxygen=doxygen doxygen-awesome-css shellcheck=shellcheck binutils=nm groff-base=groff mosquitto libmosquitto-dev
launcher=()
if command -v ccache >/dev/null; then
  launcher=(-DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
fi

begin "Scripts: shellcheck"
find "$root" -name build -prune -o -name .git -prune -o \( -name '*.sh' -o -path '*/.ci/run' \) -type f -print0 |
  xargs -0 shellcheck -x --source-path=SCRIPTDIR
echo "no complaint"

begin "Build: Release, warnings are errors (build/check)"
configure "$root/build/check" --preset developer "${launcher[@]}"
cmake --build "$root/build/check" --parallel "$jobs"

begin "Tests"
ctest --test-dir "$root/build/check" --output-on-failure -j "$jobs"

# The sanitized build needs the processors while the next steps mostly wait for one of them.
mkdir -p "$root/build"
sanitized_log=$root/build/sanitize.log
build_sanitized() {
  configure "$root/build/sanitize" --preset sanitize "${launcher[@]}" -DCAIRN_SANITIZE_ACCESSES=OFF \
    -DCAIRN_UNIT_ARCHIVE="$root/build/check/tests/unit/libcairn_unit_archive.a"
  nice -n 10 cmake --build "$root/build/sanitize" --parallel "$jobs"
}
set -m # in a process group of its own, so that a failure of the check ends it
build_sanitized >"$sanitized_log" 2>&1 &
sanitized=$!
set +m

begin "Python: the package installed, its documentation's commands, the report in a browser"
bash "$root/tests/python/check_python.sh" "$root/build/check"

for binding in cpp python rust go node java octave; do
  begin "Bindings: $binding"
  bash "$root/bindings/$binding/test.sh" "$root/build/check"
done

begin "Other tools read trajectories, maps and a mission"
bash "$root/tests/program/check_other_tools.sh" "$root/build/check"

begin "Documentation: warnings and broken links are errors"
cmake --build "$root/build/check" --target docs
/usr/bin/python3 -B "$root/tests/docs/links_test.py" "$root/build/check/docs/html"

begin "Build: sanitizers (build/sanitize), what is left of it"
wait "$sanitized" || {
  cat "$sanitized_log"
  fail "the sanitized build"
}
sanitized=""
tail -n 1 "$sanitized_log"

begin "Tests under sanitizers"
ctest --test-dir "$root/build/sanitize" --output-on-failure -j "$jobs"

begin "Packages: made of the build, installed, used, removed; the source tarball"
bash "$root/tests/install/check_packages.sh" "$root/build/check"
all_done=true
