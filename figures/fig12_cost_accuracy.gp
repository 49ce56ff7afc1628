# What makes the p-boxes smaller, and at what cost: each point is a setting of the sampler, over 4 studies of 50 runs.
# One family of settings varies one thing from the published setting; the moves are then improved one by one.
width = 17.4
height = 12.4
load 'figures/style.gp'

settings = data.'/cost_accuracy.csv'
floor_areas = data.'/pbox_floor_growth.csv'
own(family, name) = strcol('family') eq family ? column(name) : NaN
area(name) = 'area_'.name

budget = 31000
orange = '#E69F00'
sky = '#56B4E9'
families = '"criterion" "samples" "steps" "scale" "moves" "chains" "better moves" "recommended" "recommended CoV = 1"'
titles = '"Criterion: N_{eff} from 0.9 N to 0.1 N" "Samples: N from 300 to 10 000" "Steps: 1 to 20" "Scale of the proposal" "Better proposals, one by one" "Waste-free, 8 to 128 chains" "The best of these, six budgets" "Recommended, {/:Italic N}_{eff} = {/:Italic N}/2" "Recommended, CoV = 1"'
set style line 21 lc rgb 'black' lw 0.9 pt 6 ps 0.6
set style line 22 lc rgb sky lw 0.9 pt 5 ps 0.5
set style line 23 lc rgb orange lw 0.9 pt 9 ps 0.6
set style line 24 lc rgb grey lw 0.9 pt 2 ps 0.6
set style line 25 lc rgb purple lw 0.9 pt 12 ps 0.7
set style line 26 lc rgb purple lw 0.9 pt 13 ps 0.6
set style line 27 lc rgb green lw 1.6 pt 7 ps 0.6
set style line 28 lc rgb '#0072B2' lw 1.6 pt 5 ps 0.6
set style line 29 lc rgb vermillion lw 1.3 pt 4 ps 0.9 dt (6, 3)

set logscale xy
set xrange [3000:1100000]
set xtics ('3 000' 3000, '10 000' 10000, '31 000' 31000, '100 000' 100000, '300 000' 300000, '10^6' 1000000)
set lmargin at screen 0.085
set rmargin at screen 0.70
set arrow 1 from budget, graph 0 to budget, graph 1 nohead back lc rgb grey dt (4, 4) lw 0.9

unset key
set multiplot
do for [panel = 1:3] {
  set label 1 sprintf('(%s)', 'abc'[panel:panel]) at graph 0.958, 0.90 font 'Nimbus Sans:Bold,8.5' front
  set tmargin at screen 0.985 - (panel - 1) * 0.315
  set bmargin at screen 0.715 - (panel - 1) * 0.315
  if (panel < 3) { set format x ''; unset xlabel } else { set format x '%g'; set xlabel 'Likelihood evaluations of a run' offset 0, 0.3 }
  if (panel < 3) { set for [x in '3000 10000 31000 100000 300000 1000000'] xtics add ('' x + 0) } \
  else { set xtics ('3 000' 3000, '10 000' 10000, '31 000' 31000, '100 000' 100000, '300 000' 300000, '10^6' 1000000) }
  if (panel == 1) {
    name = 'friction_force_n'
    quantity = area(name)
    set ylabel 'P-box area, {/:Italic F}_{/:Italic μ} (N)' offset 0.5, 0
    set yrange [0.0015:0.5]
    set ytics (0.003, 0.01, 0.03, 0.1, 0.3) format '%g'
  }
  if (panel == 2) {
    name = 'natural_frequency_hz'
    quantity = area(name)
    set ylabel 'P-box area, {/:Italic ω}_n (Hz)' offset 0.5, 0
    set yrange [0.0006:0.08]
    set ytics (0.001, 0.003, 0.01, 0.03) format '%g'
  }
  if (panel == 3) {
    quantity = 'log_evidence_rms'
    set ylabel 'RMS error of the log-evidence' offset 0.5, 0
    set yrange [0.0012:10]
    set ytics (0.002, 0.01, 0.05, 0.2, 1, 5) format '%g'
  }
  plot floor_areas using (3000): \
         (strcol('runs') eq '50' && strcol('samples') eq '1000' && panel < 3 ? column(name) : NaN):(1097000):(0) \
         with vectors nohead ls EXACT dt '-', \
       floor_areas using (3000): \
         (strcol('runs') eq '50' && strcol('samples') eq '16000' && panel < 3 ? column(name) : NaN):(1097000):(0) \
         with vectors nohead ls EXACT dt '.', \
       for [i = 1:9] settings using 'evaluations':(own(word(families, i), quantity)) with points ls 20 + i, \
       for [i = 7:9] settings using 'evaluations':(strcol('family') eq word(families, i) ? column(quantity) : 1/0) with lines ls 20 + i, \
       settings using 'evaluations':(own('published', quantity)) with points pt 3 ps 1.1 lw 1.6 lc rgb vermillion
}

# The key takes the height of all panels.
unset label
unset arrow
unset tics
unset xlabel
unset ylabel
unset grid
unset logscale
set border 0
set lmargin at screen 0.705
set rmargin at screen 0.999
set tmargin at screen 0.995
set bmargin at screen 0.085
set xrange [0:1]
set yrange [0:1]
set key inside left top maxcols 1 Left reverse samplen 2 width 0 spacing 1.15 font ',7.5'
plot NaN notitle, \
       keyentry with points pt 3 ps 1.1 lw 1.6 lc rgb vermillion title 'Published setting', \
       for [i = 1:6] keyentry with points ls 20 + i title word(titles, i), \
       for [i = 7:9] keyentry with linespoints ls 20 + i title word(titles, i), \
       keyentry with lines ls EXACT dt '-' title '50 runs of 1000 exact draws', \
       keyentry with lines ls EXACT dt '.' title '50 runs of 16 000 exact draws', \
       keyentry with lines lc rgb grey dt (4, 4) lw 0.9 title '31 000 evaluations'
unset multiplot
