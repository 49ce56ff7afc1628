# Phase angle of the response over the frequency ratio: the printed numerical data with their stated noise, the model at
# the stated and at the fitted friction force, and Den Hartog's boundary, beyond which the motion is not continuous.
width = 8.4
height = 6.6
load 'figures/style.gp'

curves = data.'/fig2_phase_angle.csv'
observations = published.'/table1_observations.csv'
# The phase jumps at r = 1, so each side of it is drawn for itself.
below(name) = column('frequency_ratio') < 1 ? column(name) : NaN
above(name) = column('frequency_ratio') > 1 ? column(name) : NaN

set lmargin at screen 0.15
set rmargin at screen 0.975
set bmargin at screen 0.15
set tmargin at screen 0.85
set xrange [0:2]
set yrange [0:180]
set xtics 0.25 format '%g'
set ytics 30
set xlabel 'Frequency ratio {/:Italic r}' offset 0, 0.3
set ylabel 'Phase angle (deg)' offset 0.9, 0
set key at screen 0.56, 0.985 center top maxrows 2 Left reverse samplen 2.2
set label 1 'stick–slip' at 0.5, 105 center front font ',8' textcolor rgb '#505050'
set label 2 'stick–slip' at 1.5, 60 center front font ',8' textcolor rgb '#505050'

plot curves using 'frequency_ratio':(below('boundary_phase_deg')):(180) with filledcurves fc rgb pale, \
     curves using 'frequency_ratio':(above('boundary_phase_deg')):(0) with filledcurves fc rgb pale, \
     curves using 'frequency_ratio':'boundary_phase_deg' with lines ls BOUNDARY, \
     curves using 'frequency_ratio':(below('phase_deg')) with lines ls MODEL, \
     curves using 'frequency_ratio':(above('phase_deg')) with lines ls MODEL, \
     curves using 'frequency_ratio':(below('phase_fitted_deg')) with lines ls LEAST_SQUARES, \
     curves using 'frequency_ratio':(above('phase_fitted_deg')) with lines ls LEAST_SQUARES, \
     observations using 'r_measured':(column('phase_deg') - true_phase_noise_deg):(0):(2 * true_phase_noise_deg) \
         with vectors heads size screen 0.008, 90 lc rgb 'black' lw 0.9, \
     observations using 'r_measured':'phase_deg' with points pt 7 ps 0.28 lc rgb 'black', \
     keyentry with yerrorbars lc rgb 'black' lw 0.9 pt 7 ps 0.28 title 'Numerical data (Table 1)', \
     keyentry with lines ls BOUNDARY title "Den Hartog’s boundary", \
     keyentry with lines ls MODEL title sprintf('Stated, {/:Italic F}_{/:Italic μ} = %.3f N', true_friction_force_n), \
     keyentry with lines ls LEAST_SQUARES title 'Fitted by least squares'
