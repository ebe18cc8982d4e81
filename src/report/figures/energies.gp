# Tables: $zones, $subzones (from, to, number), $sub_impacts, $sub_impacts_undecided (from, to),
# $striker, $kinetic, $elastic, $plastic, $contact, $damping (energies) and $struck_point,
# $striker_path (x, y). Variables: end, time_unit, energy_unit, length_unit, n_undecided, is_damped.
middle(unused) = 0.5*(column('from') + column('to'))
is_wide(unused) = column('to') - column('from') > 0.012*end
set multiplot title marks font ',12'
set xrange [0:end]

# A strip of zones, sub-zones and sub-impacts.
eval placed(0.15, 0.97, 0.905, 0.985)
set yrange [0:3]
set format x ''
set ytics ('zones' 2.5, 'sub-zones' 1.5, 'sub-impacts' 0.5) font ',12' scale 0
unset border
unset xtics
unset grid
set style fill solid 1 noborder
plot $zones using (middle(0)):(2.5):'from':'to':(2.08):(2.92) with boxxyerror \
       lc rgb '#E3E3E3' notitle, \
     $subzones using (middle(0)):(1.5):'from':'to':(1.08):(1.92) with boxxyerror \
       lc rgb '#BDBDBD' notitle, \
     $sub_impacts using (middle(0)):(0.5):'from':'to':(0.08):(0.92) with boxxyerror \
       lc rgb '#E69F00' notitle, \
     $sub_impacts_undecided using (middle(0)):(0.5):'from':'to':(0.08):(0.92) with boxxyerror \
       lc rgb '#F6DDAA' notitle, \
     $zones using (is_wide(0) ? middle(0) : NaN):(2.5):'number' with labels font ',12' notitle, \
     $subzones using (is_wide(0) ? middle(0) : NaN):(1.5):'number' with labels font ',12' notitle
set border 3
set ytics nomirror autofreq scale 1 font ',14'
set xtics nomirror tics(end, 8)
set grid
eval shaded('$zones', '#F0F0F0')

eval placed(0.15, 0.97, 0.46, 0.89)
set ylabel 'energy, '.energy_unit
set yrange [0:*]
set offsets 0, 0, graph 0.3, 0  # room for the key
set key top center maxrows 3 samplen 2.5
plot $striker with lines title 'striker U_m', \
     $kinetic with lines title 'beam, kinetic U_k', \
     $elastic with lines title 'bending, elastic U_e', \
     $plastic with lines title 'bending, plastic U_p', \
     $contact with lines title 'contact, plastic D_c', \
     $damping using 1:(is_damped > 0 ? $2 : NaN) with lines title is_damped > 0 ? 'damping D_b' : '', \
     keyentry with boxes fillstyle solid noborder linecolor rgb '#F6DDAA' \
       title n_undecided > 0 ? 'sub-impacts not decided' : ''

eval placed(0.15, 0.97, 0.1, 0.43)
set ylabel 'deformation, '.length_unit
set yrange [*:*]
set format x '% h'
set key top left horizontal maxrows 1
set offsets 0, 0, graph 0.18, 0
set xlabel 'time, '.time_unit
plot $struck_point with lines lc 1 title 'struck point f_c', \
     $striker_path with lines lc 2 dashtype 2 title 'striker u_{mf}'
unset multiplot
