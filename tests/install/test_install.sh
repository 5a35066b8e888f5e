#!/usr/bin/env bash
# Installs a build tree to a place with spaces in its path and uses it as a stranger would.
# test_install.sh SOURCE BUILD CMAKE GENERATOR CC CXX
set -euo pipefail

source_dir=$1 build_dir=$2 cmake=$3 generator=$4 cc=$5 cxx=$6
here=$source_dir/tests/install
work=$(mktemp -d "${TMPDIR:-/tmp}/cairn install.XXXXXX")
trap 'rm -rf -- "$work"' EXIT
prefix="$work/a prefix"

pass() { printf 'ok: %s\n' "$*"; }
skip() { printf 'skipped: %s\n' "$*"; }
fail() {
  printf 'FAILED: %s\n' "$*" >&2
  exit 1
}

# same FILE FILE WHAT: both lists are equal, or the difference is told.
same() {
  diff -u "$1" "$2" || fail "$3"
}

"$cmake" --install "$build_dir" --prefix "$prefix" >"$work/install.log" || { cat "$work/install.log"; fail "install"; }
# GNUInstallDirs decides where the library goes: lib, lib64, lib/x86_64-linux-gnu.
library=$(find "$prefix" -path '*/glibc-hwcaps' -prune -o -name libcairn.so -print)
[[ -n $library ]] || fail "libcairn.so was not installed"
libdir=$(dirname -- "$library")
version=$(sed -n 's/^Version: //p' "$libdir/pkgconfig/cairn.pc")
# Before 1.0 the SONAME has the minor version too.
soversion=${version%.*}
[[ $version == 0.* ]] || soversion=${version%%.*}

# # The installed files.
for file in "$libdir/libcairn.so.$soversion" "$libdir/libcairn.so.$version" "$prefix/include/cairn/cairn.h" \
  "$libdir/libcairn_sim.so" "$libdir/libcairn_sim.so.$soversion" "$libdir/libcairn_sim.so.$version" \
  "$libdir/cmake/cairn/cairnConfig.cmake" "$libdir/cmake/cairn/cairnConfigVersion.cmake" \
  "$prefix/share/doc/cairn/LICENSE" "$prefix/share/doc/cairn/README.md" "$prefix/share/cairn/api.json"; do
  [[ -f $file ]] || fail "missing: ${file#"$prefix/"}"
done
libraries=("$libdir/libcairn.so.$version")
hwcaps=$libdir/glibc-hwcaps/x86-64-v3
if [[ -f $hwcaps/libcairn.so.$version ]]; then
  [[ -f $hwcaps/libcairn.so.$soversion ]] || fail "the x86-64-v3 build lacks its soname"
  [[ -f $hwcaps/libcairn.so ]] || fail "the x86-64-v3 build lacks the name that dlopen(\"libcairn.so\") looks for"
  libraries+=("$hwcaps/libcairn.so.$version")
fi
if grep -rIlF -e "$source_dir/" -e "$build_dir/" "$prefix/include" "$libdir/cmake" "$libdir/pkgconfig"; then
  fail "the files above name the source or build folder"
fi
pass "the tree: version $version, ${#libraries[@]} build(s) of the library"

# Each header by itself, in both languages.
mapfile -d '' -t headers < <(cd -- "$prefix/include" && find cairn -name '*.h' -print0 | sort -z)
strict=(-Wall -Wextra -pedantic -Werror -fsyntax-only -I"$prefix/include")
for header in "${headers[@]}"; do
  printf '#include <%s>\n#include <%s>\ntypedef int not_empty;\n' "$header" "$header" >"$work/alone.c"
  "$cc" -std=c99 "${strict[@]}" "$work/alone.c" || fail "$header alone as C99"
  "$cxx" -std=c++17 -x c++ "${strict[@]}" "$work/alone.c" || fail "$header alone as C++17"
done
pass "${#headers[@]} headers, each alone as C99 and as C++17"
for header in cairn/cairn.hpp cairn/sim.hpp; do
  printf '#include <%s>\n#include <%s>\nint main() {}\n' "$header" "$header" >"$work/alone.cpp"
  "$cxx" -std=c++17 "${strict[@]}" "$work/alone.cpp" || fail "$header alone as C++17"
done
pass "the headers of C++"

