# P-boxes of the posterior: the bounds of the empirical distribution functions of all runs, for each parameter and
# sampler, with the values that made the data and the least-squares estimate.
width = 17.4
height = 11
load 'figures/style.gp'

boxes = data.'/fig3_pboxes.csv'
baseline = data.'/least_squares_baseline.csv'
own(sampler, name, bound) = strcol('sampler') eq sampler && strcol('parameter') eq name ? column(bound) : NaN
estimate(name) = strcol('parameter') eq name ? column('estimate') : NaN

set yrange [0:1]
set ytics 0.25
set style fill transparent solid 0.18 noborder

set multiplot
do for [panel = 1:4] {
  name = word('friction_force_n natural_frequency_hz phase_noise_deg frequency_ratio_noise', panel)
  if (panel == 1) {
    truth = true_friction_force_n
    set xrange [0.7:1.8]
    set xtics 0.2 format '%.1f'
    set xlabel 'Friction force {/:Italic F}_{/:Italic μ} (N)' offset 0, 0.3
    set key at graph 0.66, 0.5 left center Left reverse
  }
  if (panel == 2) {
    truth = true_natural_frequency_hz
    set xrange [3.00:3.16]
    set xtics 0.04 format '%.2f'
    set xlabel 'Natural frequency {/:Italic ω}_n (Hz)' offset 0, 0.3
    unset key
  }
  if (panel == 3) {
    truth = true_phase_noise_deg
    set xrange [0:10]
    set xtics 2 format '%g'
    set xlabel 'Phase noise {/:Italic σ}_{/:Italic φ} (deg)' offset 0, 0.3
  }
  if (panel == 4) {
    truth = true_frequency_ratio_noise
    set xrange [0:0.06]
    set xtics 0.01 format '%.2f'
    set xlabel 'Frequency-ratio noise {/:Italic σ}_{/:Italic r}' offset 0, 0.3
  }
  in_left_column = panel == 1 || panel == 3
  set lmargin at screen (in_left_column ? 0.08 : 0.605)
  set rmargin at screen (in_left_column ? 0.560 : 0.980)
  set tmargin at screen (panel < 3 ? 0.965 : 0.465)
  set bmargin at screen (panel < 3 ? 0.595 : 0.095)
  if (in_left_column) {
    set ylabel 'Cumulative probability' offset 0.5, 0
    set ytics format '%.2f'
  } else {
    unset ylabel
    set ytics format ''
  }
  set label 1 sprintf('(%s)', 'abcd'[panel:panel]) at graph 0.02, 0.92 font 'Nimbus Sans:Bold,8.5' front
  set arrow 1 from truth, graph 0 to truth, graph 1 nohead front ls TRUTH
  plot boxes using 'x':(own('TMCMC', name, 'lower')):'upper' with filledcurves fc rgb blue, \
       boxes using 'x':(own('TMCMC-II', name, 'lower')):'upper' with filledcurves fc rgb vermillion, \
       for [bound in 'lower upper'] boxes using 'x':(own('TMCMC', name, bound)) with lines ls TMCMC, \
       for [bound in 'lower upper'] boxes using 'x':(own('TMCMC-II', name, bound)) with lines ls TMCMC_II, \
       baseline using (estimate(name)):(0):(0):(1) with vectors nohead ls LEAST_SQUARES, \
       keyentry with lines ls TMCMC title 'TMCMC', \
       keyentry with lines ls TMCMC_II title 'TMCMC-II', \
       keyentry with lines ls TRUTH title 'Stated truth', \
       keyentry with lines ls LEAST_SQUARES title 'Least squares'
}
unset multiplot
