# Marginal posterior densities of samples, one panel a parameter, with the median (solid) and the central 95 % (dashed).
summary = data.'/corner_summary.csv'
marginals = data.'/corner_marginals.csv'
set datafile separator comma
set datafile columnheaders
names = ''
marks = ''
stats summary using (names = names.' '.strcol('parameter'), \
    marks = marks.sprintf(' %.17g %.17g %.17g', column('q025'), column('q50'), column('q975')), 0) nooutput
d = words(names)
stats marginals using 'low' nooutput
bins = STATS_records / d
across = d < 3 ? d : 3
down = ceil(d / (1.0 * across))
width = 5.8 * across
height = 4.2 * down + 0.2
load 'figures/style.gp'
unset key
set style fill solid 0.35 noborder
set yrange [0:*]
power(x) = 10.0 ** floor(log10(x))
rounded(m) = m < 1.5 ? 1 : m < 3.5 ? 2 : m < 7.5 ? 5 : 10

set multiplot
do for [p = 1:d] {
  column_of = (p - 1) % across
  row_of = (p - 1) / across
  set lmargin at screen (column_of * 5.8 + 1.0) / width
  set rmargin at screen (column_of * 5.8 + 5.5) / width
  set tmargin at screen 1 - (row_of * 4.2 + 0.3) / height
  set bmargin at screen 1 - (row_of * 4.2 + 3.2) / height
  set xrange [*:*]
  stats marginals every ::(p - 1) * bins::p * bins - 1 using 'low':'high' nooutput
  set xrange [STATS_min_x:STATS_max_y]
  coarse = (STATS_max_y - STATS_min_x) / 3
  set xtics rounded(coarse / power(coarse)) * power(coarse) format '%g'
  set ytics format '%g'
  set label 1 word(names, p) noenhanced at graph 0.5, screen 1 - (row_of * 4.2 + 4.0) / height center
  do for [k = 1:3] {
    x = real(word(marks, 3 * (p - 1) + k))
    if (k == 2) { set arrow k from x, graph 0 to x, graph 1 nohead front ls MODEL } \
    else { set arrow k from x, graph 0 to x, graph 1 nohead front ls TRUTH }
  }
  plot marginals every ::(p - 1) * bins::p * bins - 1 using 'low':'density' with fillsteps fc rgb blue, \
       marginals every ::(p - 1) * bins::p * bins - 1 using 'low':'density' with steps ls TMCMC
}
unset multiplot
