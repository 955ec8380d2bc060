#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs the whole suite N times, in turn as it is, in random order, on one core, beside a load on
# every core, and twice at once; prints a row a run and fails where a test did.
#   tests/measure/suite_repeat.sh [N] [BUILD_DIRECTORY] [ctest arguments]
# Needs stress-ng (Debian package of that name) for the load.
set -u
cd "$(dirname "$0")/../.."
runs=${1:-20}
build=${2:-build/release}
shift $(($# < 2 ? $# : 2))
logs=$(mktemp -d)
cores=$(nproc)

suite() { ctest --test-dir "$build" --output-on-failure "$@"; }
as_it_is() { suite -j "$cores" "$@"; }
random_order() { suite -j "$cores" --schedule-random "$@"; }
one_core() { taskset -c 0 ctest --test-dir "$build" --output-on-failure -j 1 --schedule-random "$@"; }
beside_load() {
  stress-ng --cpu "$cores" --vm 1 --vm-bytes 64M --quiet &
  local load=$! status=0
  suite -j "$cores" --schedule-random "$@" || status=$?
  kill "$load" 2>/dev/null
  wait "$load" 2>/dev/null
  return $status
}
two_at_once() {
  local status=0
  suite -j 1 --schedule-random "$@" &
  local other=$!
  suite -j 1 --schedule-random "$@" || status=$?
  wait "$other" || status=$?
  return $status
}

ways="as_it_is random_order one_core two_at_once"
command -v stress-ng >/dev/null && ways="$ways beside_load" ||
  echo "suite_repeat: without stress-ng nothing runs beside a load" >&2
set -- $ways -- "$@"
order=()
while [ "$1" != -- ]; do order+=("$1"); shift; done
shift

failures=0
printf '| run | way | tests | failed | s |\n|---|---|---|---|---|\n'
for ((run = 1; run <= runs; ++run)); do
  way=${order[$(((run - 1) % ${#order[@]}))]}
  log=$logs/$run-$way
  start=$SECONDS
  "$way" "$@" >"$log" 2>&1 || failures=$((failures + 1))
  tests=$(sed -n 's/.*tests failed out of \([0-9]*\)/\1/p' "$log" | tail -1)
  failed=$(sed -n 's/^[^%]*% tests passed, \([0-9]*\) tests failed.*/\1/p' "$log" |
    awk '{ all += $1 } END { print NR ? all : "?" }')
  printf '| %s | %s | %s | %s | %s |\n' "$run" "$way" "${tests:-?}" "$failed" $((SECONDS - start))
  grep -hE '\((Failed|Timeout|SEGFAULT|Child aborted|.*Exception.*)\)$' "$log" | sort -u
done
if [ "$failures" -gt 0 ]; then
  echo "suite_repeat: $failures of $runs runs failed; what they said is in $logs" >&2
  exit 1
fi
rm -rf "$logs"
echo "no failure in $runs runs"
