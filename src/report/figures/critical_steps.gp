# The largest stable step of explicit methods over the number of cells. Reads critical_steps.csv.
table = 'critical_steps.csv'
methods = ''
stats table using (methods = added(methods, strcol('method')), 0) nooutput
of(k, theory, name) = strcol('method') eq word(methods, k) && strcol('theory') eq theory \
                      ? us*column(name) : NaN

set multiplot layout 1,2 margins 0.1,0.79,0.13,0.92 spacing 0.08
set logscale xy
set xlabel 'cells'
set format y '%g'
set xtics (101, 201, 401, 801)
set key at screen 0.8,0.92 left top Left reverse samplen 1.5 spacing 1.2
set xrange [80:1000]
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