# The lines of C that the README opens with are true.
awk '/^```c$/ {on = 1; next} /^```$/ && on {exit} on' "$prefix/share/doc/cairn/README.md" >"$work/readme.txt"
{
  grep '^#include' "$work/readme.txt"
  echo 'cairn_status readme(double dt, double left_rad_per_s, double right_rad_per_s, const double centre[3],'
  echo '  const cairn_observation *observations, size_t count, cairn_match *matches,'
  echo '  cairn_landmark *landmarks, size_t capacity, size_t needed) {'
  grep -v '^#include' "$work/readme.txt"
  echo 'return status; }'
} >"$work/readme.c"
"$cc" -std=c99 "${strict[@]}" -Wno-unused-but-set-parameter "$work/readme.c" || fail "the README's lines of C"
pass "the README's lines of C compile"
awk '/^```cpp$/ {on = 1; next} /^```$/ && on {exit} on' "$prefix/share/doc/cairn/README.md" >"$work/readme.txt"
{
  grep '^#include' "$work/readme.txt"
  echo 'int main() {'
  grep -v '^#include' "$work/readme.txt"
  echo 'static_cast<void>(pose), static_cast<void>(covariance); }'
} >"$work/readme.cpp"
"$cxx" -std=c++17 "${strict[@]}" -Wno-unused-variable "$work/readme.cpp" || fail "the README's lines of C++"
pass "the README's lines of C++ compile"

# The symbols: what the headers promise, what the committed list says, and nothing else.
symbols() { nm -D --defined-only "$1" | awk '$2 != "A" {print $3}' | LC_ALL=C sort; }
committed() { awk '!/^#/ && NF' "$@" | LC_ALL=C sort; }
committed "$source_dir/src/cairn/capi/symbols.txt" >"$work/committed"
committed "$source_dir/src/sim/symbols.txt" >"$work/committed_sim"
for file in "${libraries[@]}"; do
  symbols "$file" >"$work/exported"
  same "$work/committed" "$work/exported" "exported symbols of ${file#"$prefix/"} differ from src/cairn/capi/symbols.txt"
done
symbols "$libdir/libcairn_sim.so.$version" >"$work/exported"
same "$work/committed_sim" "$work/exported" "exported symbols of libcairn_sim differ from src/sim/symbols.txt"
for header in "${headers[@]}"; do
  "$cc" -std=c99 -E -P -I"$prefix/include" "$prefix/include/$header"
done | grep -o '\<cairn_[a-z0-9_]* *(' | tr -d ' (' | LC_ALL=C sort -u >"$work/declared"
sed 's/@.*//' "$work/committed" "$work/committed_sim" | LC_ALL=C sort >"$work/names"
same "$work/declared" "$work/names" "the headers' functions differ from src/cairn/capi/symbols.txt and src/sim/symbols.txt"
pass "$(wc -l <"$work/names") symbols, as committed and as declared"

# The libraries need only the C and C++ runtime.
for file in "${libraries[@]}" "$libdir/libcairn_sim.so.$version"; do
  foreign=$(ldd "$file" | awk '{print $1}' |
    grep -vE '^(linux-(vdso|gate)\.so\.1|lib(stdc\+\+|m|gcc_s|c)\.so\.[0-9]+|.*/ld-linux[^/]*)$' || true)
  [[ -z $foreign ]] || fail "${file#"$prefix/"} needs $foreign"
done
pass "needs the C and C++ runtime only"

# (a) C99 by pkg-config. Its output is quoted for the shell, since the path has spaces.
export PKG_CONFIG_PATH=$libdir/pkgconfig
pkg_config=$(command -v pkg-config || command -v pkgconf) || fail "no pkg-config"
read_flags() { eval "flags=($("$pkg_config" "$@" cairn))"; }
flags=()
build_consumer() {
  local output=$1
  shift
  read_flags --cflags --libs
  "$cc" -std=c99 -O2 -Wall -Wextra -pedantic -Werror "$@" "$here/consumer/consumer.c" "${flags[@]}" -o "$output" ||
    fail "consumer by pkg-config with flags: $*"
}
[[ $("$pkg_config" --modversion cairn) == "$version" ]] || fail "pkg-config --modversion"
build_consumer "$work/by_pkgconfig"
picked=$(LD_LIBRARY_PATH=$libdir "$work/by_pkgconfig") || fail "the consumer by pkg-config, exit $?"
pass "C99 consumer by pkg-config: $picked"
eval "flags=($("$pkg_config" --cflags --libs cairn-sim))"
"$cc" -std=c99 -O2 -Wall -Wextra -pedantic -Werror "$here/consumer/simulation.c" "${flags[@]}" -o "$work/simulation" ||
  fail "simulation by pkg-config"
