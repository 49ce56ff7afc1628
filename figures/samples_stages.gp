# The stages of runs, a line each: tempering parameter, effective sample size of the weights, acceptance rate, and the
# log-evidence up to beta. What a run has not recorded stays empty.
width = 17.4
height = 10.5
load 'figures/style.gp'

stages = data.'/stages.csv'
# The rows are ordered by run; independent draws record neither acceptance rates nor evidence of their stages.
recorded = 0
set table $read
set yrange [0:1]
plot stages using (runs = column('run'), recorded = valid(6) ? 1 : recorded, column('stage'))  # column 6: log_evidence
unset table
set yrange [*:*]
own(i, value) = column('run') == i ? value : NaN

unset key
set autoscale xfix
set offsets 0.3, 0.3
set multiplot
do for [panel = 1:4] {
  set lmargin at screen (panel % 2 ? 0.085 : 0.585)
  set rmargin at screen (panel % 2 ? 0.480 : 0.985)
  set tmargin at screen (panel < 3 ? 0.97 : 0.48)
  set bmargin at screen (panel < 3 ? 0.58 : 0.10)
  set label 1 sprintf('(%s)', 'abcd'[panel:panel]) at graph 0.02, 0.93 font 'Nimbus Sans:Bold,8.5' front
  if (panel > 2) { set xlabel 'Stage' offset 0, 0.4 }
  if (panel == 1) { set logscale y; set yrange [*:2]; set ytics format '10^{%T}'; set ylabel 'Tempering parameter {/:Italic β}' } \
  else { unset logscale y; set yrange [0:*]; set ytics autofreq format '%g' }
  if (panel == 2) { set ylabel 'Effective sample size' }
  if (panel == 3) { set yrange [0:1]; set ylabel 'Acceptance rate' }
  if (panel == 4) { set yrange [*:*]; set ylabel 'Log-evidence up to {/:Italic β}' }
  if (panel > 2 && !recorded) {
    set label 2 'not recorded by independent draws' at graph 0.5, 0.5 center
    unset tics
    set xrange [0:1]
    set yrange [0:1]
    plot NaN
  } else {
    what = word('beta effective_sample_size acceptance_rate log_evidence', panel)
    plot for [i = 1:runs] stages using 'stage':(own(i, column(what))) with linespoints ls TMCMC lw 0.7
  }
}
unset multiplot
