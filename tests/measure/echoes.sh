#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The tables of docs/scenarios.md that are sailed by simulated echoes or detections: the shipped scenarios,
# and random encounters beside the same in the known scene, in lock-step. Fails where a shipped scenario
# that is not named here is not reached or collides, or where fewer encounters are reached than 9 of 10 that
# the known scene reaches.
#   tests/measure/echoes.sh [COUNT [SCENE [OPTION...]]]
# COUNT: so many encounters, and so many shipped scenarios at most. SCENE: beams, or detections. OPTION: of
# the runs in that scene, for example --set simulation.detections.missed=0.1; nothing fails then.
set -eu
. "$(dirname "$0")/common.sh"
count=${1:-60}
seen=${2:-beams}
shift $(($# < 2 ? $# : 2))
# Stones at its sides from the first moment, nearer than a sonar hears, and others behind it that it never saw.
not_reached=" start-in-four-zones "
case $seen in
  beams) what=echoes ;;
  detections) what=detections ;;
  *) echo "the scene must be beams or detections" >&2; exit 2 ;;
esac

heading
printf '\n| scenario, from %s | ends | time, s | ID, m | hull, m | side flips | guard trips |\n|---|---|---|---|---|---|---|\n' "$what"
for file in $(find "$here/../../hal_sim/scenarios" -name '*.toml' | sort | head -n "$count"); do
  name=$(basename "$file" .toml)
  sail "$name" --lockstep --set "simulation.scene=$seen" "$@"
  printf '| `%s` | %s | %.1f | %s | %s | %s | %s |\n' "$name" "$(value outcome)" "$(value time_s)" \
    "$(number 2 "$(value min_inoffensive_distance_m)")" "$(number 2 "$(value min_hull_clearance_m)")" \
    "$(value side_flips)" "$(grep -c '"distance_m"' "$result" || true)"
  case $not_reached in *" $name "*) continue ;; esac
  [ $# = 0 ] || continue
  [ "$(value collided)" = false ] || broken "$name collides"
  [ "$(value reached)" = true ] || broken "$name is not reached"
done

declare -A reached=([obstacles]=0 [$seen]=0) hit=([obstacles]="" [$seen]="")
for ((number = 1; number <= count; number++)); do
  for scene in obstacles "$seen"; do
    options=()
    [ "$scene" = obstacles ] || options=("$@")
    sail "encounter:$number" --lockstep --set "simulation.scene=$scene" "${options[@]}"
    if [ "$(value collided)" = true ]; then
      hit[$scene]+=" $number"
    elif [ "$(value reached)" = true ]; then
      reached[$scene]=$((reached[$scene] + 1))
    fi
  done
done
printf '\n| %d encounters | reached | collide |\n|---|---|---|\n' "$count"
printf '| known scene | %d |%s |\n| %s | %d |%s |\n' "${reached[obstacles]}" "${hit[obstacles]:- none}" \
  "$what" "${reached[$seen]}" "${hit[$seen]:- none}"
[ $# != 0 ] || [ $((10 * reached[$seen])) -ge $((9 * reached[obstacles])) ] || broken "encounters from $what"
exit $failed
