#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Random forgeries of the blackboard's bytes and heads: so many in lock-step, and one for each five
# thousand of them (200 for a million) beside both programs as they sail.
#   tests/measure/forgeries.sh [COUNT]
# LODESMAN_BUILD: the build to measure; build/asan sees more.
set -eu
. "$(dirname "$0")/common.sh"
count=${1:-1000000}
live=$((count / 5000))
[ "$live" -ge 10 ] || live=10

# timed NAME COUNT PROGRAM TEST
timed() {
  start=$(date +%s)
  if "$bin/$3" "$4" >/dev/null; then outcome="no crash"; else outcome="FAILED"; fi
  printf '%-36s %10s %8s s  %s\n' "$1" "$2" "$(($(date +%s) - start))" "$outcome"
  [ "$outcome" = "no crash" ]
}

heading
printf '%-36s %10s %10s  %s\n' 'forgeries' 'number' 'took' 'outcome'
LODESMAN_FORGERIES=$count timed 'both levels in lock-step' "$count" test_forgeries \
  'forgeries: random bytes*'
LODESMAN_LIVE_FORGERIES=$live timed 'two processes as they sail' "$live" test_live_forgeries \
  'live forgeries:*'
timed 'not sane, beside a twin without' 'twins' test_forgeries 'forgeries: what is not sane*,forgeries: and so*'
