# Measurements of a rig and what their posterior predicts: the phase angle over the measured frequency ratio (left) and the nominal
# frequency ratio over the driving frequency (right), below each the differences from the posterior median. Bands: central 95 % of
# the model and of a new measurement.
width = 17.4
height = 11
load 'figures/style.gp'

phases = data.'/phase_band.csv'
ratios = data.'/ratio_band.csv'
rows = data.'/measurements.csv'
# The phase jumps at r = 1, so each side of it is drawn for itself.
# And what less than half of the posterior predicts is left out.
side(s, value) = (column('frequency_ratio') < 1) == (s == 1) ? value : NaN
predicted(s, value) = column('share') >= 0.5 ? side(s, value) : NaN
of(quantity, value) = strcol('quantity') eq quantity ? value : NaN

measured = '#9CC9E5'
model = '#3E97CB'

set multiplot
set key at screen 0.53, 0.995 center top maxrows 1 Left reverse samplen 2.2 width -3 font ',7.5'
set lmargin at screen 0.075
set rmargin at screen 0.49
set autoscale xfix
set yrange [*:*]

set tmargin at screen 0.93
set bmargin at screen 0.47
set xtics format ''
set ylabel 'Phase angle (deg)' offset 0.9, 0
set label 1 '(a)' at graph 0.02, 0.94 font 'Nimbus Sans:Bold,8.5' front
plot for [s = 0:1] phases using 'frequency_ratio':(predicted(s, column('low'))):'high' with filledcurves fc rgb measured, \
     for [s = 0:1] phases using 'frequency_ratio':(predicted(s, column('model_low'))):'model_high' with filledcurves fc rgb model, \
     for [s = 0:1] phases using 'frequency_ratio':(side(s, column('boundary_phase_deg'))) with lines ls BOUNDARY, \
     for [s = 0:1] phases using 'frequency_ratio':(predicted(s, column('median'))) with lines ls TMCMC, \
     rows using (of('phase_deg', column('x'))):'observed' with points pt 7 ps 0.4 lc rgb 'black', \
     keyentry with points pt 7 ps 0.4 lc rgb 'black' title 'Measured', \
     keyentry with lines ls TMCMC title 'Median', \
     keyentry with filledcurves fc rgb model title '95 % of the model', \
     keyentry with filledcurves fc rgb measured title '95 % of new data', \
     keyentry with lines ls BOUNDARY title "Den Hartog’s limit"

unset key
set tmargin at screen 0.43
set bmargin at screen 0.10
set xtics format '%g'
set xlabel 'Frequency ratio {/:Italic r}' offset 0, 0.3
set ylabel 'Phase less median (deg)' offset 0.9, 0
set label 1 '(b)'
plot for [s = 0:1] phases using 'frequency_ratio':(predicted(s, column('low_less_median'))):'high_less_median' \
         with filledcurves fc rgb measured, \
     for [s = 0:1] phases using 'frequency_ratio':(predicted(s, column('model_low_less_median'))):'model_high_less_median' \
         with filledcurves fc rgb model, \
     0 with lines ls TMCMC, \
     rows using (of('phase_deg', column('x'))):'observed_less_median' with points pt 7 ps 0.4 lc rgb 'black'

set lmargin at screen 0.59
set rmargin at screen 0.99
set tmargin at screen 0.93
set bmargin at screen 0.47
set xtics format ''
unset xlabel
set ylabel 'Nominal frequency ratio' offset 0.9, 0
set label 1 '(c)'
plot ratios using 'driving_frequency_hz':'low':'high' with filledcurves fc rgb measured, \
     ratios using 'driving_frequency_hz':'model_low':'model_high' with filledcurves fc rgb model, \
     ratios using 'driving_frequency_hz':'median' with lines ls TMCMC, \
     rows using (of('frequency_ratio', column('x'))):'observed' with points pt 7 ps 0.4 lc rgb 'black'

set tmargin at screen 0.43
set bmargin at screen 0.10
set xtics format '%g'
set xlabel 'Driving frequency {/:Italic ω}_b (Hz)' offset 0, 0.3
set ylabel 'Ratio less median' offset 0.9, 0
set label 1 '(d)'
plot ratios using 'driving_frequency_hz':'low_less_median':'high_less_median' \
         with filledcurves fc rgb measured, \
     ratios using 'driving_frequency_hz':'model_low_less_median':'model_high_less_median' \
         with filledcurves fc rgb model, \
     0 with lines ls TMCMC, \
     rows using (of('frequency_ratio', column('x'))):'observed_less_median' with points pt 7 ps 0.4 lc rgb 'black'
unset multiplot
