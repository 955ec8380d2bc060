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
end_with run

rounds=$(((minutes + 11) / 12))  # of 160 m, some 12 minutes each
squares 40.0 "$rounds" 0.22 "$(((rounds + 1) * 15 * 60)).0" >"$place/round.toml"

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
    memory=$(memory_of "$process")
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
