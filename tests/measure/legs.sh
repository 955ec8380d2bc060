#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# How well lines are kept to: a lawn-mower pattern of six lines of 40 m, 20 m apart, in still water and
# in a current, each with legs = "line" and, beside it, "free": the table of lines in docs/scenarios.md.
# Fails where the boat is more than 0.3 m off the middle 20 m of a line but the first.
#   tests/measure/legs.sh [SEEDS]
set -eu
. "$(dirname "$0")/common.sh"
seeds=${1:-1}

# survey <legs> <current> <speed>
survey() {
  cat <<TOML
name = "survey"
seed = 1
time_limit_s = 3000.0
[mission]
start_m = [0.0, 0.0]
start_heading_deg = 0.0
waypoints_m = [[0, 40], [20, 40], [20, 0], [40, 0], [40, 40], [60, 40], [60, 0], [80, 0], [80, 40],
  [100, 40]]
goal_m = [100.0, 0.0]
goal_radius_m = 1.0
legs = "$1"
[vehicle]
speed_m_s = $3
radius_m = 0.5
[environment]
current_m_s = $2
TOML
}

# off_lines: root mean square and worst over the middle 20 m of all lines but the first, on which the
# current is learnt, by where the boat truly was.
off_lines() {
  awk -F , '
    NR == 1 { for (i = 1; i <= NF; i++) column[$i] = i; next }
    {
      x = $column["x_m"]; y = $column["y_m"]
      if (y < 10 || y > 30 || x < 10) next
      off = x - 20 * int(x / 20 + 0.5 + 100) + 2000
      sum += off * off; count++
      if (off < 0) off = -off
      if (off > worst) worst = off
    }
    END { printf "%.2f %.2f\n", sqrt(sum / count), worst }' "$place/run/trajectory.csv"
}
# over: of such pairs the root mean square and the worst.
over() {
  awk 'NF { s += $1 * $1; n++; if ($2 > w) w = $2 }
    END { if (n) printf "%.2f | %.2f", sqrt(s / n), w; else printf "- | -" }'
}

heading
printf '\n| current m/s east, north | speed m/s | legs | of %d: goal | middle of the lines: RMS m | worst m | all, turns too: RMS m | worst m |\n' "$seeds"
echo "|---|---|---|---|---|---|---|---|"
for speed in 0.42 0.74 1.12; do
  for current in "[0.0, 0.0]" "[0.3, 0.0]" "[0.2, 0.2]"; do
    for legs in free line; do
      survey "$legs" "$current" "$speed" >"$place/survey.toml"
      reached=0 all="" middle=""
      for ((seed = 1; seed <= seeds; seed++)); do
        sail "$place/survey.toml" --lockstep --seed "$seed"
        [ "$(value outcome)" = goal ] && reached=$((reached + 1))
        middle="$middle$(off_lines)"$'\n'
        [ "$legs" = free ] ||
          all="$all$(member cross_track rms_m) $(member cross_track worst_m)"$'\n'
      done
      of_middle=$(printf '%s' "$middle" | over)
      echo "| $(tr -d '[]' <<<"$current") | $speed | $legs | $reached | $of_middle | $(printf '%s' "$all" | over) |"
      [ "$reached" -eq "$seeds" ] || broken "$legs in $current at $speed: $((seeds - reached)) not reached"
      [ "$legs" = free ] || holds "${of_middle##* } <= 0.3" || broken "$current at $speed: $of_middle"
    done
  done
done
exit $failed
