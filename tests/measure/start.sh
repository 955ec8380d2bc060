#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# How long each program takes to start and end again, and how many shared libraries it loads for
# that. Fails where one loads more than 40: a library that draws in all others would show so.
#   tests/measure/start.sh [TIMES]
# LODESMAN_BUILD: the build to measure.
set -eu
. "$(dirname "$0")/common.sh"
times=${1:-50}

# ms_of <command...>: median and worst. How it ends is not looked at: no boat may be there.
ms_of() {
  local i begin
  for ((i = 0; i < times; i++)); do
    begin=${EPOCHREALTIME/[.,]/}
    "$@" >/dev/null 2>&1 || true
    echo $((${EPOCHREALTIME/[.,]/} - begin))
  done | sort -n | awk '{ us[NR] = $1 }
    END { printf "%10.1f %10.1f", us[int((NR + 1) / 2)] / 1000, us[NR] / 1000 }'
}

heading
printf '%-44s %10s %10s %10s\n' command 'median ms' 'worst ms' libraries
while read -r program arguments; do
  libraries=$(ldd "$bin/$program" | grep -c '=>')
  printf '%-44s %s %10d\n' "$program $arguments" \
    "$(ms_of "$bin/$program" $arguments)" "$libraries"
  [ "$libraries" -le 40 ] || failed=1
done <<END
lodesman --version
lodesman status
lodesman-low --version
lodesman-high --version
END
printf '%-44s %s\n' "lodesman sim paper-static, lock-step" \
  "$(ms_of "$bin/lodesman" sim paper-static --lockstep --no-images --quiet --out "$place/run" --force)"
exit $failed
