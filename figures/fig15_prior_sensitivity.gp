# What the posterior owes to the prior of the noise levels: exact distribution functions under three priors, and the p-boxes of
# 50 runs of the paper's TMCMC-II (pale) and of the recommended sampler (dark) around them.
width = 17.4
height = 11.2
load 'figures/style.gp'

boxes = data.'/prior_sensitivity_pbox.csv'
own(prior, sampler, name, what) = strcol('prior') eq prior && strcol('sampler') eq sampler && strcol('parameter') eq name ? column(what) : NaN

names = 'friction_force_n natural_frequency_hz phase_noise_deg frequency_ratio_noise'
titles = '"Friction force {/:Italic F}_{/:Italic μ} (N)" "Natural frequency {/:Italic ω}_n (Hz)" "Phase noise (deg)" "Frequency ratio noise"'
priors = 'uniform log_uniform half_normal'
prior_titles = '"Uniform" "Log-uniform" "Half-normal"'
array colours[3] = [blue, vermillion, green]
set style line 21 lc rgb blue lw 1.1
set style line 22 lc rgb vermillion lw 1.1 dt (10, 4)
set style line 23 lc rgb green lw 1.1 dt (3, 3)

set yrange [0:1]
set ytics 0.25
set key at screen 0.53, 0.995 center top maxrows 1 Left reverse samplen 2 width -1

set multiplot
do for [i = 1:4] {
  name = word(names, i)
  left = (i - 1) % 2
  set lmargin at screen 0.075 + left * 0.47
  set rmargin at screen 0.515 + left * 0.47
  set tmargin at screen (i <= 2 ? 0.925 : 0.465)
  set bmargin at screen (i <= 2 ? 0.565 : 0.105)
  set xlabel word(titles, i) offset 0, 0.4
  if (left == 0) { set ylabel 'Cumulative probability' offset 0.5, 0; set format y '%.2f' } else { unset ylabel; set format y '' }
  if (i == 1) { set xrange [0.86:1.09]; set xtics 0.05 format '%.2f' }
  if (i == 2) { set xrange [3.035:3.125]; set xtics 3.04, 0.02 format '%.2f' }
  if (i == 3) { set xrange [1:7]; set xtics 1 format '%g' }
  if (i == 4) { set xrange [0.006:0.034]; set xtics 0.005 format '%.3f' }
  set label 1 sprintf('(%s)', 'abcd'[i:i]) at graph 0.02, 0.93 font 'Nimbus Sans:Bold,8.5' front
  plot for [k = 1:3] boxes using 'x':(own(word(priors, k), 'TMCMC-II', name, 'lower')):'upper' with filledcurves fc rgb colours[k] fs transparent solid 0.12 noborder, \
       for [k = 1:3] boxes using 'x':(own(word(priors, k), 'recommended', name, 'lower')):'upper' with filledcurves fc rgb colours[k] fs transparent solid 0.45 noborder, \
       for [k = 1:3] boxes using 'x':(own(word(priors, k), 'recommended', name, 'cdf')) with lines ls 20 + k, \
       for [k = 1:3] keyentry with lines ls 20 + k title word(prior_titles, k), \
       keyentry with filledcurves fc rgb grey fs transparent solid 0.2 noborder title 'TMCMC-II', \
       keyentry with filledcurves fc rgb grey fs transparent solid 0.6 noborder title 'Recommended'
  unset key
}
unset multiplot
