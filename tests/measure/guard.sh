#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The guard, in two tables. First with the pilot replaced by full ahead, at shapes in
# open water and at all that rests in the shipped scenarios and in the hard cases (where the data is):
# nothing may be touched. Then with the real pilot, in the shipped scenarios and in random encounters:
# no trip but where the same run without the guard comes nearer than the guard's own margin, 0.2 m.
#   tests/measure/guard.sh [RUNS [ENCOUNTERS]]
# RUNS: full ahead, of each shape and scenario at each speed and in both kinds of scene. With 1, of every
# fourth scenario alone.
set -eu
. "$(dirname "$0")/common.sh"
runs=${1:-4}
encounters=${2:-$((runs < 4 ? 10 * runs : 300))}
data=${LODESMAN_DATA_DIR:-$here/../../../shared/data}

heading
shipped=()
for file in "$here"/../../hal_sim/scenarios/*.toml; do shipped+=("$(basename "$file" .toml)"); done
hard=()
for file in "$data"/hard_cases/pilot/*.toml "$data"/hard_cases/echoes/*.toml; do
  [ ! -f "$file" ] || hard+=("$file")
done
all=("${shipped[@]}" "${hard[@]}")
[ "$runs" -gt 1 ] || for i in "${!all[@]}"; do [ $((i % 4)) -eq 0 ] || unset "all[$i]"; done
"$bin/full_ahead" "$runs" "${all[@]}" || broken "something was touched"

# trips: of the newest run, `count first_reason first_time first_distance`.
trips() {
  awk '/^  "guard_trips"/ { within = 1; next }
    within && /^  \]/ { exit }
    within && /"t_s"/ { ++n; if (n == 1) { gsub(/[",]/, ""); t = $2 } }
    within && n == 1 && /"reason"/ { gsub(/[",]/, ""); reason = $2 }
    within && n == 1 && /"distance_m"/ { gsub(/[",]/, ""); d = $2 }
    END { print n + 0, reason, t, d }' "$result"
}

sailed=0
tripped=0
printf '\n| real pilot | trips | the first | s | m off | hull m | without the guard | hull m |\n|---|---|---|---|---|---|---|---|\n'
for name in "${shipped[@]}" $(seq -f 'encounter:%g' 1 "$encounters"); do
  sail "$name" --lockstep
  sailed=$((sailed + 1))
  read -r count reason at off <<<"$(trips)"
  [ "$count" -gt 0 ] || continue
  tripped=$((tripped + 1))
  outcome=$(value outcome)
  hull=$(number 2 "$(value min_hull_clearance_m)")
  sail "$name" --lockstep --set guard.enabled=false
  without=$(value min_hull_clearance_m)
  echo "| $name, $outcome | $count | $reason | $at | $off | $hull | $(value outcome) | $(number 2 "$without") |"
  [ "$without" != - ] && holds "$without < 0.2" || broken "$name: nothing was imminent"
done
echo
echo "$sailed runs with the real pilot, $tripped with a trip"
exit $failed
