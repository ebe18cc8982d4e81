# Tables: $displacement, $moment (shape, x, y: lines one after another), $instants (time).
# Variables: end (of the run), length (of the beam), largest_displacement.
t = time_factor(end)
d = length_factor(largest_displacement)
array colours[7] = ['#440154', '#46327E', '#365C8D', '#277F8E', '#1FA187', '#4AC16D', '#9FDA3A']
of_shape(k) = column('shape') == k ? column('x') : NaN
n = |$instants| - 1
array times[n]
stats $instants using (times[int($0) + 1] = t*column('time'), 0) nooutput
set multiplot title marks font ',12'
set xrange [0:length]
set xtics tics(length, 8)
set xzeroaxis lc rgb '#808080'
set offsets 0, 0, graph 0.05, graph 0.05

eval placed(0.12, 0.97, 0.53, 0.88)
set ylabel 'displacement, '.length_unit(largest_displacement)
set yrange [*:*]
set format x ''
set key at graph 1, graph 1.24 right top horizontal maxrows 2 samplen 2
plot for [k=1:n] $displacement using (of_shape(k)):(d*column('y')) with lines lw 2 lc rgb colours[k] \
       title sprintf('%.3g ', times[k]).time_unit(end)

eval placed(0.12, 0.97, 0.11, 0.48)
unset key
set ylabel 'bending moment, N m'
set format x '% h'
set xlabel 'position along the beam, m'
plot for [k=1:n] $moment using (of_shape(k)):'y' with lines lw 2 lc rgb colours[k]
unset multiplot
