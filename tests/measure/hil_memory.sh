#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What the four programs of `lodesman hil` have in memory, and how many descriptors, by the minute: a
# boat goes round a square in real time, with its real drivers. Fails where one of the boat's or the
# bench grows by more than 1 MiB an hour over the second half, or holds more descriptors than it did.
# The launcher keeps a record of the run and grows by it.
#   tests/measure/hil_memory.sh [MINUTES]
set -eu
. "$(dirname "$0")/common.sh"
minutes=${1:-60}
run=
trap '[ -z "$run" ] || kill "$run" 2>/dev/null || true; rm -rf "$place"' EXIT INT TERM

# 160 m, some 12 minutes.
corners='[0.0, 40.0], [40.0, 40.0], [40.0, 0.0], [0.0, 0.0]'
rounds=$corners
for ((round = 1; round * 12 < minutes; round++)); do
  rounds="$rounds, $corners"
done
cat >"$place/round.toml" <<END
name = "round"
seed = 1
time_limit_s = $(((round + 1) * 15 * 60)).0
[mission]
start_m = [0.0, 0.0]
start_heading_deg = 0.0
goal_m = [5.0, 5.0]
goal_radius_m = 0.5
waypoints_m = [$rounds]
[vehicle]
speed_m_s = 0.22
radius_m = 0.5
END

"$bin/lodesman" hil "$place/round.toml" --no-images --quiet --set command_socket.port=0 \
  --out "$place/run" >"$place/said" 2>&1 &
run=$!
begun=$SECONDS
sleep 10  # until all have what they keep
heading
printf '%8s %-18s %12s %12s\n' 'minutes' 'program' 'memory KiB' 'descriptors'
while kill -0 "$run" 2>/dev/null; do
  minute=$(awk "BEGIN { printf \"%.1f\", ($SECONDS - $begun) / 60 }")
  for process in "$run" $(cat "/proc/$run/task/$run/children" 2>/dev/null); do
    name=$(cat "/proc/$process/comm" 2>/dev/null) || continue
    memory=$(sed -n 's/^VmRSS:[^0-9]*\([0-9]*\) kB/\1/p' "/proc/$process/status" 2>/dev/null)
    descriptors=$(find "/proc/$process/fd" -mindepth 1 2>/dev/null | wc -l)
    [ -z "$memory" ] || [ "$descriptors" = 0 ] ||
      printf '%8s %-18s %12s %12s\n' "$minute" "$name" "$memory" "$descriptors" |
      tee -a "$place/table"
  done
  [ $((SECONDS - begun)) -lt $((minutes * 60)) ] || kill "$run"
  for ((i = 0; i < 60; i++)); do
    kill -0 "$run" 2>/dev/null || break
    sleep 1
  done
done
status=0
wait "$run" || status=$?
run=
[ $status -le 1 ] || { cat "$place/said" >&2; broken "hil ends with status $status"; }  # 1: ended here
awk '{ if (!($2 in n)) { order[++names] = $2 }
       n[$2]++; at[$2, n[$2]] = $1; memory[$2, n[$2]] = $3; held[$2, n[$2]] = $4 }
     END {
       for (k = 1; k <= names; k++) {
         name = order[k]; half = int((n[name] + 1) / 2); last = n[name]
         hours = (at[name, last] - at[name, half]) / 60
         if (last < 3 || hours <= 0) { print "too short to judge"; exit 1 }
         growth = (memory[name, last] - memory[name, half]) / hours
         printf "%s: %.0f KiB an hour over the second half, %d descriptors more\n", name, growth,
                held[name, last] - held[name, half]
         bad = bad || (name != "lodesman-bench" && (growth > 1024 || held[name, last] > held[name, half]))
       }
       exit bad
     }' "$place/table" || failed=1
exit $failed
