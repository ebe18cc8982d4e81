# Tables: $sub_impacts (from, to, certain), $zones, $subzones (from, to, number); $U_m_J, $U_k_J,
# $U_e_J, $U_p_J, $D_c_J, $D_b_J, $f_c_m, $u_mf_m (x, y: over time).
# Variables: end, initial_energy, largest_displacement, n_uncertain, is_damped, is_stop.
t = time_factor(end)
e = energy_factor(initial_energy)
d = length_factor(largest_displacement)
from(unused) = t*column('from')
to(unused) = t*column('to')
middle(unused) = 0.5*t*(column('from') + column('to'))
is_wide(unused) = column('to') - column('from') > 0.012*end
of_certain(value, y) = column('certain') == value ? y : NaN
set multiplot title marks font ',12'
set xrange [0:t*end]

# A strip of zones, sub-zones and sub-impacts.
eval placed(0.15, 0.97, 0.905, 0.985)
set yrange [0:3]
set format x ''
set ytics ('zones' 2.5, 'sub-zones' 1.5, 'sub-impacts' 0.5) font ',12' scale 0
unset border
unset xtics
unset grid
set style fill solid 1 noborder
plot $zones using (middle(0)):(2.5):(from(0)):(to(0)):(2.08):(2.92) with boxxyerror \
       lc rgb '#E3E3E3' notitle, \
     $subzones using (middle(0)):(1.5):(from(0)):(to(0)):(1.08):(1.92) with boxxyerror \
       lc rgb '#BDBDBD' notitle, \
     $sub_impacts using (middle(0)):(of_certain(1, 0.5)):(from(0)):(to(0)):(0.08):(0.92) with boxxyerror \
       lc rgb '#E69F00' notitle, \
     $sub_impacts using (middle(0)):(of_certain(0, 0.5)):(from(0)):(to(0)):(0.08):(0.92) with boxxyerror \
       lc rgb '#F6DDAA' notitle, \
     $zones using (is_wide(0) ? middle(0) : NaN):(2.5):'number' with labels font ',12' notitle, \
     $subzones using (is_wide(0) ? middle(0) : NaN):(1.5):'number' with labels font ',12' notitle
set border 3
set ytics nomirror autofreq scale 1 font ',14'
set xtics nomirror tics(t*end, 8)
set grid
eval shaded('$zones', 't', '#F0F0F0')

eval placed(0.15, 0.97, 0.46, 0.89)
set ylabel 'energy, '.energy_unit(initial_energy)
set yrange [0:*]
set offsets 0, 0, graph 0.3, 0  # room for the key
set key top center maxrows 3 samplen 2.5
plot $U_m_J using (t*$1):(e*$2) with lines title (is_stop > 0 ? 'stop U_m' : 'striker U_m'), \
     $U_k_J using (t*$1):(e*$2) with lines title 'beam, kinetic U_k', \
     $U_e_J using (t*$1):(e*$2) with lines title 'bending, elastic U_e', \
     $U_p_J using (t*$1):(e*$2) with lines title 'bending, plastic U_p', \
     $D_c_J using (t*$1):(e*$2) with lines title 'contact, plastic D_c', \
     $D_b_J using (t*$1):(is_damped > 0 ? e*$2 : NaN) with lines title is_damped > 0 ? 'damping D_b' : '', \
     keyentry with boxes fillstyle solid noborder linecolor rgb '#F6DDAA' \
       title n_uncertain > 0 ? 'sub-impacts not certain' : ''

eval placed(0.15, 0.97, 0.1, 0.43)
set ylabel 'deformation, '.length_unit(largest_displacement)
set yrange [*:*]
set format x '% h'
set key top left horizontal maxrows 1
set offsets 0, 0, graph 0.18, 0
set xlabel 'time, '.time_unit(end)
plot $f_c_m using (t*$1):(d*$2) with lines lc 1 title 'struck point f_c', \
     $u_mf_m using (t*$1):(d*$2) with lines lc 2 dashtype 2 title (is_stop > 0 ? 'stop u_{mf}' : 'striker u_{mf}')
unset multiplot
