# What a repetition of the study gives: for each number of iterations, in which share of the replicated studies so many
# of the runs took it, for both samplers; below, the printed counts.
width = 17.4
height = 7.6
load 'figures/style.gp'

shares = data.'/fig9_null_distributions_counts.csv'
samplers = 'TMCMC TMCMC-II'
of(i, iterations, what) = \
    strcol('sampler') eq word(samplers, i) && column('iterations') == iterations ? column(what) : NaN
colour(i) = i == TMCMC ? blue : vermillion
full(i) = i == TMCMC ? 7 : 9
hollow(i) = i == TMCMC ? 6 : 8
# The samplers stand side by side, left and right of the number of runs.
side(i) = i == TMCMC ? -0.17 : 0.17
top = 0.28

set multiplot
do for [panel = 1:3] {
  iterations = panel + 8
  if (panel == 1) {
    set lmargin at screen 0.100
    set rmargin at screen 0.345
    set xrange [-0.7:10.7]
  }
  if (panel == 2) {
    set lmargin at screen 0.368
    set rmargin at screen 0.694
    set xrange [35.3:50.7]
  }
  if (panel == 3) {
    set lmargin at screen 0.717
    set rmargin at screen 0.990
    set xrange [-0.7:12.7]
  }

  set tmargin at screen 0.845
  set bmargin at screen 0.375
  set border 3
  set yrange [0:top]
  set ytics 0.1 nomirror scale 0.5
  set ytics format (panel == 1 ? '%.1f' : '')
  set xtics 2 format '' scale 0.5
  set grid noxtics ytics
  unset xlabel
  if (panel == 1) {
    set ylabel 'Share of the studies' offset 0.5, 0
    set key at screen 0.5375, 0.995 center top maxrows 1 Left reverse samplen 2 width 0
  }
  set label 1 sprintf('{/:Bold (%s)}  %d iterations', 'abc'[panel:panel], iterations) at graph 0, 1.07 left front
  plot for [i = 1:2] shares using (of(i, iterations, 'printed')):(top) smooth unique with impulses ls i lw 0.6, \
       for [i = 1:2] shares using (column('runs') + side(i)):(of(i, iterations, 'share_of_studies')) with impulses \
           lw 2 lc rgb colour(i), \
       for [i = 1:2] shares using (column('runs') + side(i)):(of(i, iterations, 'share_of_studies')) with points \
           pt full(i) ps (i == TMCMC ? 0.5 : 0.6) lc rgb colour(i), \
       keyentry with points pt 7 ps 0.5 lc rgb blue title 'TMCMC', \
       keyentry with points pt 9 ps 0.6 lc rgb vermillion title 'TMCMC-II', \
       keyentry with points pt 6 ps 0.75 lw 1.1 lc rgb blue title 'Printed, TMCMC', \
       keyentry with points pt 8 ps 0.8 lw 1.1 lc rgb vermillion title 'Printed, TMCMC-II'

  # The strip below: a row for each sampler.
  unset key
  unset label 1
  unset ylabel
  set tmargin at screen 0.345
  set bmargin at screen 0.150
  set border 1
  set yrange [2.6:0.4]
  if (panel == 1) { set ytics ('TMCMC' 1, 'TMCMC-II' 2) scale 0 format '%g' } else { set ytics ('' 1, '' 2) scale 0 }
  set xtics format '%g'
  set grid noxtics ytics
  set xlabel 'Runs' offset 0, 0.3
  plot for [i = 1:2] shares using (of(i, iterations, 'printed')):(i - 0.25) smooth unique with impulses ls i lw 0.6, \
       for [i = 1:2] shares using (of(i, iterations, 'printed')):(i) smooth unique with points pt full(i) ps 0.95 \
           lc rgb printed, \
       for [i = 1:2] shares using (of(i, iterations, 'printed')):(i) smooth unique with points pt hollow(i) ps 0.8 \
           lw 1.1 lc rgb colour(i)
  unset ytics
  set ytics
}
unset multiplot
