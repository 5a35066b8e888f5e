#!/usr/bin/env bash
# Systematic errors as states, over many worlds: the two tables of docs/systematic_errors.md.
#
#   tests/consistency/systematic_campaign.sh PROGRAM [RUNS [SEED]]
#
# PROGRAM is consistency_systematic of a build; the default is 50 worlds from seed 1. It fails if an error is more than
# 1.5 times that of a rover without errors, or if the ANEES is outside its band at more than a tenth of the times.
# A rover with a rate bias misses these bounds: the Cramer-Rao bound of its error is 4.7 times that of a rover without
# errors. docs/systematic_errors.md has the figures.
set -euo pipefail

if (($# < 1)); then
  echo "usage: $0 PROGRAM [RUNS [SEED]]" >&2
  exit 2
fi
program=$1 runs=${2:-50} seed=${3:-1}
failed=0
"$program" --runs "$runs" --seed "$seed" --check 1.5 || failed=1
echo
"$program" --wheels --runs "$runs" --seed "$seed" --check 1.5 || failed=1
exit "$failed"
