#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The table on fixes among stones in docs/scenarios.md: start-in-four-zones by fixes that are off by
# ever more, over so many seeds on simulated devices in lock-step, and over so many on the bench. Fails
# where anything is hit by the best of them.
#   tests/measure/among_stones.sh [SEEDS [SEEDS_ON_THE_BENCH]]
set -eu
. "$(dirname "$0")/common.sh"
seeds=${1:-50}
bench_seeds=${2:-0}

# row <title> <seeds> <sigma> <command> [option...]
row() {
  local title=$1 count=$2 sigma=$3 hit=0 least=inf most=-inf seed
  shift 3
  for ((seed = 1; seed <= count; seed++)); do
    rm -f "$result"
    "$bin/lodesman" "$1" "$place/on-fixes.toml" "${@:2}" --seed "$seed" --no-images --quiet --force \
      --out "$place/run" >/dev/null 2>&1 || true
    [ -s "$result" ] || { echo "no result: $title, seed $seed" >&2; exit 2; }
    [ "$(value outcome)" != collision ] || hit=$((hit + 1))
    read -r least most < <(awk -v least="$least" -v most="$most" -v hull="$(value min_hull_clearance_m)" \
      'BEGIN { print (hull + 0 < least + 0 || least == "inf" ? hull : least),
                     (hull + 0 > most + 0 || most == "-inf" ? hull : most) }')
  done
  echo "| $sigma | $title | $count | $hit | $(number 2 "$least") to $(number 2 "$most") |"
  if [ "$sigma" = 0.05 ] && [ "$hit" -gt 0 ]; then broken "$title: $hit hit by fixes $sigma m off"; fi
}

heading
printf '\n| fixes off by m | devices | seeds | collide | hull, least to most m |\n|---|---|---|---|---|\n'
for sigma in 0.05 0.3 1; do
  {
    cat "$here/../../hal_sim/scenarios/start-in-four-zones.toml"
    printf '\n[position]\nsource = "gps"\ngps_sigma_m = %s\n' "$sigma"
  } >"$place/on-fixes.toml"
  row simulated "$seeds" "$sigma" sim --lockstep
  [ "$bench_seeds" -eq 0 ] || row 'the bench' "$bench_seeds" "$sigma" hil --set command_socket.port=0
done
exit $failed
