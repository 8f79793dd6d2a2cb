# The common style of all figures (gnuplot 5.4): letters of one size, ticks outside, and no grid unless a figure sets one.
set encoding utf8
set border 3 back lc rgb "#111111" lw 1
set tics nomirror out scale 0.6,0.3 offset 0,0.2 textcolor rgb "#222222"
set ytics offset 0.4,0
set grid lc rgb "#DDDDDD" lw 0.8 dt 1 back
unset key
set datafile separator ","
set datafile commentschars "#"
set datafile columnheaders
