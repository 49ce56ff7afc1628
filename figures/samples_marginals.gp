# Marginal posterior densities of samples, one panel a parameter, with the median (solid) and the central 95 % (dashed).
summary = data.'/corner_summary.csv'
marginals = data.'/corner_marginals.csv'
load 'figures/panels.gp'
across = d < 3 ? d : 3
down = ceil(d / (1.0 * across))
width = 5.8 * across
height = 4.2 * down + 0.2
load 'figures/style.gp'
unset key
set style fill solid 0.35 noborder
set yrange [0:*]
set y2range [0:1]
own(p, value) = strcol('parameter') eq name(p) ? value : NaN
mark = "using (own(p, column(level))):(0):(0):(1) axes x1y2 with vectors nohead"

set multiplot
do for [p = 1:d] {
  column_of = (p - 1) % across
  row_of = (p - 1) / across
  set lmargin at screen (column_of * 5.8 + 1.0) / width
  set rmargin at screen (column_of * 5.8 + 5.5) / width
  set tmargin at screen 1 - (row_of * 4.2 + 0.3) / height
  set bmargin at screen 1 - (row_of * 4.2 + 3.2) / height
  set xrange [low(p):high(p)]
  set xtics tick(p) format '%g'
  set ytics format '%g'
  set label 1 name(p) noenhanced at graph 0.5, screen 1 - (row_of * 4.2 + 4.0) / height center
  plot marginals using (own(p, column('low'))):'density' with fillsteps fc rgb blue, \
       marginals using (own(p, column('low'))):'density' with steps ls TMCMC, \
       for [level in 'q025 q975'] summary @mark ls TRUTH, for [level in 'q50'] summary @mark ls MODEL
}
unset multiplot
