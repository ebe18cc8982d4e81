# Tables: $moment_largest, $moment_smallest, $strain_largest, $strain_smallest,
# $displacement_largest, $displacement_smallest, $set (x, y), $zones (from, to: plastic zones).
# Variables: length (of the beam), largest_displacement (of $set if the beam has plastic zones),
# yields (whether it has), yield_moment, yield_strain.
d = length_factor(largest_displacement)
set multiplot title marks font ',12'
set xrange [0:length]
set xtics tics(length, 8)
set xzeroaxis lc rgb '#808080'
set offsets 0, 0, graph 0.06, graph 0.06
set format x ''
if (yields > 0) { eval shaded('$zones', '1', '#FBE6BE') }

eval placed(0.12, 0.97, 0.69, 0.92)
set key at graph 1, graph 1.28 right top horizontal maxrows 2 samplen 2.5
set ylabel 'bending moment, N m'
plot $moment_largest with lines lc 1 title 'largest', \
     $moment_smallest with lines lc 2 title 'smallest', \
     for [sign in '1 -1'] (yields > 0 ? sign*yield_moment : NaN) with lines lc rgb '#606060' \
       dashtype 2 lw 1 title (yields > 0 && sign > 0 ? 'first yield' : ''), \
     keyentry with boxes fillstyle solid noborder linecolor rgb '#FBE6BE' \
       title (yields > 0 ? 'plastic zones' : '')

eval placed(0.12, 0.97, 0.39, 0.62)
set key at graph 1, graph 1.16 right top horizontal maxrows 1 samplen 2.5
set ylabel 'outer strain, 10^{−3}'
# A hinge strains far more than the rest of the beam: its peak is cut off.
limit = 6e3*yield_strain
stats $strain_largest using 'y' nooutput
top = 1e3*STATS_max
stats $strain_smallest using 'y' nooutput
bottom = 1e3*STATS_min
if (yields > 0 && top > limit) { set yrange [*:limit] }
if (yields > 0 && bottom < -limit) { set yrange [-limit:*] }
if (yields > 0 && bottom < -limit && top > limit) { set yrange [-limit:limit] }
plot $strain_largest using 1:(1e3*$2) with lines lc 1 title 'largest', \
     $strain_smallest using 1:(1e3*$2) with lines lc 2 title 'smallest', \
     for [sign in '1 -1'] (yields > 0 ? 1e3*sign*yield_strain : NaN) with lines \
       lc rgb '#606060' dashtype 2 lw 1 notitle

eval placed(0.12, 0.97, 0.09, 0.32)
set yrange [*:*]
set format x '% h'
set xlabel 'position along the beam, m'
if (yields > 0) {
  set ylabel 'permanent set, '.length_unit(largest_displacement)
  plot $set using 1:(d*$2) with lines lc 3 notitle
} else {
  set ylabel 'displacement, '.length_unit(largest_displacement)
  plot $displacement_largest using 1:(d*$2) with lines lc 1 title 'largest', \
       $displacement_smallest using 1:(d*$2) with lines lc 2 title 'smallest'
}
unset multiplot
