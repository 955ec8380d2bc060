#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The table of ping to thrust in docs/threads.md: `paper-static` in real time, both levels as
# processes of their own, and what share of one core each of these takes. Fails where a run
# collides, has no such time, or has not its two processes; how long anything takes is not judged.
#   tests/measure/ping_to_thrust.sh [SECONDS]
# SECONDS: of each run; without it each sails to the goal.
# shellcheck disable=SC2016  # the backticks are Markdown's
set -eu
. "$(dirname "$0")/common.sh"
limit=()
run=
trap '[ -z "$run" ] || kill "$run" 2>/dev/null || true; rm -rf "$place"' EXIT
[ $# -eq 0 ] || limit=(--time-limit "$1")
ticks_a_second=$(getconf CLK_TCK)

# share_of <process>: in percent, since it began. Its name may hold blanks, what follows does not.
share_of() {
  sed 's/.*) //' "/proc/$1/stat" 2>/dev/null | awk -v hz="$ticks_a_second" \
    -v up="$(cut -d ' ' -f 1 /proc/uptime)" '{
      age = up - $20 / hz
      if (age > 0) { printf "%.1f", ($12 + $13) / hz / age * 100 } }'
}

heading
printf '\n| ping to thrust, `paper-static` | `default` p50, p99 | `paper` p50, p99 |\n|---|---|---|\n'
row="| woken |"
for profile in default paper; do
  children=()
  declare -A "share_$profile=()"
  declare -n shares=share_$profile
  rm -f "$result"
  "$bin/lodesman" sim paper-static --profile $profile "${limit[@]}" --no-images --quiet \
    --out "$place/run" --force >"$place/said" 2>&1 &
  run=$!
  while kill -0 $run 2>/dev/null; do
    sleep 0.5
    read -r -a children 2>/dev/null <"/proc/$run/task/$run/children" || true
    for child in "${children[@]}"; do
      name=$(cat "/proc/$child/comm" 2>/dev/null) || continue
      share=$(share_of "$child")
      [ -z "$share" ] || shares["$name"]=$share
    done
  done
  status=0
  wait $run || status=$?
  run=
  [ -s "$result" ] || { cat "$place/said" >&2; exit 2; }
  # 1: the time limit, if there is one.
  [ $status -eq 0 ] || { [ $status -eq 1 ] && [ $# -gt 0 ]; } ||
    broken "$profile ends in $(value outcome), with status $status"
  p50=$(member ping_to_command_us p50)
  p99=$(member ping_to_command_us p99)
  case $p50 in '' | - | 0 | 0.0) broken "$profile: no ping came to thrust" ;; esac
  row="$row $(awk "BEGIN { printf \"%.1f, %.1f ms\", ${p50/-/0} / 1000, ${p99/-/0} / 1000 }") |"
  for name in lodesman-low lodesman-high; do
    [ -n "${shares[$name]:-}" ] || broken "$profile: no process $name"
  done
done
echo "$row"
printf '\n| share of one core | `default` | `paper` |\n|---|---|---|\n'
for name in lodesman-low lodesman-high; do
  echo "| $name | ${share_default[$name]:--} % | ${share_paper[$name]:--} % |"
done
exit $failed
