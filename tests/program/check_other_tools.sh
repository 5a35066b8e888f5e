#!/usr/bin/env bash
# Other tools read what a build writes: evo the trajectories, plyfile and pyproj the maps, rerun a mission. Installs these
# tools from the Python package index into BUILD/other_tools.
# check_other_tools.sh BUILD
set -euo pipefail
# shellcheck source=../support/setup.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../support/setup.sh"

(($# == 1)) || fail "usage: check_other_tools.sh BUILD"
build=$(cd -- "$1" && pwd -P)
need_packages gcc=cc python3 python3-venv

work=$build/other_tools
mkdir -p "$work/home"
[[ -x $work/venv/bin/pip ]] || /usr/bin/python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet --disable-pip-version-check --retries 5 \
  --requirement "$root/tests/program/other_tools.txt" || fail "pip could not install the tools: see above. Is there a network?"

export CAIRN_PROGRAM=$build/bin/cairn CAIRN_MAKE_STARS=$build/tests/program/make_stars
export PYTHONPATH=$root/bindings/python CAIRN_LIBRARY=$build/lib CAIRN_INCLUDE_DIR=$root/include PYTHONDONTWRITEBYTECODE=1
export HOME=$work/home PATH=$work/venv/bin:$PATH  # evo writes its settings into the home folder
"$work/venv/bin/python3" "$root/tests/program/other_tools_test.py"
