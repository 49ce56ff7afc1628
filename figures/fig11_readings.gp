# Each reading of the paper, in the order of the data: the presets, then single changes to the first of them. Median and
# central 95 % of the p-box areas over the replicated studies, and the log-likelihood of the printed tables.
width = 17.4
height = 11.5
load 'figures/style.gp'

readings = data.'/readings.csv'
printed_areas = published.'/table3_pbox_area.csv'
samplers = 'TMCMC TMCMC-II'
presets = 3
# As many as the data have: the height of the panels.
rows = 14
own(i, what) = strcol('sampler') eq word(samplers, i) ? column(what) : NaN
# A reading has two rows, one a sampler, drawn above and below its name.
row(n) = int(n) / 2 + 1
side(i) = i == TMCMC ? -0.17 : 0.17
plain(s) = strstrt(s, '_') ? s[1:strstrt(s, '_') - 1].'\_'.plain(s[strstrt(s, '_') + 1:]) : s
name(s) = s eq 'infeasible -inf' ? 'infeasible −∞' : s[1:8] eq 'omega_n ' ? '{/:Italic ω}_n '.s[9:] : plain(s)
colour(i) = i == TMCMC ? blue : vermillion
full(i) = i == TMCMC ? 7 : 9

set tmargin at screen 0.925
set bmargin at screen 0.105
set yrange [rows + 0.6:0.4]
set ytics scale 0
set border 1
set arrow 1 from graph 0, first presets + 0.5 to graph 1, first presets + 0.5 nohead back lc rgb grey lw 0.6

# The curves of the first two panels.
AREAS = "for [i = 1:2] printed_areas using (own(i, parameter)):(0.4):(0):(rows + 0.2) ".\
    "with vectors nohead ls i lw 0.8, ".\
    "for [i = 1:2] readings using (own(i, area.'_low')):(row(column(0)) + side(i)):".\
    "(column(area.'_high') - column(area.'_low')):(0) with vectors nohead lw 1.8 lc rgb colour(i), ".\
    "for [i = 1:2] readings using (own(i, area.'_median')):(row(column(0)) + side(i)) with points pt full(i) ".\
    "ps (i == TMCMC ? 0.6 : 0.7) lc rgb colour(i)"

set multiplot
do for [panel = 1:3] {
  if (panel == 1) {
    area = 'area_force'
    parameter = 'friction_force_n'
    set logscale x
    set xrange [0.045:0.6]
    set xtics (0.05, 0.1, 0.2, 0.5) format '%g'
    set xlabel 'P-box area, friction force (N)' offset 0, 0.3
    set lmargin at screen 0.175
    set rmargin at screen 0.450
    set key at screen 0.5, 0.995 center top maxrows 1 Left reverse samplen 2.6 width 0
  }
  if (panel == 2) {
    area = 'area_frequency'
    parameter = 'natural_frequency_hz'
    set xrange [0.0045:0.2]
    set xtics (0.005, 0.01, 0.02, 0.05, 0.1)
    set xlabel 'P-box area, natural frequency (Hz)' offset 0, 0.3
    set lmargin at screen 0.470
    set rmargin at screen 0.745
  }
  if (panel == 3) {
    # A logarithmic axis of the distance below 0.
    unset logscale x
    set xrange [-1000:-10]
    set nonlinear x via -log10(-x) inverse -10**(-x)
    set xtics (-300, -100, -30, -10) format '%g'
    set minussign
    set xlabel 'Log-likelihood of the tables' offset 0, 0.3
    set lmargin at screen 0.778
    set rmargin at screen 0.980
  }
  set label 1 sprintf('(%s)', 'abc'[panel:panel]) at graph 0, 1.025 left font 'Nimbus Sans:Bold,8.5' front
  if (panel == 1) {
    # The first curve has no marks: it names the rows.
    plot readings using (NaN):(row(column(0))):ytic(name(strcol('reading'))) with dots, @AREAS, \
         keyentry with linespoints pt 7 ps 0.6 lw 1.8 lc rgb blue title 'TMCMC', \
         keyentry with linespoints pt 9 ps 0.7 lw 1.8 lc rgb vermillion title 'TMCMC-II', \
         keyentry with lines ls TMCMC lw 0.8 title 'Printed, TMCMC', \
         keyentry with lines ls TMCMC_II lw 0.8 title 'Printed, TMCMC-II'
    unset key
    set ytics 1 format '' scale 0
  }
  if (panel == 2) { plot @AREAS }
  if (panel == 3) {
    plot readings using (own(TMCMC, 'log_likelihood_of_tables')):(row(column(0))) with points pt 5 ps 0.6 lc rgb 'black'
  }
}
unset multiplot
