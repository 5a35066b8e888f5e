#!/usr/bin/env bash
# Makes the source tarball of a commit: cairn-VERSION.tar.gz in OUT. Two runs give the same bytes. The tarball builds
# without git.
# make_tarball.sh [OUT [COMMIT]]   (default: build/packages HEAD)
set -euo pipefail
# shellcheck source=../tests/support/setup.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../tests/support/setup.sh"

(($# <= 2)) || fail "usage: make_tarball.sh [OUT [COMMIT]]"
out=${1:-$root/build/packages} commit=${2:-HEAD}
need_packages git=git gzip=gzip
version=$(git -C "$root" show "$commit:CMakeLists.txt" | sed -n 's/^project(cairn VERSION \([0-9.]*\).*/\1/p')
[[ -n $version ]] || fail "$commit: CMakeLists.txt names no version"
mkdir -p -- "$out"
file=$out/cairn-$version.tar.gz
# The times in the archive are those of the commit. gzip -n leaves out its own name and time. A user's configuration of
# git could change line ends and permissions.
git -C "$root" -c core.autocrlf=false -c tar.umask=0022 archive --format=tar --prefix="cairn-$version/" "$commit" -- . \
  ':(exclude).ci' | gzip -n -9 >"$file"
printf '%s\n' "$file"
