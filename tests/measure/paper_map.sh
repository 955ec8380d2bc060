#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The measured tables of docs/paper_map.md, all in the `paper` profile in lock-step, and over so many
# seeds what due times that are late at random make of two of them. Fails where a goal is not reached,
# where others than the three that the document explains meet an obstacle, and where a smallest
# distance of the first experiment is more than 5 cm from eq. 12.
#   tests/measure/paper_map.sh [SEEDS]
set -eu
. "$(dirname "$0")/common.sh"
seeds=${1:-60}
jitter=simulation.lockstep_jitter_s=0.005

# paper <scenario> [option...]: sailed to its goal.
paper() {
  sail "$@" --profile paper --lockstep
  [ "$(value reached)" = true ] || broken "$* does not reach its goal"
}
id() { number "$1" "$(value min_inoffensive_distance_m)"; }
id_at() { number 1 "$(value time_of_min_inoffensive_distance_s)"; }
# eq12 <C> <radius>: with a protection circle of 3.5 m and the vehicle's radius of 0.5 m.
eq12() { awk "BEGIN { printf \"%.3f\", 3.5 * cos($1 / 7) - $2 - 0.5 }"; }
# beside_eq12 <label> <C> <radius>: a row.
beside_eq12() {
  local by_paper
  by_paper=$(eq12 "$2" "$3")
  echo "| $1 m | $(id 3) m | $by_paper m |"
  holds "($(id 3) - $by_paper) ^ 2 <= 0.05 ^ 2" || broken "$1 m is more than 5 cm from eq. 12"
}
range_of() { sort -n "$1" | awk '{ v[NR] = $1 } END { print v[1] "-" v[NR] }'; }

# What the first experiment tells of itself beyond its result, as `name=value` for the shell.
trajectory() {
  awk -F , 'NR > 1 {
      right = $4 > 180 ? $4 - 360 : $4
      if (!later && $1 >= 26) { later = 1; printf "at_26=%.1f\n", right }
      if (right < least) { least = right; at = $1 }
    }
    END { printf "leftmost=%.1f\nleftmost_at=%.1f\n", -least, at }' "$place/run/trajectory.csv"
}
# The side is that on which a path passes the obstacle, which lies at (0, 10) on the straight way.
sides() {
  awk '{
      captured = $0; sub(/.*"captured_s":/, "", captured); captured += 0
      if ($0 !~ /"found":true/) {
        reason = $0; sub(/.*"reason":"/, "", reason); sub(/".*/, "", reason)
        if (captured > 34 && !(reason in seen)) {
          seen[reason] = 1
          lost = lost (lost ? ", " : "yes, ") reason " from " sprintf("%.1f", captured) " s on"
        }
        next
      }
      path = $0; sub(/.*"path_m":\[\[/, "", path); sub(/\]\].*/, "", path)
      points = split(path, point, /\],\[/)
      side = 0
      for (i = 1; i <= points; i++) {
        split(point[i], xy, ",")
        if (xy[2] >= 10) { side = xy[1] < 0 ? "left" : "right"; break }
      }
      if (i == 1 || !side) { next }  # it has passed
      if (before && side != before) {
        changes++
        if (!first) { first = captured }
        last = captured; to = side
      }
      before = side
    }
    END { printf "changes=%d\nfirst=%.1f\nlast=%.1f\nto=%s\nlost=\"%s\"\n",
                 changes, first, last, to ? to : "none", lost }' "$place/run/plans.jsonl"
}

