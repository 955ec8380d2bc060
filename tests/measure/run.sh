#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Runs all that is measured: each measure_* program of a build, and each script of this directory but
# the drivers and what they share. Each prints a table under a line that names commit and machine,
# fails where a bound is broken, and takes how often as its first argument; without one it measures in
# full. Fails too where a document names a script that is not there.
#   tests/measure/run.sh [--reduced] [BUILD_DIRECTORY]
# --reduced: as often as the file `reduced_counts` says (name and count), 3 times where it does not, and
# not at all where it says 0.
set -u
cd "$(dirname "$0")/../.." || exit
reduced=false
[ "${1:-}" = --reduced ] && reduced=true && shift
build=${1:-build/release}
export LODESMAN_BUILD=$build
. tests/measure/common.sh

# count_of <name>: nothing where all is measured in full.
count_of() {
  $reduced || return 0
  awk -v name="$1" '$1 == name { count = $2 } END { print count == "" ? 3 : count }' \
    tests/measure/reduced_counts
}

failed=""
for script in $(grep -oh 'tests/[a-z_]*/[a-z_]*\.sh' README.md CONTRIBUTING.md docs/*.md | sort -u); do
  [ -f "$script" ] && continue
  echo "measure: a document names $script, which is not there" >&2
  failed="$failed $script"
done
for what in "$build"/bin/measure_* tests/measure/*.sh; do
  name=$(basename "$what" .sh)
  case $name in run | common | suite_repeat | 'measure_*') continue ;; esac
  [ "$(count_of "$name")" != 0 ] || continue
  start=$SECONDS
  echo "== $name $(count_of "$name")"
  case $name in measure_*) heading ;; esac
  # shellcheck disable=SC2046  # no count is no argument
  "$what" $(count_of "$name") || failed="$failed $name"
  echo "== $name took $((SECONDS - start)) s"
done
[ -z "$failed" ] || { echo "measure: failed:$failed" >&2; exit 1; }
