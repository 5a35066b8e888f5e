#!/usr/bin/env bash
# Tests the C++ headers: test.sh [BUILD_DIR]. BUILD_DIR (build/check of the project by default) is a configured build
# that holds the built library in lib and the C replayer bin/cairn_conformance. Everything that is built goes to
# BUILD_DIR/bindings/cpp.
set -euo pipefail
here=$(CDPATH='' cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
# shellcheck source=../../tests/support/setup.sh
source "$here/../../tests/support/setup.sh"
build=$(CDPATH='' cd -- "${1:-$root/build/check}" && pwd -P)
work=$build/bindings/cpp
rm -rf -- "$work"
mkdir -p "$work"

need_packages g++=g++ clang=clang++ clang-format=clang-format cmake=cmake ninja-build=ninja pkgconf=pkg-config \
  python3=python3 libeigen3-dev doctest-dev nlohmann-json3-dev valgrind=valgrind

[[ -x $build/bin/cairn_conformance ]] ||
  fail "$build/bin/cairn_conformance is missing: build the target cairn_conformance"
export LD_LIBRARY_PATH=$build/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
warnings=(-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Werror)
include=("-I$here/include" "-I$root/include" "-I$here/tests" "-I$root/tests/conformance" "-I$work")
libraries=("-L$build/lib" -lcairn_sim -lcairn -pthread)
version=$(sed -n 's/^ *"version": "\(.*\)".*/\1/p' "$root/src/api/api.json" | head -n 1)
sources() { git -C "$root" status --porcelain -- bindings/cpp examples/cpp 2>/dev/null || true; }
before=$(sources)

say "Generated headers, what they lack of the interface, and style"
python3 "$here/generate.py" --check
find "$here" "$root/examples/cpp" \( -name '*.hpp' -o -name '*.cpp' \) ! -name '*types.hpp' -print0 |
  xargs -0 clang-format --dry-run -Werror

# In the background, two at a time: what is built takes most of the time of this script.
run() {
  while (($(jobs -rp | wc -l) >= jobs)); do wait -n || failed=true; done
  "$@" &
}
finish() {
  while (($(jobs -rp | wc -l) > 0)); do wait -n || failed=true; done
  if $failed; then fail "see above"; fi
}
failed=false

say "Compilers: $(g++ --version | head -n 1), $(clang++ --version | head -n 1)"
for compiler in g++ clang++; do
  for standard in c++17 c++20; do
    run "$compiler" "-std=$standard" -fsyntax-only "${warnings[@]}" "-I$here/include" "-I$root/include" \
      "$root/examples/cpp/rover.cpp"
  done
done
run g++ -std=c++20 -O1 "${warnings[@]}" "${include[@]}" "$here/tests/behaviour.cpp" "${libraries[@]}" \
  -o "$work/behaviour"
run g++ -std=c++17 -O0 "${include[@]}" -isystem /usr/include/eigen3 "$here/tests/eigen.cpp" "${libraries[@]}" \
  -o "$work/eigen"
run g++ -std=c++17 -O2 "${warnings[@]}" "${include[@]}" "$here/tests/timing.cpp" "${libraries[@]}" -o "$work/timing"
python3 "$here/generate.py" --fields "$work/fields.hpp"
objects=()
for source in "$here"/tests/{conformance,functions}.cpp "$root"/tests/conformance/{call,callbacks}.cpp; do
  object=$work/$(basename "$source" .cpp).o
  objects+=("$object")
  run g++ -std=c++17 -O0 -ffp-contract=off -Wall -Wextra "${include[@]}" -c "$source" -o "$object"
done
finish
g++ "${objects[@]}" "${libraries[@]}" -o "$work/conformance"

say "What must not compile"
if g++ -std=c++17 -fsyntax-only -fmax-errors=0 "${include[@]}" -isystem /usr/include/eigen3 "$here/tests/refused.cpp" \
  >"$work/refused.log" 2>&1; then
  fail "refused.cpp compiles"
fi
while IFS=: read -r line _; do
  grep -q "refused.cpp:$line:" "$work/refused.log" || fail "line $line of tests/refused.cpp compiles"
done < <(grep -n '// refused$' "$here/tests/refused.cpp")
grep -c '// refused$' "$here/tests/refused.cpp"

say "Errors, ownership, arrays, callbacks, threads, leaks"
"$work/behaviour"
"$work/eigen"

say "The conformance scenarios, to the last bit"
mkdir -p "$work/c"
# Whether these values are the recorded ones is a test of their own; here the C replayer is what C++ is compared with.
"$build/bin/cairn_conformance" "$root/tests/conformance" "$work/c" >"$work/c.log" 2>&1 ||
  tail -n 1 "$work/c.log"
"$work/conformance" "$root/tests/conformance" "$work/c" "$root/src/api/api.json"

say "An update beside the same update in C"
"$work/timing"
for language in c cpp; do
  valgrind --tool=callgrind --callgrind-out-file=/dev/null --toggle-collect="drive_$language" \
    "$work/timing" "$language" >"$work/$language.log" 2>&1 || { cat "$work/$language.log"; fail "callgrind"; }
done
instructions() { sed -n 's/.*Collected : //p' "$work/$1.log"; }
python3 - "$(instructions c)" "$(instructions cpp)" <<'PYTHON'
import sys
c, cpp = map(int, sys.argv[1:])
print(f"a drive: {c} instructions in C, {cpp} in C++: {100 * (cpp / c - 1):+.3f} %")
if cpp > 1.01 * c:
    sys.exit("C++ takes more than 1 % over C")
PYTHON

say "A fresh project that finds the installed headers"
for component in runtime development; do
  cmake --install "$build" --prefix "$work/prefix" --component "$component" >/dev/null
done
mkdir -p "$work/fresh"
cp "$root/examples/cpp/rover.cpp" "$work/fresh/rover.cpp"
cat >"$work/fresh/CMakeLists.txt" <<'CMAKE'
cmake_minimum_required(VERSION 3.22)
project(rover LANGUAGES CXX)
find_package(cairn ${wanted} REQUIRED COMPONENTS sim)
add_executable(rover rover.cpp)
target_compile_features(rover PRIVATE cxx_std_17)
target_link_libraries(rover PRIVATE cairn::cairn cairn::sim)
CMAKE
# find_cairn VERSIONS
find_cairn() {
  cmake -S "$work/fresh" -B "$work/fresh/build" -G Ninja "-DCMAKE_PREFIX_PATH=$work/prefix" "-Dwanted=$1"
}
{ find_cairn "$version" && cmake --build "$work/fresh/build"; } >"$work/fresh.log" 2>&1 ||
  { cat "$work/fresh.log"; fail "the fresh project"; }
rover=$work/fresh/build/rover
env -u LD_LIBRARY_PATH "$rover"

say "What a missing or an older library says"
# refuses TEXT COMMAND...: the command must fail and say TEXT on one line.
refuses() {
  local text=$1
  shift
  if "$@" >"$work/refused.log" 2>&1; then fail "this should have failed: $*"; fi
  tr -s ' \n' ' ' <"$work/refused.log" >"$work/refused.txt"
  grep -oF -- "$text" "$work/refused.txt" || {
    cat "$work/refused.log" >&2
    fail "\"$text\" is missing in what this says: $*"
  }
}
echo 'unsigned cairn_version_number(void) { return 100; }' | gcc -shared -fPIC -x c - -o "$work/older.so"
refuses "cairn.hpp $version needs libcairn ${version%.*}, and libcairn 0.1.0 is loaded" \
  env LD_PRELOAD="$work/older.so" "$rover"
mkdir -p "$work/empty"
mv "$work/prefix" "$work/away"
refuses "libcairn.so.${version%.*}: cannot open shared object file" env LD_LIBRARY_PATH="$work/empty" \
  LD_PRELOAD='' "$rover"
mv "$work/away" "$work/prefix"
refuses "version: $version" find_cairn 9.0

[[ $(sources) == "$before" ]] || fail "the tests changed the sources: $(sources)"
say "The C++ headers pass"
