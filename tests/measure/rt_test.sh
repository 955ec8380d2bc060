#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The tables of docs/performance.md: `lodesman rt-test` beside cyclictest on an idle machine and under
# load, with real-time rights and, where this is run by root, as a user without any. Fails where a
# report is not whole or does not agree with its exit status; how long anything takes is not judged.
#   tests/measure/rt_test.sh [SECONDS]
# SECONDS: of each of the runs; without it 60.
set -eu
. "$(dirname "$0")/common.sh"
seconds=${1:-60}
run=
trap '[ -z "$run" ] || kill "$run" 2>/dev/null || true; rm -rf "$place"' EXIT INT TERM

# as_nobody <command...>: without a right to SCHED_FIFO or to locked memory.
as_nobody() {
  setpriv --reuid 65534 --regid 65534 --clear-groups --inh-caps=-all --bounding-set=-all "$@"
}

# look <title> <as> <load> [option...]: one run, and its table.
look() {
  local title=$1 as=$2 load=$3 status=0
  shift 3
  [ "$as" = as_found ] && as=
  $as "$bin/lodesman" rt-test --load "$load" --seconds "$seconds" "$@" \
    >"$place/table" 2>"$place/said" &
  run=$!
  wait "$run" || status=$?
  run=
  printf '\n%s\n' "$title"
  cat "$place/table"
  local rows
  rows=$(grep -cE '^(world|ahrs|position|estimator|delta_t|path_finder|planner|controller|thruster) ' \
    "$place/table" || true)
  [ "$rows" = 18 ] || broken "$title: $rows lines of tasks, not 18; $(tail -n 1 "$place/said")"
  case $status:$(tail -n 1 "$place/table") in
    '0:verdict: pass' | '1:verdict: fail') ;;
    *) broken "$title: status $status; $(tail -n 1 "$place/said")" ;;
  esac
}

beside=()
if command -v cyclictest >/dev/null; then beside=(--cyclictest); fi
loads=idle
if command -v stress-ng >/dev/null; then loads="idle all"; fi
heading
uptime
for load in $loads; do
  look "== $load" as_found "$load" "${beside[@]}"
done
if [ "$(id -u)" -eq 0 ] && command -v setpriv >/dev/null && as_nobody test -x "$bin/lodesman"; then
  chmod 711 "$place"
  for load in $loads; do
    look "== $load, without real-time rights" as_nobody "$load" "${beside[@]}"
  done
fi
exit $failed
