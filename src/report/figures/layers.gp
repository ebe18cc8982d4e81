# Event times with layers compared with those of the exact section law. Reads layers.csv.
table = 'layers.csv'
stats table using (n = column('layers'), error = us*column('max_difference_s'), 0) nooutput
# A column of the rows in which all sub-impacts correspond, or of those in which some do not.
of(name, all) = (column('corresponding') == column('sub_impacts') \
                 && column('corresponding') == column('exact_sub_impacts')) == all \
                ? us*column(name) : NaN
set logscale xy
set xlabel 'layers'
set ylabel 'event times, layers − exact (µs)'
set format y '10^{%L}'
set xtics (10, 20, 40, 80, 160, 320, 640)
set xrange [8:800]
set key above
plot error*(n/x)**2 with lines lt rgb '#808080' dt 2 title 'falling as 1/layers^2', \
     table using 'layers':(of('max_difference_s', 1)) with points lt 1 pt 7 title 'largest', \
     table using 'layers':(of('max_difference_s', 0)) with points lt 1 pt 6 \
       title 'largest, some sub-impacts lost or invented', \
     table using 'layers':(of('median_difference_s', 1)) with points lt 2 pt 5 title 'median', \
     table using 'layers':(of('median_difference_s', 0)) with points lt 2 pt 4 \
       title 'median of those that correspond'
