#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The table and the pictures of docs/gallery.md: what `lodesman segment` makes of each set of shared real frames,
# drawn over its echoes, and the sonar views of simulated runs. Fails where a set cannot be read, a frame
# has no picture, or an obstacle found no room.
#   tests/measure/gallery.sh [FRAMES [DIRECTORY]]
# FRAMES: of each set at most so many, and of the simulated runs at most twice as many seconds. DIRECTORY: for
# the pictures, one below it for each set; without it they are looked at and thrown away. The frames'
# owners allow few of them to be shown (docs/gallery.md says which): keep DIRECTORY out of what you publish.
# LODESMAN_BUILD: the build to measure. LODESMAN_DATA_DIR: where the frames lie. Where they do not, this says so
# and draws the simulated ones alone, and with CI=true fails.
set -eu
. "$(dirname "$0")/common.sh"
. "$here/../../deploy/packages.sh"
frames=${1:-200}
out=${2:-$place/gallery}
data=${LODESMAN_DATA_DIR:-$here/../../../shared/data}
install_packages python3 >&2
mkdir -p "$out"

# row <name> <segment option...>: of the frames whose names stand on standard input. What one ping shows is counted;
# what is drawn may be tracked.
row() {
  local name=$1 files pictures alone=() option
  shift
  for option; do [ "$option" = --track ] || alone+=("$option"); done
  mapfile -t files < <(head -n "$frames")
  [ "${#files[@]}" -gt 0 ] || { broken "$name: no frames"; return 0; }
  "$bin/lodesman" segment "${files[@]}" "$@" --overlay "$out/$name" --json --quiet >"$place/$name.json" ||
    { broken "$name: could not be read"; return 0; }
  "$bin/lodesman" segment "${files[@]}" "${alone[@]}" --json --quiet >"$place/$name-alone.json"
  pictures=$(find "$out/$name" -name '*.png' -size +1k | wc -l)
  [ "$pictures" -ge "${#files[@]}" ] || broken "$name: $pictures pictures of ${#files[@]} frames"
  /usr/bin/python3 "$here/gallery_row.py" "$name" "$place/$name-alone.json" "$place/$name.json" || broken "$name: an obstacle found no room"
}

# files <directory below the data> [pattern]
files() { find "$data/$1" -maxdepth 1 -type f -name "${2:-*.p[gn][mg]}" | sort; }

# One below the other: the range setting is in a frame's name. The same for all is no option.
known_range() {
  local file range
  for file in $(files fls_oculus_known_range/polar_120x500); do
    range=$(sed -n 's/.*_\([0-9]*\)m.*/\1/p' <<<"$(basename "$file")")
    row "fls_oculus_known_range-$range" --range-m "$range" --sector-deg 120 <<<"$file"
  done
}

# The wall frames of the tank were cut out otherwise: apex and radius are fitted to each kind's straight sides.
aris() {
  local walls=' 1412 153 535 621 958 ' file number
  for file in $(files fls_aris3000_watertank/fan); do
    number=${file##*-}
    case $walls in *" ${number%.png} "*) echo "$file" >>"$place/walls" ;; *) echo "$file" >>"$place/objects" ;; esac
  done
  row fls_aris3000_watertank --layout fan --apex bottom --apex-px 159.4,599.5 --radius-px 574.5 --range-m 5 \
    --sector-deg 30.1 <"$place/objects"
  row fls_aris3000_watertank-walls --layout fan --apex bottom --apex-px 159.6,744.5 --radius-px 717.5 \
    --range-m 5 --sector-deg 24.4 <"$place/walls"
}

# view <name> <scenario> [option...]: the sonar views of a run from simulated echoes.
view() {
  local name=$1
  shift
  "$bin/lodesman" sim "$@" --time-limit $((2 * frames)) --lockstep --set 'simulation.scene="beams"' --quiet --out "$out/$name" --force \
    >/dev/null 2>&1 || true
  [ -n "$(find "$out/$name/sonar" -name '*.jpg' -size +1k 2>/dev/null)" ] || broken "$name: no sonar views"
}

heading
if [ -d "$data/fls_oculus_m1200d" ]; then
  printf '\n| set | frames | obstacles a frame, most | of them polygons | tracks at the end: may move, surely |\n'
  echo "|---|---|---|---|---|"
  row fls_oculus_m1200d --range-m 30 --sector-deg 120 < <(files fls_oculus_m1200d/polar_120x500)
  known_range
  aris
  row fls_didson_river --layout fan --apex bottom --apex-px 198.6,816.5 --radius-px 816.5 --range-m 10 \
    --sector-deg 28.4 --track < <(files fls_didson_river)
  row sonar_raw_oculus_pings --range-m 2 --sector-deg 60 < <(files sonar_raw_oculus_pings/polar)
  row fls_moving_auv --range-m 30 --sector-deg 120 --track < <(files fls_moving_auv/sonar4)
elif [ "${CI:-}" = true ]; then
  broken "CI=true, and there is no $data/fls_oculus_m1200d (set LODESMAN_DATA_DIR)"
else
  echo "skipped: no $data/fls_oculus_m1200d (set LODESMAN_DATA_DIR)"
fi

view sim-paper-static paper-static
view sim-tank-moving tank-moving
view sim-twenty-movers twenty-movers
for noise in tank sea; do
  view "sim-wide-wall-$noise" wide-wall --set "simulation.noise=$noise"
done
[ "$out" = "$place/gallery" ] || echo "pictures: $out" >&2
exit $failed
