#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The table of the bench in docs/scenarios.md: `paper-static` in real time with the real drivers on
# emulated devices, beside the same on simulated ones, in the paper's profile. Fails where a run does
# not arrive, its arrival is more than 12 % off, or its smallest inoffensive distance 0.3 m.
#   tests/measure/hil.sh [TIMES]
# shellcheck disable=SC2016  # the backticks are Markdown's
set -eu
. "$(dirname "$0")/common.sh"
times=${1:-5}

# start <name> <command>: in a directory of its own, beside the others.
start() {
  "$bin/lodesman" "$2" paper-static --profile paper --no-images --quiet --force \
    --set command_socket.port=0 --out "$place/$1" >"$place/$1.said" 2>&1 &
}

heading
start sim sim
for ((i = 1; i <= times; i++)); do
  start "hil-$i" hil
done
wait
printf '\n| `paper-static`, `paper` | outcome | arrival s | smallest ID m | estimate off by m |\n'
printf '|---|---|---|---|---|\n'
for run in sim $(seq -f 'hil-%.0f' 1 "$times"); do
  result=$place/$run/result.json
  [ -s "$result" ] || { cat "$place/$run.said" >&2; exit 2; }
  arrival=$(number 1 "$(value time_s)")
  distance=$(number 2 "$(value min_inoffensive_distance_m)")
  echo "| ${run%%-*} | $(value outcome) | $arrival | $distance |" \
    "$(number 2 "$(value estimate_error_m)") |"
  [ "$(value outcome)" = goal ] || broken "$run does not arrive"
  if [ "$run" = sim ]; then
    sim_arrival=$arrival
    sim_distance=$distance
  else
    holds "($arrival - $sim_arrival) ^ 2 <= (0.12 * $sim_arrival) ^ 2" || broken "$run: arrival"
    holds "($distance - $sim_distance) ^ 2 <= 0.3 ^ 2" || broken "$run: ID"
  fi
done
exit $failed
