#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# lodesman calibrate on the bench, in real time, through the real drivers of AHRS, receiver and
# thruster box: left and right of the thrusters are exchanged in the water, and the configuration
# takes the heading sensor to be turned by 6 degrees, which it is not. Prints what was found beside
# what is; fails where the wiring is not found, a speed is more than 5 % off or the offset 2 degrees.
# It wants a core to spare: a heading that is late by 0.3 s ends the walk.
#   tests/measure/calibrate.sh [TIMES [SURGE_REF,...]]
set -eu
. "$(dirname "$0")/common.sh"
times=${1:-1}
surge_refs=${2:-31,57,91}
root=$here/../..
run=
end_with run

cp "$root/hal_sim/vessels/paper-asv.toml" "$place/hull.toml"
echo 'wires_swapped = true' >>"$place/hull.toml"
cat >"$place/pond.toml" <<'END'
name = "pond"
seed = 1
time_limit_s = 1800.0
[mission]
start_m = [0.0, 0.0]
start_heading_deg = 0.0
goal_m = [0.0, 50.0]
goal_radius_m = 0.5
[vehicle]
speed_m_s = 0.74
radius_m = 0.5
[position]
source = "gps"
gps_sigma_m = 0.02
END

# true_speed <SurgeRef>: of the speed table that ships, which was measured on this hull.
true_speed() {
  tr -d ' ' <"$root/deploy/config/default.toml" |
    sed -n '/^speed_table=/,/^\]/p' | grep -o "\[$1,[0-9.]*\]" | tr -d '[]' | cut -d, -f2
}

# walk: one, on a bench of its own; its document goes to found.json.
walk() {
  "$bin/lodesman" hil "$place/pond.toml" --wait-start --no-images --quiet --force \
    --set command_socket.port=0 --set mounting.heading_deg=6.0 \
    --set "simulation.hull=$place/hull.toml" --out "$place/run" >"$place/said" 2>&1 &
  run=$!
  local port='' i
  for ((i = 0; i < 300; i++)); do
    port=$(sed -n 's/.*command socket on .* port \([0-9]*\)$/\1/p' "$place/said")
    # Until its box has been tried.
    [ -n "$port" ] && grep -q 'thrusters (.*: working' "$place/said" && break
    sleep 0.1
  done
  "$bin/lodesman" calibrate --port "${port:-0}" --segment "lodesman-sim-$run" --room 30 --leg 14 \
    --surge "$surge_refs" --quiet --json >"$place/found.json" 2>"$place/ended" || true
  kill "$run"
  wait "$run" || true
  run=
}

# found <pattern>: of the document, the first that fits after its key.
found() { grep -o "$1[^,}]*" "$place/found.json" | head -n 1 | sed 's/.*://'; }

heading
printf '\n| found by calibrate | is | found |\n|---|---|---|\n'
for ((round = 1; round <= times; round++)); do
  walk
  swapped=$(found '"swapped":')
  echo "| exchanged | true | ${swapped:--} |"
  if [ "$swapped" != true ]; then
    broken "the wiring is not found: $(cat "$place/ended")"
    continue
  fi
  for surge_ref in ${surge_refs//,/ }; do
    is=$(true_speed "$surge_ref")
    speed=$(found "\"surge_ref\":$surge_ref,\"speed_m_s\":" | tail -n 1)
    echo "| m/s at SurgeRef $surge_ref | $is | $(number 3 "${speed:--}") |"
    holds "${speed:-0} > 0.95 * $is && ${speed:-0} < 1.05 * $is" || broken "SurgeRef $surge_ref"
  done
  offset=$(found '"heading_offset_deg":')
  echo "| heading offset, degrees | -6 | $(number 2 "${offset:--}") |"
  holds "(${offset:-99} + 6) ^ 2 < 4" || broken "heading offset; $(cat "$place/ended")"
done
exit $failed
