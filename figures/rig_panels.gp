# One parameter of the rig: name, label, and range, which holds all but a thousandth of the exact posterior. Call with its number, from
# 1, after loading style.gp and setting `marginals`.
parameter = int(ARG1)
name = word('friction_force_n natural_frequency_hz phase_noise_deg frequency_ratio_noise', parameter)
own(value) = strcol('parameter') eq name ? value : NaN
set xrange [*:*]
set yrange [*:*]  # else it would select the points that count
stats marginals using (own(column('cdf') > 0.0005 && column('cdf') < 0.9995 ? column('x') : NaN)) nooutput
set xrange [STATS_min:STATS_max]
# About ARG2 round tics.
tenth(x) = 10.0 ** floor(log10(x))
rounded(m) = m < 1.5 ? 1 : m < 3.5 ? 2 : m < 7.5 ? 5 : 10
coarse = (STATS_max - STATS_min) / ARG2
set xtics rounded(coarse / tenth(coarse)) * tenth(coarse) format '%g'
if (parameter == 1) { set xlabel 'Friction force {/:Italic F}_{/:Italic μ} (N)' offset 0, 0.3 }
if (parameter == 2) { set xlabel 'Natural frequency {/:Italic ω}_n (Hz)' offset 0, 0.3 }
if (parameter == 3) { set xlabel 'Phase noise {/:Italic σ}_{/:Italic φ} (deg)' offset 0, 0.3 }
if (parameter == 4) { set xlabel 'Frequency-ratio noise {/:Italic σ}_{/:Italic r}' offset 0, 0.3 }
