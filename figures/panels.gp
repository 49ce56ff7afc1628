# What the panels of samples need of a row of corner_summary.csv: name(p), low(p), high(p) and tick(p) of its parameters, p = 1 ... d.
# The first cells of a row, as text, are the words of `panels`.
set datafile separator comma
set datafile columnheaders
panels = ''
quoted(c) = ' "'.strcol(c).'"'
set xrange [0:1]
set yrange [0:1]
set table $read
plot data.'/corner_summary.csv' using (panels = panels.quoted('parameter').quoted('low').quoted('high').quoted('tick'), 0)
unset table
set xrange [*:*]
set yrange [*:*]
d = words(panels) / 4
name(p) = word(panels, 4 * p - 3)
low(p) = real(word(panels, 4 * p - 2))
high(p) = real(word(panels, 4 * p - 1))
tick(p) = real(word(panels, 4 * p))