heading
printf '\nThe first experiment\n\n| | paper | here |\n|---|---|---|\n'
paper paper-static
at_26=0 leftmost=0 leftmost_at=0 changes=0 first=0 last=0 to=none lost=""
eval "$(trajectory)"
eval "$(sides)"
direction() { awk "BEGIN { printf \"%.1f degrees %s\", $1 < 0 ? -($1) : $1, $1 < 0 ? \"left\" : \"right\" }"; }
cat <<TABLE
| arrival | 95 s | $(number 2 "$(value time_s)") s |
| where | (about 0, 19.68) | ($(number 2 "$(element final_m 1)"), $(number 2 "$(element final_m 2)")), $(number 3 "$(value goal_error_m)") m from the goal |
| new side | by 26-27 s, to the right | $changes changes, first by $first s, last by $last s, to the $to |
| heading then | 27.3 degrees right at 26 s | $(direction "$at_26") at 26 s; at most $leftmost degrees left, at $leftmost_at s |
| no path at 36 s | yes, start in the zone | ${lost:-no} |
| plans | - | $(value plans): $(value plans_found) found, $(not_found) |
| smallest ID | 2.44 m by eq. 12 | $(id 3) m at $(id_at) s |
TABLE
echo
echo "It sails $(number 2 "$(value path_length_m)") m at a mean of $(number 3 "$(value mean_speed_m_s)") m/s."

printf '\n| C | smallest ID here | eq. 12 |\n|---|---|---|\n'
for interval in 0.6 1.3 2.6; do
  paper paper-static --set planner.waypoint_interval_m=$interval
  beside_eq12 $interval $interval 0.5
done

printf '\nFig. 7a: radius of the obstacle\n\n| radius | smallest ID here | eq. 12 |\n|---|---|---|\n'
for radius in 0.2 0.5 1.0 1.5; do
  paper paper-radius-$radius
  beside_eq12 $radius 1.3 $radius
  id_at >>"$place/radius_at"
done
echo
echo "At $(sort -u "$place/radius_at" | paste -s -d ,) s."

printf '\nFig. 7b: speed of the vehicle\n\n'
printf '| speed | arrival | smallest ID | heading travel | plans without a path |\n|---|---|---|---|---|\n'
for speed in 0.11 0.22 0.42 0.74 1.12; do
  paper paper-speed-$speed
  echo "| $speed m/s | $(number 1 "$(value time_s)") s | $(id 3) m |" \
    "$(number 0 "$(value heading_travel_deg)") degrees | $(value plans_not_found) of $(value plans) |"
  [ "$(value collided)" = false ] || broken "paper-speed-$speed meets its obstacle"
done

printf '\nThe others\n\n'
printf '| scenario | outcome | time | smallest ID | hull clearance | truth to estimate at the end |\n'
printf '|---|---|---|---|---|---|\n'
for scenario in paper-multiple paper-local-minimum tank-straight tank-static tank-moving; do
  paper $scenario
  outcome=$(value outcome)
  case $scenario:$outcome in
    paper-local-minimum:collision | tank-static:collision | tank-moving:collision)
      outcome="**collision**, then goal" ;;
    *:collision) broken "$scenario meets an obstacle" ;;
  esac
  echo "| $scenario | $outcome | $(number 1 "$(value time_s)") s | $(id 3) m |" \
    "$(number 3 "$(value min_hull_clearance_m)") m |" \
    "$(number 2 "$(value estimate_error_m)") m |" | sed 's/| - m /| - /g; s/| 0.00 m |$/| 0 |/'
done

printf '\nWith due times late by up to 5 ms at random, seeds 1-%d:\n\n' "$seeds"
for ((seed = 1; seed <= seeds; seed++)); do
  paper paper-static --seed "$seed" --set $jitter
  number 1 "$(value time_s)" >>"$place/arrivals"
  id 3 >>"$place/ids"
  value side_flips >>"$place/flips"
done
echo "- paper-static arrives at $(range_of "$place/arrivals") s, smallest ID $(range_of "$place/ids") m," \
  "the side changes $(range_of "$place/flips") times"
for ((seed = 1; seed <= seeds; seed++)); do
  paper tank-static --seed "$seed" --set $jitter
  value min_hull_clearance_m >>"$place/hulls"
done
awk '{ if ($1 < 0) { touched++; deep -= $1 } else { clear++ } }
  END { printf "- tank-static touches in %d runs, by %.2f m at the mean, and does not in %d\n",
               touched, touched ? deep / touched : 0, clear }' "$place/hulls"
exit $failed
