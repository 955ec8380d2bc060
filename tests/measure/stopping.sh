#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The table of stopping distances in docs/operations.md: the shipped boat straight on in open water, in
# lock-step, when a device falls silent for good; how far it goes over ground from then until it has
# stopped: with fixes gone, from when they have been bridged for as long as is allowed (15 s). Fails where
# it never stops, or goes farther than 4 m.
#   tests/measure/stopping.sh [SPEEDS]
# SPEEDS: so many, of the five that are listed.
set -eu
. "$(dirname "$0")/common.sh"
speeds=(1.12 0.74 0.42 0.22 0.11)
count=${1:-5}

scenario() { # scenario <speed in m/s> <device>
  cat <<END
name = "stops"
seed = 1
time_limit_s = 60.0
[mission]
start_m = [0.0, 0.0]
start_heading_deg = 0.0
goal_m = [0.0, $(awk "BEGIN { print 55 * $1 }")]
goal_radius_m = 0.5
[vehicle]
speed_m_s = $1
radius_m = 0.5
END
  [ "$2" != position ] || printf '[position]\nsource = "gps"\ngps_sigma_m = 0.1\n'
  printf '[[fault]]\ndevice = "%s"\nkind = "stall"\nat_s = 20.0\nduration_s = 40.0\n' "$2"
}

# gone <from s>: [m] from then until slower than 0.05 m/s, and how long that took [s].
gone() {
  awk -F, -v from="$1" 'NR > 1 && $1 >= from {
      if (begin == "") { begin = $1; x = $2; y = $3 }
      if ($7 < 0.05) { printf "%.2f in %.1f s\n", sqrt(($2 - x) ^ 2 + ($3 - y) ^ 2), $1 - begin; found = 1; exit }
    } END { if (!found) print "-" }' "$place/run/trajectory.csv"
}

heading
printf '\n| m/s | sonar silent, m | heading lost, m | position lost, m |\n|---|---|---|---|\n'
for speed in "${speeds[@]:0:$count}"; do
  row="| $speed |"
  for device in sonar ahrs position; do
    scenario "$speed" "$device" >"$place/stops.toml"
    sail "$place/stops.toml" --lockstep
    from=20
    [ $device != position ] || from=35
    way=$(gone $from)
    row="$row $way |"
    [ "$way" != - ] && holds "${way%% *} <= 4" || broken "$device at $speed m/s: $way"
  done
  echo "$row"
done
exit $failed
