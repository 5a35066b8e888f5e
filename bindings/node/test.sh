#!/usr/bin/env bash
# Tests the npm package as CI does: makes it, installs it in a fresh project, and tests there what was installed: its
# own tests, the conformance scenarios, leaks, time. test.sh [BUILD]. BUILD is a build tree of the library; what it lacks
# is built. All results stay in BUILD/node-package.
set -euo pipefail
# shellcheck source=../../tests/support/setup.sh
source "$(dirname -- "${BASH_SOURCE[0]}")/../../tests/support/setup.sh"

(($# <= 1)) || fail "usage: test.sh [BUILD]"
need_packages cmake=cmake g++=g++ gcc=gcc ninja-build=ninja libeigen3-dev libnanoflann-dev nlohmann-json3-dev \
  libcmocka-dev doctest-dev python3=python3 nodejs=node npm=npm

built_library "$@"
work=$build/node-package
package=$work/tree/bindings/node
project=$work/project
mkdir -p "$package" "$work/tree/src/api"
same_libraries "$build" "$work/lib"
export CAIRN_LIBRARY=$work/lib npm_config_audit=false npm_config_fund=false npm_config_update_notifier=false
unset NODE_PATH NODE_OPTIONS
before=$(find "$root/bindings/node" | sort)

say "The package: $(node --version), npm $(npm --version)"
# Everything but the modules that are there already is copied anew; the sources stay as they are.
find "$package" -mindepth 1 -maxdepth 1 -not -name node_modules -exec rm -rf -- {} +
tar -C "$root/bindings/node" --exclude=./node_modules --exclude=./dist -cf - . | tar -C "$package" -xf -
cp -- "$root/src/api/api.json" "$work/tree/src/api"
if ! cmp -s "$package/package-lock.json" "$work/installed-lock.json"; then
  (cd -- "$package" && npm ci --ignore-scripts)
  cp -- "$package/package-lock.json" "$work/installed-lock.json"
fi
(cd -- "$package" && npm pack --silent)
tarball=$(find "$package" -maxdepth 1 -name '*.tgz')
tar -tzf "$tarball" >"$work/files"
for file in dist/index.js dist/index.d.ts README.md LICENSE; do
  grep -qxF "package/$file" "$work/files" || fail "the package lacks $file"
done
echo "${tarball##*/}: $(wc -l <"$work/files") files"

say "A fresh project installs it"
rm -rf -- "$project"
mkdir -p "$project"
(cd -- "$project" && npm init --yes >/dev/null && npm pkg set type=module && npm install --prefer-offline "$tarball")

say "Types (tsc, strict) and lints (eslint)"
cp -R -- "$package/test" "$project/test"
cp -- "$package/tsconfig.json" "$project"
(cd -- "$project" && "$package/node_modules/.bin/tsc" --project test --typeRoots "$package/node_modules/@types")
(cd -- "$package" && npm run --silent lint)
echo "no complaint"

# Libraries of other versions, and one that lacks functions.
other() {
  mkdir -p "$work/others/$1"
  gcc -shared -fPIC "-DVERSION=\"$1\"" "${@:2}" "$package/test/other.c" -o "$work/others/$1/$soname"
}
other 0.1.1
other 0.3.0 -DNUMBER=300
other "$version" "-DNUMBER=$(sed -n 's/^ *"version_number": \([0-9]*\).*/\1/p' "$root/src/api/api.json")"

say "Tests"
export CAIRN_TEST_README=$root/bindings/node/README.md CAIRN_TEST_OTHERS=$work/others
export CAIRN_TEST_API=$root/src/api/api.json
(cd -- "$project" && node --expose-gc --test dist-test/binding.test.js dist-test/leak.test.js) \
  >"$work/tests.log" 2>&1 || {
  cat "$work/tests.log"
  fail "the tests failed"
}
grep -E '^# (pass|fail|closed|forgotten)' "$work/tests.log"

say "Conformance: the same bits as C"
# Whether C agrees with the recorded values is for another test; here its bits are wanted.
(cd / && "$build/bin/cairn_conformance" "$root/tests/conformance" "$work/conformance_of_c") >"$work/replay.log" 2>&1 ||
  echo "the C replayer says: $(tail -n 1 "$work/replay.log")"
(cd -- "$project" && node dist-test/conformance.js "$root/tests/conformance" "$work/conformance_of_c" \
  "$root/src/api/api.json" "$work/names")
python3 -B "$root/src/api/bindings_check.py" "$root/src/api/api.json" "$work/names"

say "An update beside the same update in C"
gcc -O2 -Wall -Wextra -Werror -I"$root/include" "$package/test/update.c" -o "$work/update" -L"$build/lib" -lcairn \
  -Wl,-rpath,"$build/lib"
(cd -- "$project" && node dist-test/timing.js "$work/update")

[[ $(find "$root/bindings/node" | sort) == "$before" ]] || fail "files were left in $root/bindings/node"
