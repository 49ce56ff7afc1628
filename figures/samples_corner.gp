# Corner plot of samples: marginal densities on the diagonal with median and central 95 %, below it the joint densities, shaded by the
# probability of the smallest region around them; the contours of 50 and 95 % are where the shade changes.
load_summary = data.'/corner_summary.csv'
joint = data.'/corner.csv'
marginals = data.'/corner_marginals.csv'
set datafile separator comma
set datafile columnheaders
names = ''
lows = ''
highs = ''
stats load_summary using (names = names.' '.strcol('parameter'), lows = lows.sprintf(' %.17g', column('low')), \
    highs = highs.sprintf(' %.17g', column('high')), 0) nooutput
d = words(names)
stats marginals using 'low' nooutput
bins = STATS_records / d

side = d < 5 ? 3.6 : d < 9 ? 2.4 : 1.8
width = d * side + 1.9
height = d * side + 1.6
load 'figures/style.gp'

low(p) = real(word(lows, p))
high(p) = real(word(highs, p))
# Two or three round tics.
power(x) = 10.0 ** floor(log10(x))
rounded(m) = m < 1.5 ? 1 : m < 3.5 ? 2 : m < 7.5 ? 5 : 10
step(p) = rounded((high(p) - low(p)) / 2.5 / power((high(p) - low(p)) / 2.5)) * power((high(p) - low(p)) / 2.5)
before(x, y) = (x - 1) * d - x * (x - 1) / 2 + y - x - 1  # pairs of parameters before (x, y), x < y

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
    set xtics step(col) format (row == d ? '%g' : '')
    unset label
    if (row == d) { set label 1 word(names, col) noenhanced font ',7.5' at graph 0.5, screen 0.25 / height center }
    if (col == 1 && row > 1) { set label 2 word(names, row) noenhanced font ',7.5' at screen 0.25 / width, graph 0.5 center rotate by 90 }
    if (row == col) {
      set yrange [0:*]
      unset ytics
      plot marginals every ::(col - 1) * bins::col * bins - 1 using 'low':'density' with fillsteps fc rgb blue, \
           marginals every ::(col - 1) * bins::col * bins - 1 using 'low':'density' with steps ls TMCMC
    } else {
      set yrange [low(row):high(row)]
      set ytics step(row) format (col == 1 ? '%g' : '') nomirror out scale 0.5, 0.3 textcolor rgb 'black'
      if (d > 8) { unset ytics }
      first = before(col, row) * bins * bins
      plot joint every ::first::first + bins * bins - 1 using 'x':'y':'level' with image
    }
  }
}
unset multiplot
