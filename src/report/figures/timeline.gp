# Tables: $columns (from, to, left, right: what a column of panels shows and where), $sub_impacts
# (column, number, start, duration_us, impulse_mNs; label_duration_us, label_impulse_mNs: whether
# there is room for the number; decided: 1 or 0; error_us, scatter_us: of the start, 0: none).
# Variables: titles of the columns, time_unit, horizon of prediction (NaN: the end).
n = |$columns| - 1
array from[n]
array to[n]
array left[n]
array right[n]
stats $columns using (k = int($0) + 1, from[k] = column('from'), to[k] = column('to'), \
                      left[k] = column('left'), right[k] = column('right'), 0) nooutput
of(c, name) = column('column') == c ? column(name) : NaN
decided(c, name) = column('decided') == 1 ? of(c, name) : NaN
undecided(c, name) = column('decided') == 0 ? of(c, name) : NaN
number(c, name) = column('label_'.name) == 1 ? of(c, name) : NaN
bar(c, name) = column(name) > 0 ? of(c, name) : NaN
largest_error = largest_scatter = 0
stats $sub_impacts using (e = column('error_us'), s = column('scatter_us'), \
                          largest_error = e > largest_error ? e : largest_error, \
                          largest_scatter = s > largest_scatter ? s : largest_scatter, 0) nooutput

set multiplot title marks font ',12'
set logscale y
unset key
do for [name in 'duration_us impulse_mNs'] {
  first = name eq 'duration_us'
  bottom = first ? 0.54 : 0.115
  low = 1e300
  high = 0
  set autoscale  # "stats" heeds the ranges of the panel before
  stats $sub_impacts using (v = column(name), low = v > 0 && v < low ? v : low, \
                            high = v > high ? v : high, 0) nooutput
  if (high == 0) { low = 0.2; high = 10/3.0 }
  least = low/1000  # of the bars that are shown
  if (first) {
    set autoscale
    stats $sub_impacts using (e = column('error_us'), s = column('scatter_us'), \
                              low = e > least && e < low ? e : low, \
                              low = s > least && s < low ? s : low, 0) nooutput
  }
  low = low/2
  high = 3*high
  if (floor(log10(high)) - ceil(log10(low)) < 1) {  # two labelled ticks at least
    low = 10.0**floor(log10(low))
    high = 10.0**ceil(log10(high))
  }
  set yrange [low:high]
  set format x (first ? '' : '% h')
  do for [c=1:n] {
    eval placed(left[c], right[c], bottom, bottom + 0.36)
    set xrange [from[c]:to[c]]
    set xtics tics(to[c] - from[c], 5)
    set title (first ? word(titles, c) : '') offset 0, -0.5
    set ylabel (c > 1 ? '' : first ? 'duration, µs' : 'impulse, mN s')
    set format y (c > 1 ? '' : '%g')
    set xlabel (first ? '' : 'start, '.time_unit)
    dark = first ? '#0072B2' : '#D55E00'
    pale = first ? '#8CBEDF' : '#EFB58C'
    unset key
    if (first && c == n) {
      set key at screen 0.98, screen 0.995*panels right top horizontal maxrows 1 samplen 1.5 font ',12'
    }
    unset object
    unset arrow
    if (horizon < to[c]) {
      set object rectangle from first (horizon > from[c] ? horizon : from[c]), graph 0 \
        to first to[c], graph 1 behind fillcolor rgb '#F7EDF3' fillstyle solid noborder
      if (horizon > from[c]) {
        set arrow from first horizon, graph 0 to first horizon, graph 1 nohead dt 2 lc rgb '#A8447F'
      }
    }
    plot $sub_impacts using 'start':(decided(c, name)) with impulses lc rgb dark lw 2 notitle, \
         $sub_impacts using 'start':(undecided(c, name)) with impulses lc rgb pale lw 1.5 notitle, \
         $sub_impacts using 'start':(first ? bar(c, 'scatter_us') : NaN) with impulses \
           lc rgb '#CC79A7' lw 6 notitle, \
         $sub_impacts using 'start':(first ? bar(c, 'error_us') : NaN) with impulses \
           lc rgb '#000000' lw 3 notitle, \
         $sub_impacts using 'start':(decided(c, name)) with points lc rgb dark pt 7 ps 0.8 notitle, \
         $sub_impacts using 'start':(undecided(c, name)) with points lc rgb pale pt 6 ps 0.9 notitle, \
         $sub_impacts using 'start':(number(c, name)):'number' with labels center offset 0, 0.8 \
           font ',11' notitle, \
         keyentry with boxes fillstyle solid noborder lc rgb '#000000' \
           title largest_error > 0 ? 'error of the start' : '', \
         keyentry with boxes fillstyle solid noborder lc rgb '#CC79A7' \
           title largest_scatter > 0 ? 'its scatter' : '', \
         keyentry with boxes fillstyle solid noborder lc rgb '#F7EDF3' \
           title horizon < to[n] ? 'not predictable' : ''
  }
}
unset multiplot