LD_LIBRARY_PATH=$libdir "$work/simulation" >"$work/drive" || fail "the simulation by pkg-config, exit $?"
pass "C99 simulation by pkg-config cairn-sim: $(cat "$work/drive")"

# (b) C++17 by find_package, with a range of versions and a component.
configure_consumer() {
  local folder=$1
  shift
  "$cmake" -S "$here/consumer" -B "$folder" -G "$generator" -DCMAKE_PREFIX_PATH="$prefix" \
    -DCMAKE_CXX_COMPILER="$cxx" -DCMAKE_BUILD_TYPE=Release "$@"
}
by_cmake() { configure_consumer "$work/by cmake" && "$cmake" --build "$work/by cmake"; }
by_cmake >"$work/cmake.log" 2>&1 || { cat "$work/cmake.log"; fail "consumer by find_package"; }
printed=$("$work/by cmake/consumer") || fail "the consumer by find_package, exit $?"
[[ $printed == "$picked" ]] || fail "the consumers were given different builds: $picked, $printed"
pass "C++17 consumer by find_package: $printed"
printed=$("$work/by cmake/simulation") || fail "the simulation by find_package, exit $?"
[[ $printed == "$(cat "$work/drive")" ]] || fail "two drives of one seed differ: $printed, $(cat "$work/drive")"
pass "C++17 simulation by find_package: $printed"

