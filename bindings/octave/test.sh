#!/usr/bin/env bash
# Tests the package for Octave as CI does: makes the tarball, installs it by "pkg install" into a fresh folder, and
# tests what was installed: its own tests, the conformance scenarios, leaks, time, the examples of the pages.
# test.sh [BUILD]. BUILD is a build tree of the library; what it lacks is built. All results stay in
# BUILD/octave-package.
set -euo pipefail
# shellcheck source=../../tests/support/setup.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../../tests/support/setup.sh"

(($# <= 1)) || fail "usage: test.sh [BUILD]"
need_packages cmake=cmake g++=g++ gcc=gcc make=make ninja-build=ninja libeigen3-dev libnanoflann-dev \
  nlohmann-json3-dev libcmocka-dev doctest-dev octave=octave-cli octave-dev=mkoctfile python3

built_library "$@"
here=$root/bindings/octave
work=$build/octave-package
rm -rf -- "$work"
mkdir -p "$work/home"
export PYTHONDONTWRITEBYTECODE=1 LD_LIBRARY_PATH=$build/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
export HOME=$work/home # Octave keeps its history and its list of packages there
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1
before=$(find "$here" | sort)

say "The generated files are those of the description"
python3 "$here/generate.py" --check

say "pkg install in a fresh folder, from the tarball"
tarball=$(bash "$here/make_package.sh" "$work")
cmp "$tarball" "$(bash "$here/make_package.sh" "$work/again")" || fail "two runs of make_package.sh give two tarballs"
export CAIRN_CFLAGS="-I$root/include -Wall -Wextra" CAIRN_LIBS="-L$build/lib -lcairn_sim -lcairn"
# octave CODE: runs code in an Octave that has only the installed package.
octave() {
  (cd -- "$work" && octave-cli --norc --no-history --quiet --no-window-system --eval "pkg('prefix', '$work/packages', '$work/packages');
pkg('local_list', '$work/packages.list');
$1")
}
octave "pkg install -verbose ${tarball##*/}" >"$work/install.log" 2>&1 || {
  cat "$work/install.log"
  fail "pkg install failed"
}
! grep -n '[ch]pp:.*warning:' "$work/install.log" || fail "the compiler warns"
octave "pkg load cairn
found = which('cairn_mex');
assert(strncmp(found, '$work/packages', $((${#work} + 9))), found)
printf('cairn %s\n', cairn.version())"

say "The tests of the package"
octave "pkg load cairn
[passed, all] = test('$here/tests/binding.tst', 'quiet', '$work/binding.log');
printf('%d of %d tests\n', passed, all);
exit(passed ~= all || all == 0)" || {
  grep -A 12 '!!!!!' "$work/binding.log"
  fail "tests of the package failed"
}

say "A library that is missing or older"
mkdir -p "$work/broken"
: >"$work/broken/$soname"
printf '%s\n' '#include <stdint.h>' 'uint32_t cairn_version_number(void) { return 100; }' \
  'const char *cairn_version(void) { return "0.1.0"; }' >"$work/older.c"
gcc -shared -fPIC -o "$work/older.so" "$work/older.c"
# message: what a user sees, and that it names both versions.
message="try, cairn.Filter(), catch problem, printf('%s: %s\n', problem.identifier, problem.message); end"
of_missing=$(LD_LIBRARY_PATH=$work/broken:$LD_LIBRARY_PATH octave "pkg load cairn; $message")
of_older=$(LD_PRELOAD=$work/older.so octave "pkg load cairn; $message")
printf '%s\n' "$of_missing" "$of_older"
[[ $of_missing == "cairn:LIBRARY: Cairn for Octave is version 0.2.0 and needs the libraries $soname "* ]] ||
  fail "the message about a missing library is another one"
[[ $of_older == "cairn:LIBRARY: Cairn for Octave is version 0.2.0, but the library "*"is version 0.1.0" ]] ||
  fail "the message about an older library is another one"

say "Conformance: the same bits as C"
mkdir -p "$work/conformance"
# Whether C agrees with the recorded values is for another test (ctest -R conformance); here its bits are wanted.
"$build/bin/cairn_conformance" "$root/tests/conformance" "$work/conformance_of_c" >"$work/replay.log" 2>&1 ||
  echo "the C replayer says: $(tail -n 1 "$work/replay.log")"
python3 "$here/tests/conformance.py" write "$root/tests/conformance" "$work/conformance"
octave "pkg load cairn; addpath('$here/tests'); replay('$work/conformance')"
octave "pkg load cairn; addpath('$here/tests'); constants()" >"$work/conformance/constants.out"
python3 "$here/tests/conformance.py" compare "$root/tests/conformance" "$work/conformance" "$work/conformance_of_c"

say "The examples of the pages"
for page in "$here/README.md" "$root/docs/coming_from_ekfslam.md"; do
  # shellcheck disable=SC2016
  sed -n '/^```matlab$/,/^```$/{/^```/!p}' "$page" >"$work/page.m"
  [[ -s $work/page.m ]] || fail "$page has no example"
  octave "pkg load cairn; source('$work/page.m')"
done

say "Leak and time"
octave "pkg load cairn; addpath('$here/tests'); leak()"
gcc -std=c99 -O2 -Wall -Wextra -pedantic -Werror -ffp-contract=off -I"$root/include" "$here/tests/timing.c" \
  -L"$build/lib" -lcairn -o "$work/timing"
"$work/timing" >"$work/timing.txt"
octave "pkg load cairn; addpath('$here/tests'); timing('$work/timing.txt')"

[[ $(find "$here" | sort) == "$before" ]] || fail "the tests left files in $here"
say "The package for Octave is as it should be"
