# Tables: $bands, $bands_undecided (from, to: sub-impacts), $force, $struck, $striker, $deflection (x, y).
# Variables: end, time_unit, force_unit, length_unit, n_undecided.
eval shaded('$bands', '#FBE6BE')
eval hatched('$bands_undecided', '#F0CE8C')
set multiplot title marks font ',12'
set xrange [0:end]
set xtics tics(end, 8)
set offsets 0, 0, graph 0.06, 0

eval placed(0.11, 0.97, 0.56, 0.92)
set ylabel 'contact force, '.force_unit offset 0.5
set yrange [0:*]
set format x ''
set key at graph 1, graph 1.16 right top horizontal maxrows 1 samplen 2.5
plot $force with lines lw 1 notitle, \
     keyentry with boxes fillstyle solid noborder linecolor rgb '#FBE6BE' \
       title 'sub-impacts'.(n_undecided > 0 ? ', decided' : ''), \
     keyentry with boxes fillstyle transparent pattern 4 noborder linecolor rgb '#F0CE8C' \
       title n_undecided > 0 ? 'not decided' : ''

eval placed(0.11, 0.97, 0.12, 0.48)
set key at graph 1, graph 1.16 right top horizontal maxrows 1 samplen 2.5 width -1
set ylabel 'displacement, '.length_unit
set yrange [*:*]
set format x '% h'
set xlabel 'time, '.time_unit
plot $struck with lines lw 2.5 lc 1 title 'struck point w_c', \
     $striker with lines lc 2 dashtype 2 title 'striker w_m', \
     $deflection with lines lc 3 title 'deflection f_c'
unset multiplot
