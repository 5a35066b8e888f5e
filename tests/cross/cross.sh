#!/usr/bin/env bash
# Compiles for machines that are not here, and runs what an emulator can run (docs/platforms.md). Everything that it
# builds is in build/cross. Ends at the first failure.
#   cross.sh [--short] [layout|apple|plain|aarch64|mingw|clang|all]...
# --short is for CI: nothing is optimised, and the files of a folder are compiled together. For aarch64 and Windows only
# the smaller library is built; the unit tests of the lower rooms run on aarch64.
set -euo pipefail
# shellcheck source=../support/setup.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../support/setup.sh"

toolchains=$root/src/cmake/toolchains
out=$root/build/cross
short=false
parts=()
for argument; do
  case $argument in
    --short) short=true ;;
    layout | apple | plain | aarch64 | mingw | clang) parts+=("$argument") ;;
    all) parts+=(layout apple plain aarch64 mingw clang) ;;
    *) fail "unknown argument $argument; usage: cross.sh [--short] [layout|apple|plain|aarch64|mingw|clang|all]..." ;;
  esac
done
if ((${#parts[@]} == 0)); then parts=(layout apple plain aarch64 mingw clang); fi

options=(-DCMAKE_BUILD_TYPE=Release -DCAIRN_DEVELOPER=ON -DCAIRN_HWCAPS=OFF -DCAIRN_MATIO=OFF)
if command -v ccache >/dev/null; then
  options+=(-DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
fi
if $short; then
  # Checked libc calls need an optimising compiler, and warn without.
  options+=(-DCAIRN_UNITY=ON -DCAIRN_HARDENING=OFF "-DCMAKE_C_FLAGS_RELEASE=-O0 -DNDEBUG"
    "-DCMAKE_CXX_FLAGS_RELEASE=-O0 -DNDEBUG")
fi

# committed SYMBOLS: the names of a list of exported symbols, without versions.
committed() { sed -n 's/^\(cairn_[a-z0-9_]*\).*/\1/p' "$1" | LC_ALL=C sort; }

# same_symbols SYMBOLS WHAT: the names on the standard input are those of the list.
same_symbols() {
  diff -u <(committed "$1") <(LC_ALL=C sort) || fail "$2 exports other symbols than ${1#"$root/"}"
  echo "ok: $2 exports the $(committed "$1" | wc -l) symbols of ${1#"$root/"}"
}

# The compiler of each machine agrees with api.json on size and offset of every public struct and field, on every
# constant and every signature.
part_layout() {
  need_packages python3 gcc=gcc gcc-aarch64-linux-gnu=aarch64-linux-gnu-gcc \
    gcc-arm-linux-gnueabihf=arm-linux-gnueabihf-gcc gcc-mingw-w64-x86-64-posix=x86_64-w64-mingw32-gcc-posix \
    libc6-dev libc6-dev-arm64-cross libc6-dev-armhf-cross
  local pins=$out/pins.c compiler check=(-std=c11 -Wall -Wextra -Werror -fsyntax-only "-I$root/include")
  mkdir -p "$out"
  python3 -B "$root/tests/api/make_pins.py" "$root/src/api/api.json" "$pins"
  sed '0,/offsetof(\(.*\)) == \([0-9]*\)/s//offsetof(\1) == 1\2/' "$pins" >"$out/wrong_pins.c"
  for compiler in gcc aarch64-linux-gnu-gcc arm-linux-gnueabihf-gcc x86_64-w64-mingw32-gcc-posix; do
    "$compiler" "${check[@]}" "$pins" || fail "$compiler lays out the interface in another way than src/api/api.json"
    if "$compiler" "${check[@]}" "$out/wrong_pins.c" 2>/dev/null; then fail "$compiler overlooks a wrong offset"; fi
    echo "ok: $(grep -c 'sizeof.*==\|offsetof.*==' "$pins") sizes and offsets by $compiler"
  done
}

# Apple's SDK is not free, so this part sees only the headers and the list of exported symbols.
part_apple() {
  need_packages clang=clang lld=lld llvm=llvm-nm cmake=cmake
  mkdir -p "$out/apple"
  cd "$out/apple"
  printf '#include <cairn/%s.h>\n' cairn sim fleet >headers.c
  echo "typedef int not_empty;" >>headers.c
  local target symbols library
  for target in arm64-apple-macos11 x86_64-apple-macos11 x86_64-pc-windows-msvc; do
    clang --target=$target -std=c99 -ffreestanding -Wall -Wextra -pedantic -Werror -fsyntax-only "-I$root/include" \
      headers.c || fail "the headers for $target"
    echo "ok: the headers for $target"
  done
  echo "include(\"$root/src/cmake/CairnExports.cmake\")" >exports.cmake
  # shellcheck disable=SC2016  # the variables are those of CMake
  echo 'cairn_write_exports(${SYMBOLS} ${LIST})' >>exports.cmake
  for symbols in "$root/src/cairn/capi/symbols.txt" "$root/src/sim/symbols.txt"; do
    cmake "-DSYMBOLS=$symbols" "-DLIST=$PWD/list" -P exports.cmake
    { committed "$symbols" | sed 's/.*/void &(void) {}/'; echo 'void internal(void) {}'; } >library.c
    library=$(basename "$(dirname "$symbols")").dylib
    clang --target=arm64-apple-macos11 -nostdlib -shared -fuse-ld=lld "-Wl,-exported_symbols_list,$PWD/list" \
      library.c -o "$library" || fail "linking with the list of $symbols"
    llvm-nm -gU "$library" | awk '{sub(/^_/, "", $3); print $3}' | same_symbols "$symbols" "$library of ld64.lld"
  done
  cd "$root"
}

# cmocka_for_arm64: the library for tests in C, from Debian's archive, without telling this machine's own apt of another
# architecture. $cmocka is then the folder to look into.
cmocka_for_arm64() {
  cmocka=$out/cmocka
  if [[ -d $cmocka/usr ]]; then return; fi
  local apt=(apt-get -q -o "Dir::State=$cmocka/state" -o "Dir::Cache=$cmocka/cache" -o APT::Sandbox::User=root
    -o Dir::State::status=/var/lib/dpkg/status -o APT::Architectures::=amd64 -o APT::Architectures::=arm64)
  mkdir -p "$cmocka/state/lists/partial" "$cmocka/cache/archives/partial"
  cd "$cmocka"
  "${apt[@]}" update >/dev/null && "${apt[@]}" download libcmocka-dev:arm64 libcmocka0:arm64 || return 1
  local package
  for package in ./*.deb; do dpkg-deb -x "$package" .; done
  rm -rf state cache
  cd "$root"
}

# rooms_program NAME ROOM...: the unit tests of rooms that use no other room, compiled with "${compiler[@]}".
rooms_program() {
  local name=$1 folder=$out/$1 room file files flags
  shift
  rm -rf "$folder"
  mkdir -p "$folder"
  flags=(-std=c++17 -Wall -Wextra -Wshadow -Wno-psabi -Werror -DEIGEN_DONT_PARALLELIZE "-I$root/src/cairn"
    "-I$root/tests/unit" -isystem /usr/include/eigen3)
  files=("$root/tests/unit/main.cpp")
  for room; do files+=("$root/src/cairn/$room"/*.cpp "$root/tests/unit/$room"/*_test.cpp); done
  for file in "${files[@]}"; do
    "${compiler[@]}" "${flags[@]}" -c "$file" -o "$folder/$(basename "$file" .cpp).o"
  done
  "${compiler[@]}" "$folder"/*.o -o "$folder/$name"
}

part_aarch64() {
  need_packages cmake=cmake ninja-build=ninja g++-aarch64-linux-gnu=aarch64-linux-gnu-g++ qemu-user=qemu-aarch64 \
    libeigen3-dev libnanoflann-dev doctest-dev python3
  local build=$out/aarch64 cross=(--toolchain "$toolchains/aarch64-linux-gnu.cmake") targets=(all) cmocka compiler
  local libraries=(cairn/capi:libcairn sim:libcairn_sim)
  if $short; then
    need_packages clang=clang
    build+=-short targets=(cairn_sim) libraries=(sim:libcairn_sim)
    cross+=(-DCAIRN_CROSS_CLANG=ON)
  else
    cmocka_for_arm64 || say "No cmocka for arm64 in the archive: the tests of the C interface are left out"
    cross+=("-DCMAKE_FIND_ROOT_PATH=$cmocka/usr" "-DCMAKE_PREFIX_PATH=$cmocka/usr/lib/aarch64-linux-gnu/cmake")
  fi
  configure "$build" "${options[@]}" "${cross[@]}"
  cmake --build "$build" --parallel "$jobs" --target "${targets[@]}"
  local library name
  for library in "${libraries[@]}"; do
    name=${library#*:}
    aarch64-linux-gnu-nm -D --defined-only "$build/lib/$name.so" |
      awk '$2 != "A" {sub(/@.*/, "", $3); print $3}' |
      same_symbols "$root/src/${library%:*}/symbols.txt" "$name.so for aarch64"
  done
  if $short; then
    compiler=(clang++ --target=aarch64-linux-gnu -O0)
    rooms_program aarch64-rooms core linear motion
    qemu-aarch64 -L /usr/aarch64-linux-gnu "$out/aarch64-rooms/aarch64-rooms"
  else
    ctest --test-dir "$build" --output-on-failure -j "$jobs" --no-tests=error
  fi
}

# Copies of packages that are headers only: what else is in /usr/include is not for Windows.
headers_for_mingw() {
  headers=$out/headers
  rm -rf "$headers"
  mkdir -p "$headers/include" "$headers/share" "$headers/lib/cmake"
  cp -r /usr/include/eigen3 /usr/include/nanoflann.hpp /usr/include/doctest "$headers/include"
  cp -r /usr/share/eigen3 /usr/share/nanoflann "$headers/share"
  cp -r /usr/lib/cmake/doctest "$headers/lib/cmake"
}

part_mingw() {
  need_packages cmake=cmake ninja-build=ninja g++-mingw-w64-x86-64-posix=x86_64-w64-mingw32-g++-posix \
    binutils-mingw-w64-x86-64=x86_64-w64-mingw32-objdump libeigen3-dev libnanoflann-dev doctest-dev
  local build=$out/mingw headers targets=(all) libraries=(cairn/capi:libcairn sim:libcairn_sim)
  local strict=(-Wall -Wextra -Wshadow -pedantic -Werror "-I$root/include")
  if $short; then # the smaller library, and the one file of the program that calls Windows
    build+=-short targets=(cairn_sim) libraries=(sim:libcairn_sim)
    x86_64-w64-mingw32-g++-posix -std=c++17 "${strict[@]}" "-I$root/src" -fsyntax-only \
      "$root/src/program/output/process.cpp"
  fi
  headers_for_mingw
  configure "$build" "${options[@]}" --toolchain "$toolchains/x86_64-w64-mingw32.cmake" -DCAIRN_BUILD_TESTS=OFF \
    -DCAIRN_BUILD_EXAMPLES=OFF "-DCMAKE_FIND_ROOT_PATH=$headers"
  cmake --build "$build" --parallel "$jobs" --target "${targets[@]}"
  local library name parts_of_dll foreign program wine
  wine=$(command -v wine64 || command -v wine || true)
  for library in "${libraries[@]}"; do
    name=${library#*:}
    parts_of_dll=$(x86_64-w64-mingw32-objdump -p "$build/bin/$name.dll")
    awk '/Ordinal\/Name Pointer/ {on = 1; next} on && !NF {on = 0} on {print $NF}' <<<"$parts_of_dll" |
      same_symbols "$root/src/${library%:*}/symbols.txt" "$name.dll"
    foreign=$(awk '/DLL Name:/ && tolower($3) !~ /^(kernel32|msvcrt)\.dll$/ {print $3}' <<<"$parts_of_dll")
    [[ -z $foreign ]] || fail "$name.dll needs $foreign, which not every Windows has"
    # The caller in C that the test of the installed library uses, too.
    if [[ $name == libcairn ]]; then program=consumer; else program=simulation; fi
    x86_64-w64-mingw32-gcc-posix -std=c99 -O1 "${strict[@]}" "$root/tests/install/consumer/$program.c" \
      "$build/lib/$name.dll.a" -o "$build/bin/$program.exe" || fail "$program.c with the import library of $name.dll"
    x86_64-w64-mingw32-objdump -p "$build/bin/$program.exe" | grep -q "DLL Name: $name.dll" ||
      fail "$program.exe does not load $name.dll"
    echo "ok: $name.dll needs only what Windows has, and $program.c links to it"
    if [[ -n $wine ]]; then
      WINEDEBUG=-all "$wine" "$build/bin/$program.exe" || fail "$program.exe under Wine, exit $?"
    else
      echo "skipped: running $program.exe, for there is no Wine here"
    fi
  done
}

# A compiler without vector types gets the loops of linear/lanes.hpp: GCC compiles them here.
part_plain() {
  need_packages g++=g++ libeigen3-dev doctest-dev
  local compiler=(g++ -O0 -DCAIRN_PLAIN_LANES)
  rooms_program plain core linear
  "$out/plain/plain"
}

# The warnings of clang. With --short it only reads the library, and makes no code from it.
part_clang() {
  need_packages cmake=cmake ninja-build=ninja clang=clang g++=g++ libeigen3-dev libnanoflann-dev doctest-dev \
    libcmocka-dev python3
  local build=$out/clang clang=(-DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++)
  if $short; then
    configure "$build-short" "${options[@]}" "${clang[@]}" -DCAIRN_BUILD_TESTS=OFF -DCAIRN_PRECOMPILED_HEADERS=OFF \
      -DCMAKE_CXX_FLAGS_RELEASE=-fsyntax-only -DCMAKE_CXX_COMPILER_LAUNCHER=
    cmake --build "$build-short" --parallel "$jobs" --target cairn_objects
    return
  fi
  configure "$build" "${options[@]}" "${clang[@]}"
  cmake --build "$build" --parallel "$jobs"
  ctest --test-dir "$build" --output-on-failure --no-tests=error -R '^(unit|golden|api/pins|capi_status|sim_options)'
}

for part in "${parts[@]}"; do
  say "$part"
  "part_$part"
done
say "All of it passed in $SECONDS s: ${parts[*]}"
