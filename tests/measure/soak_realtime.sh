#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The boat's two programs in real time under load (lodesman rt-test --load all, without it idle):
# memory, descriptors, segments and how late steps begin, by the minute. Fails where a program grows
# by more than 1 MiB an hour over the second half, holds more descriptors than it did, a segment is
# left, or the run ends in a fault; how late anything is is shown and not judged.
#   tests/measure/soak_realtime.sh [MINUTES]
# MINUTES: at most 60, which is what it takes without.
set -eu
. "$(dirname "$0")/common.sh"
minutes=${1:-60}
run=
trap '[ -z "$run" ] || kill "$run" 2>/dev/null || true; rm -rf "$place"' EXIT INT TERM
load=idle
if command -v stress-ng >/dev/null; then load=all; fi
# segments: of this run; other boats may be about.
segments() { find /dev/shm -maxdepth 1 -name "lodesman-sim-$run*" 2>/dev/null | wc -l; }

"$bin/lodesman" rt-test --load $load --seconds $((minutes * 60)) --json \
  >"$place/report" 2>"$place/said" &
run=$!
begun=$SECONDS
sleep 10  # until all have what they keep
heading
uptime
echo "load $load"
printf '%8s %-18s %12s %12s %10s %14s\n' 'minutes' 'program' 'memory KiB' 'descriptors' 'segments' \
  'worst late us'

# worst_late: of all tasks so far, by their own health.
worst_late() {
  "$bin/lodesman" watch --once --json --segment "lodesman-sim-$run" 2>/dev/null |
    grep -o '"worst_\(wake_\)\?late_ns":[0-9]*' | sed 's/.*://' | sort -n | tail -n 1 |
    awk '{ printf "%.0f", $1 / 1000 }'
}

while kill -0 "$run" 2>/dev/null; do
  minute=$(awk "BEGIN { printf \"%.1f\", ($SECONDS - $begun) / 60 }")
  late=$(worst_late)
  for process in $(cat "/proc/$run/task/$run/children" 2>/dev/null); do
    name=$(cat "/proc/$process/comm" 2>/dev/null) || continue
    case $name in lodesman-*) ;; *) continue ;; esac
    memory=$(sed -n 's/^VmRSS:[^0-9]*\([0-9]*\) kB/\1/p' "/proc/$process/status" 2>/dev/null)
    descriptors=$(find "/proc/$process/fd" -mindepth 1 2>/dev/null | wc -l)
    [ -z "$memory" ] || [ "$descriptors" = 0 ] ||
      printf '%8s %-18s %12s %12s %10s %14s\n' "$minute" "$name" "$memory" "$descriptors" \
        "$(segments)" "${late:--}" | tee -a "$place/rows"
  done
  for ((i = 0; i < 60 && i < minutes * 15; i++)); do
    kill -0 "$run" 2>/dev/null || break
    sleep 1
  done
done
status=0
wait "$run" || status=$?
[ "$(segments)" = 0 ] || broken "a segment is left in /dev/shm"
run=
[ $status -le 1 ] || { cat "$place/said" >&2; broken "rt-test ends with status $status"; }
grep -o '"verdict":"[a-z]*"\|"reasons":\[[^]]*\]' "$place/report" || broken "no report"
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
         bad = bad || growth > 1024 || held[name, last] > held[name, half]
       }
       exit bad || names != 2
     }' "$place/rows" || failed=1
exit $failed
