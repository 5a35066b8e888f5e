#!/usr/bin/env bash
# Builds the Debian packages of Cairn from this source tree into OUT, and looks over them with lintian.
# build_debs.sh [--build TREE] [OUT]   (default of OUT: build/packages)
#   --build TREE   packages what is already built in TREE, so that nothing is compiled twice. TREE must be configured with
#                  -DCMAKE_INSTALL_PREFIX=/usr, because Debian's folders depend on it, and with -DCAIRN_STATIC=ON. The
#                  preset developer is.
# Environment: CAIRN_JOBS is the number of compilers at a time, where something is compiled (default: all processors).
set -euo pipefail
# shellcheck source=../tests/support/setup.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../tests/support/setup.sh"

tree=""
if [[ ${1:-} == --build ]]; then
  [[ -f ${2:-}/CMakeCache.txt ]] || fail "--build: ${2:-nothing} is no build tree"
  tree=$(cd -- "$2" && pwd -P)
  shift 2
fi
(($# <= 1)) || fail "usage: build_debs.sh [--build TREE] [OUT]"
mkdir -p -- "${1:-$root/build/packages}"
out=$(cd -- "${1:-$root/build/packages}" && pwd -P)
if [[ -n $tree ]]; then
  grep -qx 'CMAKE_INSTALL_PREFIX:PATH=/usr' "$tree/CMakeCache.txt" ||
    fail "$tree: configure it with -DCMAKE_INSTALL_PREFIX=/usr to make packages of it"
  grep -qx 'CAIRN_STATIC:BOOL=ON' "$tree/CMakeCache.txt" ||
    fail "$tree: configure it with -DCAIRN_STATIC=ON to make packages of it"
  grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$tree/CMakeCache.txt" || fail "$tree was built from other sources"
fi

# A binding that is not in this tree has no package: the profile leaves it out of debian/control.
profiles=()
packages=(build-essential dpkg-dev debhelper lintian fakeroot chrpath cmake=cmake ninja-build=ninja pkgconf=pkg-config
  libeigen3-dev libnanoflann-dev libmatio-dev doxygen=doxygen doxygen-awesome-css
  python3)
if [[ -d $root/bindings/python ]]; then
  packages+=(dh-python pybuild-plugin-pyproject python3-all python3-setuptools python3-wheel python3-cffi python3-numpy)
else
  profiles+=(pkg.cairn.nopython)
fi
if [[ -d $root/bindings/octave ]]; then packages+=(octave-dev); else profiles+=(pkg.cairn.nooctave); fi
need_packages "${packages[@]}"

# The packages are made in a copy of the sources: debian/ never appears in the tree itself.
work=$(mktemp -d "${TMPDIR:-/tmp}/cairn-debs.XXXXXX")
trap 'rm -rf -- "$work"' EXIT
source_dir=$work/cairn
mkdir -- "$source_dir"
tar -C "$root" --exclude='./build*' --exclude=./.git --exclude=./out --exclude=__pycache__ -cf - . |
  tar -C "$source_dir" -xf -
cp -R -- "$root/packaging/debian" "$source_dir/debian"
rm -rf -- "$out"/*.deb "$out"/cairn_*.changes "$out"/cairn_*.buildinfo

say "Packages of $root"
# What is needed was looked for above; a cmake that is no Debian package is good enough.
# CAIRN_BUILD_TREE is what debian/rules installs from; where it is empty, debian/rules builds.
(
  cd -- "$source_dir"
  profile_list=$(IFS=,; printf '%s' "${profiles[*]}")
  # Debian's Python, not one of a virtual environment.
  export PATH=/usr/sbin:/usr/bin:/sbin:/bin:$PATH
  CAIRN_BUILD_TREE=$tree DEB_BUILD_OPTIONS="nocheck parallel=${CAIRN_JOBS:-$jobs}" \
    dpkg-buildpackage --build=binary --no-check-builddeps --no-sign --no-pre-clean -us -uc ${profile_list:+"--build-profiles=$profile_list"}
) >"$out/build.log" 2>&1 || { tail -n 60 -- "$out/build.log" >&2; fail "no packages: see $out/build.log"; }
mv -- "$work"/*.deb "$work"/*.changes "$work"/*.buildinfo "$out"

say "lintian"
# Overrides for one package are in debian/*.lintian-overrides. Three tags do not apply to any package of this script,
# because it makes packages for installing, not for an upload to Debian: no bug in Debian's tracker asks for them, and the
# maintainer's address is none until somebody uploads them under theirs.
# In a container root is the one who builds.
lintian --allow-root --fail-on error,warning --display-info --tag-display-limit 0 \
  --suppress-tags initial-upload-closes-no-bugs,bogus-mail-host,bogus-mail-host-in-debian-changelog \
  "$out"/cairn_*.changes ||
  fail "lintian: see above"
ls -l -- "$out"/*.deb
