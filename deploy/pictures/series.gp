# SPDX-License-Identifier: Apache-2.0
# What the pictures over time share: what there is in the trajectory of `run`, and the look. Loaded
# by each of them.

rows = run.'/trajectory.csv'
set encoding utf8
set datafile separator ','
set datafile columnheaders

# One look through all rows. A field that is empty is no number: NaN, which no comparison holds for.
first_s = NaN; last_s = NaN; first_deg = 0; heading_deg = 0; low_deg = NaN; high_deg = NaN
high_m = 1; low_m = 0; least_m = NaN; least_s = NaN
pathless_since_s = NaN; pathless = ''  # the times without a path, as from, until, from, until ...
is_number(x) = x == x
lower(a, b) = b >= a ? a : is_number(b) ? b : a
higher(a, b) = b <= a ? a : is_number(b) ? b : a
# Continuous where the heading passes north.
unwrapped(before, x) = x - 360 * floor((x - before) / 360.0 + 0.5)
heading_at(x) = is_number(x) ? (heading_deg = unwrapped(heading_deg, x)) : NaN
end_pathless(t) = is_number(pathless_since_s) \
  ? (pathless = pathless.sprintf(' %.3f %.3f', pathless_since_s, t), pathless_since_s = NaN) : NaN
begin_pathless(t) = is_number(pathless_since_s) ? NaN : (pathless_since_s = t)
note_time(t) = (first_s = lower(first_s, t), last_s = t)
note_heading(x) = (heading_at(x), \
  first_deg = is_number(low_deg) ? first_deg : heading_deg, \
  low_deg = lower(low_deg, heading_deg), high_deg = higher(high_deg, heading_deg))
note_distance(t, x) = (least_s = is_number(x) && !(least_m <= x) ? t : least_s, \
  least_m = lower(least_m, x), low_m = lower(low_m, x), high_m = higher(high_m, x))
note_plan(t, plan, found) = plan > 0 && found == 0 ? begin_pathless(t) : end_pathless(t)
set xrange [-1:1]
set yrange [-1:1]
set table $nothing
plot rows using (0):(note_time(column('t_s')), note_heading(column('heading_deg')), \
  note_distance(column('t_s'), column('id_m')), \
  note_plan(column('t_s'), column('plan_id'), column('path_found')), 0)
unset table
dummy = end_pathless(last_s)
first_s = is_number(first_s) ? first_s : 0.0
last_s = is_number(last_s) && last_s > first_s + 1 ? last_s : first_s + 1
low_deg = is_number(low_deg) ? low_deg : 0.0
high_deg = is_number(high_deg) ? high_deg : 0.0

# From `low` to `high` with a margin, no narrower than `narrowest`.
margin(low, high, narrowest) = \
  0.08 * (high - low) + (high - low < narrowest ? (narrowest - (high - low)) / 2.0 : 0)

# lodesman names the run; by itself this says where it lies.
if (!exists("title")) title = run

blue = '#005f99'
orange = '#e69f00'
red = '#cc3311'
grey = '#666666'
shade = '#555555'

set title title font 'Sans Bold,15' offset 0,-0.2
set border lc rgb '#444444'
set tics nomirror
set format '%g'
set grid back lt 1 lc rgb '#e4e4e4' lw 1
set xlabel 'Time [s]' offset 0,0.3
set lmargin at screen 0.09
set rmargin at screen 0.975
set tmargin at screen 0.92
set bmargin at screen 0.19
set key at screen 0.5325,0.045 center center vertical Left reverse maxrows 1 samplen 3 width 1
set xrange [first_s:last_s]
set style fill transparent solid 0.22 noborder

# Of the legend: text of a plot command, and nothing where there is no such time, for each entry has
# its place even if it draws nothing.
pathless_entry = words(pathless) == 0 ? '' \
  : "NaN with filledcurves closed fc rgb shade title 'no path found', "
do for [i = 1:words(pathless):2] {
  set object rectangle from first real(word(pathless, i)), graph 0 \
    to first real(word(pathless, i + 1)), graph 1 behind fc rgb shade \
    fs transparent solid 0.22 noborder
}
