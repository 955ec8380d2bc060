#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The table of runs on fixes in docs/estimation.md: paper-multiple with the receiver as the source of
# position, over so many seeds. Fails where anything is hit.
#   tests/measure/estimator.sh [SEEDS]
set -eu
. "$(dirname "$0")/common.sh"
seeds=${1:-50}

heading
printf '\n| sigma m | of %d: reached | hit | held or late | largest error of the estimate at the end m |\n' "$seeds"
echo '|---|---|---|---|---|'
for sigma in 0.5 1 2; do
  {
    cat "$here/../../hal_sim/scenarios/paper-multiple.toml"
    printf '\n[position]\nsource = "gps"\ngps_sigma_m = %s\n' "$sigma"
  } >"$place/on-fixes.toml"
  reached=0 hit=0 other=0 worst=0
  for ((seed = 1; seed <= seeds; seed++)); do
    sail "$place/on-fixes.toml" --lockstep --seed "$seed"
    case $(value outcome) in
      goal) reached=$((reached + 1)) ;;
      collision) hit=$((hit + 1)) ;;
      *) other=$((other + 1)) ;;
    esac
    worst=$(awk "BEGIN { e = $(value estimate_error_m); print (e > $worst ? e : $worst) }")
  done
  echo "| $sigma | $reached | $hit | $other | $(number 2 "$worst") |"
  [ "$hit" -eq 0 ] || broken "sigma $sigma m: $hit hit"
done
exit $failed
