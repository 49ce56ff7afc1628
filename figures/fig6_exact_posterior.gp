# Marginal posterior densities of the four parameters: exact, by quadrature, and the pooled samples of all runs of each
# sampler as histograms; with the least-squares estimate and the values that made the data.
width = 17.4
height = 11.6
load 'figures/style.gp'

marginals = data.'/exact_posterior_marginals.csv'
histograms = data.'/exact_posterior_histograms.csv'
baseline = data.'/least_squares_baseline.csv'
own(name, what) = strcol('parameter') eq name ? column(what) : NaN
pooled(sampler, name, what) = strcol('sampler') eq sampler ? own(name, what) : NaN

set yrange [0:*]
set y2range [0:1]
set style fill transparent solid 0.15 noborder
set key at screen 0.53, 0.995 center top maxrows 1 Left reverse samplen 2.6 width 0

set multiplot
do for [panel = 1:4] {
  name = word('friction_force_n natural_frequency_hz phase_noise_deg frequency_ratio_noise', panel)
  if (panel == 1) {
    truth = true_friction_force_n
    set xrange [0.82:1.14]
    set xtics 0.05 format '%.2f'
    set ytics 5 format '%g'
    set xlabel 'Friction force {/:Italic F}_{/:Italic μ} (N)' offset 0, 0.3
    set ylabel 'Probability density (1/N)' offset 0.5, 0
  }
  if (panel == 2) {
    truth = true_natural_frequency_hz
    set xrange [3.03:3.13]
    set xtics 0.02 format '%.2f'
    set ytics 10
    set xlabel 'Natural frequency {/:Italic ω}_n (Hz)' offset 0, 0.3
    set ylabel 'Probability density (1/Hz)'
    unset key
  }
  if (panel == 3) {
    truth = true_phase_noise_deg
    set xrange [0:10]
    set xtics 2 format '%g'
    set ytics 0.2 format '%.1f'
    set xlabel 'Phase noise {/:Italic σ}_{/:Italic φ} (deg)' offset 0, 0.3
    set ylabel 'Probability density (1/deg)'
  }
  if (panel == 4) {
    truth = true_frequency_ratio_noise
    set xrange [0:0.05]
    set xtics 0.01 format '%.2f'
    set ytics 40 format '%g'
    set xlabel 'Frequency-ratio noise {/:Italic σ}_{/:Italic r}' offset 0, 0.3
    set ylabel 'Probability density'
  }
  in_left_column = panel == 1 || panel == 3
  set lmargin at screen (in_left_column ? 0.075 : 0.580)
  set rmargin at screen (in_left_column ? 0.475 : 0.975)
  set tmargin at screen (panel < 3 ? 0.935 : 0.455)
  set bmargin at screen (panel < 3 ? 0.580 : 0.100)
  set label 1 sprintf('(%s)', 'abcd'[panel:panel]) at graph 0.02, 0.92 font 'Nimbus Sans:Bold,8.5' front
  set arrow 1 from truth, graph 0 to truth, graph 1 nohead front ls TRUTH
  plot histograms using 'low':(pooled('TMCMC', name, 'density')) with fillsteps fc rgb blue, \
       histograms using 'low':(pooled('TMCMC-II', name, 'density')) with fillsteps fc rgb vermillion, \
       histograms using 'low':(pooled('TMCMC', name, 'density')) with steps ls TMCMC lw 0.8, \
       histograms using 'low':(pooled('TMCMC-II', name, 'density')) with steps ls TMCMC_II lw 0.8, \
       marginals using 'x':(own(name, 'density')) with lines ls EXACT, \
       baseline using (own(name, 'estimate')):(0):(0):(1) axes x1y2 with vectors nohead ls LEAST_SQUARES, \
       keyentry with lines ls EXACT title 'Exact', \
       keyentry with lines ls TMCMC title 'TMCMC', \
       keyentry with lines ls TMCMC_II title 'TMCMC-II', \
       keyentry with lines ls TRUTH title 'Stated truth', \
       keyentry with lines ls LEAST_SQUARES title 'Least squares'
}
unset multiplot
