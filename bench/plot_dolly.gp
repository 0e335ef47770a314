# SPDX-License-Identifier: MIT
# The curves of limn-bench dolly as a picture, with gnuplot (Debian: gnuplot-nox):
#
#   limn-bench dolly --frames 300 assets/imp.obj >dolly.csv && gnuplot -c bench/plot_dolly.gp dolly.csv docs/dolly.svg
set terminal svg size 900,480 font "sans-serif,13" background "#ffffff"
set output ARG2
set datafile separator ","
set logscale x 2
set logscale y 10
set xrange [16.5:1]
set yrange [0.001:20]
set xtics (16, 8, 4, 2, 1)
set format y "%g"
set xlabel "distance of the camera, in diagonals of the mesh: coming nearer by 0.9 % a frame"
set ylabel "largest movement between frames, pixels"
set grid ytics lc rgb "#dddddd"
set border 3
set tics nomirror
set key outside top center horizontal
# Nothing is drawn where nothing moves.
above(x) = x > 0.001 ? x : NaN
plot ARG1 using 2:(above($7)) with points pt 7 ps 0.35 lc rgb "#d1495b" title "without morphing", \
     "" using 2:(above($6)) with points pt 7 ps 0.35 lc rgb "#edae49" title "to and from level 0", \
     "" using 2:5 with lines lw 1 lc rgb "#9aa5b1" title "bound of morphing", \
     "" using 2:4 with lines lw 2 lc rgb "#00798c" title "morphing"
