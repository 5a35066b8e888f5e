#!/usr/bin/env bash
# Makes Debian packages of a build, installs them with apt, uses and removes them; makes the source tarball and builds from
# it. check_packages.sh BUILD. The packages stay in BUILD/packages.
set -euo pipefail
# shellcheck source=../support/setup.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../support/setup.sh"

(($# == 1)) || fail "usage: check_packages.sh BUILD"
build=$(cd -- "$1" && pwd -P)
if command -v apt-get >/dev/null; then
  bash "$root/packaging/build_debs.sh" --build "$build" "$build/packages"
  bash "$root/tests/install/debian_test.sh" "$build/packages"
else
  say "Debian packages: skipped, there is no apt-get here"
fi

say "Source tarball"
launcher=$(sed -n 's/^CMAKE_CXX_COMPILER_LAUNCHER:[A-Z]*=//p' "$build/CMakeCache.txt")
bash "$root/tests/install/tarball_test.sh" ${launcher:+"-DCMAKE_CXX_COMPILER_LAUNCHER=$launcher"}
