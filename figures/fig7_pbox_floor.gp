# P-boxes of as many runs as a study has: of the samplers, and of independent exact draws from the same posterior, which
# are the narrowest that any sampler with as many samples can be expected to give.
width = 17.4
height = 6.8
load 'figures/style.gp'

boxes = data.'/fig3_pboxes.csv'
floor_boxes = data.'/pbox_floor_pbox.csv'
own(sampler, name, bound) = strcol('sampler') eq sampler && strcol('parameter') eq name ? column(bound) : NaN

set yrange [0:1]
set ytics 0.25
set tmargin at screen 0.87
set bmargin at screen 0.155
set key at screen 0.53, 0.99 center top maxrows 1 Left reverse samplen 2.6 width 0

set multiplot
do for [panel = 1:2] {
  if (panel == 1) {
    name = 'friction_force_n'
    truth = true_friction_force_n
    set xrange [0.78:1.18]
    set xtics 0.1 format '%.1f'
    set xlabel 'Friction force {/:Italic F}_{/:Italic μ} (N)' offset 0, 0.3
    set ylabel 'Cumulative probability' offset 0.5, 0
    set ytics format '%.2f'
    set lmargin at screen 0.075
    set rmargin at screen 0.515
  } else {
    name = 'natural_frequency_hz'
    truth = true_natural_frequency_hz
    set xrange [3.03:3.13]
    set xtics 0.02 format '%.2f'
    set xlabel 'Natural frequency {/:Italic ω}_n (Hz)' offset 0, 0.3
    unset ylabel
    set ytics format ''
    set lmargin at screen 0.545
    set rmargin at screen 0.985
    unset key
  }
  set label 1 sprintf('(%s)', 'ab'[panel:panel]) at graph 0.02, 0.93 font 'Nimbus Sans:Bold,8.5' front
  set arrow 1 from truth, graph 0 to truth, graph 1 nohead front ls TRUTH
  set style fill transparent solid 0.15 noborder
  plot boxes using 'x':(own('TMCMC', name, 'lower')):'upper' with filledcurves fc rgb blue, \
       boxes using 'x':(own('TMCMC-II', name, 'lower')):'upper' with filledcurves fc rgb vermillion, \
       for [bound in 'lower upper'] boxes using 'x':(own('TMCMC', name, bound)) with lines ls TMCMC, \
       for [bound in 'lower upper'] boxes using 'x':(own('TMCMC-II', name, bound)) with lines ls TMCMC_II, \
       floor_boxes using 'x':(own('exact draws', name, 'lower')):'upper' with filledcurves fs solid 0.75 noborder fc rgb purple, \
       for [bound in 'lower upper'] floor_boxes using 'x':(own('exact draws', name, bound)) with lines ls EXACT lw 0.8, \
       keyentry with lines ls TMCMC title 'TMCMC', \
       keyentry with lines ls TMCMC_II title 'TMCMC-II', \
       keyentry with filledcurves fs solid 0.75 noborder fc rgb purple title 'Exact draws', \
       keyentry with lines ls TRUTH title 'Stated truth'
}
unset multiplot
