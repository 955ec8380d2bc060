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
held_heading
while kill -0 "$run" 2>/dev/null; do
  minute=$(minutes_since "$begun")
  for process in "$run" $(children_of "$run"); do
    held_by "$minute" "$process" | tee -a "$place/table"
  done
  [ $((SECONDS - begun)) -lt $((minutes * 60)) ] || kill "$run"
  wait_while_alive 60 "$run"
done
status=0
wait "$run" || status=$?
run=
[ $status -le 1 ] || { cat "$place/said" >&2; broken "hil ends with status $status"; }  # 1: ended here
judge_growth "$place/table" lodesman-bench || failed=1
exit $failed
