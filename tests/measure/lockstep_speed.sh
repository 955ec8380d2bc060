#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The table of how many times faster than real time runs go in lock-step, in docs/performance.md.
# The kinds of runs take turns, so that a machine whose speed changes meanwhile changes all alike.
# Fails where a run does not end in its goal, or where two of a kind have not the same recording.
#   tests/measure/lockstep_speed.sh [TIMES]
set -eu
. "$(dirname "$0")/common.sh"
times=${1:-9}
scenarios="paper-static paper-multiple twenty-movers"

heading
for ((i = 0; i < times; i++)); do
  for scenario in $scenarios; do
    for profile in default paper; do
      sail "$scenario" --profile $profile --lockstep
      value real_time_factor >>"$place/$scenario-$profile"
      value recording_hash >>"$place/$scenario-$profile-hash"
      value outcome >"$place/$scenario-$profile-outcome"
      value time_s >"$place/$scenario-$profile-time"
    done
  done
done
printf '\n| scenario | profile | outcome | s | times real time: median of %d | least | most |\n' "$times"
printf '|---|---|---|---|---|---|---|\n'
for scenario in $scenarios; do
  for profile in default paper; do
    kind=$place/$scenario-$profile
    outcome=$(cat "$kind-outcome")
    echo "| $scenario | $profile | $outcome | $(number 0 "$(cat "$kind-time")") |" \
      "$(sort -n "$kind" | awk '{ v[NR] = $1 }
        END { printf "%.0f | %.0f | %.0f", v[int((NR + 1) / 2)], v[1], v[NR] }') |"
    # The paper's way does not foresee movers: it may meet one of the twenty.
    [ "$outcome" = goal ] || [ "$scenario-$profile" = twenty-movers-paper ] ||
      broken "$scenario, $profile: $outcome"
    [ "$(sort -u "$kind-hash" | wc -l)" -eq 1 ] || broken "$scenario, $profile: recordings differ"
  done
done
exit $failed
