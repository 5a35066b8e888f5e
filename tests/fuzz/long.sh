#!/usr/bin/env bash
# Runs tests/fuzz/api_fuzz with one seed after another until the time is up. Ends at the first failure, whose message
# names seed and call: the same arguments reproduce it.
#
#   tests/fuzz/long.sh API_FUZZ SECONDS [FIRST_SEED [CALLS [LIMIT]]]
set -euo pipefail

if (($# < 2 || $# > 5)); then
  echo "usage: $0 API_FUZZ SECONDS [FIRST_SEED [CALLS [LIMIT]]]" >&2
  exit 2
fi
program=$1 seconds=$2 first=${3:-1} calls=${4:-20000}
numbers=("${@:5}")
seed=$first
while ((SECONDS < seconds)); do
  "$program" "$seed" "$calls" "${numbers[@]}"
  seed=$((seed + 1))
done
echo "$((seed - first)) seeds from $first on, $calls calls each: nothing found"
