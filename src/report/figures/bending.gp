# Tables: $sections (position, as part of the length), $loops and $ends (section, curvature, moment).
# Variables: n_columns, n_rows of panels; width, height of the figure in pixels; yields: whether
# moment and curvature are shown in units of first yield, yield_moment and yield_curvature.
x(k) = column('section') == k ? column('curvature')/(yields > 0 ? yield_curvature : 1) : NaN
y(unused) = column('moment')/(yields > 0 ? yield_moment : 1)
set multiplot title marks font ',12'
set xlabel (yields > 0 ? 'curvature, κ/κ_y' : 'curvature, 1/m')
set ylabel (yields > 0 ? 'moment, M/M_y' : 'moment, N m') offset 1
set offsets graph 0.05, graph 0.05, graph 0.08, graph 0.08
set xzeroaxis lc rgb '#808080'
set yzeroaxis lc rgb '#808080'
panel_width = width/n_columns
panel_height = height/n_rows
do for [k=1:|$sections| - 1] {
  left = panel_width*((k - 1)%int(n_columns))
  top = height - panel_height*((k - 1)/int(n_columns))
  eval placed((left + 86)/width, (left + panel_width - 20)/width, \
              (top - panel_height + 74)/height, (top - 39)/height)
  set autoscale  # "stats" heeds the ranges of the panel before
  stats $sections using (int($0) + 1 == k ? (position = column('position'), 0) : 0) \
        nooutput
  stats $loops using (x(k)) nooutput
  set title sprintf('x = %.3g l', position) offset 0, -0.5
  set xtics tics(STATS_max - STATS_min, 5)
  plot $loops using (x(k)):(y(0)) with lines lc k lw 1.2 \
         notitle, \
       $ends using (x(k)):(y(0)) with points \
         lc rgb '#000000' pt 7 notitle
}
unset multiplot
