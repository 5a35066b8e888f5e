#!/usr/bin/env bash
# Makes the source tarball twice, unpacks it, and builds the simulator's library from it without git. Configuring the rest
# proves that no source file is missing: CMake looks for every one that it lists.
# tarball_test.sh [CMAKE_OPTION...], for example -DCMAKE_CXX_COMPILER_LAUNCHER=ccache
set -euo pipefail
# shellcheck source=../support/setup.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../support/setup.sh"
need_packages git=git cmake=cmake g++=g++ ninja-build=ninja libeigen3-dev libnanoflann-dev pkgconf=pkg-config libmatio-dev
if ! git -C "$root" rev-parse HEAD >/dev/null 2>&1; then
  echo "skipped: these sources are no checkout of git, so there is nothing to make a tarball of"
  exit
fi
work=$(mktemp -d "${TMPDIR:-/tmp}/cairn-tarball.XXXXXX")
trap 'rm -rf -- "$work"' EXIT

first=$(bash "$root/packaging/make_tarball.sh" "$work/first" | tail -n 1)
# Neither the time nor the user's umask may show.
sleep 1
second=$(umask 0077 && TZ=Asia/Tokyo bash "$root/packaging/make_tarball.sh" "$work/second" | tail -n 1)
cmp -- "$first" "$second" || fail "two tarballs of one commit differ"
tar -C "$work" -xzf "$first"
tree=$work/$(basename -- "$first" .tar.gz)
[[ -f $tree/CMakeLists.txt && -f $tree/LICENSE ]] || fail "the tarball has not one folder of its own name"
[[ ! -e $tree/.git ]] || fail "the tarball contains .git"

# A git that fails, before any other: the build may not ask it.
mkdir "$work/bin"
printf '#!/bin/sh\necho "git was called: $*" >>"%s"\nexit 1\n' "$work/git_calls" >"$work/bin/git"
chmod +x "$work/bin/git"
(
  export PATH="$work/bin:$PATH" CCACHE_BASEDIR=$tree CCACHE_NOHASHDIR=1
  cmake -S "$tree" -B "$tree/build/default" -G Ninja "$@" &&
    cmake --build "$tree/build/default" --parallel "$jobs" --target cairn_sim
) >"$work/log" 2>&1 || { tail -n 40 "$work/log"; fail "the tarball does not build"; }
[[ ! -e $work/git_calls ]] || { cat "$work/git_calls"; fail "the build needs git"; }
[[ -f $tree/build/default/lib/libcairn_sim.so ]] || fail "no library came out of the tarball"
echo "ok: $(basename -- "$first"), $(stat -c %s "$first") bytes, builds without git"
