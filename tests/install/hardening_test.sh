#!/usr/bin/env bash
# Looks for the flags of src/cmake/CairnHardening.cmake in built libraries.
# hardening_test.sh LIBRARY...
set -euo pipefail

failures=0
fail() {
  printf 'FAILED: %s: %s\n' "$file" "$*" >&2
  failures=$((failures + 1))
}
(($# > 0)) || { echo "usage: hardening_test.sh LIBRARY..." >&2; exit 2; }
for file; do
  segments=$(readelf -lW "$file") dynamic=$(readelf -dW "$file") notes=$(readelf -nW "$file")
  symbols=$(readelf -sW --dyn-syms "$file")
  [[ $segments == *GNU_RELRO* ]] || fail "no read-only relocations (GNU_RELRO)"
  [[ $dynamic == *BIND_NOW* ]] || fail "symbols are bound lazily, so the GOT stays writable (no BIND_NOW)"
  [[ $dynamic != *TEXTREL* ]] || fail "relocations in code (TEXTREL)"
  stack=$(awk '$1 == "GNU_STACK" {print $7}' <<<"$segments")
  [[ $stack == RW ]] || fail "the stack is executable (GNU_STACK is '$stack')"
  if awk '$1 == "LOAD" && /RWE/ {exit 1}' <<<"$segments"; then :; else fail "a segment is both writable and executable"; fi
  [[ $symbols == *__stack_chk_fail* ]] || fail "no stack protector (__stack_chk_fail)"
  grep -qE '__[a-z]*printf_chk' <<<"$symbols" || fail "libc's checked calls are missing (_FORTIFY_SOURCE)"
  # An x86-64 processor checks indirect branches and returns only where the library says that it is ready.
  if readelf -hW "$file" | grep 'Machine:.*X86-64' >/dev/null; then
    [[ $notes == *IBT* ]] || fail "indirect branch targets are not marked (no IBT)"
    [[ $notes == *SHSTK* ]] || fail "not ready for a shadow stack (no SHSTK)"
    # The note is a promise: whatever a caller can jump to begins with the mark,
    while read -r address name; do
      head=$(objdump -d --no-show-raw-insn "--start-address=0x$address" "--stop-address=$((16#$address + 4))" "$file")
      [[ $head == *endbr64* ]] || fail "$name does not begin with endbr64"
    done < <(nm -D --defined-only "$file" | awk '$2 == "T" {print $1, $3}')
    # and the dynamic section names no entry point without the mark.
    ! grep -qE '\((INIT|FINI)\)' <<<"$dynamic" || fail "has _init or _fini, which the system's start files do not mark"
  fi
done
((failures == 0)) || exit 1
echo "ok: $# hardened libraries"
