# shellcheck shell=bash
# shellcheck disable=SC2034  # root and jobs are for the scripts that source this
# Sourced by the scripts that must work on a bare Debian 12: where the project is, how they speak, what they install.

root=$(CDPATH='' cd -- "$(dirname -- "${BASH_SOURCE[0]}")/../.." && pwd -P)
jobs=$(nproc)
export PATH  # where the caller had none, bash knows one but keeps it to itself

say() { printf '\n== %s\n' "$*"; }
fail() {
  printf '%s: %s\n' "${0##*/}" "$*" >&2
  exit 1
}

# need_packages PACKAGE[=COMMAND]...
# Installs the Debian packages that are missing. One whose command is there, wherever it came from, is not missing.
need_packages() {
  local entry package missing=() as_root=()
  for entry; do
    package=${entry%%=*}
    if [[ $entry == *=* ]] && command -v "${entry#*=}" >/dev/null; then continue; fi
    if [[ $(dpkg-query -W -f '${Status}' "$package" 2>/dev/null) == *'ok installed'* ]]; then continue; fi
    missing+=("$package")
  done
  if ((${#missing[@]} == 0)); then return; fi
  if ! command -v apt-get >/dev/null; then
    say "No apt-get here. On Debian these packages would be installed now; going on without: ${missing[*]}"
    return
  fi
  if ((EUID != 0)); then
    command -v sudo >/dev/null ||
      fail "these packages are missing, and installing them takes root or sudo: ${missing[*]}"
    as_root=(sudo)
  fi
  say "Installing what is missing: ${missing[*]}"
  # Every command gets its own empty input: nothing may ask, nor eat the input of the script.
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -q -o Acquire::Retries=3 </dev/null ||
    fail "apt-get update failed: see above"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends \
    -o Acquire::Retries=3 -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0 "${missing[@]}" </dev/null ||
    fail "apt-get could not install: ${missing[*]}"
  if [[ " ${missing[*]} " == *' mosquitto '* ]]; then rest_broker "${as_root[@]}"; fi
}

# rest_broker [sudo]: Debian starts a broker as soon as it is installed, and with the machine. It is here for an example,
# which starts one of its own: the system's was not asked for. In a container there is none to stop.
rest_broker() {
  if [[ -d /run/systemd/system ]]; then
    "$@" systemctl --quiet disable --now mosquitto.service || say "The broker mosquitto may be running: see above"
  elif [[ -x /etc/init.d/mosquitto ]]; then
    "$@" env PATH="$PATH:/usr/sbin:/sbin" sh -c 'update-rc.d mosquitto disable; service mosquitto stop' \
      </dev/null >/dev/null 2>&1 || true
  fi
}

# configure FOLDER CMAKE_OPTION...: configures the project in a folder that belongs to the calling script.
configure() {
  local folder=$1
  shift
  # A cache from another place (the checkout was moved or copied) is worth nothing here.
  if [[ -f $folder/CMakeCache.txt ]] &&
    ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$folder/CMakeCache.txt"; then
    rm -rf -- "$folder"
  fi
  cmake -S "$root" -B "$folder" -G Ninja "$@"
}

# built_library [BUILD]: the build tree BUILD (build/bindings by default) in which a binding is tested. The library and the
# C replayer are built if they are missing. $build is its path then, $soname and $version are those of the library.
built_library() {
  build=${1:-$root/build/bindings}
  soname=$(sed -n 's/.*"soname": "\(libcairn\.so[^"]*\)".*/\1/p' "$root/src/api/api.json" | head -n 1)
  # shellcheck disable=SC2034  # for the script that calls
  version=$(sed -n 's/^ *"version": "\([^"]*\)".*/\1/p' "$root/src/api/api.json" | head -n 1)
  if [[ ! -e $build/lib/$soname || ! -x $build/bin/cairn_conformance ]]; then
    say "Build of the library and of the C replayer ($build)"
    [[ -f $build/CMakeCache.txt ]] ||
      configure "$build" -DCMAKE_BUILD_TYPE=Release -DCAIRN_BUILD_TESTS=ON -DCAIRN_MATIO=OFF
    cmake --build "$build" --parallel "$jobs" --target cairn cairn_sim cairn_conformance
  fi
  build=$(CDPATH='' cd -- "$build" && pwd -P)
}

# refuses TEXT COMMAND...: the command must fail and say TEXT on one line. Keeps what it says in the folder $work of the
# script that calls.
# shellcheck disable=SC2154
refuses() {
  local text=$1
  shift
  if "$@" >"$work/refused.log" 2>&1; then fail "this should have failed: $*"; fi
  grep -m 1 -F -- "$text" "$work/refused.log" || {
    cat "$work/refused.log" >&2
    fail "\"$text\" is missing in what this says: $*"
  }
}

# same_libraries BUILD FOLDER: links in FOLDER to the libraries that the loader picks for the programs of a build, on many
# machines the second build of libcairn. For what opens a library by its path, where the loader does not pick.
same_libraries() {
  local build=$1 folder=$2 picked
  picked=$(LD_LIBRARY_PATH=$build/lib ldd "$build/bin/cairn_conformance" | sed -n 's|.* => \(/.*\)/libcairn\.so.*|\1|p')
  [[ -n $picked ]] || fail "the loader finds no libcairn in $build/lib"
  rm -rf -- "$folder"
  mkdir -p "$folder"
  ln -s "$build"/lib/libcairn_sim.so* "$picked"/libcairn.so* "$folder/"
}

# Builds the program cairn with the flags of the benchmarks; $program is then its path. Writes only to stderr.
bench_program() {
  say "Build (build/bench)" >&2
  {
    need_packages cmake=cmake g++=g++ ninja-build=ninja pkgconf=pkg-config libeigen3-dev libnanoflann-dev libmatio-dev \
      libbenchmark-dev libopenblas-dev
    configure "$root/build/bench" --preset bench
    cmake --build "$root/build/bench" --parallel "$jobs" --target cairn_program
  } >&2
  program=$root/build/bench/bin/cairn
}
