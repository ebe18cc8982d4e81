# Tables: $first, $later (x, y: the first sub-impact and those after it), $insets (number, start,
# from, to, peak) and $inset_loops (inset, x, y): later sub-impacts that yield again.
# Variables: n_later, largest (indentation), largest_force; yields_x, yields_y, unloads_x, unloads_y:
# marks in the first sub-impact, if any.
f = force_factor(largest_force)
d = length_factor(largest)
force_name = force_unit(largest_force)
length_name = length_unit(largest)
n_insets = |$insets| - 1
if ($insets[2] eq 'NaN,NaN,NaN,NaN,NaN') { n_insets = 0 }
set multiplot title marks font ',12'
eval placed(0.10, n_insets ? 0.61 : 0.97, 0.14, 0.91)
set xlabel 'indentation, '.length_name
set ylabel 'contact force, '.force_name offset 0.5
set xrange [0:1.06*d*largest]
set xtics tics(d*largest, 4)
set yrange [0:*]
set offsets 0, 0, graph 0.06, 0
set key at graph 1, graph 1.1 right top horizontal maxrows 1 samplen 2.5
if (exists('yields_x')) {
  set label 'A: contact yields' at d*yields_x, f*yields_y point pt 7 ps 1.2 lc rgb '#000000' \
      left offset 1, -0.4 front
}
if (exists('unloads_x')) {
  set label 'B: unloading begins' at d*unloads_x, f*unloads_y point pt 7 ps 1.2 lc rgb '#000000' \
      right offset -1, 1 front
}
plot $later using (d*$1):(f*$2) with lines lc rgb '#A0A0A0' lw 1 title n_later > 0 ? 'later sub-impacts' : '', \
     $first using (d*$1):(f*$2) with lines lc 1 title 'first sub-impact'
unset label

height = n_insets ? 0.82/n_insets : 1
unset key
do for [i=1:n_insets] {
  set autoscale x  # "stats" heeds the range of the panel before
  stats $insets using (int($0) + 1 == i ? (number = column('number'), start = 1e3*column('start'), \
                       low = d*column('from'), high = d*column('to'), peak = f*column('peak'), 0) : 0) \
        nooutput
  last = i == n_insets
  top = 0.95 - height*(i - 1)
  eval placed(0.71, 0.97, top - height + (last ? 0.01 : 0.08), top - 0.045)
  margin = 0.1*(high - low)
  set title sprintf('no. %d, at %.4g ms', number, start) offset 0, -0.7 font ',13'
  set xlabel (last ? 'indentation, '.length_name : '')
  set ylabel force_name offset 1.5
  set xrange [low - margin:high + margin]
  set xtics tics(high - low, 3)
  set ytics tics(peak, 3)
  plot $inset_loops using (column('inset') == i ? d*column('x') : NaN):(f*column('y')) with lines lc i + 1 lw 1.2
}
unset multiplot
