# Printed beside reproduced, for each sampler: the areas of the p-boxes, and how many runs needed how many iterations.
width = 17.4
height = 7.6
load 'figures/style.gp'

table = data.'/fig4_areas_and_iterations.csv'
# Central 95 % of the replicated studies, behind our bars as whiskers.
studies = data.'/compare_published.csv'
spread(name, sampler, what) = \
    strcol('table') eq 'Table 3' && strcol('column') eq name && strcol('row') eq sampler ? column(what) : NaN
count_spread(sampler, what) = strcol('table') eq 'Table 4' && strcol('column') eq sampler ? column(what) : NaN
place(sampler) = strcol('table') eq 'Table 4' && strcol('column') eq sampler ? column('row') : NaN
set style line 20 lc rgb 'black' lw 0.9
count(source, sampler) = strcol('panel') eq 'iterations' && strcol('source') eq source ? column(sampler) : NaN
area(source, name, sampler) = \
    strcol('panel') eq 'area' && strcol('source') eq source && strcol('category') eq name ? column(sampler) : NaN
shown(x) = x == x ? sprintf('%.4g', x) : ''

bar = 0.36
set style fill solid 1 border lc rgb 'black'
set key at screen 0.5, 0.995 center top maxrows 1 Left reverse samplen 1.6 width 0
colour(sampler) = sampler eq 'TMCMC' ? blue : vermillion
samplers = 'TMCMC TMCMC-II'

set multiplot

# Areas: horizontal bars, the first sampler on top, printed above reproduced.
set lmargin at screen 0.095
set rmargin at screen 0.47
set xrange [0:*]
set yrange [2.55:0.45]
set offsets 0, graph 0.1, 0, 0
set ytics ('TMCMC' 1, 'TMCMC-II' 2) scale 0
set grid noytics
do for [panel = 1:2] {
  if (panel == 1) {
    name = 'friction_force_n'
    set tmargin at screen 0.87
    set bmargin at screen 0.60
    set xlabel 'P-box area, friction force (N)' offset 0, 0.4
    set xtics 0.05 format '%.2f'
  } else {
    name = 'natural_frequency_hz'
    set tmargin at screen 0.40
    set bmargin at screen 0.13
    set xlabel 'P-box area, natural frequency (Hz)' offset 0, 0.4
    set xtics 0.004 format '%.3f'
    unset key
  }
  set label 1 sprintf('(%s)', 'abcd'[panel:panel]) at screen 0.008, (panel == 1 ? 0.92 : 0.45) \
      font 'Nimbus Sans:Bold,8.5'
  plot for [i = 1:2] table using (0):(i - bar / 2):(0):(area('printed', name, word(samplers, i))):(i - bar):(i) \
           with boxxyerror fc rgb printed lw 0.6, \
       for [i = 1:2] table using (0):(i + bar / 2):(0):(area('reproduced', name, word(samplers, i))):(i):(i + bar) \
           with boxxyerror fc rgb colour(word(samplers, i)) lw 0.6, \
       for [i = 1:2] studies using (spread(name, word(samplers, i), 'low')):(i + bar / 2): \
           (spread(name, word(samplers, i), 'high') - column('low')):(0) with vectors heads size screen 0.004, 90 ls 20, \
       for [i = 1:2] table using (area('printed', name, word(samplers, i))):(i - bar / 2): \
           (shown(area('printed', name, word(samplers, i)))) with labels left offset 0.6, 0 font ',7.5', \
       for [i = 1:2] table using (0):(i + bar / 2): \
           (shown(area('reproduced', name, word(samplers, i)))) with labels left offset 0.6, 0 font ',7.5' tc rgb 'white', \
       keyentry with boxes fc rgb printed lw 0.6 title 'Printed', \
       keyentry with boxes fc rgb blue lw 0.6 title 'Ours, TMCMC', \
       keyentry with boxes fc rgb vermillion lw 0.6 title 'Ours, TMCMC-II', \
       keyentry with lines ls 20 title '95 % of the studies'
}

# Iterations: vertical bars over the number of iterations, printed left of reproduced.
set boxwidth bar
set tmargin at screen 0.87
set bmargin at screen 0.13
set yrange [0:52]
set xrange [*:*]
set offsets 0.15, 0.15, 0, 0
set autoscale xfix
set xtics 1 scale 0 format '%g'
set ytics 10 scale 0.5
set grid noxtics ytics
do for [panel = 3:4] {
  sampler = word(samplers, panel - 2)
  if (panel == 3) {
    set lmargin at screen 0.562
    set rmargin at screen 0.765
    set ylabel 'Runs' offset 0.8, 0
  } else {
    set lmargin at screen 0.785
    set rmargin at screen 0.988
    unset ylabel
    set ytics format ''
  }
  set xlabel 'Iterations, '.sampler offset 0, 0.4
  set label 1 sprintf('(%s)', 'abcd'[panel:panel]) at screen (panel == 3 ? 0.525 : 0.788), 0.92 \
      font 'Nimbus Sans:Bold,8.5'
  plot table using (column('category') - bar / 2):(count('printed', sampler)) with boxes fc rgb printed lw 0.6, \
       table using (column('category') + bar / 2):(count('reproduced', sampler)) with boxes \
           fc rgb colour(sampler) lw 0.6, \
       studies using (place(sampler) + bar / 2):(count_spread(sampler, 'low')):(0): \
           (count_spread(sampler, 'high') - column('low')) with vectors heads size screen 0.004, 90 ls 20, \
       table using (column('category') - bar / 2):(count('printed', sampler)):(shown(count('printed', sampler))) \
           with labels offset 0, 0.5 font ',7.5', \
       table using (column('category') + bar * 1.05):(count('reproduced', sampler)): \
           (shown(count('reproduced', sampler))) with labels left offset 0.15, 0 font ',7.5'
}
unset multiplot
