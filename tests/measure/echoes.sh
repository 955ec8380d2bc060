#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The tables of docs/scenarios.md that are sailed by simulated echoes or detections: the shipped scenarios,
# and random encounters beside the same in the known scene, in lock-step. Fails where a shipped scenario
# that is not named here is not reached or collides, or where fewer encounters are reached than 9 of 10 that
# the known scene reaches.
#   tests/measure/echoes.sh [COUNT [SCENE [OPTION...]]]
# COUNT: so many encounters, and so many shipped scenarios at most. SCENE: beams (clean echoes), sea (echoes in
# its noise) or detections; beams and sea where none is given. OPTION: of the runs in that scene, for example
# --set simulation.detections.missed=0.1; nothing fails then.
set -eu
. "$(dirname "$0")/common.sh"
count=${1:-60}
scenes=${2:-beams sea}
shift $(($# < 2 ? $# : 2))
# Stones at its sides from the first moment, nearer than a sonar hears, and others behind it that it never saw.
beams_not_reached=" start-in-four-zones "
# What is heard behind a wall is taken for solid, and the goal lies in it; and stretches of a wall that send little
# back are taken for gaps.
sea_not_reached="$beams_not_reached paper-local-minimum wide-wall "
# More than half of its plans find no way into the ring.
detections_not_reached="$beams_not_reached ring-opens "

# choose <scene>: what it is called, and the options of its runs.
choose() {
  case $1 in
    beams) what="echoes" options=(--set simulation.scene=beams) not_reached=$beams_not_reached ;;
    sea)
      what="echoes at sea" options=(--set simulation.scene=beams --set simulation.noise=sea)
      not_reached=$sea_not_reached
      ;;
    detections)
      what=detections options=(--set simulation.scene=detections) not_reached=$detections_not_reached
      ;;
    *) echo "the scene must be beams, sea or detections" >&2; exit 2 ;;
  esac
}

# sail_shipped <option...>
sail_shipped() {
  local file name
  printf '\n| scenario, from %s | ends | time, s | ID, m | hull, m | side flips | guard trips |\n|---|---|---|---|---|---|---|\n' "$what"
  for file in $(find "$here/../../hal_sim/scenarios" -name '*.toml' | sort | head -n "$count"); do
    name=$(basename "$file" .toml)
    sail "$name" --lockstep "${options[@]}" "$@"
    printf '| `%s` | %s | %.1f | %s | %s | %s | %s |\n' "$name" "$(value outcome)" "$(value time_s)" \
      "$(number 2 "$(value min_inoffensive_distance_m)")" "$(number 2 "$(value min_hull_clearance_m)")" \
      "$(value side_flips)" "$(grep -c '"distance_m"' "$result" || true)"
    case $not_reached in *" $name "*) continue ;; esac
    [ $# = 0 ] || continue
    [ "$(value collided)" = false ] || broken "$name collides, from $what"
    [ "$(value reached)" = true ] || broken "$name is not reached, from $what"
  done
}

# sail_encounters <option...>: into `reached` and `hit`.
sail_encounters() {
  local number
  reached=0 hit=
  for ((number = 1; number <= count; number++)); do
    sail "encounter:$number" --lockstep "$@"
    if [ "$(value collided)" = true ]; then
      hit+=" $number"
    elif [ "$(value reached)" = true ]; then
      reached=$((reached + 1))
    fi
  done
}

heading
known_reached=
for scene in $scenes; do
  choose "$scene"
  sail_shipped "$@"
  if [ -z "$known_reached" ]; then
    sail_encounters --set simulation.scene=obstacles
    known_reached=$reached known_hit=${hit:- none}
  fi
  sail_encounters "${options[@]}" "$@"
  printf '\n| %d encounters | reached | collide |\n|---|---|---|\n' "$count"
  printf '| known scene | %d |%s |\n| %s | %d |%s |\n' "$known_reached" "$known_hit" "$what" "$reached" "${hit:- none}"
  [ $# != 0 ] || [ $((10 * reached)) -ge $((9 * known_reached)) ] || broken "encounters from $what"
done
exit $failed
