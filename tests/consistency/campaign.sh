#!/usr/bin/env bash
# Runs tests/consistency/monte_carlo over all of its rows and prints one table: final error, ANEES per degree of freedom
# and the share of times inside the 95 % band, for both error states, for submaps with both joinings, and for dead
# reckoning. For submaps it also prints the ratio of the final error to that of the single invariant map.
#
#   tests/consistency/campaign.sh MONTE_CARLO [RUNS [SEED [OPTION...]]]
#
# MONTE_CARLO is the program consistency_monte_carlo of a build; the default is 50 runs from seed 1. Its options are:
# --iterations N, --gated.
set -euo pipefail

if (($# < 1)); then
  echo "usage: $0 MONTE_CARLO [RUNS [SEED [OPTION...]]]" >&2
  exit 2
fi
program=$1 runs=${2:-50} seed=${3:-1}
options=("${@:4}")

echo "Final pose RMSE (m / deg), ANEES/6 [% of instants in its band], against the single map; $runs runs."
echo
echo "| velocity, rate, laps, submaps | dead reckoning | standard | invariant | dense submaps | sparse submaps |"
echo "|---|---|---|---|---|---|"
for row in 1 2 3 4; do
  "$program" --row "$row" --runs "$runs" --seed "$seed" "${options[@]}" | awk '
    function filter(first) { return $first "/" $(first + 1) ", " $(first + 2) " [" $(first + 3) + 0 "]" }
    function submaps() { return filter(3) ", " $9 "/" $11 }
    /^row/ { name = $3 " m/s, " $5 " deg/s, " $7 ", " $11; sub(/,$/, "", name) }
    /^dead/ { dead = $3 "/" $4 }
    /^standard/ { standard = filter(2) }
    /^invariant/ { invariant = filter(2) }
    /^dense/ { dense = submaps() }
    /^sparse/ { sparse = submaps() }
    END { printf "| %s | %s | %s | %s | %s | %s |\n", name, dead, standard, invariant, dense, sparse }'
done
