# P-boxes of the posterior of a rig: bounds of the empirical distribution functions of all runs, for each parameter and sampler, around the
# exact distribution function (above), and less the exact one (below).
width = 17.4
height = 9.6
load 'figures/panels.gp'
load 'figures/style.gp'

boxes = data.'/pboxes.csv'
marginals = data.'/exact_marginals.csv'
box(sampler, value) = strcol('sampler') eq sampler && strcol('parameter') eq name(parameter) ? value : NaN

set style fill transparent solid 0.18 noborder
set key at screen 0.53, 0.995 center top maxrows 1 Left reverse samplen 2.6 width 0

# One scale of the differences for all parameters: the one that gnuplot chooses for all rows.
set table $read
plot boxes using 'x':'lower_less_exact', boxes using 'x':'upper_less_exact'
unset table
difference_low = GPVAL_Y_MIN
difference_high = GPVAL_Y_MAX

set multiplot
do for [below = 0:1] {
  do for [i = 1:4] {
    call 'figures/rig_panels.gp' sprintf('%d', i)
    set lmargin at screen 0.092 + (i - 1) * 0.228
    set rmargin at screen 0.092 + (i - 1) * 0.228 + 0.207
    set tmargin at screen (below ? 0.50 : 0.925)
    set bmargin at screen (below ? 0.12 : 0.54)
    set label 1 sprintf('(%s)', 'abcdefgh'[4 * below + i:4 * below + i]) at graph 0.03, 0.92 font 'Nimbus Sans:Bold,8.5' front
    if (below) {
      set yrange [difference_low:difference_high]
      set ytics autofreq nomirror out scale 0.5, 0.3 textcolor rgb 'black'
      unset ylabel
      if (i == 1) { set label 2 'Less the exact one' at screen 0.012, graph 0.5 center rotate by 90 } else { unset label 2 }
    } else {
      set yrange [0:1]
      set ytics 0.25 nomirror out scale 0.5, 0.3 textcolor rgb 'black'
      set xtics format ''
      unset xlabel
      set ylabel 'Cumulative probability' offset 0.5, 0
    }
    if (i == 1) { set ytics format '%g' } else { unset ylabel; set ytics format '' }
    from = below ? 'lower_less_exact' : 'lower'
    to = below ? 'upper_less_exact' : 'upper'
    plot boxes using 'x':(box('TMCMC', column(from))):(column(to)) with filledcurves fc rgb blue, \
         boxes using 'x':(box('TMCMC-II', column(from))):(column(to)) with filledcurves fc rgb vermillion, \
         for [bound in from.' '.to] boxes using 'x':(box('TMCMC', column(bound))) with lines ls TMCMC, \
         for [bound in from.' '.to] boxes using 'x':(box('TMCMC-II', column(bound))) with lines ls TMCMC_II, \
         marginals using 'x':(own(below ? 0 : column('cdf'))) with lines ls EXACT lw 1, \
         keyentry with lines ls EXACT title 'Exact', \
         keyentry with lines ls TMCMC title 'TMCMC (CoV = 1)', \
         keyentry with lines ls TMCMC_II title 'TMCMC-II ({/:Italic N}_{eff} = {/:Italic N}/2)'
    unset key
  }
}
unset multiplot
