#!/usr/bin/env bash
# Tests the package: test.sh [BUILD_DIR]. BUILD_DIR (build/check of the project by default) holds the built library in lib
# and the C replayer bin/cairn_conformance. Installs Debian's Go if there is none. Everything that is built goes to
# BUILD_DIR/bindings/go and to Go's own cache; the package needs no network.
set -euo pipefail
here=$(CDPATH='' cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
# shellcheck source=../../tests/support/setup.sh
source "$here/../../tests/support/setup.sh"
build=$(CDPATH='' cd -- "${1:-$root/build/check}" && pwd -P)
work=$build/bindings/go
mkdir -p "$work"

need_packages golang-go=go gcc=cc pkgconf=pkg-config python3=python3

# describe FOLDER INCLUDE: what pkg-config reads of an installed library, for the one in BUILD_DIR with these headers.
describe() {
  local name
  mkdir -p "$1"
  for name in cairn cairn-sim; do
    printf 'Name: %s\nDescription: Cairn of a build folder\nVersion: 0\nCflags: -I%s\nLibs: -L%s -l%s\n' \
      "$name" "$2" "$build/lib" "${name/-/_}" >"$1/$name.pc"
  done
}
describe "$work/pkgconfig" "$root/include"
export PKG_CONFIG_PATH=$work/pkgconfig LD_LIBRARY_PATH=$build/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
export GOFLAGS=-mod=mod GOPROXY=off GOTOOLCHAIN=local
# Go's cache knows these variables, but neither what pkg-config says nor what is in the headers.
headers=$(cat "$root"/include/cairn/*.h | sha256sum)
export CGO_CPPFLAGS="-DCAIRN_GO_HEADERS=${headers:0:16}" CGO_LDFLAGS="-L$build/lib"
cd "$here"

# The files here that differ from those of git, or nothing outside of a checkout.
sources() { git -C "$here" status --porcelain -- . 2>/dev/null || true; }
before=$(sources)

say "Generated files, and what the package lacks of the interface"
python3 generate.py --check

say "Style: $(go version)"
unformatted=$(gofmt -l .)
[[ -z $unformatted ]] || fail "gofmt would change $unformatted"
go vet ./...
go vet -tags cairn_nosim .

say "Tests under the race detector, with the conformance scenarios to the last bit"
[[ -x $build/bin/cairn_conformance ]] || fail "$build/bin/cairn_conformance is missing: build the target cairn_conformance"
mkdir -p "$work/conformance"
# --record: its own comparison is a test of the library, not of this package.
"$build/bin/cairn_conformance" --record "$root/tests/conformance" "$work/conformance" >"$work/conformance.log" 2>&1 ||
  fail "the C replayer failed: see $work/conformance.log"
go_test() {
  if ! CAIRN_CONFORMANCE=$root/tests/conformance CAIRN_CONFORMANCE_OUTPUT=$work/conformance \
    go test -count=1 -timeout 500s -v "$@" . >"$work/tests.log" 2>&1; then
    grep -vE '^ *(=== |--- PASS)' "$work/tests.log" >&2
    fail "the tests failed: go test $*"
  fi
  grep -E 'the same bits|memory has grown' "$work/tests.log" || fail "no test said what it has compared: see $work/tests.log"
}
go_test -race -short

say "Leaks"
go_test -run TestMemory

say "An update beside the same update in C"
go run ./internal/timing

say "A fresh project with the README's first example"
fresh=$work/fresh
rm -rf -- "${fresh:?}"
mkdir -p "$fresh"
awk '/^```/ { inside = /^```go/; next } inside' README.md >"$fresh/main.go"
(
  cd "$fresh"
  go mod init rover 2>/dev/null
  go mod edit -require=cairn@v0.2.0 -replace="cairn=$here"
  go build -o rover .
  ./rover
)

say "What a missing or another library says"
mkdir -p "$work/none" "$work/old/cairn"
refuses 'libcairn.so.0.2' env LD_LIBRARY_PATH="$work/none" "$fresh/rover"
echo 'unsigned cairn_version_number(void) { return 100; } const char *cairn_version(void) { return "0.1.0"; }' |
  cc -shared -fPIC -x c - -o "$work/old/version.so"
refuses 'the Go package cairn 0.2 needs libcairn 0.2, but libcairn 0.1.0 is loaded' \
  env LD_PRELOAD="$work/old/version.so" "$fresh/rover"
# Headers of version 0.3 behind those of this version's names.
cp -r "$root/include/cairn" "$work/old"
describe "$work/old/pkgconfig" "$work/old"
sed -i -E 's/(define CAIRN_VERSION_MINOR +)[0-9]+/\13/' "$work/old/cairn/export.h"
refuses 'the Go package cairn 0.2 needs libcairn 0.2, but these headers are of libcairn 0.3' \
  env PKG_CONFIG_PATH="$work/old/pkgconfig" CGO_CPPFLAGS="-DCAIRN_GO_HEADERS=old" go build -o "$work/refused" "$here"
mkdir -p "$work/empty"
refuses "Package 'cairn'" \
  env PKG_CONFIG_PATH= PKG_CONFIG_LIBDIR="$work/empty" CGO_CPPFLAGS="-DCAIRN_GO_HEADERS=none" \
  go build -o "$work/refused" "$here"

[[ $(sources) == "$before" ]] || fail "the tests changed the sources: $(sources)"
say "The package passes"
