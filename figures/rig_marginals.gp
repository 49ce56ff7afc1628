# Marginal posterior densities of a rig: exact, by quadrature, and the pooled samples of all runs of each sampler as histograms, with
# the least-squares estimate where there is one.
width = 17.4
height = 11.6
load 'figures/panels.gp'
load 'figures/style.gp'

marginals = data.'/exact_marginals.csv'
histograms = data.'/histograms.csv'
baseline = data.'/exact_posterior.csv'
pooled(sampler, value) = strcol('sampler') eq sampler ? own(value) : NaN
fitted(value) = value > low(parameter) && value < high(parameter) ? own(value) : NaN

set y2range [0:1]
set ytics format '%g'
set style fill transparent solid 0.15 noborder
set key at screen 0.53, 0.995 center top maxrows 1 Left reverse samplen 2.6 width 0

set multiplot
do for [i = 1:4] {
  call 'figures/rig_panels.gp' sprintf('%d', i)
  in_left_column = i == 1 || i == 3
  set lmargin at screen (in_left_column ? 0.080 : 0.585)
  set rmargin at screen (in_left_column ? 0.475 : 0.980)
  set tmargin at screen (i < 3 ? 0.935 : 0.455)
  set bmargin at screen (i < 3 ? 0.580 : 0.100)
  set label 1 sprintf('(%s)', 'abcd'[i:i]) at graph 0.02, 0.92 font 'Nimbus Sans:Bold,8.5' front
  set yrange [0:*]
  set ylabel 'Probability density ('.word('1/N 1/Hz 1/deg 1', i).')' offset -0.5, 0
  plot histograms using 'low':(pooled('TMCMC', column('density'))) with fillsteps fc rgb blue, \
       histograms using 'low':(pooled('TMCMC-II', column('density'))) with fillsteps fc rgb vermillion, \
       histograms using 'low':(pooled('TMCMC', column('density'))) with steps ls TMCMC lw 0.8, \
       histograms using 'low':(pooled('TMCMC-II', column('density'))) with steps ls TMCMC_II lw 0.8, \
       marginals using 'x':(own(column('density'))) with lines ls EXACT, \
       baseline using (fitted(column('least_squares'))):(0):(0):(1) axes x1y2 with vectors nohead ls LEAST_SQUARES, \
       keyentry with lines ls EXACT title 'Exact', \
       keyentry with lines ls TMCMC title 'TMCMC (CoV = 1)', \
       keyentry with lines ls TMCMC_II title 'TMCMC-II ({/:Italic N}_{eff} = {/:Italic N}/2)', \
       keyentry with lines ls LEAST_SQUARES title 'Least squares'
  unset key
}
unset multiplot
