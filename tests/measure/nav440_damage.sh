#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The table of damaged streams in docs/wire/nav440.md: so many packets of a NAV440 each, some of whose
# bytes are replaced by random ones, through framing and plausibility. Fails where a heading that is
# off by more than plausibility ever allows is used.
#   tests/measure/nav440_damage.sh [FRAMES]
# LODESMAN_BUILD: the build to measure.
set -eu
. "$(dirname "$0")/common.sh"
frames=${1:-10000000}

heading
echo
echo '| packet | bytes replaced | sent | ceiling, % | right by CRC, % | believed, % | wrong by CRC | in yaw | believed, any bit wrong | worst heading, deg | used wrong |'
echo '|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|'
if ! LODESMAN_FRAMES=$frames "$bin/test_nav440" 'nav440: what damaged streams come to' >"$place/out"; then
  broken "a heading of a damaged packet is used"
fi
grep '^|' "$place/out"
exit $failed
