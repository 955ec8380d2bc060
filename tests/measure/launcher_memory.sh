#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# What `lodesman sim` has in memory, and its run on disk, by the hour of the boat's own time: a boat
# goes round a square in lock-step. Fails where the memory grows by more than 2 MiB an hour over the
# second half.
#   tests/measure/launcher_memory.sh [HOURS]
# LODESMAN_BUILD: the build to measure.
set -eu
. "$(dirname "$0")/common.sh"
hours=${1:-12}
run=
end_with run

rounds=$((hours > 3 ? hours / 2 : 1))  # of 1.92 h each
squares 190.0 "$rounds" 0.11 "$((hours * 3600)).0" >"$place/round.toml"
cat >>"$place/round.toml" <<END
[[obstacle]]
shape = "circle"
centre_m = [0.0, 95.0]
radius_m = 1.0
protection_m = 2.0
END

"$bin/lodesman" sim "$place/round.toml" --lockstep --no-images --quiet --out "$place/run" &
run=$!
# Of the last whole row.
virtual_s() {
  tail -c 400 "$place/run/trajectory.csv" 2>/dev/null | tail -n 2 | head -n 1 |
    sed -n 's/^\([0-9]*\)\.[0-9]*,.*/\1/p'
}
heading
printf '%8s %12s %12s\n' 'hours' 'memory KiB' 'disk KiB'
next_s=1
while memory=$(memory_of "$run") && [ -n "$memory" ]; do
  at_s=$(virtual_s)
  if [ "${at_s:-0}" -ge "$next_s" ]; then
    printf '%8s %12s %12s\n' "$(awk "BEGIN { printf \"%.2f\", $at_s / 3600 }")" "$memory" \
      "$(du -sk "$place/run" | cut -f1)" | tee -a "$place/table"
    next_s=$((at_s / 3600 * 3600 + 3600))
  fi
  sleep 0.2
done
wait "$run" || [ $? -eq 1 ]  # the time limit will do
awk '{ h[NR] = $1; m[NR] = $2 }
     END {
       half = int((NR + 1) / 2)
       if (NR < 3) { print "too short to judge"; exit 1 }
       growth = (m[NR] - m[half]) / (h[NR] - h[half])
       printf "over the second half: %.0f KiB an hour\n", growth
       exit growth > 2048
     }' "$place/table"
