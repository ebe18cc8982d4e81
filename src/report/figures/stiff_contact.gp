# The largest stable step while a spring holds the striker in contact. Reads stiff_contact.csv.
table = 'stiff_contact.csv'
set logscale xy
set xlabel 'contact stiffness (N/m)'
set ylabel 'largest stable step (µs)'
set format x '10^{%L}'
set format y '%g'
set key above
plot table using 'stiffness_N_per_m':(us*column('beam_only_s')) with lines lt 7 dt 2 \
       title 'beam alone', \
     table using 'stiffness_N_per_m':(us*column('predicted_s')) with lines lt 1 \
       title 'beam, contact and striker: predicted', \
     table using 'stiffness_N_per_m':(us*column('measured_s')) with points lt 2 pt 7 \
       title 'measured'
