# Tables: $force_N, $w_c_m, $w_m_m, $f_c_m (x, y: over time), $sub_impacts (from, to, certain).
# Variables: end, largest_force, largest_displacement, n_uncertain, is_stop.
t = time_factor(end)
f = force_factor(largest_force)
d = length_factor(largest_displacement)
eval shaded('$sub_impacts', 't', '#FBE6BE')
eval hatched('$sub_impacts', 't', '#F0CE8C')
set multiplot title marks font ',12'
set xrange [0:t*end]
set xtics tics(t*end, 8)
set offsets 0, 0, graph 0.06, 0

eval placed(0.11, 0.97, 0.56, 0.92)
set ylabel 'contact force, '.force_unit(largest_force) offset 0.5
set yrange [0:*]
set format x ''
set key at graph 1, graph 1.16 right top horizontal maxrows 1 samplen 2.5
plot $force_N using (t*$1):(f*$2) with lines lw 1 notitle, \
     keyentry with boxes fillstyle solid noborder linecolor rgb '#FBE6BE' \
       title 'sub-impacts'.(n_uncertain > 0 ? ', certain' : ''), \
     keyentry with boxes fillstyle transparent pattern 4 noborder linecolor rgb '#F0CE8C' \
       title n_uncertain > 0 ? 'not certain' : ''

eval placed(0.11, 0.97, 0.12, 0.48)
set key at graph 1, graph 1.16 right top horizontal maxrows 1 samplen 2.5 width -1
set ylabel 'displacement, '.length_unit(largest_displacement)
set yrange [*:*]
set format x '% h'
set xlabel 'time, '.time_unit(end)
plot $w_c_m using (t*$1):(d*$2) with lines lw 2.5 lc 1 title 'struck point w_c', \
     $w_m_m using (t*$1):(d*$2) with lines lc 2 dashtype 2 title (is_stop > 0 ? 'stop w_m' : 'striker w_m'), \
     $f_c_m using (t*$1):(d*$2) with lines lc 3 title 'deflection f_c'
unset multiplot
