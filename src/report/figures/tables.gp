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
# A spacing of tics, 1, 2 or 5 times a power of ten, that cuts an extent into about so many parts.
tics(extent, parts) = extent > 0 ? rounded(1.0*extent/parts, 10**floor(log10(1.0*extent/parts))) : 1
rounded(raw, decade) = raw <= decade ? decade : raw <= 2*decade ? 2*decade \
                       : raw <= 5*decade ? 5*decade : 10*decade
# eval placed(left, right, bottom, top): the axes of the panel that follows, in fractions of the
# figure. `panels`: the part of the height that lines of text above the panels leave.

placed(left, right, bottom, top) = sprintf( \
  'set lmargin at screen %g; set rmargin at screen %g; set bmargin at screen %g; '.\
  'set tmargin at screen %g', left, right, panels*bottom, panels*top)
# eval shaded('$table', colour): bands behind the panels that follow, from columns "from" and "to".
# eval hatched('$table', colour): more of them, hatched.
shaded(table, colour) = 'unset object; '.bands(table, colour, 1, 'solid')
hatched(table, colour) = bands(table, colour, 100001, 'transparent pattern 4')
bands(table, colour, first, fill) = 'n = |'.table.'| - 1; array from[n]; array to[n]; '.\
  'stats '.table.' using (from[int($0) + 1] = column("from"), to[int($0) + 1] = column("to"), 0) '.\
  'nooutput; do for [i=1:n] { set object i + '.first.' - 1 rectangle from first from[i], graph 0 '.\
  'to first to[i], graph 1 behind fillcolor rgb "'.colour.'" fillstyle '.fill.' noborder }'
