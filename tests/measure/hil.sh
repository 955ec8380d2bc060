#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The table of the bench in docs/scenarios.md: scenarios in real time with the real drivers on
# emulated devices, beside the same on simulated ones. `sim` has all devices simulated and the
# truth for its position; `hil, reckoned` real drivers for heading and thrusters, and dead
# reckoning; `hil` four real drivers, and satellite fixes. Fails where a run does not arrive, or
# where the reckoned one in the paper's profile arrives more than 12 % off or its smallest
# inoffensive distance differs by 0.3 m.
#   tests/measure/hil.sh [TIMES [PROFILE [SCENARIO...]]]
# Or one table of scenarios, all that are shipped where none is named, each once with four real
# drivers beside once on simulated devices in lock-step, AT_ONCE runs at a time (1):
#   tests/measure/hil.sh --table PROFILE [AT_ONCE [DIRECTORY [SCENARIO...]]]
# Each result is kept in DIRECTORY (runs/hil-PROFILE) once it is there: an interruption prints what
# there is, and the same call again goes on with the rest. Fails where a run is missing or a fault.
# shellcheck disable=SC2016  # the backticks are Markdown's
set -eu
. "$(dirname "$0")/common.sh"

# keep <scenario> <command> [option...]: one run, whose result is kept unless it was interrupted.
keep() {
  local scenario=$1 command=$2
  shift 2
  "$bin/lodesman" "$command" "$scenario" --profile "$profile" --no-images --quiet --force \
    --set command_socket.port=0 "$@" --out "$place/$scenario.$command" \
    >"$place/$scenario.$command.said" 2>&1 || true
  result=$place/$scenario.$command/result.json
  if [ -s "$result" ] && [ "$(value outcome)" != aborted ]; then
    cp "$result" "$kept/$scenario.$command.json"
  fi
}

# cells <scenario> <command>: of its row; `-` where there is no result.
cells() {
  result=$kept/$1.$2.json
  [ -s "$result" ] || { echo '- | - | - |'; return; }
  echo "$(value outcome) | $(number 1 "$(value time_s)") |" \
    "$(number 2 "$(value min_hull_clearance_m)") |"
}

print_table() {
  heading
  printf '\n| `%s` | sim | arrival s | hull m | hil | arrival s | hull m |\n' "$profile"
  printf '|---|---|---|---|---|---|---|\n'
  local scenario command
  for scenario in "$@"; do
    echo "| $scenario | $(cells "$scenario" sim) $(cells "$scenario" hil)"
    for command in sim hil; do
      result=$kept/$scenario.$command.json
      if [ ! -s "$result" ] || [ "$(value outcome)" = fault ]; then broken "$scenario: $command"; fi
    done
  done
}

end_all() {
  local group
  for group in $(jobs -p); do kill -- "-$group" 2>/dev/null || true; done
  wait
}

if [ "${1:-}" = --table ]; then
  profile=${2:-default}
  at_once=${3:-1}
  kept=${4:-runs/hil-$profile}
  shift $(($# < 4 ? $# : 4))
  if [ $# -eq 0 ]; then
    for file in "$here"/../../hal_sim/scenarios/*.toml; do
      set -- "$@" "$(basename "$file" .toml)"
    done
  fi
  mkdir -p "$kept"
  set -m  # each run is a group, which can be ended as one
  trap 'end_all; print_table "$@"; exit 1' INT TERM
  for scenario in "$@"; do
    for command in sim hil; do
      [ ! -s "$kept/$scenario.$command.json" ] || continue
      while [ "$(jobs -rp | wc -l)" -ge "$at_once" ]; do wait -n || true; done
      if [ $command = sim ]; then
        keep "$scenario" sim --lockstep &
      else
        keep "$scenario" hil &
      fi
    done
  done
  wait
  print_table "$@"
  exit $failed
fi

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
