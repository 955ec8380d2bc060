# SPDX-License-Identifier: Apache-2.0
# The inoffensive distance, its minimum and the times without a path (the paper's Fig. 7):
#   gnuplot -c inoffensive_distance.gp runs/THE-RUN

run = ARGC > 0 ? ARG1 : '.'
folder = ''
do for [i = 1:strlen(ARG0)] { if (ARG0[i:i] eq '/') { folder = ARG0[1:i] } }
load folder.'series.gp'

# lodesman knows the minimum between the rows too, as result.json has it.
if (!exists("minimum_m")) { minimum_m = least_m; minimum_s = least_s }

set terminal pngcairo noenhanced font 'Sans,13' size 1200,600
if (!exists("output")) output = run.'/inoffensive_distance.png'
set output output

set ylabel 'Inoffensive distance (ID) [m]'
space = margin(low_m, high_m, 2)
set yrange [low_m - space:high_m + space]
minimum_layer = ''
if (is_number(minimum_m)) {
  minimum_layer = ", '+' every ::::0 using (minimum_s):(minimum_m) " \
    ."with points pt 7 ps 1.6 lc rgb red title 'minimum'"
  is_late = minimum_s > (first_s + last_s) / 2
  set label sprintf('%.2f m at %.1f s', minimum_m, minimum_s) at minimum_s, minimum_m \
    right offset char -1.2,-0.9 front font 'Sans Bold,13'
  if (!is_late) {
    set label 1 left offset char 1.2,-0.9
  }
}
if (!is_number(least_m)) { set label 'no obstacle in this run' at graph 0.5,0.5 center }
plot @pathless_entry \
  0 with lines dt (10,6) lc rgb red lw 2 title 'collision (ID = 0)', \
  NaN with lines lc rgb blue lw 2.5 title 'inoffensive distance', \
  rows using (column('t_s')):(column('id_m')) with lines lc rgb blue lw 2.5 notitle \
  @minimum_layer
unset output
