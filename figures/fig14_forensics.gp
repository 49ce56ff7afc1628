# Matrix of pairs of settings: log-density of the printed tables if the setting of a row made the column of TMCMC and that of a
# column the column of TMCMC-II, less that of one sampler for both. Dots: absolute predictive p of 0.05 and more. The numbers are
# written into the cells, so that the matrix can be read without colours.
width = 8.4
height = 8.6
load 'figures/style.gp'

pairs = data.'/forensics_pairs.csv'
shown(x) = x <= -100 ? '' : sprintf('%d', floor(x + 0.5))

set lmargin at screen 0.335
set rmargin at screen 0.985
set tmargin at screen 0.985
set bmargin at screen 0.325
set autoscale fix
set yrange [*:*] reverse
set cbrange [-20:6]
set palette defined (-20 '#F2F2F2', -8 '#D8D8D8', 0 '#FFFFFF', 2 '#9CCBE6', 6 '#2F86BE')
unset colorbox
unset grid
set border 15 back ls 100
set xtics rotate by 60 right offset 0.3, 0.1 scale 0 font ',7'
set ytics scale 0 font ',7'
set label 1 'Setting of TMCMC' at screen 0.022, 0.655 center rotate by 90
set label 2 'Setting of TMCMC-II' at screen 0.66, 0.025 center

plot pairs using 'column':'row':'gain':xtic(strcol('second')):ytic(strcol('first')) with image pixels, \
     pairs using 'column':'row':(shown(column('gain'))) with labels font ',6.5', \
     pairs using (column('p') >= 0.05 ? column('column') + 0.33 : NaN):(column('row') - 0.33) with points pt 7 ps 0.22 \
         lc rgb 'black'
