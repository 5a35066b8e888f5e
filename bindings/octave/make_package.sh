#!/usr/bin/env bash
# Makes the package for "pkg install" of Octave: cairn-octave-VERSION.tar.gz in OUT. Two runs give the same bytes.
# make_package.sh [OUT]   (default: build/packages)
set -euo pipefail
# shellcheck source=../../tests/support/setup.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../../tests/support/setup.sh"

(($# <= 1)) || fail "usage: make_package.sh [OUT]"
out=${1:-$root/build/packages}
here=$root/bindings/octave
version=$(sed -n 's/^Version: //p' "$here/DESCRIPTION")
name=cairn-octave-$version
mkdir -p -- "$out"
stage=$(mktemp -d)
trap 'rm -rf -- "$stage"' EXIT
mkdir -p "$stage/$name/inst" "$stage/$name/src" "$stage/$name/doc"
cp -R -- "$here/+cairn" "$stage/$name/inst"
cp -- "$here"/src/{Makefile,*.cpp,*.hpp} "$stage/$name/src"
cp -- "$here/DESCRIPTION" "$stage/$name"
cp -- "$root/LICENSE" "$stage/$name/COPYING"
cp -- "$here/README.md" "$stage/$name/doc"
date=$(sed -n 's/^Date: //p' "$here/DESCRIPTION")
tar --sort=name --mtime="$date UTC" --owner=0 --group=0 --numeric-owner --mode='u=rwX,go=rX' -C "$stage" -cf - "$name" |
  gzip -n -9 >"$out/$name.tar.gz"
printf '%s\n' "$out/$name.tar.gz"
