# The largest stable step of explicit methods over the number of cells. Reads critical_steps.csv.
table = 'critical_steps.csv'
methods = ''
sizes = ''
stats table using (methods = added(methods, strcol('method')), 0) nooutput
of(k, theory, name) = strcol('method') eq word(methods, k) && strcol('theory') eq theory \
                      ? us*column(name) : NaN

set multiplot layout 1,2 margins 0.1,0.79,0.13,0.92 spacing 0.08
set logscale xy
set xlabel 'cells'
set format y '%g'
stats table using (sizes = added(sizes, strcol('segments')), column('segments')) nooutput
set xtics ()
do for [n in sizes] { set xtics add (n int(n)) }
set key at screen 0.8,0.92 left top Left reverse samplen 1.5 spacing 1.2
set xrange [0.8*STATS_min:1.25*STATS_max]
do for [theory in 'rayleigh euler-bernoulli'] {
  first = theory eq 'rayleigh'
  set title (first ? 'Rayleigh: lines predicted, points measured' : 'Euler-Bernoulli (no rotary inertia)')
  set ylabel (first ? 'largest stable step (µs)' : '')
  plot for [k=1:words(methods)] table using 'segments':(of(k, theory, 'predicted_s')) \
         with lines lt colour(k) dt dashes(k) notitle, \
       for [k=1:words(methods)] table using 'segments':(of(k, theory, 'measured_s')) \
         with points lt colour(k) pt 7 title first ? '' : word(methods, k)
}
unset multiplot
