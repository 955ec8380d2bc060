#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The table of what planner, path finder and controller take from one ping to the next, in
# docs/performance.md, by bench_pilot, so many times. Fails where it fails, or where two times a
# scenario has not the same number of pings; how long they take is not judged.
#   tests/measure/ping_work.sh [TIMES]
# LODESMAN_BUILD: the build to measure. Where it has no bench_pilot this says so and measures nothing.
set -eu
. "$(dirname "$0")/common.sh"
times=${1:-3}
if [ ! -x "$bin/bench_pilot" ]; then
  echo "not built: cmake --preset release -DLODESMAN_BENCH=ON &&" \
    "cmake --build --preset release --target bench_pilot"
  exit 0
fi

heading
for ((i = 1; i <= times; i++)); do
  echo
  "$bin/bench_pilot" | tee "$place/table" || broken "bench_pilot fails"
  awk -F ' [|] ' '{ print $1, $2 }' "$place/table" >"$place/pings"
  if [ "$i" -eq 1 ]; then mv "$place/pings" "$place/first"; else
    cmp -s "$place/first" "$place/pings" || broken "two times, not the same pings"
  fi
done
exit $failed
