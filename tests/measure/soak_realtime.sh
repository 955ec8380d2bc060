#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The boat's two programs in real time under load (lodesman rt-test --load all; idle where stress-ng is
# not installed, or by LOAD, where the machine has work enough):
# memory, descriptors, segments and how late steps begin, by the minute. Fails where a program grows
# by more than 1 MiB an hour over the second half, holds more descriptors than it did, a segment is
# left, or the run ends in a fault; how late anything is is shown and not judged.
#   tests/measure/soak_realtime.sh [MINUTES [LOAD]]
# MINUTES: at most 60, which is what it takes without.
set -eu
. "$(dirname "$0")/common.sh"
minutes=${1:-60}
run=
end_with run
load=${2:-$(command -v stress-ng >/dev/null && echo all || echo idle)}
# segments: of this run; other boats may be about.
segments() { find /dev/shm -maxdepth 1 -name "lodesman-sim-$run*" 2>/dev/null | wc -l; }

"$bin/lodesman" rt-test --load "$load" --seconds $((minutes * 60)) --json \
  >"$place/report" 2>"$place/said" &
run=$!
begun=$SECONDS
sleep 10  # until all have what they keep
heading
uptime
echo "load $load"
held_heading | sed "s/$/ $(printf '%10s %14s' 'segments' 'worst late us')/"

# worst_late: of all tasks so far, by their own health.
worst_late() {
  "$bin/lodesman" watch --once --json --segment "lodesman-sim-$run" 2>/dev/null |
    grep -o '"worst_\(wake_\)\?late_ns":[0-9]*' | sed 's/.*://' | sort -n | tail -n 1 |
    awk '{ printf "%.0f", $1 / 1000 }'
}

while kill -0 "$run" 2>/dev/null; do
  minute=$(minutes_since "$begun")
  late=$(worst_late)
  for process in $(children_of "$run"); do
    case $(cat "/proc/$process/comm" 2>/dev/null) in lodesman-*) ;; *) continue ;; esac
    held_by "$minute" "$process" | sed "s/$/ $(printf '%10s %14s' "$(segments)" "${late:--}")/" |
      tee -a "$place/rows"
  done
  wait_while_alive $((minutes < 4 ? minutes * 15 : 60)) "$run"
done
status=0
wait "$run" || status=$?
[ "$(segments)" = 0 ] || broken "a segment is left in /dev/shm"
run=
[ $status -le 1 ] || { cat "$place/said" >&2; broken "rt-test ends with status $status"; }
grep -o '"verdict":"[a-z]*"\|"reasons":\[[^]]*\]' "$place/report" || broken "no report"
judge_growth "$place/rows" || failed=1
exit $failed
