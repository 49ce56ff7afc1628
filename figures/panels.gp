# What the panels of samples need of a row of corner_summary.csv: name(p), low(p), high(p) and tick(p) of its parameters, p = 1 ... d.
# gnuplot takes no text such as 5e-04 for a number, so that only the names are words.
set datafile separator comma
set datafile columnheaders
names = ''
set xrange [0:1]
set yrange [0:1]
set table $read
plot data.'/corner_summary.csv' using (names = names.' "'.strcol('parameter').'"', 0)
d = words(names)
array lows[d]
array highs[d]
array ticks[d]
p = 0
plot data.'/corner_summary.csv' using (p = p + 1, lows[p] = column('low'), highs[p] = column('high'), ticks[p] = column('tick'), 0)
unset table
set xrange [*:*]
set yrange [*:*]
name(p) = word(names, p)
low(p) = lows[p]
high(p) = highs[p]
tick(p) = ticks[p]
