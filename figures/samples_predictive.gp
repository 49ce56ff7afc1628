# Measurements and what the posterior predicts for them, a row of panels for each measured quantity: the values (left), and less the
# posterior median in standard deviations of a new measurement (right). Bands: central 95 % of the model and of a new measurement.
# Few measurements have a box and a label each, many a band over their numbers.
predictive = data.'/predictive.csv'
set datafile separator comma
set datafile columnheaders
quantities = ''
set xrange [0:1]
set yrange [0:1]
set table $read
plot predictive using (quantities = column('number') == 1 ? quantities.' "'.strcol('quantity').'"' : quantities, 0)
unset table
set xrange [*:*]
set yrange [*:*]
d = words(quantities)

width = 17.4
height = 5.6 * d + 0.7
load 'figures/style.gp'
measured = '#9CC9E5'
model = '#3E97CB'
few = 30
own(value) = strcol('quantity') eq quantity ? value : NaN
low(band) = band == 1 ? 'low' : 'model_low'
high(band) = band == 1 ? 'high' : 'model_high'
fill(band) = band == 1 ? measured : model

set multiplot
set key at screen 0.53, screen 1 - 0.05 / height center top maxrows 1 Left reverse samplen 2.2 width -1 font ',7.5'
set style fill solid 1 noborder
set offsets 0, 0, graph 0.03, graph 0.03
do for [row = 1:d] {
  quantity = word(quantities, row)
  labels = ''
  is_long = 0
  named(_) = (is_long = is_long || strlen(strcol('label')) > 3, count = column('number'), labels.(labels eq '' ? '' : ', ').sprintf('"%s" %d', strcol('label'), count))
  set xrange [0:1]
  set yrange [0:1]
  set table $read
  plot predictive using (labels = strcol('quantity') eq quantity ? named(0) : labels, 0)
  unset table
  set xrange [0.4:count + 0.6]
  set yrange [*:*]
  do for [side = 0:1] {
    set lmargin at screen (side == 0 ? 0.085 : 0.585)
    set rmargin at screen (side == 0 ? 0.480 : 0.980)
    set tmargin at screen 1 - (5.6 * (row - 1) + 0.8) / height
    set bmargin at screen 1 - (5.6 * (row - 1) + 4.9) / height
    set label 1 sprintf('(%s)', 'abcdefghijklmnop'[2 * row + side - 1:2 * row + side - 1]) at graph 0, 1.07 font 'Nimbus Sans:Bold,8.5'
    set ylabel (side == 0 ? quantity : 'Less median (std. dev.)') noenhanced offset (side == 0 ? 0.9 : 0), 0
    of(end) = own(column(side == 0 ? end : end.'_score'))
    median(_) = side == 0 ? own(column('median')) : own(0)
    number(_) = column('number')
    if (count <= few) {
      unset xlabel
      eval 'set xtics ('.labels.') scale 0'
      set xtics nomirror font ',7'
      if (is_long) { set xtics rotate by 40 right } else { set xtics norotate center }
      plot for [band = 1:2] predictive using (number(0)):(median(0)):(number(0) - 0.4):(number(0) + 0.4):(of(low(band))):(of(high(band))) \
               with boxxyerror fc rgb fill(band), \
           predictive using (number(0) - 0.4):(median(0)):(0.8):(0) with vectors nohead ls TMCMC, \
           predictive using (number(0)):(of('observed')) with points pt 7 ps 0.4 lc rgb 'black', \
           keyentry with points pt 7 ps 0.4 lc rgb 'black' title 'Measured', \
           keyentry with lines ls TMCMC title 'Median', \
           keyentry with filledcurves fc rgb model title '95 % of the model', \
           keyentry with filledcurves fc rgb measured title '95 % of new data'
    } else {
      set xlabel 'Number' offset 0, 0.4
      unset xtics
      set xtics nomirror out scale 0.5, 0.3 norotate center autofreq font ',8.5' textcolor rgb 'black'
      plot for [band = 1:2] predictive using (number(0)):(of(low(band))):(of(high(band))) with filledcurves fc rgb fill(band), \
           predictive using (number(0)):(median(0)) with lines ls TMCMC, \
           predictive using (number(0)):(of('observed')) with points pt 7 ps 0.25 lc rgb 'black', \
           keyentry with points pt 7 ps 0.4 lc rgb 'black' title 'Measured', \
           keyentry with lines ls TMCMC title 'Median', \
           keyentry with filledcurves fc rgb model title '95 % of the model', \
           keyentry with filledcurves fc rgb measured title '95 % of new data'
    }
    unset key
  }
}
unset multiplot
