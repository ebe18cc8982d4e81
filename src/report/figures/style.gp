# Lines and points 1 to 8 in the colours of Okabe and Ito, which the colour-blind can distinguish.
set linetype 1 lc rgb '#0072B2' lw 2 pt 7
set linetype 2 lc rgb '#D55E00' lw 2 pt 5
set linetype 3 lc rgb '#009E73' lw 2 pt 9
set linetype 4 lc rgb '#CC79A7' lw 2 pt 13
set linetype 5 lc rgb '#E69F00' lw 2 pt 11
set linetype 6 lc rgb '#56B4E9' lw 2 pt 15
set linetype 7 lc rgb '#000000' lw 2 pt 6
set linetype 8 lc rgb '#8B7500' lw 2 pt 4
set border 3 lc rgb '#404040'
set tics nomirror
set grid lc rgb '#D8D8D8' lw 0.5
# Minus signs as they are set in print.
set encoding utf8
set minussign
