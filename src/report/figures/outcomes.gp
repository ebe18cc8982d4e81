# How runs come out, by method and by step or tolerance. Reads outcomes.csv.
table = 'outcomes.csv'
verdicts = "right 'wrong count' inaccurate unstable failed refused 'not run'"
titles = "right 'wrong count' inaccurate unstable 'solver failed' refused 'left out'"
colours = '#009E73 #E69F00 #CC79A7 #D55E00 #7A0019 #56B4E9 #D0D0D0'

# Lists of texts with blanks: each text takes 60 characters.
padded(text) = sprintf('%60s', text)
with_text(list, text) = strstrt(list, padded(text)) ? list : list.padded(text)
length(list) = strlen(list)/60
place(list, text) = (strstrt(list, padded(text)) - 1)/60
trimmed(text) = text[1:1] eq ' ' ? trimmed(text[2:]) : text
text_at(list, i) = trimmed(list[60*i + 1:60*(i + 1)])

# The table has semicolons in place of commas.
with_comma(text) = strstrt(text, ';') \
                   ? text[:strstrt(text, ';') - 1].','.text[strstrt(text, ';') + 1:] : text
setting(unused) = sprintf('%g', column('omega_h_or_rtol'))

unset grid
unset key
set border 0
set tics scale 0
set style fill solid 1 noborder
set multiplot layout 1,2 margins 0.19,0.99,0.26,0.93 spacing 0.18
do for [k=1:words(verdicts)] {
  x = 0.12 + 0.125*(k - 1)
  set object k rect from screen x,0.02 to screen x + 0.015,0.06 \
      fc rgb word(colours, k) fs solid 1 noborder
  set label k word(titles, k) at screen x + 0.022,0.04 left
}
do for [group in "'fixed step' tolerance"] {
  set autoscale  # "stats" heeds the ranges of the panel before
  rows = ''
  columns = ''
  stats table using (strcol('group') eq group \
                     ? (rows = with_text(rows, strcol('row')), \
                        columns = with_text(columns, setting(0)), 0) : NaN) nooutput
  if (length(rows) > 0) {
    set title (group eq 'fixed step' ? group : 'error control')
    set xlabel (group eq 'fixed step' ? '{/Symbol w}_{max} h' : 'relative tolerance')
    set xrange [-0.6:length(columns) - 0.4]
    set yrange [length(rows) - 0.4:-0.6]
    set xtics rotate by 45 right ('' 0)
    set ytics ('' 0)
    do for [i=0:length(columns) - 1] { set xtics add (text_at(columns, i) i) }
    do for [i=0:length(rows) - 1] { set ytics add (with_comma(text_at(rows, i)) i) }
    plot for [k=1:words(verdicts)] table \
           using (strcol('group') eq group && strcol('verdict') eq word(verdicts, k) \
                  ? place(columns, setting(0)) : NaN):(place(rows, strcol('row'))):(0.46):(0.44) \
           with boxxyerror lc rgb word(colours, k)
  }
}
unset multiplot
