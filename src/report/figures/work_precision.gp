# Cost against error, one panel per study. Table $points: panel, method, mark (right; wrong: some
# sub-impacts lost or invented; failed), error_us, cost. Variables: labels of the panels,
# cost_label, width of the figure in pixels.
methods = ''
low_error = low_cost = 1e300
high_error = high_cost = 0
stats $points using (methods = added(methods, strcol('method')), \
                     low_error = least(column('error_us'), low_error), \
                     high_error = most(column('error_us'), high_error), \
                     low_cost = least(column('cost'), low_cost), \
                     high_cost = most(column('cost'), high_cost), 0) nooutput
if (high_error == 0) { low_error = 0.1; high_error = 10 }
if (high_cost == 0) { low_cost = 0.1; high_cost = 10 }
strip = decade_above(1.0001*high_error)  # to the right of it: runs that broke down
edge = 50*strip

of(panel, k, marks) = column('panel') == panel && strcol('method') eq word(methods, k) \
                      && strstrt(marks, strcol('mark'))
error(panel, k, marks) = of(panel, k, marks) ? column('error_us') : NaN

set multiplot
set logscale xy
set bmargin screen 0.14
set tmargin screen 0.9
set xrange [decade_below(low_error):edge]
set yrange [decade_below(low_cost):decade_above(1.0001*high_cost)]
set xlabel 'largest error of an event time (µs)'
set format x '10^{%L}'
set format y '10^{%L}'
set mxtics 1
set mytics 10
n = words(labels)
set key at screen (400.0*n + 70)/width,0.9 left top Left reverse samplen 2 spacing 1.25
set object 1 rectangle from strip, graph 0 to edge, graph 1 fc rgb '#F0F0F0' fs noborder behind
set label 1 'failed' at 18*strip, graph 0.5 center rotate by 90 tc rgb '#606060'
do for [p=1:n] {
  set lmargin screen (400.0*p - 310)/width
  set rmargin screen (400.0*p + 40)/width
  set title word(labels, p)
  set ylabel (p == 1 ? cost_label : '')
  in_key(words) = p == n ? words : ''
  plot for [k=1:words(methods)] $points using (error(p, k, 'right wrong')):'cost' \
         with lines lt colour(k) dt dashes(k) lw 1.5 notitle, \
       for [k=1:words(methods)] $points using (error(p, k, 'right')):'cost' \
         with points lt colour(k) pt filled(k) lw 1.5 ps 1.0 notitle, \
       for [k=1:words(methods)] $points using (error(p, k, 'wrong')):'cost' \
         with points lt colour(k) pt hollow(k) lw 1.5 ps 1.0 notitle, \
       for [k=1:words(methods)] $points using (of(p, k, 'failed') ? 3*strip : NaN):'cost' \
         with points lt colour(k) pt 2 lw 1.5 ps 1.0 notitle, \
       for [k=1:words(methods)] keyentry with linespoints lt colour(k) dt dashes(k) pt filled(k) \
         lw 1.5 title in_key(word(methods, k)), \
       keyentry with points lt rgb '#404040' pt 7 title in_key('every sub-impact found'), \
       keyentry with points lt rgb '#404040' pt 6 title in_key('some lost or invented'), \
       keyentry with points lt rgb '#404040' pt 2 title in_key('unstable, or gave up')
}
unset multiplot
