# The stages of runs, a line each: tempering parameter, effective sample size of the weights, acceptance rate, and the sum of the
# increments of the log-evidence. What a run has not recorded stays empty.
width = 17.4
height = 10.5
load 'figures/style.gp'

stages = data.'/stages.csv'
stats stages using 'run' nooutput
runs = STATS_max
stats stages using 'stage' nooutput
last = STATS_max
stats stages using (column('beta') > 0 ? column('beta') : NaN) nooutput
smallest = STATS_min
stats stages using 'log_evidence_increment' nooutput
has_increments = STATS_max > STATS_min || STATS_max != 0
own(i, value) = column('run') == i ? value : NaN

unset key
set xrange [0.7:last + 0.3]
set multiplot
do for [panel = 1:4] {
  set lmargin at screen (panel % 2 ? 0.085 : 0.585)
  set rmargin at screen (panel % 2 ? 0.480 : 0.985)
  set tmargin at screen (panel < 3 ? 0.97 : 0.48)
  set bmargin at screen (panel < 3 ? 0.58 : 0.10)
  set label 1 sprintf('(%s)', 'abcd'[panel:panel]) at graph 0.02, 0.93 font 'Nimbus Sans:Bold,8.5' front
  if (panel > 2) { set xlabel 'Stage' offset 0, 0.4 }
  if (panel == 1) { set logscale y; set yrange [smallest / 2:2]; set ytics format '10^{%T}'; set ylabel 'Tempering parameter {/:Italic β}' } \
  else { unset logscale y; set yrange [0:*]; set ytics autofreq format '%g' }
  if (panel == 2) { set ylabel 'Effective sample size' }
  if (panel == 3) { set yrange [0:1]; set ylabel 'Acceptance rate' }
  if (panel == 4) { if (has_increments) { set yrange [*:*] } else { set yrange [-1:1] }; set ylabel 'Log-evidence up to {/:Italic β}' }
  total = 0
  unset label 2
  if (panel > 2 && !has_increments) {  # of independent draws
    set label 2 'not recorded by independent draws' at graph 0.5, 0.5 center
    plot NaN
  } else { if (panel < 4) {
    what = word('beta effective_sample_size acceptance_rate', panel)
    plot for [i = 1:runs] stages using 'stage':(own(i, column(what))) with linespoints ls TMCMC lw 0.7
  } else {
    plot for [i = 1:runs] stages using 'stage':(column('run') == i ? (total = (column('stage') == 1 ? 0 : total) + \
        column('log_evidence_increment'), total) : NaN) with linespoints ls TMCMC lw 0.7
  } }
}
unset multiplot
