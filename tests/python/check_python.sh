#!/usr/bin/env bash
# Installs a build and the Python package as a user would, then tests every command of docs/python.md, the report, and its
# page in a browser without network. bindings/python/test.sh tests the rest of the package.
# check_python.sh BUILD. All results stay in BUILD/python, including screenshots.
set -euo pipefail
# shellcheck source=../support/setup.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../support/setup.sh"

(($# == 1)) || fail "usage: check_python.sh BUILD"
build=$(cd -- "$1" && pwd -P)
need_packages cmake=cmake gcc=cc python3 python3-dev python3-venv chromium=chromium fonts-dejavu-core

work=$build/python
rm -rf -- "$work"
mkdir -p "$work"
cmake --install "$build" --prefix "$work/prefix" >"$work/install.log" || fail "cmake --install failed: see $work/install.log"
libdir=$(dirname -- "$(find "$work/prefix" -path '*/glibc-hwcaps' -prune -o -name libcairn.so -print)")

# A copy of what the package needs of the source tree. It takes the installed library; building one again takes minutes.
mkdir "$work/clone" "$work/shots"
cp -R -- "$root/bindings" "$root/include" "$root/LICENSE" "$work/clone"
export CAIRN_BUNDLE=$libdir
find "$work/clone" -name __pycache__ -prune -exec rm -rf {} +

# All that Python takes comes from the package index. The tests of the build (ctest) run with Debian's numpy and cffi.
/usr/bin/python3 -m venv "$work/venv"
export PATH=$work/venv/bin:$work/prefix/bin:$PATH
# pip splits the value of this variable at spaces, which the project's path may have: a URL has none.
PIP_CONSTRAINT=$(/usr/bin/python3 -c 'import pathlib, sys; print(pathlib.Path(sys.argv[1]).as_uri())' \
  "$root/tests/python/constraints.txt")
export PIP_CONSTRAINT PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_RETRIES=5
export PYTHONDONTWRITEBYTECODE=1
unset PYTHONPATH CAIRN_LIBRARY

say "The commands of docs/python.md"
# All sh blocks form one script; all python blocks form one program that runs in the same folder.
block() { awk -v kind="$1" '$0 == "```" kind {on = 1; next} $0 == "```" && on {on = 0; print ""} on' "$root/docs/python.md"; }
block sh >"$work/commands.sh"
block python >"$work/lines.py"
[[ -s $work/commands.sh && -s $work/lines.py ]] || fail "docs/python.md has lost its commands"
(cd -- "$work/clone" && bash -euxo pipefail "$work/commands.sh") >"$work/commands.log" 2>&1 ||
  { cat "$work/commands.log"; fail "a command of docs/python.md failed"; }
(cd -- "$work/clone" && python3 "$work/lines.py") || fail "the Python lines of docs/python.md failed"
for file in out/report.html boats/report.html both/report.html figures/figure_05.png figures/figure_13.png \
  figures/usv_figure_02.png figures/usv_figure_05.png figures/usv_figure_07.png; do
  [[ -s $work/clone/$file ]] || fail "the commands of docs/python.md made no $file"
done
echo "ok"

say "The installed package: tests of the report"
export CAIRN_PROGRAM=$work/prefix/bin/cairn CAIRN_SHOTS=$work/shots
where=$(cd / && python3 -c 'import cairn, cairn._abi; print(cairn.__file__)')
[[ $where == "$work/venv/"* ]] || fail "cairn was imported from $where, not from where pip installed it"
for name in report team_report team_time trust; do
  python3 "$root/tests/python/${name}_test.py"
done

say "The page in a browser"
python3 "$root/tests/python/browser_test.py"
