#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The table of decisions made again, in docs/recording.md: every shipped scenario in lock-step and a run
# on emulated devices, in both profiles. Fails where a decision differs, or where none was judged.
#   tests/measure/replay.sh [SCENARIOS]   so many of the shipped ones; all without a number
set -eu
. "$(dirname "$0")/common.sh"
count=${1:-1000}
hil_s=$((count < 24 ? 15 : 60))

heading
printf '\n| recording | profile | s | decisions | differ | not judged | times real time |\n|---|---|---|---|---|---|---|\n'
# number_of <key>: of the newest replay.
number_of() { awk -v key="\"$1\":" '$1 == key { sub(/,$/, "", $2); print $2; exit }' "$place/replay.json"; }
# replayed <name> <profile>
replayed() {
  "$bin/lodesman" replay "$place/run/mission.mcap" --json >"$place/replay.json" 2>/dev/null || broken "$1, $2: replay"
  echo "| $1 | \`$2\` | $(number 0 "$(number_of span_s)") | $(number_of judged) | $(number_of differing) |" \
    "$(number_of not_judged) | $(number 0 "$(number_of times_real_time)") |"
  [ "$(number_of differing)" = 0 ] && [ "$(number_of judged)" -gt 0 ] || broken "$1, $2"
}
for file in $(find "$here/../../hal_sim/scenarios" -name '*.toml' | sort | head -n "$count"); do
  name=$(basename "$file" .toml)
  for profile in default paper; do
    sail "$name" --profile $profile --lockstep --record
    replayed "$name" $profile
  done
done
for profile in default paper; do
  "$bin/lodesman" hil tank-straight --profile $profile --record --time-limit "$hil_s" --no-images --quiet \
    --out "$place/run" --force >/dev/null 2>&1 || true
  replayed "\`hil\` tank-straight" $profile
done
exit $failed
