# Phase angle over the force ratio at the frequency ratios of Table 1: closed form up to Den Hartog's limit, integration in
# time below and beyond it; and the phase error of the published discretisation over the frequency ratio.
width = 17.4
height = 8.2
load 'figures/style.gp'

grid_rows = data.'/model_validation.csv'
errors = data.'/model_validation_errors.csv'
at_ratio(r, what) = abs(column('frequency_ratio') - r) < 1e-9 ? column(what) : NaN
every_tenth(r, what) = int(column(0)) % 10 == 0 ? at_ratio(r, what) : NaN
below(what) = column('frequency_ratio') < 1 ? column(what) : NaN
above(what) = column('frequency_ratio') > 1 ? column(what) : NaN

# Four of the ten ratios, which lie close together, and where their names stand.
ratios = '0.644 0.954 1.065 1.937'
label_x = '0.66 0.62 0.62 0.78'
label_y = '38 79 104 138'
integrated = '#707070'

set multiplot
set lmargin at screen 0.070
set rmargin at screen 0.515
set tmargin at screen 0.895
set bmargin at screen 0.125
set xrange [0:1]
set yrange [0:180]
set xtics 0.2 format '%.1f'
set ytics 30
set xlabel 'Force ratio {/:Italic ϕ} = {/:Italic F}_{/:Italic μ} / {/:Italic k Y}_b' offset 0, 0.3
set ylabel 'Phase angle (deg)' offset 0.9, 0
set key at screen 0.2925, 0.995 center top maxrows 1 Left reverse samplen 2.2 width 0
set label 1 '(a)' at graph 0.02, 0.5 font 'Nimbus Sans:Bold,8.5' front
do for [i = 1:4] {
  set label 10 + i sprintf('{/:Italic r} = %s', word(ratios, i)) at first word(label_x, i) + 0, word(label_y, i) + 0 \
      center font ',8' front
}
plot for [r in ratios] grid_rows using 'force_ratio':(at_ratio(r + 0, 'phase_integrated_deg')) with lines lw 0.6 \
         lc rgb integrated, \
     for [r in ratios] grid_rows using 'force_ratio':(at_ratio(r + 0, 'phase_exact_deg')) with lines ls MODEL lw 1.6, \
     for [r in ratios] grid_rows using 'force_ratio':(every_tenth(r + 0, 'phase_integrated_deg')) with points pt 6 \
         ps 0.5 lw 0.8 lc rgb integrated, \
     keyentry with lines ls MODEL lw 1.6 title 'Closed form, to its limit', \
     keyentry with linespoints pt 6 ps 0.5 lw 0.6 lc rgb integrated title 'Integrated in time'

do for [i = 1:4] { unset label 10 + i }
unset key
set lmargin at screen 0.610
set rmargin at screen 0.980
set xrange [0.6:2]
set xtics 0.2
set yrange [-0.04:0.04]
set ytics 0.02 format '%.2f'
set xtics format '%.1f'
set xlabel 'Frequency ratio {/:Italic r}' offset 0, 0.3
set ylabel 'Phase error (deg)' offset -0.1, 0
set label 1 '(b)' at graph 0.04, 0.92 font 'Nimbus Sans:Bold,8.5' front
plot errors using 'frequency_ratio':(below('phase_error_deg')) with lines ls MODEL, \
     errors using 'frequency_ratio':(above('phase_error_deg')) with lines ls MODEL
unset multiplot
