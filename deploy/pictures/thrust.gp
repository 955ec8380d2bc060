# SPDX-License-Identifier: Apache-2.0
# Both thrust commands (the paper's Fig. 12b):
#   gnuplot -c thrust.gp runs/THE-RUN

run = ARGC > 0 ? ARG1 : '.'
folder = ''
do for [i = 1:strlen(ARG0)] { if (ARG0[i:i] eq '/') { folder = ARG0[1:i] } }
load folder.'series.gp'

set terminal pngcairo noenhanced font 'Sans,13' size 1200,600
if (!exists("output")) output = run.'/thrust.png'
set output output

unset object
stop = 127.5  # both 127 and 128 stop the propeller
set ylabel 'Thrust command [0-255]'
set yrange [0:260]
set ytics (0, 32, 64, 96, stop, 160, 192, 224, 255)
plot stop with lines dt (10,6) lc rgb grey lw 1.5 title sprintf('stop (%.1f)', stop), \
  rows using (column('t_s')):(column('thrust_left')) with steps lc rgb orange lw 4 \
    title 'left thruster', \
  rows using (column('t_s')):(column('thrust_right')) with steps lc rgb blue lw 1.8 \
    title 'right thruster'
unset output
