#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The two tables of the paper's experiments in docs/scenarios.md, as test_scenarios prints them.
# Fails where the test does, or where two times differ.
#   tests/measure/scenarios.sh [TIMES]
set -eu
. "$(dirname "$0")/common.sh"
times=${1:-2}

heading
for ((i = 1; i <= times; i++)); do
  "$bin/test_scenarios" >"$place/said" || broken "test_scenarios fails"
  grep '^|' "$place/said" >"$place/table" || true
  if [ "$i" -eq 1 ]; then
    mv "$place/table" "$place/first"
  else
    cmp -s "$place/first" "$place/table" || broken "sailed again, the tables differ"
  fi
done
awk -F ' [|] ' '
  /^\|---/ { next }
  /^\| scenario/ { head = $0; sub(/ profile \|/, "", head); next }
  $2 != profile {
    profile = $2
    print "\n`" profile "`\n\n" head
    print "|---|---|---|---|---|---|---|---|---|---|"
  }
  { sub(/ [|] [a-z]+ [|]/, " |"); print }  # without the column of the profile
' "$place/first"
[ "$(grep -c '^| [pt]' "$place/first")" -eq 32 ] || broken "not all 16 scenarios in both profiles"
exit $failed
