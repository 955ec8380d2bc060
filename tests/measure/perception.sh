#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The tables of docs/perception.md: what `lodesman segment` finds in the shared real frames by threshold and by
# contrast, scored by the judge that lies beside them, and the processor time a frame, the least of so many
# runs. Fails where by contrast fewer than 31 of 31 labelled targets are one obstacle, or an obstacle found no
# room; how long it takes is not judged.
#   tests/measure/perception.sh [REPEATS]
# LODESMAN_BUILD: the build to measure. LODESMAN_DATA_DIR: where the frames lie. Where they do not, this says so
# and measures nothing, and with CI=true fails.
set -eu
. "$(dirname "$0")/common.sh"
. "$here/../../deploy/packages.sh"
repeats=${1:-5}
data=${LODESMAN_DATA_DIR:-$here/../../../shared/data}
judge=$data/../tools/evaluate_perception.py

for needed in "$data/fls_oculus_m1200d" "$judge"; do
  [ ! -e "$needed" ] || continue
  [ "${CI:-}" != true ] || { echo "CI=true, and there is no $needed (set LODESMAN_DATA_DIR)" >&2; exit 1; }
  echo "skipped: no $needed (set LODESMAN_DATA_DIR)"
  exit 0
done
# shellcheck disable=SC2086  # a list
install_packages $perception_packages

heading
for method in threshold contrast; do
  printf '\n== by %s\n' "$method"
  /usr/bin/python3 "$judge" --binary "$bin/lodesman" --out "$place/$method" \
    --set "segmentation.method=$method" >"$place/$method.txt" || broken "the judge fails by $method"
  cat "$place/$method.txt"
done
# Of the row of all passes: how many frames, and in how many the target is one obstacle.
read -r frames found <<<"$(awk '$1 == "all" { print $2, $3 }' "$place/contrast.txt")"
[ "${frames:-0}" -ge 31 ] && [ "${found:-0}" -eq "$frames" ] ||
  broken "by contrast ${found:-no} of ${frames:-no} labelled targets are one obstacle"

echo
/usr/bin/python3 "$here/perception_times.py" "$bin/lodesman" "$data" "$repeats" ||
  broken "an obstacle found no room, or a set could not be read"
exit $failed
