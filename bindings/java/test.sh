#!/usr/bin/env bash
# Tests the Java module as CI does: builds and installs it with Maven, runs its tests (conformance with C, errors,
# threads, leaks, time), makes its documentation without warnings, and runs a fresh project that depends on it.
# test.sh [BUILD]. BUILD is a build tree of the library; what it lacks is built. All results stay in BUILD/java.
set -euo pipefail
# shellcheck source=../../tests/support/setup.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../../tests/support/setup.sh"

(($# <= 1)) || fail "usage: test.sh [BUILD]"
need_packages cmake=cmake g++=g++ gcc=gcc ninja-build=ninja libeigen3-dev libnanoflann-dev nlohmann-json3-dev libcmocka-dev \
  doctest-dev python3=python3 openjdk-17-jdk-headless=javac maven=mvn ca-certificates-java=mvn

built_library "$@"
work=$build/java
mkdir -p "$work"
rm -rf -- "$work/fixtures" "$work/consumer" "$work/conformance_of_c"
same_libraries "$build" "$work/lib"
before=$(find "$root/bindings/java" | sort)

# CI leaves nothing in the user's repository of Maven but what was downloaded.
grep -q "<version>$version</version>" "$root/bindings/java/pom.xml" || fail "pom.xml has another version than api.json"
installed=${HOME:-/root}/.m2/repository/org/cairnslam
if [[ ! -e $installed ]]; then trap 'rm -rf -- "$installed"' EXIT; fi
maven=(mvn -B -q -Dmaven.wagon.http.retryHandler.count=5)

say "Conformance: what C answers"
# Whether C agrees with the recorded values is for another test (ctest -R conformance); here its bits are wanted.
LD_LIBRARY_PATH=$build/lib "$build/bin/cairn_conformance" "$root/tests/conformance" "$work/conformance_of_c" \
  >"$work/replay.log" 2>&1 || echo "the C replayer says: $(tail -n 1 "$work/replay.log")"

# Libraries that the module must refuse, and the sequence whose time is compared with that of C.
mkdir -p "$work"/fixtures/{none,older,other,lacking}
compile=(cc -shared -fPIC -O2 -Wall -Wextra -Werror)
"${compile[@]}" -DVERSION='"0.1.0"' "$root/bindings/java/src/test/c/old.c" -o "$work/fixtures/older/libcairn.so"
"${compile[@]}" -DVERSION='"0.9.3"' -DNUMBER=903 "$root/bindings/java/src/test/c/old.c" -o "$work/fixtures/other/$soname"
number=$(sed -n 's/^ "version_number": \(.*\),$/\1/p' "$root/src/api/api.json")
"${compile[@]}" -DVERSION="\"$version\"" -DNUMBER="$number" "$root/bindings/java/src/test/c/old.c" \
  -o "$work/fixtures/lacking/$soname"
"${compile[@]}" -I"$root/include" "$root/bindings/java/src/test/c/timing.c" -o "$work/fixtures/libtiming.so" \
  -L"$build/lib" -lcairn -Wl,-rpath,"$build/lib"

say "mvn install: javac -Xlint:all -Werror, tests, javadoc"
"${maven[@]}" -f "$root/bindings/java" install -Dcairn.build="$work/target" -Dcairn.root="$root" \
  -Dcairn.lib="$work/lib" -Dcairn.replayed="$work/conformance_of_c" -Dcairn.fixtures="$work/fixtures" ||
  fail "the module does not build, or a test failed"
# skipped: what surefire counted as skipped. Nothing may be, for everything that tests need was made above.
skipped=$(cat "$work"/target/surefire-reports/*.txt | sed -n 's/.*Skipped: \([0-9]*\).*/\1/p' | paste -sd+ | sed 's/^$/1/')
tests=$(cat "$work"/target/surefire-reports/*.txt | sed -n 's/.*Tests run: \([0-9]*\),.*/\1/p' | paste -sd+)
echo "$((tests)) tests, $((skipped)) skipped"
((skipped == 0)) || fail "tests were skipped"

say "The sources are generated the same way twice"
/usr/bin/env python3 -B "$root/bindings/java/generate.py" "$root/src/api/api.json" "$work/again"
diff -r "$work/again" "$work/target/generated-sources/cairn" || fail "generate.py gives other sources than Maven's build"

say "A fresh project"
cp -r -- "$root/bindings/java/example" "$work/consumer"
"${maven[@]}" -f "$work/consumer" compile exec:java -Djna.library.path="$work/lib" | tee "$work/consumer.log"
grep -q 'Pose\[position=.* landmarks' "$work/consumer.log" || fail "the example did not say where the rover is"
# README shows the same lines, less indented.
sed -n '/README: from here/,/README: to here/p' "$work/consumer/src/main/java/Rover.java" | sed '1d;$d;s/^    //' \
  >"$work/lines"
python3 - "$work/lines" "$root/bindings/java/README.md" <<'END' || fail "README.md shows another example than Rover.java"
import sys
lines, page = (open(name, encoding="utf-8").read() for name in sys.argv[1:])
sys.exit(lines not in page)
END

[[ $before == "$(find "$root/bindings/java" | sort)" ]] || fail "the test left files in bindings/java"
say "Java: all well"
