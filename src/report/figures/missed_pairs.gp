# Sub-impacts and separations that begin and end within one step. Reads missed_pairs.csv.
table = 'missed_pairs.csv'
stats table using (shortest = us*column('shortest_s'), n = column('runs'), 0) nooutput
set logscale x
set xlabel 'step (µs)'
set ylabel sprintf('strikes (of %d) wholly found', n)
set format x '%g'
set yrange [0:1.1*n]
set arrow from shortest, graph 0 to shortest, graph 1 nohead dt 2 lc rgb '#808080'
set label 'shortest sub-impact or separation' at shortest, graph 0.03 left rotate by 90 \
    offset -1,0 tc rgb '#606060'
set key above
plot table using (us*column('step_s')):'right_with_search' with linespoints lt 1 \
       title 'pairs within a step looked for', \
     table using (us*column('step_s')):'right_without' with linespoints lt 2 \
       title 'ends of steps only'
