# Tables: $bands (from, to: the first sub-impact), $force, $stress (x, y).
# Variables: end, time_unit, force_unit; yields_at, if a fibre yields; bounds: the yield stresses
# (MPa) that the stress comes near.
eval shaded('$bands', '#FBE6BE')
set multiplot title marks font ',12'
set xrange [0:end]
set xtics tics(end, 6)
if (exists('yields_at')) {
  set arrow 1 from first yields_at, graph 0 to first yields_at, graph 1 nohead dashtype 3 lw 1.5 \
      lc rgb '#404040'
}

eval placed(0.11, 0.97, 0.56, 0.92)
set ylabel 'contact force, '.force_unit offset 0.5
set yrange [0:*]
set offsets 0, 0, graph 0.06, 0
set format x ''
plot $force with lines notitle

eval placed(0.11, 0.97, 0.12, 0.48)
if (exists('yields_at')) {
  set label sprintf('first fibre yields, %.3g %s', yields_at, time_unit) \
      at first yields_at, graph 0.07 left offset 0.7, 0
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
set xlabel 'time, '.time_unit
plot $stress with lines lc 2 notitle, \
     for [i=1:words(bounds)] bound(i) with lines lc rgb '#404040' dashtype 2 lw 1 notitle
unset multiplot
