# P-boxes of the posterior of a rig: bounds of the empirical distribution functions of all runs, for each parameter and sampler, around the
# exact distribution function (above), and less the exact one (below).
width = 17.4
height = 9.6
load 'figures/style.gp'

boxes = data.'/pboxes.csv'
marginals = data.'/exact_marginals.csv'
box(sampler, value) = strcol('sampler') eq sampler && strcol('parameter') eq name ? value : NaN

set style fill transparent solid 0.18 noborder
set key at screen 0.53, 0.995 center top maxrows 1 Left reverse samplen 2.6 width 0

set multiplot
do for [below = 0:1] {
  do for [i = 1:4] {
    call 'figures/rig_panels.gp' sprintf('%d', i) '3'
    set lmargin at screen 0.075 + (i - 1) * 0.232
    set rmargin at screen 0.075 + (i - 1) * 0.232 + 0.212
    set tmargin at screen (below ? 0.50 : 0.925)
    set bmargin at screen (below ? 0.12 : 0.54)
    set label 1 sprintf('(%s)', 'abcdefgh'[4 * below + i:4 * below + i]) at graph 0.03, 0.92 font 'Nimbus Sans:Bold,8.5' front
    if (below) {
      set yrange [*:*]
      unset ytics
      stats boxes using (abs(column('lower') - column('exact')) > abs(column('upper') - column('exact')) ? \
          abs(column('lower') - column('exact')) : abs(column('upper') - column('exact'))) nooutput name 'off'
      set yrange [-1.15 * off_max:1.15 * off_max]
      set ytics autofreq nomirror out scale 0.5, 0.3 textcolor rgb 'black'
      set ylabel 'Less the exact one'
    } else {
      set yrange [0:1]
      set ytics 0.25 nomirror out scale 0.5, 0.3 textcolor rgb 'black'
      set xtics format ''
      unset xlabel
      set ylabel 'Cumulative probability'
    }
    if (i == 1) { set ylabel offset (below ? 1.2 : 0.5), 0; set ytics format '%g' } else { unset ylabel; set ytics format '' }
    less = below
    plot boxes using 'x':(box('TMCMC', column('lower') - less * column('exact'))):(column('upper') - less * column('exact')) \
             with filledcurves fc rgb blue, \
         boxes using 'x':(box('TMCMC-II', column('lower') - less * column('exact'))):(column('upper') - less * column('exact')) \
             with filledcurves fc rgb vermillion, \
         for [bound in 'lower upper'] boxes using 'x':(box('TMCMC', column(bound) - less * column('exact'))) with lines ls TMCMC, \
         for [bound in 'lower upper'] boxes using 'x':(box('TMCMC-II', column(bound) - less * column('exact'))) with lines ls TMCMC_II, \
         marginals using 'x':(own((1 - less) * column('cdf'))) with lines ls EXACT lw 1, \
         keyentry with lines ls EXACT title 'Exact', \
         keyentry with lines ls TMCMC title 'TMCMC (CoV = 1)', \
         keyentry with lines ls TMCMC_II title 'TMCMC-II ({/:Italic N}_{eff} = {/:Italic N}/2)'
    unset key
  }
}
unset multiplot
