# What figures share that read tables: CSV with a heading, units SI.
set datafile separator ','
set datafile missing NaN
set datafile columnheaders
us = 1e6  # per second
# A list of words with one more word, unless it holds that word.
added(list, word) = strstrt(' '.list.' ', ' '.word.' ') ? list : list.' '.word
# Colour and dashes of the k-th of many lines.
colour(k) = (k - 1)%8 + 1
dashes(k) = (k - 1)/8 + 1
# Marks of the k-th of many lines, filled and hollow.
filled(k) = int(word('7 5 9 13 11 15', (k - 1)%6 + 1))
hollow(k) = int(word('6 4 8 12 10 14', (k - 1)%6 + 1))

least(a, b) = a < b ? a : b  # NaN is neither less nor more
most(a, b) = a > b ? a : b
decade_below(x) = 10.0**floor(log10(x))
decade_above(x) = 10.0**ceil(log10(x))

# A spacing of tics, 1, 2 or 5 times a power of ten, that cuts an extent into about so many parts.
tics(extent, parts) = extent > 0 ? rounded(1.0*extent/parts, 10**floor(log10(1.0*extent/parts))) : 1
rounded(raw, decade) = raw <= decade ? decade : raw <= 2*decade ? 2*decade \
                       : raw <= 5*decade ? 5*decade : 10*decade
# eval placed(left, right, bottom, top): the axes of the panel that follows, in fractions of the
# figure. `panels`: the part of the height that lines of text above the panels leave.

placed(left, right, bottom, top) = sprintf( \
  'set lmargin at screen %g; set rmargin at screen %g; set bmargin at screen %g; '.\
  'set tmargin at screen %g', left, right, panels*bottom, panels*top)
# Units that suit the largest value that is shown: values in SI units times the factor.
force_unit(x) = x >= 1e3 ? 'kN' : x >= 0.1 ? 'N' : 'mN'
force_factor(x) = x >= 1e3 ? 1e-3 : x >= 0.1 ? 1 : 1e3
length_unit(x) = x >= 1e-4 ? 'mm' : x >= 1e-7 ? 'µm' : 'nm'
length_factor(x) = x >= 1e-4 ? 1e3 : x >= 1e-7 ? 1e6 : 1e9
energy_unit(x) = x >= 0.1 ? 'J' : x >= 1e-4 ? 'mJ' : 'µJ'
energy_factor(x) = x >= 0.1 ? 1 : x >= 1e-4 ? 1e3 : 1e6
time_unit(x) = x > 1e-3 ? 'ms' : 'µs'
time_factor(x) = x > 1e-3 ? 1e3 : 1e6

# eval shaded('$table', factor, colour): bands behind the panels that follow, from columns "from"
# and "to" times a factor; of sub-impacts the certain ones.
# eval hatched('$sub_impacts', factor, colour): those not certain, hatched.
shaded(table, factor, colour) = 'unset object; '.bands(table, factor, colour, \
  table eq '$sub_impacts' ? 'column("certain") == 1' : '1', 1, 'solid')
hatched(table, factor, colour) = bands(table, factor, colour, 'column("certain") == 0', 100001, \
  'transparent pattern 4')
bands(table, factor, colour, condition, first, fill) = 'n = |'.table.'| - 1; array from[n]; '.\
  'array to[n]; do for [i=1:n] { to[i] = -1 }; stats '.table.' using (i = int($0) + 1, '.\
  'from[i] = '.factor.'*column("from"), to[i] = '.condition.' ? '.factor.'*column("to") : -1, 0) '.\
  'nooutput; do for [i=1:n] { if (to[i] >= 0) { set object i + '.first.' - 1 rectangle from '.\
  'first from[i], graph 0 to first to[i], graph 1 behind fillcolor rgb "'.colour.'" fillstyle '.\
  fill.' noborder } }'
