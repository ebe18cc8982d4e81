# Table: $strikes (strike, restitution, dent, set, bending, contact, e_error, set_error). Variables: n
# (of strikes), largest_dent, largest_set.
# Bars of errors that are larger than the values are cut off.
d = length_factor(largest_dent)
w = length_factor(largest_set)
set multiplot title marks font ',12'
set xrange [0.5:n + 0.5]
set xtics tics(n, 8)
set format x ''
unset key

eval placed(0.14, 0.87, 0.69, 0.96)
set ylabel 'restitution'
plot $strikes using 'strike':'restitution':'e_error' with yerrorbars lc 1 lw 0.5 pt 7 ps 0.4

eval placed(0.14, 0.87, 0.39, 0.64)
set key at graph 1, graph 1.16 right top horizontal maxrows 1 samplen 2.5
set ytics nomirror
set y2tics
set ylabel 'dent, '.length_unit(largest_dent)
set y2label 'permanent set, '.length_unit(largest_set)
set yrange [0:1.1*d*(largest_dent > 0 ? largest_dent : 1)]
set y2range [0:1.1*w*(largest_set > 0 ? largest_set : 1)]
plot $strikes using 'strike':(d*column('dent')) with linespoints lc 1 pt 7 ps 0.4 title 'dent', \
     '' using 'strike':(w*column('set')):(w*column('set_error')) axes x1y2 with yerrorbars lc 2 \
       lw 0.5 pt 6 ps 0.4 title 'set (right)'
unset y2tics
unset y2label
set ytics mirror

eval placed(0.14, 0.87, 0.09, 0.34)
set format x '% h'
set xlabel 'strike'
set ylabel 'dissipated by the strike, J'
set yrange [0:*]
plot $strikes using 'strike':'bending' with linespoints lc 3 pt 7 ps 0.4 title 'bending', \
     '' using 'strike':'contact' with linespoints lc 4 pt 6 ps 0.4 title 'contact'
unset multiplot
