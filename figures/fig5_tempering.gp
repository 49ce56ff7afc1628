# Tempering parameter over the stage, one thin line per run: the samplers side by side, on a logarithmic and on a linear
# scale. beta = 0 at stage 0 is on the linear scale only.
width = 17.4
height = 10.5
load 'figures/style.gp'

runs = 50
stages = data.'/fig5_tempering.csv'
own(sampler, i, from) = \
    strcol('sampler') eq sampler && column('run') == i && column('stage') >= from ? column('beta') : NaN

set xrange [-0.3:11.3]
set xtics 1

set multiplot
do for [panel = 1:4] {
  in_left_column = panel == 1 || panel == 3
  if (panel == 1 || panel == 2) {
    from = 1
    set logscale y
    set yrange [5e-11:3]
    set ytics 100
    unset mytics
    set tmargin at screen 0.94
    set bmargin at screen 0.56
    set xtics format ''
    unset xlabel
    set title (in_left_column ? 'TMCMC' : 'TMCMC-II') offset 0, -0.6 font 'Nimbus Sans:Bold,8.5'
  } else {
    from = 0
    unset logscale y
    set yrange [-0.02:1.05]
    set ytics 0.2
    set tmargin at screen 0.50
    set bmargin at screen 0.10
    set xtics format '%g'
    set xlabel 'Stage {/:Italic j}' offset 0, 0.4
    unset title
  }
  if (in_left_column) {
    set lmargin at screen 0.085
    set rmargin at screen 0.52
    set ytics format (panel == 1 ? '10^{%T}' : '%.1f')
    set ylabel 'Tempering parameter {/:Italic β}_{/:Italic j}' offset (panel == 1 ? 1.6 : -0.8), 0
  } else {
    set lmargin at screen 0.55
    set rmargin at screen 0.985
    set ytics format ''
    unset ylabel
  }
  set label 1 sprintf('(%s)', 'abcd'[panel:panel]) at graph 0.02, 0.94 font 'Nimbus Sans:Bold,8.5' front
  if (in_left_column) {
    plot for [i = 0:runs - 1] stages using 'stage':(own('TMCMC', i, from)) with linespoints \
        ls TMCMC_RUN
  } else {
    plot for [i = 0:runs - 1] stages using 'stage':(own('TMCMC-II', i, from)) with linespoints \
        ls TMCMC_II_RUN
  }
}
unset multiplot
