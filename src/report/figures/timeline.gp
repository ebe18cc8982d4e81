# Tables: $sub_impacts (number, zone, from, to, impulse, certain: 1 or 0; start_error, start_scatter,
# 0: none), $zones (from, to, number). Variables: end, n_uncertain, horizon of prediction (NaN: the
# end).
t = time_factor(end)
# A column of panels per zone, as wide as the zone lasts; one for all where there are many zones.
n_zones = |$zones| - 1
array from[n_zones]
array to[n_zones]
to[1] = -1
stats $zones using (k = int($0) + 1, from[k] = t*column('from'), to[k] = t*column('to'), 0) nooutput
n = n_zones > 4 ? 1 : n_zones
to[1] = n < n_zones ? to[n_zones] : to[1]
title_of(c) = n < n_zones ? sprintf('zones 1 to %d', n_zones) : sprintf('zone %d', c)
if (!(to[1] >= 0)) {
  from[1] = 0
  to[1] = t*end
  title_of(c) = 'no sub-impact'
}
gap = 0.03
total = sum [c=1:n] (to[c] - from[c])
share(c) = most((to[c] - from[c])/total, 0.15)
per_share = (0.98 - 0.11 - gap*(n - 1))/(sum [c=1:n] share(c))
array left[n]
array right[n]
do for [c=1:n] {
  left[c] = c == 1 ? 0.11 : right[c - 1] + gap
  right[c] = left[c] + per_share*share(c)
}
do for [c=1:n] {  # with margins
  margin = 0.022*(to[c] - from[c])/(right[c] - left[c])
  from[c] = from[c] - margin
  to[c] = to[c] + margin
}
# Values in the units of the axes.
shown(name) = name eq 'duration' ? 1e6*(column('to') - column('from')) : 1e3*column('impulse')
predictable = t*horizon
start(unused) = t*column('from')
is_of(c) = n < n_zones || column('zone') == c
of(c, name) = is_of(c) ? shown(name) : NaN
certain(c, name) = column('certain') == 1 ? of(c, name) : NaN
uncertain(c, name) = column('certain') == 0 ? of(c, name) : NaN
number(c, name) = has_number[int($0) + 1] == c ? of(c, name) : NaN
bar(c, name) = column(name) > 0 && is_of(c) ? 1e6*column(name) : NaN
m = |$sub_impacts| - 1
array starts[m]
array zone[m]
array values[m]
array has_number[m]
largest_error = largest_scatter = 0
stats $sub_impacts using (e = 1e6*column('start_error'), s = 1e6*column('start_scatter'), \
                          largest_error = most(e, largest_error), \
                          largest_scatter = most(s, largest_scatter), 0) nooutput

set multiplot title marks font ',12'
set logscale y
unset key
do for [name in 'duration impulse'] {
  first = name eq 'duration'
  bottom = first ? 0.54 : 0.115
  low = 1e300
  high = 0
  set autoscale  # "stats" heeds the ranges of the panel before
  stats $sub_impacts using (v = shown(name), low = v > 0 ? least(v, low) : low, \
                            high = most(v, high), 0) nooutput
  if (high == 0) { low = 0.2; high = 10/3.0 }
  lowest_bar = low/1000  # that is shown
  if (first) {
    set autoscale
    stats $sub_impacts using (e = 1e6*column('start_error'), s = 1e6*column('start_scatter'), \
                              low = e > lowest_bar ? least(e, low) : low, \
                              low = s > lowest_bar ? least(s, low) : low, 0) nooutput
  }
  low = low/2
  high = 3*high
  if (floor(log10(high)) - ceil(log10(low)) < 1) {  # two labelled ticks at least
    low = decade_below(low)
    high = decade_above(high)
  }
  # Numbers have room a part of the width after that of the sub-impact before, unless they would lie
  # on the stem of a taller neighbour.
  do for [i=1:m] { starts[i] = zone[i] = values[i] = has_number[i] = 0 }
  set autoscale
  stats $sub_impacts using (i = int($0) + 1, starts[i] = start(0), zone[i] = column('zone'), \
                            values[i] = shown(name), 0) nooutput
  do for [c=1:n] {
    spacing = 0.03*(to[c] - from[c])/(right[c] - left[c])
    last = -1e300
    do for [i=1:m] {
      if ((n < n_zones || zone[i] == c) && starts[i] - last >= spacing \
          && 0 == (sum [j=1:m] (abs(starts[j] - starts[i]) < 0.5*spacing && values[j] > values[i]))) {
        has_number[i] = c
        last = starts[i]
      }
    }
  }
  set yrange [low:high]
  set format x (first ? '' : '% h')
  do for [c=1:n] {
    eval placed(left[c], right[c], bottom, bottom + 0.36)
    set xrange [from[c]:to[c]]
    set xtics tics(to[c] - from[c], 5)
    set title (first ? title_of(c) : '') offset 0, -0.5
    set ylabel (c > 1 ? '' : first ? 'duration, µs' : 'impulse, mN s')
    set format y (c > 1 ? '' : '%g')
    set xlabel (first ? '' : 'start, '.time_unit(end))
    dark = first ? '#0072B2' : '#D55E00'
    pale = first ? '#8CBEDF' : '#EFB58C'
    unset key
    if (first && c == n) {
      set key at screen 0.98, screen 0.995*panels right top horizontal maxrows 1 samplen 1.5 font ',12'
    }
    unset object
    unset arrow
    if (predictable < to[c]) {
      set object rectangle from first (predictable > from[c] ? predictable : from[c]), graph 0 \
        to first to[c], graph 1 behind fillcolor rgb '#F7EDF3' fillstyle solid noborder
      if (predictable > from[c]) {
        set arrow from first predictable, graph 0 to first predictable, graph 1 nohead dt 2 lc rgb '#A8447F'
      }
    }
    plot $sub_impacts using (start(0)):(certain(c, name)) with impulses lc rgb dark lw 2 notitle, \
         $sub_impacts using (start(0)):(uncertain(c, name)) with impulses lc rgb pale lw 1.5 notitle, \
         $sub_impacts using (start(0)):(first ? bar(c, 'start_scatter') : NaN) with impulses \
           lc rgb '#CC79A7' lw 6 notitle, \
         $sub_impacts using (start(0)):(first ? bar(c, 'start_error') : NaN) with impulses \
           lc rgb '#000000' lw 3 notitle, \
         $sub_impacts using (start(0)):(certain(c, name)) with points lc rgb dark pt 7 ps 0.8 notitle, \
         $sub_impacts using (start(0)):(uncertain(c, name)) with points lc rgb pale pt 6 ps 0.9 notitle, \
         $sub_impacts using (start(0)):(number(c, name)):'number' with labels center offset 0, 0.8 \
           font ',11' notitle, \
         keyentry with boxes fillstyle solid noborder lc rgb '#000000' \
           title largest_error > 0 ? 'error of the start' : '', \
         keyentry with boxes fillstyle solid noborder lc rgb '#CC79A7' \
           title largest_scatter > 0 ? 'its scatter' : '', \
         keyentry with boxes fillstyle solid noborder lc rgb '#F7EDF3' \
           title predictable < to[n] ? 'not predictable' : ''
  }
}
unset multiplot
