# SPDX-License-Identifier: Apache-2.0
# True heading, and the heading reference below it (the paper's Figs 12a and 16):
#   gnuplot -c heading.gp runs/THE-RUN

run = ARGC > 0 ? ARG1 : '.'
folder = ''
do for [i = 1:strlen(ARG0)] { if (ARG0[i:i] eq '/') { folder = ARG0[1:i] } }
load folder.'series.gp'

set terminal pngcairo noenhanced font 'Sans,13' size 1200,700
if (!exists("output")) output = run.'/heading.png'
set output output

set multiplot
set tmargin at screen 0.92
set bmargin at screen 0.50
set ylabel 'True heading [deg]'
space = margin(low_deg, high_deg, 20)
set yrange [low_deg - space:high_deg + space]
set format x ''
unset xlabel
set key off
heading_deg = 0
plot rows using (column('t_s')):(heading_at(column('heading_deg'))) \
  with lines lc rgb blue lw 2.5

unset title
set format x '%g'
set xlabel 'Time [s]' offset 0,0.3
set key on
set tmargin at screen 0.45
set bmargin at screen 0.19
set ylabel 'HeadRef [-]'
set ytics 50
set yrange [-105:105]
plot @pathless_entry \
  NaN with lines lc rgb blue lw 2.5 title 'true heading, clockwise from Y', \
  rows using (column('t_s')):(column('head_ref')) \
    with steps lc rgb orange lw 2 title 'heading reference (HeadRef)'
unset multiplot
unset output
