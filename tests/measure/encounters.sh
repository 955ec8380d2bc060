#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The table of random encounters in docs/scenarios.md, by groups of fifty as test_encounters has them.
# Fails where the test does: a collision that it does not name, or one that could be avoided.
#   tests/measure/encounters.sh [GROUPS]
set -eu
. "$(dirname "$0")/common.sh"
groups=${1:-6}

heading
names=(first second third fourth fifth sixth)
for name in "${names[@]:0:$groups}"; do
  "$bin/test_encounters" --reporter xml "encounters: $name group" >>"$place/said" ||
    broken "the $name group fails"
done
printf '\n| encounters | reached | collisions that could be avoided | that could not |\n|---|---|---|---|\n'
sed -n 's/^ *\([0-9]*\) runs: \([0-9]*\) reached, .* collisions: \([0-9]*\) that could be avoided, \([0-9]*\) that could not.*/\1 \2 \3 \4/p' \
  "$place/said" | awk '{ for (i = 1; i <= 4; i++) { sum[i] += $i } }
    END { printf "| %d | %d | %d | %d |\n", sum[1], sum[2], sum[3], sum[4] }'
printf '\nNot reached:\n'
# Each tells itself twice where the test fails, in the failure too.
grep -o 'encounter:[0-9]*: .*; again' "$place/said" | sed 's/; again//' | sort -u -t : -k 2n || true
exit $failed
