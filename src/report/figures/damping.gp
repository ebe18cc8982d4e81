# What methods leave of an oscillation in one step. Reads damping.csv and bdf_growth.csv.
methods = ''
stats 'damping.csv' using (methods = added(methods, strcol('method')), 0) nooutput
of(k, name) = strcol('method') eq word(methods, k) ? column(name) : NaN
table_of(method) = method[strstrt(method, ':') + 1:]

set multiplot layout 1,2 margins 0.085,0.985,0.14,0.91 spacing 0.09
set logscale x
set xlabel '{/Symbol w} h'
set format x '%g'
set xrange [0.1:100]

set title 'implicit tables: lines predicted, points measured'
set ylabel 'amplitude left by one step'
set yrange [0:1.05]
set key bottom left samplen 2 spacing 0.9
plot for [k=1:words(methods)] 'damping.csv' using 'omega_h':(of(k, 'predicted')) \
       with lines lt colour(k) dt dashes(k) title table_of(word(methods, k)), \
     for [k=1:words(methods)] 'damping.csv' using 'omega_h':(of(k, 'measured')) \
       with points lt colour(k) pt 7 ps 0.6 notitle

set title 'BDF: above 1 an oscillation grows'
set ylabel 'growth per step'
set yrange [0.7:1.15]
set key top right
plot 1 with lines lt rgb '#808080' dt 2 notitle, \
     for [k=1:5] 'bdf_growth.csv' \
       using 'omega_h':(column('order') == k ? column('growth') : NaN) \
       with lines lt k title sprintf('order %d', k)
unset multiplot
