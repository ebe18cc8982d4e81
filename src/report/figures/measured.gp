# Tables: $computed, $measured (x, y: force in N over time of the run), $difference, $near_computed,
# $near_measured (about the largest force).
# Variables: from, to; near_from, near_to; largest_force.
t = time_factor(to)
f = force_factor(largest_force)
set multiplot title marks font ',12'
set xrange [t*from:t*to]
set xtics tics(t*(to - from), 8)
set offsets 0, 0, graph 0.06, 0

eval placed(0.13, 0.97, 0.69, 0.94)
set ylabel 'force, '.force_unit(largest_force) offset 0.5
set format x ''
set key at graph 1, graph 1.2 right top horizontal maxrows 1 samplen 2.5
plot $measured using (t*$1):(f*$2) with lines lc 2 lw 1 title 'measured', \
     $computed using (t*$1):(f*$2) with lines lc 1 lw 1 title 'computed, as the transducer shows it'

eval placed(0.13, 0.97, 0.49, 0.64)
set ylabel 'difference, '.force_unit(largest_force) offset 0.5
set format x '% h'
set xlabel 'time of the run, '.time_unit(to)
plot $difference using (t*$1):(f*$2) with lines lc 7 lw 1 notitle

eval placed(0.13, 0.97, 0.08, 0.37)
t = time_factor(near_to)
set xrange [t*near_from:t*near_to]
set xtics tics(t*(near_to - near_from), 8)
set ylabel 'force, '.force_unit(largest_force) offset 0.5
set xlabel 'time of the run, '.time_unit(near_to).': about the largest force'
plot $near_measured using (t*$1):(f*$2) with linespoints lc 2 pt 7 ps 0.3 lw 1 notitle, \
     $near_computed using (t*$1):(f*$2) with lines lc 1 lw 1 notitle
unset multiplot
