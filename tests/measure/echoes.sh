#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The tables of docs/scenarios.md that are sailed by simulated echoes: the shipped scenarios, and random
# encounters beside the same in the known scene, in lock-step. Fails where a shipped scenario that is not
# named here is not reached or collides, or where fewer encounters are reached than 9 of 10 that the known
# scene reaches.
#   tests/measure/echoes.sh [COUNT]
# COUNT: so many encounters, and so many shipped scenarios at most.
set -eu
. "$(dirname "$0")/common.sh"
count=${1:-60}
# Stones at its sides from the first moment, nearer than a sonar hears, and others behind it that it never saw.
not_reached=" start-in-four-zones "

heading
printf '\n| scenario, from echoes | ends | time, s | ID, m | hull, m | side flips | guard trips |\n|---|---|---|---|---|---|---|\n'
for file in $(find "$here/../../hal_sim/scenarios" -name '*.toml' | sort | head -n "$count"); do
  name=$(basename "$file" .toml)
  sail "$name" --lockstep --set 'simulation.scene="beams"'
  printf '| `%s` | %s | %.1f | %s | %s | %s | %s |\n' "$name" "$(value outcome)" "$(value time_s)" \
    "$(value min_inoffensive_distance_m)" "$(value min_hull_clearance_m)" "$(value side_flips)" \
    "$(grep -c '"distance_m"' "$result" || true)"
  case $not_reached in *" $name "*) continue ;; esac
  [ "$(value collided)" = false ] || broken "$name collides"
  [ "$(value reached)" = true ] || broken "$name is not reached"
done

declare -A reached=([obstacles]=0 [beams]=0) hit=([obstacles]="" [beams]="")
for ((number = 1; number <= count; number++)); do
  for scene in obstacles beams; do
    sail "encounter:$number" --lockstep --set "simulation.scene=\"$scene\""
    if [ "$(value collided)" = true ]; then
      hit[$scene]+=" $number"
    elif [ "$(value reached)" = true ]; then
      reached[$scene]=$((reached[$scene] + 1))
    fi
  done
done
printf '\n| %d encounters | reached | collide |\n|---|---|---|\n' "$count"
printf '| known scene | %d |%s |\n| echoes | %d |%s |\n' "${reached[obstacles]}" "${hit[obstacles]:- none}" \
  "${reached[beams]}" "${hit[beams]:- none}"
[ $((10 * reached[beams])) -ge $((9 * reached[obstacles])) ] || broken "encounters from echoes"
exit $failed
