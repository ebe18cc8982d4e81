# Tables: $sections (position, extent of x), $loops and $ends (section, x, y).
# Variables: n_columns, n_rows of panels; width, height of the figure in pixels; yields: whether
# moment and curvature are in units of first yield.
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
  stats $sections using (int($0) + 1 == k ? (position = column('position'), \
                                             extent = column('extent'), 0) : 0) nooutput
  set title sprintf('x = %.3g l', position) offset 0, -0.5
  set xtics tics(extent, 5)
  plot $loops using (column('section') == k ? column('x') : NaN):'y' with lines lc k lw 1.2 \
         notitle, \
       $ends using (column('section') == k ? column('x') : NaN):'y' with points \
         lc rgb '#000000' pt 7 notitle
}
unset multiplot
