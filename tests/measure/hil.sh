#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The table of the bench in docs/scenarios.md: scenarios in real time with the real drivers on
# emulated devices, beside the same on simulated ones. `sim` has all devices simulated and the
# truth for its position; `hil, reckoned` real drivers for heading and thrusters, and dead
# reckoning; `hil` four real drivers, and satellite fixes. Fails where a run does not arrive, or
# where the reckoned one in the paper's profile arrives more than 12 % off or its smallest
# inoffensive distance differs by 0.3 m.
#   tests/measure/hil.sh [TIMES [PROFILE [SCENARIO...]]]
# shellcheck disable=SC2016  # the backticks are Markdown's
set -eu
. "$(dirname "$0")/common.sh"
times=${1:-5}
profile=${2:-paper}
shift $(($# < 2 ? $# : 2))
[ $# -gt 0 ] || set -- paper-static

# start <name> <scenario> <command> [option...]: in a directory of its own, beside the others.
start() {
  local name=$1 scenario=$2 command=$3
  shift 3
  "$bin/lodesman" "$command" "$scenario" --profile "$profile" --no-images --quiet --force \
    --set command_socket.port=0 "$@" --out "$place/$name" >"$place/$name.said" 2>&1 &
}

# row <name> <title>: of the run of that name; says what it measured in `arrival` and `distance`.
row() {
  result=$place/$1/result.json
  [ -s "$result" ] || { cat "$place/$1.said" >&2; exit 2; }
  arrival=$(number 1 "$(value time_s)")
  distance=$(number 2 "$(value min_inoffensive_distance_m)")
  echo "| $scenario | $2 | $(value outcome) | $arrival | $distance |" \
    "$(number 2 "$(value estimate_error_m)") |"
  [ "$(value outcome)" = goal ] || broken "$scenario, $2: does not arrive"
}

heading
printf '\n| `%s` | devices | outcome | arrival s | smallest ID m | estimate off by m |\n' "$profile"
printf '|---|---|---|---|---|---|\n'
for scenario in "$@"; do
  start sim "$scenario" sim
  for ((i = 1; i <= times; i++)); do
    start "reckoned-$i" "$scenario" hil --set devices.sonar=sim: --set devices.position=none
    start "hil-$i" "$scenario" hil --seed "$i"
  done
  wait
  row sim sim
  sim_arrival=$arrival
  sim_distance=$distance
  for ((i = 1; i <= times; i++)); do
    row "reckoned-$i" 'hil, reckoned'
    if [ "$profile" = paper ]; then
      holds "($arrival - $sim_arrival) ^ 2 <= (0.12 * $sim_arrival) ^ 2" || broken "$i: arrival"
      holds "($distance - $sim_distance) ^ 2 <= 0.3 ^ 2" || broken "$i: ID"
    fi
  done
  for ((i = 1; i <= times; i++)); do
    row "hil-$i" hil
  done
done
exit $failed
