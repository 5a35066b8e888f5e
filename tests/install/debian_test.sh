#!/usr/bin/env bash
# Installs the Debian packages with apt, uses them as a stranger would, and removes them again. Nothing may stay.
# debian_test.sh FOLDER   FOLDER has the packages that packaging/build_debs.sh has made.
set -euo pipefail
# shellcheck source=../support/setup.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../support/setup.sh"

(($# == 1)) || fail "usage: debian_test.sh FOLDER"
here=$root/tests/install
debs=("$(cd -- "$1" && pwd -P)"/*.deb)
[[ -f ${debs[0]} ]] || fail "$1 has no packages"
if ! command -v apt-get >/dev/null; then
  echo "skipped: no apt-get here"
  exit
fi
as_root=()
if ((EUID != 0)); then as_root=(sudo); fi
need_packages gcc=cc libc6-dev pkgconf=pkg-config binutils=readelf
names=()
for deb in "${debs[@]}"; do names+=("$(dpkg-deb -f "$deb" Package)"); done
for name in libcairn0.2 libcairn-dev libcairn-doc cairn-tools; do
  [[ " ${names[*]} " == *" $name "* ]] || fail "there is no package $name"
done
for name in "${names[@]}"; do
  if dpkg-query -W "$name" >/dev/null 2>&1; then fail "$name is installed already: remove it first"; fi
done

work=$(mktemp -d "${TMPDIR:-/tmp}/cairn-debian.XXXXXX")
apt() {
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y --no-install-recommends -o DPkg::Lock::Timeout=300 \
    -o Dpkg::Use-Pty=0 "$@" </dev/null >>"$work/apt.log" 2>&1
}
clean() {
  apt purge "${names[@]}" || true
  rm -rf -- "$work"
}
trap clean EXIT
# What the packages bring with them (numpy for Python, for example) may stay, and must be there before the list is made.
mapfile -t wanted < <(for deb in "${debs[@]}"; do dpkg-deb -f "$deb" Depends; done | tr ',' '\n' |
  sed 's/[ (|].*//; s/^ *//' | awk 'NF' | sort -u)
needed=()
for name in "${wanted[@]}"; do
  if [[ " ${names[*]} " != *" $name "* ]] && [[ -n $(apt-cache show "$name" 2>/dev/null) ]]; then
    needed+=("$name")
  fi
done
need_packages "${needed[@]}"
# Every file whose name has to do with the library, below the folders that packages install to.
traces() {
  find /usr /etc /opt /var/lib/dpkg/info -xdev -path /usr/local -prune -o -iname '*cairn*' -print 2>/dev/null |
    LC_ALL=C sort
}
traces >"$work/before"

# The program of a stranger, from the packages to its first pose, by pkg-config only.
say "apt install"
unset PKG_CONFIG_PATH LD_LIBRARY_PATH
start=$(date +%s%N)
apt install "${debs[@]}" || { cat "$work/apt.log"; fail "apt could not install the packages"; }
read -ra flags <<<"$(pkg-config --cflags --libs cairn)"
cc -std=c99 -O2 -Wall -Wextra -pedantic -Werror "$here/consumer/consumer.c" "${flags[@]}" -o "$work/consumer" ||
  fail "the consumer by pkg-config"
printed=$("$work/consumer") || fail "the consumer, exit $?"
end=$(date +%s%N)
printf 'ok: from apt install to the first pose of a C program: %d ms (%s)\n' $(((end - start) / 1000000)) "$printed"

library=$(ldd "$work/consumer" | awk '/libcairn/ {print $3}')
case $library in /usr/lib/* | /lib/*) ;; *) fail "the consumer was given $library" ;; esac
[[ $(dpkg -S "$(readlink -f -- "$library")" | cut -d: -f1) == libcairn0.2 ]] || fail "$library is of no package"
libdir=/usr/lib/$(dpkg-architecture -qDEB_HOST_MULTIARCH 2>/dev/null || cc -print-multiarch)

# A program that opens the library by its development name gets the build that the loader gives to linked programs.
cc -std=c99 -O2 "$here/consumer/by_name.c" -o "$work/by_name" || fail "by_name.c"
by_name=$("$work/by_name") || fail "dlopen(\"libcairn.so\"), exit $?"
[[ $by_name == "$printed" ]] || fail "dlopen(\"libcairn.so\") gave $by_name, linking gave $printed"
if [[ -d $libdir/glibc-hwcaps/x86-64-v3 ]] && /lib64/ld-linux-x86-64.so.2 --help | grep 'x86-64-v3 (supported' >/dev/null; then
  [[ $by_name == *" x86-64-v3" ]] || fail "this processor can run x86-64-v3, but the loader gave $by_name"
fi
echo "ok: dlopen(\"libcairn.so\"): $by_name"

read -ra flags <<<"$(pkg-config --cflags --libs --static cairn)"
cc -std=c99 -O2 -static "$here/consumer/consumer.c" "${flags[@]}" -o "$work/static" || fail "linking statically"
echo "ok: pkg-config --static: $("$work/static")"

mapfile -t libraries < <(find "$libdir" -name 'libcairn*.so.*.*.*' -type f)
bash "$here/hardening_test.sh" "${libraries[@]}"

say "The program, its page, the documentation, the bindings"
cairn simulate mars --landmarks 20 --summary json >"$work/summary.json" 2>"$work/log" || { cat "$work/log"; fail "cairn simulate"; }
grep -q pose_rmse_m "$work/summary.json" || fail "cairn simulate printed no summary"
if readelf -dW "$(command -v cairn)" | grep -E 'R(UN)?PATH'; then fail "the program has a path to the library"; fi
[[ $(dpkg -L cairn-tools) == */man1/cairn.1.gz* ]] || fail "no manual page"
[[ $(dpkg -L libcairn-doc) == */html/index.html* ]] || fail "no documentation"
if [[ " ${names[*]} " == *" python3-cairn "* ]]; then
  (cd / && env -u PYTHONPATH -u CAIRN_LIBRARY PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 - "${printed% *}") <<'PYTHON' ||
import sys
import cairn
assert cairn.__file__.startswith("/usr/lib/python3/"), cairn.__file__
assert cairn.version() == sys.argv[1], cairn.version()
world = cairn.World(seed=3)
with cairn.Filter(max_observations=world.most_observations, initial_pose=world.pose(0.0)) as rover:
    camera = rover.add_stereo_head(**world.head())
    for step in world:
        for motion in step.motions:
            rover.predict_twist(motion["dt"], motion["velocity"], motion["rate"])
        rover.update(camera, step.observations["id"], step.observations["z"])
    print("ok: python3-cairn, a drive to", rover.pose()[0])
PYTHON
    fail "python3-cairn"
fi
if [[ " ${names[*]} " == *" octave-cairn "* ]]; then
  # The package's own tests run with the binding. Here: Octave finds and loads it, without a path and without "pkg load".
  (cd / && octave-cli --norc --eval 'printf("ok: octave-cairn, version %s\n", cairn.version())') || fail "octave-cairn"
fi

say "apt purge"
apt purge "${names[@]}" || { cat "$work/apt.log"; fail "apt could not remove the packages"; }
traces >"$work/after"
diff -u "$work/before" "$work/after" || fail "the removed packages left these files"
if [[ $(ldconfig -p 2>/dev/null || /sbin/ldconfig -p) == *libcairn* ]]; then fail "the loader's cache still names libcairn"; fi
if "$work/consumer" >/dev/null 2>&1; then fail "the consumer still finds a library"; fi
echo "ok: removed without a trace"
