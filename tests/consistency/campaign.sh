#!/usr/bin/env bash
# Runs tests/consistency/monte_carlo over all of its rows and prints one table: final error, ANEES per degree of freedom
# and the share of instants inside the 95 % band of both kinds of error, next to dead reckoning.
#
#   tests/consistency/campaign.sh MONTE_CARLO [RUNS [SEED [ITERATIONS]]]
#
# MONTE_CARLO is the program consistency_monte_carlo of a build; 50 runs from seed 1, the filter's own iterations.
set -euo pipefail

if (($# < 1 || $# > 4)); then
  echo "usage: $0 MONTE_CARLO [RUNS [SEED [ITERATIONS]]]" >&2
  exit 2
fi
program=$1 runs=${2:-50} seed=${3:-1}
arguments=(--runs "$runs" --seed "$seed")
if (($# == 4)); then arguments+=(--iterations "$4"); fi

echo "Final pose RMSE (m / deg), ANEES/6 [% of instants in its band], NIS/dof; $runs runs."
echo
echo "| velocity, rate, laps | dead reckoning | standard | invariant | NIS/dof |"
echo "|---|---|---|---|---|"
for row in 1 2 3 4; do
  "$program" --row "$row" "${arguments[@]}" | awk '
    /^row/ { name = $3 " m/s, " $5 " deg/s, " $7; sub(/;.*/, "", name) }
    /^dead/ { dead = $3 "/" $4 }
    /^invariant/ { invariant = $2 "/" $3 ", " $4 " [" $5 + 0 "]"; nis = $6 " [" $7 + 0 "]" }
    /^standard/ { standard = $2 "/" $3 ", " $4 " [" $5 + 0 "]" }
    END { printf "| %s | %s | %s | %s | %s |\n", name, dead, standard, invariant, nis }'
done
