#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Do the tests hold the drivers' and the emulated devices' constants? Changes one at a time, as
# mutations.txt has them, in a copy of the tree, builds the tests concerned and says which failed
# first. The tree itself is only read. Fails where a change survives that is not listed as such, and
# where a listed line is no longer there.
#   tests/measure/mutations.sh [COUNT]
# COUNT: of the lines, spread evenly over the list; all where it is left out.
# LODESMAN_BUILD: the build directory beside which the copy is made.
set -eu
. "$(dirname "$0")/common.sh"
root=$(cd "$here/../.." && pwd)
copy=$(dirname "$bin")/mutations
copy=$(mkdir -p "$copy" && cd "$copy" && pwd)
trap 'rm -rf "$place" "$copy"' EXIT
tests="test_nav440 test_maestro test_roboclaw test_emulators test_conformance"
export LODESMAN_DATA_DIR=${LODESMAN_DATA_DIR:-$root/../shared/data}
export CCACHE_BASEDIR=$copy  # where ccache is told to be used

quiet_or_tell() { "$@" >"$place/log" 2>&1 || { tail -n 30 "$place/log" >&2; return 1; }; }

# concerned <file>: the test programs, the nearest first.
concerned() {
  case $1 in
    drivers/*) room=${1#drivers/} && echo "test_${room%%/*} test_conformance" ;;
    hal_sim/emulators/*) echo "test_emulators test_conformance" ;;
    *) echo "mutations: no test is concerned with $1" >&2 && return 1 ;;
  esac
}

# first_failure <test program>: the name of the first test that fails, or nothing.
first_failure() {
  local status=0
  # Data that is not there is no failure here, whatever CI says.
  env -u CI timeout 120 "$copy/build/bin/$1" --abort >"$place/test" 2>&1 </dev/null || status=$?
  [ $status -eq 0 ] && return
  [ $status -ne 124 ] || { echo "$1 does not end" && return; }
  # Its name stands between two rules, over more than one line where it is long.
  awk '/^-----/ { ++rules; next } rules == 1 { sub(/^ +/, ""); text = text (text ? " " : "") $0 }
    END { print text ? text : "it ends with an error" }' "$place/test"
}

# judge <file>: what the tests say of the copy as it stands.
judge() {
  local test failure
  for test in $(concerned "$1"); do
    if ! nice ninja -C "$copy/build" "$test" >"$place/log" 2>&1; then
      echo "does not compile" && return
    fi
    failure=$(first_failure "$test")
    [ -z "$failure" ] || { echo "$test: $failure" && return; }
  done
  echo SURVIVED
}

# change <file> <old> <new>: in the copy; the old text must stand there once.
change() {
  local text rest
  text=$(cat "$root/$1"; printf x)
  rest=${text#*"$2"}
  if [ "$rest" = "$text" ] || [ "${rest#*"$2"}" != "$rest" ]; then
    echo "mutations: \"$2\" does not stand once in $1" >&2 && return 1
  fi
  text=${text%%"$2"*}$3$rest
  printf '%s' "${text%x}" >"$copy/tree/$1"
}

rm -rf "$copy"
mkdir -p "$copy/tree" "$copy/build"
git -C "$root" ls-files -z | tar -C "$root" --null -T - -cf - | tar -C "$copy/tree" -xf -
quiet_or_tell cmake -S "$copy/tree" -B "$copy/build" -G Ninja -DCMAKE_BUILD_TYPE=Release \
  -DCMAKE_CXX_FLAGS_RELEASE=-O1 -DCMAKE_UNITY_BUILD=ON
# shellcheck disable=SC2086  # names of targets
quiet_or_tell nice ninja -C "$copy/build" $tests
for test in $tests; do
  failure=$(first_failure "$test")
  [ -z "$failure" ] || { echo "mutations: with nothing changed $test fails: $failure" >&2; exit 1; }
done

grep -v -e '^#' -e '^$' "$here/mutations.txt" >"$place/list"
lines=$(wc -l <"$place/list")
count=${1:-$lines}
[ "$count" -le "$lines" ] || count=$lines
heading
printf '%-36s %-68s %s\n' file change 'the first test to fail'
survived=0
for ((i = 0; i < count; ++i)); do
  IFS='|' read -r file old new why < <(sed -n "$((i * lines / count + 1))p" "$place/list")
  change "$file" "$old" "$new"
  outcome=$(judge "$file")
  cp "$root/$file" "$copy/tree/$file"
  if [ "$outcome" = SURVIVED ]; then
    survived=$((survived + 1))
    if [ -n "$why" ]; then outcome="survived: $why"; else broken "$file: $old -> $new survived"; fi
  fi
  printf '%-36s %-68s %s\n' "$file" "${old//std::chrono::/} -> ${new//std::chrono::/}" "$outcome"
done
echo "$count changes, $survived survived"
exit $failed
