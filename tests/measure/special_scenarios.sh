#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The table of special scenarios in docs/scenarios.md: each with doubtful tracks over so many seeds.
# Fails where anything is hit, or where more than one in twenty of a row is not reached.
#   tests/measure/special_scenarios.sh [SEEDS]
set -eu
. "$(dirname "$0")/common.sh"
seeds=${1:-50}

heading
printf '\n| scenario | of %d: reached | held | hit |\n|---|---|---|---|\n' "$seeds"
for scenario in start-in-four-zones goal-abeam goal-astern goal-in-mover closing-channel ring-opens \
  wide-wall twenty-movers; do
  reached=0 held=0 hit=0 others=""
  for ((seed = 1; seed <= seeds; seed++)); do
    sail "$scenario" --lockstep --seed "$seed" --set tracks.place_sigma_m=0.05 \
      --set tracks.velocity_sigma_m_s=0.02 --set tracks.dropout=0.2
    outcome=$(value outcome)
    case $outcome in
      goal) reached=$((reached + 1)) && continue ;;
      held) held=$((held + 1)) ;;
      collision) hit=$((hit + 1)) ;;
    esac
    others="$others${others:+, }seed $seed: $outcome"
  done
  echo "| $scenario | $reached${others:+ ($others)} | $held | $hit |"
  [ "$hit" -eq 0 ] || broken "$scenario: $hit hit"
  [ $(((seeds - reached) * 20)) -le "$seeds" ] || broken "$scenario: $((seeds - reached)) not reached"
done
exit $failed
