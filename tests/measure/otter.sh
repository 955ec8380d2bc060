#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The tables of docs/vessels.md: the hull `otter` beside the ten published manoeuvres, as test_world
# prints them, and the paper's experiments sailed with it. Fails where the test does, or where the
# `default` profile does not reach a goal or touches something.
#   tests/measure/otter.sh
# LODESMAN_BUILD: the build to measure. LODESMAN_DATA_DIR: where otter_manoeuvres lies.
set -eu
. "$(dirname "$0")/common.sh"
export LODESMAN_DATA_DIR=${LODESMAN_DATA_DIR:-$here/../../../shared/data}

heading
printf '\n| manoeuvre | m/s published | here | sway m/s published | here | rad/s published | here |'
printf ' sailed m | off at the end %% | at most %% |\n|---|---|---|---|---|---|---|---|---|---|\n'
"$bin/test_world" "otter:*" >"$place/said" || broken "test_world fails"
grep '^|' "$place/said" || broken "no manoeuvre: is otter_manoeuvres in $LODESMAN_DATA_DIR?"

# outcome_of <scenario> <profile>
outcome_of() {
  sail "$1" --profile "$2" --lockstep --set simulation.hull=otter
  echo "$(value outcome), $(number 1 "$(value time_s)") s, $(number 2 "$(value min_hull_clearance_m)") m"
  [ "$2" = paper ] || [ "$(value outcome)" = goal ] || broken "$1 does not end well"
}
printf '\n| scenario | `default` | `paper` |\n|---|---|---|\n'
for scenario in paper-static paper-multiple paper-moving paper-speed-0.11 paper-speed-0.42 \
  paper-speed-0.74 paper-speed-1.12 paper-local-minimum; do
  echo "| $scenario | $(outcome_of $scenario default) | $(outcome_of $scenario paper) |"
done
exit $failed
