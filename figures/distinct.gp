# The different values of a column, in the order of the file: words of `found`. Call with file and column, after loading style.gp.
found = ''
noted(value) = strstrt(found, '"'.value.'"') ? 0 : (found = found.' "'.value.'"', 0)
set xrange [0:1]
set yrange [0:1]
set table $read
plot ARG1 using (noted(strcol(ARG2)))
unset table
set xrange [*:*]
set yrange [*:*]
