# Corner plot of samples: marginal densities on the diagonal with median and central 95 %, below it the joint densities, shaded by the
# probability of the smallest region around them; the contours of 50 and 95 % are where the shade changes.
joint = data.'/corner.csv'
marginals = data.'/corner_marginals.csv'
load 'figures/panels.gp'

side = d < 5 ? 3.6 : d < 9 ? 2.4 : 1.8
width = d * side + 1.9
height = d * side + 1.6
load 'figures/style.gp'

set datafile missing NaN  # the cells of other pairs
own(p, value) = strcol('parameter') eq name(p) ? value : NaN
of_pair(x, y, value) = strcol('x_parameter') eq name(x) && strcol('y_parameter') eq name(y) ? value : NaN

set palette defined (0 '#0072B2', 0.5 '#4F9FCC', 0.5 '#86BEDF', 0.95 '#C5E0F0', 0.95 '#E9F3FA', 0.999 '#F4F9FD', 1 'white')
set cbrange [0:1]
unset colorbox
unset key
set style fill solid 0.35 noborder
set tics font ',7'
set xtics rotate by -40
if (d > 8) { unset tics }

set multiplot
do for [row = 1:d] {
  do for [col = 1:row] {
    set lmargin at screen (1.6 + (col - 1) * side + 0.1) / width
    set rmargin at screen (1.6 + col * side - 0.1) / width
    set tmargin at screen 1 - (0.15 + (row - 1) * side) / height
    set bmargin at screen 1 - (0.15 + row * side - 0.2) / height
    set xrange [low(col):high(col)]
    set xtics tick(col) format (row == d ? '%g' : '')
    unset label
    if (row == d) { set label 1 name(col) noenhanced font ',7.5' at graph 0.5, screen 0.25 / height center }
    if (col == 1 && row > 1) { set label 2 name(row) noenhanced font ',7.5' at screen 0.25 / width, graph 0.5 center rotate by 90 }
    if (row == col) {
      set yrange [0:*]
      unset ytics
      plot marginals using (own(col, column('low'))):'density' with fillsteps fc rgb blue, \
           marginals using (own(col, column('low'))):'density' with steps ls TMCMC
    } else {
      set yrange [low(row):high(row)]
      set ytics tick(row) format (col == 1 ? '%g' : '') nomirror out scale 0.5, 0.3 textcolor rgb 'black'
      if (d > 8) { unset ytics }
      plot joint using (of_pair(col, row, column('x'))):'y':'level' with image
    }
  }
}
unset multiplot