# The next minor version, counted from the installed one: the tests outlive a change of the version.
rest=${version#*.}
major=${version%%.*} minor=${rest%%.*}
accepted() {
  configure_consumer "$work/asked" "-DCONSUMER_VERSION=$1" "-DCONSUMER_COMPONENTS=$2" >"$work/asked.log" 2>&1
}
for asked in "$major.$minor" "$version" "$major.$minor...<$major.$((minor + 1))" "0.0...$((major + 1))"; do
  accepted "$asked" "cairn;sim" || { cat "$work/asked.log"; fail "find_package refuses version $asked"; }
done
for asked in "$major.$((minor + 1))" "$((major + 1)).0" "$major.$minor.999" "0.0...<$version" \
  "$major.$((minor + 1))...$((major + 1))"; do
  if accepted "$asked" sim; then fail "find_package takes version $asked, but $version is installed"; fi
  grep -q "version: $version" "$work/asked.log" || { cat "$work/asked.log"; fail "no word of the installed version"; }
done
if accepted "$version" "sim;radar"; then fail "find_package takes the component radar"; fi
tr -s ' \n' ' ' <"$work/asked.log" >"$work/asked.txt"
grep -q "cairn has no component 'radar'. The installed components are: cairn, sim" "$work/asked.txt" ||
  { cat "$work/asked.log"; fail "the refusal of a component does not name it"; }
pass "find_package: ranges of versions, components, refusals"

# A program that opens the development name at run time, like many bindings do.
"$cc" -std=c99 -O2 -Wall -Wextra -pedantic -Werror "$here/consumer/by_name.c" -ldl -o "$work/by_name" || fail "by_name.c"
printed=$(LD_LIBRARY_PATH=$libdir "$work/by_name") || fail "the consumer by dlopen, exit $?"
[[ $printed == "$picked" ]] || fail "dlopen(\"libcairn.so\") gave $printed, linking gave $picked"
pass "dlopen(\"libcairn.so\"): $printed"

# (c) The static library: a program without any shared library, and one that links only libcairn this way.
if [[ -f $libdir/libcairn.a ]]; then
  for archive in libcairn libcairn_sim; do
    nm --defined-only --extern-only "$libdir/$archive.a" | awk 'NF == 3 {print $3}' | LC_ALL=C sort >"$work/exported"
    nm -D --defined-only "$libdir/$archive.so.$version" | awk '$2 != "A" {sub("@.*", "", $3); print $3}' |
      LC_ALL=C sort >"$work/names"
    same "$work/names" "$work/exported" "$archive.a and $archive.so differ in their global symbols"
  done
  read_flags --cflags --libs --static
  "$cc" -std=c99 -O2 -static "$here/consumer/consumer.c" "${flags[@]}" -o "$work/static" || fail "linking statically"
  if readelf -l "$work/static" | grep INTERP >/dev/null; then fail "the static program has a loader"; fi
  printed=$("$work/static") || fail "the static consumer, exit $?"
  pass "C99 consumer by pkg-config --static: $printed"
  # The same line with the archive in place of the shared library.
  for i in "${!flags[@]}"; do
    if [[ ${flags[i]} == -lcairn ]]; then flags[i]=-l:libcairn.a; fi
  done
  # Other code in the program has functions of the same names as the library has inside, and other meanings.
  "$cxx" -std=c++17 -O1 -c "$here/consumer/rival.cpp" -o "$work/rival.o" || fail "rival.cpp"
  "$cc" -std=c99 -O2 "$here/consumer/consumer.c" "$work/rival.o" "${flags[@]}" -o "$work/static" ||
    fail "linking libcairn.a beside C++ of other people"
  if ldd "$work/static" | grep libcairn; then fail "the program still needs libcairn.so"; fi
  [[ $("$work/static") == "$printed" ]] || fail "the consumer with libcairn.a beside C++ of other people"
  pass "libcairn.a beside C++ of other people: $printed"
  accepted "$version" "sim;static" || { cat "$work/asked.log"; fail "find_package refuses the component static"; }
  [[ $("$work/by cmake/static_consumer") == "$printed" ]] || fail "the consumer of cairn::static"
  pass "C++17 consumer of cairn::static by find_package: $printed"
else
  skip "no static library in this tree"
fi

# The loader picks the x86-64-v3 build where it is installed and the machine can, and the baseline where that is masked.
loader=$(readelf -l "$work/by_pkgconfig" | sed -n 's/.*program interpreter: \(.*\)\]/\1/p')
on_baseline() { LD_LIBRARY_PATH=$libdir "$loader" --glibc-hwcaps-mask none "$@"; }
if [[ $(uname -m) == x86_64 ]]; then
  if ((${#libraries[@]} == 2)); then
    printed=$(on_baseline "$work/by_pkgconfig") || fail "the consumer on the baseline build, exit $?"
    [[ $printed == "$version x86-64" ]] || fail "masked, the loader gave $printed"
    if "$loader" --help | grep -q 'x86-64-v3 (supported'; then
      [[ $picked == "$version x86-64-v3" ]] || fail "on a v3 machine the loader gave $picked"
      pass "the loader picks: $picked; masked: $printed"
    else
      [[ $picked == "$version x86-64" ]] || fail "on a machine without v3 the loader gave $picked"
      skip "this machine has no x86-64-v3 to pick that build for"
    fi
  else
    skip "no x86-64-v3 build in this tree"
  fi

  # (d) A caller compiled for wider vectors than the library: Eigen's layout depends on them, the C boundary must not.
  for flag in avx512f avx2 avx; do
    build_consumer "$work/wide" "-m$flag"
    if grep -qw "$flag" /proc/cpuinfo; then
      printed=$(on_baseline "$work/wide") || fail "a caller with -m$flag on the baseline build, exit $?"
      pass "caller with -m$flag on the baseline build: $printed"
    else
      skip "running a caller with -m$flag: it compiles and links, but this CPU has no $flag"
    fi
  done
  build_consumer "$work/wide" -march=native
  printed=$(on_baseline "$work/wide") || fail "a caller with -march=native on the baseline build, exit $?"
  pass "caller with -march=native on the baseline build: $printed"
else
  skip "the x86-64 part, on $(uname -m)"
fi

# A moved prefix still serves.
mv -- "$prefix" "$work/moved away"
prefix="$work/moved away"
libdir=$prefix/${libdir#"$work/a prefix/"}
export PKG_CONFIG_PATH=$libdir/pkgconfig
build_consumer "$work/after_move"
LD_LIBRARY_PATH=$libdir "$work/after_move" >/dev/null || fail "the consumer after a move, exit $?"
pass "pkg-config after a move of the prefix"

# The program and its manual page.
if [[ -x $prefix/bin/cairn ]]; then
  printed=$(env -u LD_LIBRARY_PATH "$prefix/bin/cairn" --version) || fail "cairn --version, exit $?"
  [[ $printed == *"$version"* ]] || fail "cairn --version says $printed, not $version"
  pass "cairn --version after a move of the prefix: $printed"
  [[ -f $prefix/share/man/man1/cairn.1 ]] || fail "no manual page"
  if command -v groff >/dev/null; then
    complaints=$(groff -man -Tutf8 -ww -z "$prefix/share/man/man1/cairn.1" 2>&1)
    [[ -z $complaints ]] || fail "manual page: $complaints"
    pass "the manual page, by groff"
  else
    skip "the manual page: no groff"
  fi
  if command -v mandoc >/dev/null; then
    mandoc -T lint -W warning "$prefix/share/man/man1/cairn.1" || fail "manual page, by mandoc"
    pass "the manual page, by mandoc"
  fi
else
  skip "the program: this tree was built without it"
fi
