# Counted work against the error of the runs of a plan, one line per sequence. Reads plan.csv.
# Variables: wanted_us and reference_us, the wanted error and that of the reference.
table = 'plan.csv'
sequences = ''
low_error = low_work = 1e300
high_error = high_work = 0
# A run of which no sub-impact was compared has the error 0 and is not drawn.
stats table using (sequences = added(sequences, strcol('sequence')), \
                   low_error = column('error_s') > 0 ? least(column('error_s'), low_error) : low_error, \
                   high_error = most(column('error_s'), high_error), \
                   low_work = least(column('counted_work'), low_work), \
                   high_work = most(column('counted_work'), high_work), 0) nooutput

set logscale xy
set format x '10^{%L}'
set format y '10^{%L}'
set xlabel 'largest error of an event time before the horizon (µs)'
set ylabel 'counted work (evaluations times unknowns)'
# Whole decades, so that each axis has two labelled tics at least.
set xrange [decade_below(0.5*least(1e6*low_error, reference_us)):decade_above(2*most(1e6*high_error, wanted_us))]
set yrange [decade_below(0.5*low_work):decade_above(2*high_work)]
set key outside right top Left reverse samplen 2 spacing 1.25
set arrow 1 from wanted_us, graph 0 to wanted_us, graph 1 nohead dt 2 lc rgb '#404040'
set label 1 'wanted' at wanted_us, graph 0.02 left offset 0.5,0 tc rgb '#404040'

of(k) = strcol('sequence') eq word(sequences, k)
right(k) = of(k) && strcol('verdict') eq 'right' ? 1e6*column('error_s') : NaN
marked(k, admitted) = of(k) && column('admitted') == admitted ? 1e6*column('error_s') : NaN
plot for [k=1:words(sequences)] table using (right(k)):'counted_work' \
       with lines lt colour(k) dt dashes(k) lw 1.5 notitle, \
     for [k=1:words(sequences)] table using (marked(k, 0)):'counted_work' \
       with points lt colour(k) pt hollow(k) lw 1.5 ps 1.0 notitle, \
     for [k=1:words(sequences)] table using (marked(k, 1)):'counted_work' \
       with points lt colour(k) pt filled(k) lw 1.5 ps 1.0 notitle, \
     table using (column('cheapest') == 1 ? 1e6*column('error_s') : NaN):'counted_work' \
       with points pt 6 ps 2.5 lw 2 lc rgb '#404040' title 'advised', \
     for [k=1:words(sequences)] NaN with linespoints lt colour(k) dt dashes(k) pt filled(k) \
       lw 1.5 title word(sequences, k), \
     NaN with points lt rgb '#404040' pt 7 title 'within, as are all finer', \
     NaN with points lt rgb '#404040' pt 6 title 'not'
