# The one style of all figures (gnuplot 5.4). Colours are Okabe and Ito's; each method keeps its colour, dash and marker.
set encoding utf8
set border 3 back lc rgb "#555555" lw 1
set tics nomirror out scale 0.6 textcolor rgb "#333333"
set grid xtics ytics lc rgb "#DDDDDD" lw 0.9 dt 1 back
set key bmargin center horizontal Left reverse noenhanced samplen 3 spacing 1.15 height 0.6 nobox textcolor rgb "#222222" width 1
set title font "DejaVu Sans:Bold,13" textcolor rgb "#111111" offset 0,-0.3 noenhanced
set xlabel textcolor rgb "#333333" noenhanced offset 0,0.8
set ylabel textcolor rgb "#333333" noenhanced
set datafile separator ","
set datafile commentschars "#"
set datafile columnheaders
