# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash disable=SC2034
# What the scripts of this directory share. To be sourced by bash, from any directory.
# LODESMAN_BUILD: the build to measure.

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
bin=${LODESMAN_BUILD:-$here/../../build/release}/bin
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
result=$place/run/result.json  # of the newest run
failed=0

# What was measured, on what, when: numbers say little without.
heading() {
  local processor
  processor=$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -n 1)
  echo "$(git -C "$here" describe --always --dirty 2>/dev/null || echo 'no commit')," \
    "${processor:-$(uname -m)}, $(nproc) cores, $(date -u +%F)"
}

# broken <what...>: a bound is. All is measured nevertheless; the script ends with `exit $failed`.
broken() {
  echo "broken: $*" >&2
  failed=1
}

# sail <scenario> [option...]: a run, whatever comes of it, as long as it tells.
sail() {
  rm -f "$result"
  "$bin/lodesman" sim "$@" --no-images --quiet --out "$place/run" --force >/dev/null 2>&1 || true
  [ -s "$result" ] || { echo "no result: lodesman sim $*" >&2; exit 2; }
}

# value <key>, member <key> <key within>: of the newest run; `-` for null.
value() { member '' "$1"; }
member() {
  awk -v group="$1" -v key="$2" '
    { name = $1; gsub(/[":]/, "", name) }
    /^  [^ ]/ { within = name }
    name == key && (group == "" ? /^  "/ : /^    "/ && within == group) {
      sub(/^[^:]*: /, ""); sub(/,$/, ""); gsub(/"/, "")
      print $0 == "null" ? "-" : $0
      exit
    }' "$result"
}

# element <key> <index from 1>: of a list of numbers.
element() {
  awk -v key="\"$1\":" -v index_="$2" '
    $1 == key { within = 1; next }
    within && ++at == index_ { sub(/,$/, ""); print $1; exit }' "$result"
}

# not_found: the reasons of plans without a path, as `reason count, reason count`.
not_found() {
  awk '/^  "plan_reasons"/ { within = 1; next }
    within && /}/ { exit }
    within { gsub(/[":,]/, ""); if ($1 != "found") { text = text (text ? ", " : "") $1 " " $2 } }
    END { print text ? text : "-" }' "$result"
}

# number <decimals> <value>: rounded; `-` stays.
number() { if [ "$2" = - ]; then echo -; else printf '%.*f\n' "$1" "$2"; fi; }

# holds <condition in awk>
holds() { awk "BEGIN { exit !($1) }"; }
