# Tables: $bands (from, to: the first sub-impact), $force_N, $stress_back_Pa (x, y: over time).
# Variables: end, largest_force; yields_at, when a fibre yields (NaN: never), yield_stress.
t = time_factor(end)
f = force_factor(largest_force)
time_name = time_unit(end)
first_yield = t*yields_at
eval shaded('$bands', 't', '#FBE6BE')
# Either yield stress is shown where the stress comes near it, in MPa.
stats $stress_back_Pa using 'y' nooutput
bounds = (STATS_max > 0.5*yield_stress ? sprintf('%.4g ', 1e-6*yield_stress) : '') \
         .(STATS_min < -0.5*yield_stress ? sprintf('%.4g ', -1e-6*yield_stress) : '')
set multiplot title marks font ',12'
set xrange [0:t*end]
set xtics tics(t*end, 6)
if (yields_at <= end) {
  set arrow 1 from first first_yield, graph 0 to first first_yield, graph 1 nohead dashtype 3 lw 1.5 \
      lc rgb '#404040'
}

eval placed(0.11, 0.97, 0.56, 0.92)
set ylabel 'contact force, '.force_unit(largest_force) offset 0.5
set yrange [0:*]
set offsets 0, 0, graph 0.06, 0
set format x ''
plot $force_N using (t*$1):(f*$2) with lines notitle

eval placed(0.11, 0.97, 0.12, 0.48)
if (yields_at <= end) {
  set label sprintf('first fibre yields, %.3g %s', first_yield, time_name) \
      at first first_yield, graph 0.07 left offset 0.7, 0
}
bound(i) = words(bounds) ? word(bounds, i) + 0 : NaN
do for [i=1:words(bounds)] {
  set label sprintf('yield stress, %.4g MPa', bound(i)) at graph 0.98, first bound(i) right \
      offset 0, (bound(i) > 0 ? 0.8 : -0.8)
}
set ylabel 'back stress, MPa'
set yrange [*:*]
set offsets 0, 0, graph 0.18, graph 0.18
set format x '% h'
set xlabel 'time, '.time_name
plot $stress_back_Pa using (t*$1):(1e-6*$2) with lines lc 2 notitle, \
     for [i=1:words(bounds)] bound(i) with lines lc rgb '#404040' dashtype 2 lw 1 notitle
unset multiplot
