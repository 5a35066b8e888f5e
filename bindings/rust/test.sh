#!/usr/bin/env bash
# Tests the crates: test.sh [BUILD_DIR]. BUILD_DIR (build/check of the project by default) holds the built library in
# lib and the C replayer bin/cairn_conformance. Installs Debian's Rust if there is none. Everything that is built goes to
# BUILD_DIR/bindings/rust; the crates need no network.
set -euo pipefail
here=$(CDPATH='' cd -- "$(dirname -- "${BASH_SOURCE[0]}")" && pwd -P)
# shellcheck source=../../tests/support/setup.sh
source "$here/../../tests/support/setup.sh"
build=$(CDPATH='' cd -- "${1:-$root/build/check}" && pwd -P)
work=$build/bindings/rust
mkdir -p "$work"

need_packages pkgconf=pkg-config cargo=cargo rustc=rustc rust-clippy=cargo-clippy rustfmt=cargo-fmt gcc=cc python3=python3

export CAIRN_LIBRARY_DIR=$build/lib LD_LIBRARY_PATH=$build/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}
export CARGO_TARGET_DIR=$work/target CARGO_NET_OFFLINE=true CARGO_INCREMENTAL=0
cd "$here"

# The files here that differ from those of git, or nothing outside of a checkout.
sources() { git -C "$here" status --porcelain -- . 2>/dev/null || true; }
before=$(sources)

say "Generated files, and what the crate lacks of the interface"
python3 generate.py --check

say "Style and lints: $(cargo --version), $(rustc --version)"
cargo fmt --all --check
cargo clippy --locked --all-targets --quiet -- -D warnings
cargo clippy --locked --package cairn --no-default-features --quiet -- -D warnings
RUSTDOCFLAGS='-D warnings' cargo doc --locked --no-deps --package cairn-sys --package cairn --quiet

say "Tests, with the conformance scenarios to the last bit"
[[ -x $build/bin/cairn_conformance ]] ||
  fail "$build/bin/cairn_conformance is missing: build the target cairn_conformance"
mkdir -p "$work/conformance"
"$build/bin/cairn_conformance" "$root/tests/conformance" "$work/conformance" >"$work/conformance.log" 2>&1 ||
  fail "the C replayer failed: see $work/conformance.log"
if ! CAIRN_CONFORMANCE=$root/tests/conformance CAIRN_CONFORMANCE_OUTPUT=$work/conformance \
  cargo test --locked --package cairn-sys --package cairn --quiet -- --nocapture >"$work/tests.log" 2>&1; then
  cat "$work/tests.log" >&2
  fail "the tests failed"
fi
grep -E 'test result|KiB' "$work/tests.log"
grep -E '^[0-9]+ scenarios' "$work/tests.log" || fail "the conformance scenarios were skipped"

say "An update beside the same update in C"
cargo run --locked --release --package cairn-timing --quiet

say "A fresh project that installs the packages"
rm -rf -- "${work:?}/packages" "${work:?}/home" "$work/fresh"
mkdir -p "$work/packages" "$work/home"
for crate in cairn-sys cairn; do
  CARGO_HOME=$work/home cargo package --locked --no-verify --allow-dirty --quiet --package "$crate"
  version=$(sed -n 's/^version = "\(.*\)"/\1/p' "$crate/Cargo.toml")
  tar -xzf "$work/target/package/$crate-$version.crate" -C "$work/packages"
  echo '{"files":{},"package":null}' >"$work/packages/$crate-$version/.cargo-checksum.json"
  # From here on crates.io is this folder, which holds the packages.
  printf '[source.crates-io]\nreplace-with = "packages"\n[source.packages]\ndirectory = "%s"\n' \
    "$work/packages" >"$work/home/config.toml"
done
# The library is found as an installed one is: by pkg-config, whose files name the folder of the library here.
mkdir -p "$work/pkgconfig"
for module in cairn cairn-sim; do
  sed "s|^libdir=.*|libdir=$build/lib|" "$build/$module.pc" >"$work/pkgconfig/$module.pc"
done
(
  export CARGO_HOME=$work/home CARGO_TARGET_DIR=$work/fresh-target PKG_CONFIG_PATH=$work/pkgconfig
  unset CAIRN_LIBRARY_DIR
  cargo new --quiet --vcs none --name rover "$work/fresh"
  cd "$work/fresh"
  cargo add --quiet cairn
  cp "$here/cairn/examples/rover.rs" src/main.rs
  cargo run --quiet
)

say "What a missing or an older library says"
rover=$work/fresh-target/debug/rover
mkdir -p "$work/none" "$work/old"
touch "$work/old/libcairn.so" "$work/old/libcairn.so.0.1" "$work/old/libcairn_sim.so"
sys=(cargo check --locked --package cairn-sys --quiet)
needs="$version needs libcairn ${version%.*}"
refuses "cairn-sys $needs, but $work/none holds no libcairn" env CAIRN_LIBRARY_DIR="$work/none" "${sys[@]}"
refuses "cairn-sys $needs, but $work/old holds libcairn 0.1" env CAIRN_LIBRARY_DIR="$work/old" "${sys[@]}"
refuses "cairn-sys $needs, but pkg-config finds no cairn" \
  env -u CAIRN_LIBRARY_DIR PKG_CONFIG_LIBDIR="$work/none" "${sys[@]}"
refuses "libcairn.so.${version%.*}" env LD_LIBRARY_PATH="$work/none" "$rover"
echo 'unsigned cairn_version_number(void) { return 100; }' | cc -shared -fPIC -x c - -o "$work/old/version.so"
refuses "the crate cairn $needs, but libcairn 0.1.0 is loaded" \
  env LD_PRELOAD="$work/old/version.so" "$rover"

[[ $(sources) == "$before" ]] || fail "the tests changed the sources: $(sources)"
say "The crates pass"
