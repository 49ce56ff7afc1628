# Simulation-based calibration: rank of the true parameter among posterior draws, over simulated data sets. Calibrated
# samplers give flat histograms; peaks at the ends are posteriors that are too narrow.
width = 17.4
height = 8.8
load 'figures/style.gp'

ranks = data.'/calibration_ranks.csv'
names = 'friction_force_n natural_frequency_hz phase_noise_deg frequency_ratio_noise'
titles = '"Friction force" "Natural frequency" "Phase noise" "Frequency ratio noise"'
own(sampler, name, what) = strcol('sampler') eq sampler && strcol('parameter') eq name ? column(what) : NaN

set xrange [0:1]
set yrange [40:175]
set xtics ('0' 0, '' 0.25, '0.5' 0.5, '' 0.75, '1' 1)
set ytics 40
set boxwidth 0.05
set key at screen 0.53, 0.99 center top maxrows 1 Left reverse samplen 2

set multiplot
do for [row = 1:2] {
  sampler = row == 1 ? 'published' : 'recommended'
  colour = row == 1 ? vermillion : green
  do for [i = 1:4] {
    name = word(names, i)
    set lmargin at screen 0.075 + (i - 1) * 0.2325
    set rmargin at screen 0.075 + (i - 1) * 0.2325 + 0.21
    set tmargin at screen 0.885 - (row - 1) * 0.40
    set bmargin at screen 0.545 - (row - 1) * 0.40
    set format y (i == 1 ? '%g' : '')
    if (i == 1) { set ylabel 'Data sets' offset 0.8, 0 } else { unset ylabel }
    if (row == 2) { set xlabel word(titles, i).': rank' offset 0, 0.4; set format x '%g' } else { unset xlabel; set format x '' }
    if (row == 1) { set xtics ('' 0, '' 0.25, '' 0.5, '' 0.75, '' 1) } else { set xtics ('0' 0, '' 0.25, '0.5' 0.5, '' 0.75, '1' 1) }
    set label 1 sprintf('(%s)', 'abcdefgh'[(row - 1) * 4 + i:(row - 1) * 4 + i]) at graph 0.03, 0.92 font 'Nimbus Sans:Bold,8.5' front
    plot ranks using 'place':(own(sampler, name, 'band_low')):'band_high' with filledcurves fc rgb '#C8C8C8' fs solid noborder, \
         ranks using 'place':(own(sampler, name, 'expected')) with lines ls BOUNDARY lw 0.8, \
         ranks using 'place':(own(sampler, name, 'count')) with histeps lc rgb colour lw 1.3, \
         keyentry with lines lc rgb vermillion lw 1.3 title 'Published setting', \
         keyentry with lines lc rgb green lw 1.3 title 'Recommended', \
         keyentry with filledcurves fc rgb '#C8C8C8' fs solid noborder title '99 % of a calibrated sampler'
    unset key
  }
}
unset multiplot
