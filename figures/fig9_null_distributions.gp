# What a repetition of the study gives: empirical distribution functions of the p-box areas over the replicated studies,
# for both samplers; below them the central 95 % of the studies and the printed value, with its two-sided p; and the areas of
# the friction force under both samplers jointly.
# The steps of the functions are too fine to show: their tops are joined by lines.
width = 17.4
height = 9.0
load 'figures/style.gp'

areas = data.'/fig9_null_distributions.csv'
marks = data.'/fig9_null_distributions_printed.csv'
pairs = data.'/fig9_null_distributions_pairs.csv'
samplers = 'TMCMC TMCMC-II'
own(i, name, what) = strcol('sampler') eq word(samplers, i) && strcol('parameter') eq name ? column(what) : NaN
colour(i) = i == TMCMC ? blue : vermillion
full(i) = i == TMCMC ? 7 : 9
hollow(i) = i == TMCMC ? 6 : 8
# The curves coincide: the first is wide and pale, so that the second, on it, shows in grey too.
wide = '#88'.blue[2:]

set multiplot
do for [panel = 1:2] {
  if (panel == 1) {
    name = 'friction_force_n'
    set xrange [0.06:0.30]
    set xtics 0.06
    x_format = '%.2f'
    x_name = 'P-box area, friction force (N)'
    set lmargin at screen 0.090
    set rmargin at screen 0.360
    set ylabel 'Share of the studies' offset 0.5, 0
  } else {
    name = 'natural_frequency_hz'
    set xrange [0.0068:0.0198]
    set xtics 0.003
    x_format = '%.3f'
    x_name = 'P-box area, natural frequency (Hz)'
    set lmargin at screen 0.385
    set rmargin at screen 0.655
    unset ylabel
  }

  set tmargin at screen 0.905
  set bmargin at screen 0.360
  set border 3
  set yrange [0:1]
  set ytics 0.25 nomirror scale 0.5
  set ytics format (panel == 1 ? '%.2f' : '')
  set xtics format '' scale 0.5
  set grid xtics ytics
  unset xlabel
  if (panel == 1) { set key at screen 0.5, 0.995 center top maxrows 1 Left reverse samplen 2.2 width -3 }
  set label 1 sprintf('(%s)', 'ab'[panel:panel]) at graph 0.90, 0.07 font 'Nimbus Sans:Bold,8.5' front
  plot for [i = 1:2] marks using (own(i, name, 'printed')):(0):(0):(1) with vectors nohead ls i lw 0.6, \
       areas using 'area':(own(TMCMC, name, 'cumulative')) with lines lw 3 lc rgb wide, \
       areas using 'area':(own(TMCMC_II, name, 'cumulative')) with lines ls TMCMC_II lw 1.1, \
       keyentry with lines lw 3 lc rgb wide title 'TMCMC', \
       keyentry with lines ls TMCMC_II lw 1.1 title 'TMCMC-II', \
       keyentry with lines lw 3 lc rgb grey title 'Central 95 %', \
       keyentry with points pt 6 ps 0.75 lw 1.1 lc rgb blue title 'Printed, TMCMC', \
       keyentry with points pt 8 ps 0.8 lw 1.1 lc rgb vermillion title 'Printed, TMCMC-II'

  # The strip below: a row for each sampler.
  unset key
  unset label 1
  unset ylabel
  set tmargin at screen 0.335
  set bmargin at screen 0.130
  set border 1
  set yrange [2.6:0.4]
  if (panel == 1) { set ytics ('TMCMC' 1, 'TMCMC-II' 2) scale 0 format '%g' } else { set ytics ('' 1, '' 2) scale 0 }
  set xtics format x_format
  set grid xtics noytics
  set xlabel x_name offset 0, 0.3
  plot for [i = 1:2] marks using (own(i, name, 'printed')):(0.4):(0):(i - 0.4) with vectors nohead ls i lw 0.6, \
       for [i = 1:2] marks using (own(i, name, 'low')):(i):(column('high') - column('low')):(0) with vectors nohead \
           lw 3 lc rgb colour(i), \
       for [i = 1:2] marks using (own(i, name, 'printed')):(i) with points pt full(i) ps 0.95 lc rgb printed, \
       for [i = 1:2] marks using (own(i, name, 'printed')):(i) with points pt hollow(i) ps 0.8 lw 1.1 \
           lc rgb colour(i), \
       for [i = 1:2] marks using (own(i, name, 'high')):(i):(sprintf('{/:Italic p} = %.2f', column('p'))) \
           with labels left offset 0.8, 0 font ',7.5'
  unset ytics
  set ytics
}
# Both samplers jointly: one point a study, the printed pair, and the line of equal areas.
set lmargin at screen 0.755
set rmargin at screen 0.985
set tmargin at screen 0.905
set bmargin at screen 0.130
set border 3
set logscale xy
set xrange [0.065:0.30]
set yrange [0.065:0.30]
set xtics (0.07, 0.1, 0.15, 0.2, 0.3) format '%g' scale 0.5
set ytics (0.07, 0.1, 0.15, 0.2, 0.3) format '%g' scale 0.5
set grid xtics ytics
set xlabel 'Area under TMCMC (N)' offset 0, 0.3
set ylabel 'Area under TMCMC-II (N)' offset 0.6, 0
set label 1 '(c)' at graph 0.90, 0.05 font 'Nimbus Sans:Bold,8.5' front
set arrow 1 from 0.065, 0.065 to 0.30, 0.30 nohead back lc rgb grey lw 0.6
plot pairs using 'first':'second' with points pt 7 ps 0.18 lc rgb '#88000000', \
     marks using (own(1, 'friction_force_n', 'printed')):(0.065):(0):(0.235) with vectors nohead lc rgb 'black' lw 0.9 dt (5, 3), \
     marks using (0.065):(own(2, 'friction_force_n', 'printed')):(0.235):(0) with vectors nohead lc rgb 'black' lw 0.9 dt (5, 3), \
     marks using (own(1, 'friction_force_n', 'printed')):(0.285):('printed') with labels left offset 0.4, 0 font ',7.5'
unset multiplot
