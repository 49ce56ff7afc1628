# Simulation-based calibration: rank of the true parameter among posterior draws, over simulated data sets. For each sampler the
# distribution function of the ranks less that of a calibrated sampler, which is 0; the band holds such a function at all
# 19 inner places with a probability of 99 % or more (Normal, Bonferroni: 3.47 standard deviations). A line that falls and then rises, or the other way, is a posterior of a wrong width.
width = 17.4
height = 6.2
load 'figures/style.gp'

ranks = data.'/calibration_ranks.csv'
names = 'friction_force_n natural_frequency_hz phase_noise_deg frequency_ratio_noise'
titles = '"Friction force" "Natural frequency" "Phase noise" "Frequency ratio noise"'
colours = blue.' '.vermillion.' '.green.' '.purple
call 'figures/distinct.gp' ranks 'sampler'
samplers = found
is(sampler, name) = strcol('parameter') eq name && strcol('sampler') eq sampler

panels = words(samplers)
set xrange [0:1]
set yrange [-0.048:0.048]
set xtics 0.25 format '%g'
set ytics 0.02
set key at screen 0.53, 0.995 center top maxrows 1 Left reverse samplen 2.6 width -2.5 font ',7.5'
set tmargin at screen 0.83
set bmargin at screen 0.17
set multiplot
do for [k = 1:panels] {
  sampler = word(samplers, k)
  set lmargin at screen 0.085 + (k - 1) * 0.91 / panels
  set rmargin at screen 0.085 + k * 0.91 / panels - 0.02
  if (k == 1) { set ylabel 'ECDF of the rank − uniform' offset 0.8, 0; set format y '%.2f' } else { unset ylabel; set format y '' }
  set xlabel 'Rank of the truth' offset 0, 0.4
  set label 1 sprintf('(%s) %s', 'abcd'[k:k], sampler) at graph 0, 1.05 left font 'Nimbus Sans:Bold,8.5' front
  plot ranks using 'edge':(is(sampler, word(names, 1)) ? -column('ecdf_band') : NaN):'ecdf_band' with filledcurves fc rgb '#E4E4E4' fs solid noborder, \
       0 with lines ls BOUNDARY lw 0.8, \
       for [i = 1:4] ranks using 'edge':(is(sampler, word(names, i)) ? column('ecdf_difference') : NaN) with lines lw 1.3 lc rgb word(colours, i) dt i \
           title word(titles, i), \
       keyentry with boxes fc rgb '#E4E4E4' fs solid noborder title '99 % band'
  unset key
}
unset multiplot
