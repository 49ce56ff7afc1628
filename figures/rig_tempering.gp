# Tempering parameter over the stage, one thin line per run: the samplers side by side, on a logarithmic and on a linear scale.
width = 17.4
height = 10.5
load 'figures/style.gp'

stages = data.'/tempering.csv'
# The rows are ordered by run, and one scale serves both samplers.
set table $read
set logscale y
plot stages using (runs = column('run') + 1, column('stage')):'beta'
unset logscale y
unset table
beta_low = GPVAL_Y_MIN
own(sampler, i, from) = \
    strcol('sampler') eq sampler && column('run') == i && column('stage') >= from ? column('beta') : NaN

set autoscale xfix
set offsets 0.3, 0.3
set xtics autofreq

set multiplot
do for [panel = 1:4] {
  in_left_column = panel == 1 || panel == 3
  if (panel < 3) {
    from = 1
    set logscale y
    set yrange [beta_low:3]
    set ytics autofreq format '10^{%T}'
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
    set ytics 0.2 format '%.1f'
    set tmargin at screen 0.50
    set bmargin at screen 0.10
    set xtics format '%g'
    set xlabel 'Stage {/:Italic j}' offset 0, 0.4
    unset title
  }
  set lmargin at screen (in_left_column ? 0.085 : 0.55)
  set rmargin at screen (in_left_column ? 0.52 : 0.985)
  if (in_left_column) {
    set ylabel 'Tempering parameter {/:Italic β}_{/:Italic j}' offset (panel == 1 ? 0.2 : -0.8), 0
  } else {
    set ytics format ''
    unset ylabel
  }
  set label 1 sprintf('(%s)', 'abcd'[panel:panel]) at graph 0.02, 0.94 font 'Nimbus Sans:Bold,8.5' front
  plot for [i = 0:runs - 1] stages using 'stage':(own(in_left_column ? 'TMCMC' : 'TMCMC-II', i, from)) with linespoints \
      ls (in_left_column ? TMCMC_RUN : TMCMC_II_RUN)
}
unset multiplot
