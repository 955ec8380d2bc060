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

# memory_of <process>: [KiB] resident; nothing where it has ended.
memory_of() { sed -n 's/^VmRSS:[^0-9]*\([0-9]*\) kB/\1/p' "/proc/$1/status" 2>/dev/null; }

# children_of <process>
children_of() { cat "/proc/$1/task/$1/children" 2>/dev/null; }

# minutes_since <$SECONDS of then>
minutes_since() { awk "BEGIN { printf \"%.1f\", ($SECONDS - $1) / 60 }"; }

# wait_while_alive <seconds> <process>
wait_while_alive() {
  local i
  for ((i = 0; i < $1; i++)); do
    kill -0 "$2" 2>/dev/null || return 0
    sleep 1
  done
}

# held_heading, and held_by <minute> <process>: a row of what it holds; nothing where it has ended.
held_heading() { printf '%8s %-18s %12s %12s\n' 'minutes' 'program' 'memory KiB' 'descriptors'; }
held_by() {
  local name memory descriptors
  name=$(cat "/proc/$2/comm" 2>/dev/null) || return 0
  memory=$(memory_of "$2")
  descriptors=$(find "/proc/$2/fd" -mindepth 1 2>/dev/null | wc -l)
  [ -z "$memory" ] || [ "$descriptors" = 0 ] ||
    printf '%8s %-18s %12s %12s\n' "$1" "$name" "$memory" "$descriptors"
}

# judge_growth <file of such rows> [program]: fails where a program grows by more than 1 MiB an hour over
# the second half of its rows, or holds more descriptors than it did; <program> is shown and not judged.
judge_growth() {
  awk -v spared="${2:-}" '
    { if (!($2 in n)) { order[++names] = $2 }
      n[$2]++; at[$2, n[$2]] = $1; memory[$2, n[$2]] = $3; held[$2, n[$2]] = $4 }
    END {
      for (k = 1; k <= names; k++) {
        name = order[k]; half = int((n[name] + 1) / 2); last = n[name]
        hours = (at[name, last] - at[name, half]) / 60
        if (last < 3 || hours <= 0) { print "too short to judge"; exit 1 }
        growth = (memory[name, last] - memory[name, half]) / hours
        printf "%s: %.0f KiB an hour over the second half, %d descriptors more\n", name, growth,
               held[name, last] - held[name, half]
        bad = bad || (name != spared && (growth > 1024 || held[name, last] > held[name, half]))
      }
      exit bad || names < 2
    }' "$1"
}

# end_with <variable>: the process that it names ends with this script.
end_with() {
  # shellcheck disable=SC2064  # the name of the variable is known now
  trap "[ -z \"\$$1\" ] || kill \"\$$1\" 2>/dev/null || true; rm -rf \"\$place\"" EXIT INT TERM
}

# squares <side in m> <count> <speed in m/s> <time limit in s>: a scenario that goes round a square so
# often, without obstacles.
squares() {
  local corners="[0.0, $1], [$1, $1], [$1, 0.0], [0.0, 0.0]" rounds i
  rounds=$corners
  for ((i = 1; i < $2; i++)); do rounds="$rounds, $corners"; done
  cat <<END
name = "round"
seed = 1
time_limit_s = $4
[mission]
start_m = [0.0, 0.0]
start_heading_deg = 0.0
goal_m = [5.0, 5.0]
goal_radius_m = 0.5
waypoints_m = [$rounds]
[vehicle]
speed_m_s = $3
radius_m = 0.5
END
}
