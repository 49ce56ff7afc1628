# Three samplers on problems with known evidence, at equal numbers of evaluations: root-mean-square error of the log-evidence (upper
# row) and of the error in units of the stated one (lower row; 1 is honest). Open marks: most runs warn. Crosses at the right edge:
# no run has reached the posterior. Red rings: a run without a warning is off by more than five of its stated errors.
width = 17.4
height = 20.6
load 'figures/style.gp'

# gnuplot's strcol() ends at a comma within quotes: these become semicolons.
table = data.'/benchmark_problems.csv'
arena = sprintf("< sed 's/\"\\([^\",]*\\), \\([^\"]*\\)\"/\\1; \\2/g' %s", table)
call 'figures/distinct.gp' arena 'problem'
problems = found
replaced(s, old, new) = strstrt(s, old) ? s[1:strstrt(s, old) - 1].new.s[strstrt(s, old) + 1:] : s
plain(s) = replaced(replaced(s, ';', ','), '_', ' ')
place(name) = sum [i = 1:words(problems)] (word(problems, i) eq name ? i : 0)

samplers = '"published" "better moves" "recommended"'
titles = '"Published setting" "Better moves" "Recommended: independent draws"'
budgets = '3000 10000 31000 100000'
budget_titles = '"3 000 evaluations" "10 000" "31 000" "100 000"'
colours = vermillion.' '.green.' #0072B2'
shapes = '8 6 4'
is(k, e) = strcol('sampler') eq word(samplers, k) && strcol('evaluations') eq word(budgets, e)

n = words(problems)
set yrange [n + 0.8:0.2]
set grid ytics lc rgb '#EEEEEE' lt 1 lw 0.5
set logscale x
set multiplot
do for [row = 1:2] {
  do for [e = 1:4] {
    set lmargin at screen 0.205 + (e - 1) * 0.2
    set rmargin at screen 0.205 + (e - 1) * 0.2 + 0.187
    set tmargin at screen (row == 1 ? 0.955 : 0.475)
    set bmargin at screen (row == 1 ? 0.545 : 0.055)
    unset ytics
    if (e == 1) {
      do for [i = 1:n] { if (i == 1) { set ytics (plain(word(problems, i)) i) font ',5.6' scale 0 } else { set ytics add (plain(word(problems, i)) i) font ',5.6' } }
    } else {
      set ytics 1, 1, n format '' scale 0
    }
    if (row == 1) { set xrange [0.0004:300]; set xtics ('0.001' 0.001, '' 0.01, '0.1' 0.1, '' 1, '10' 10, '' 100) font ',7'; set xlabel (e == 2 ? 'RMS error of the log-evidence' : ' ') offset 13, 0.7; quantity = 'rms_error'; edge = 230 } \
    else { set xrange [0.3:300]; set xtics ('1' 1, '10' 10, '100' 100) font ',7'; set xlabel (e == 2 ? 'RMS of error over stated standard error' : ' ') offset 13, 0.7; quantity = 'rms_z'; edge = 250 }
    unset arrow 1
    if (row == 2) { set arrow 1 from 1, graph 0 to 1, graph 1 nohead back lc rgb grey dt (4, 4) lw 0.9 }
    set label 1 sprintf('(%s) %s', 'abcdefgh'[(row - 1) * 4 + e:(row - 1) * 4 + e], word(budget_titles, e)) at graph 0, 1.022 left font 'Nimbus Sans:Bold,8.5' front
    if (row == 1 && e == 1) { set key at screen 0.55, 0.998 center top maxrows 1 Left reverse samplen 1 width -4 font ',7.5' } else { unset key }
    plot for [k = 1:3] arena using (is(k, e) && column('warned') <= 0.5 && column('unfinished') < 0.99 ? column(quantity) : NaN):(place(strcol('problem'))) \
           with points pt (word(shapes, k) + 1) ps 0.42 lc rgb word(colours, k), \
         for [k = 1:3] arena using (is(k, e) && column('warned') > 0.5 && column('unfinished') < 0.99 ? column(quantity) : NaN):(place(strcol('problem'))) \
           with points pt (word(shapes, k) + 0) ps 0.42 lw 0.8 lc rgb word(colours, k), \
         for [k = 1:3] arena using (is(k, e) && column('unfinished') >= 0.99 ? edge : NaN):(place(strcol('problem')) + 0.25 * (k - 2)) \
           with points pt 2 ps 0.3 lw 0.8 lc rgb word(colours, k), \
         arena using (is(3, e) && column('worst_z_without_warning') > 5 ? column(quantity) : NaN):(place(strcol('problem'))) \
           with points pt 6 ps 1 lw 1.2 lc rgb 'red', \
         for [k = 1:3] keyentry with points pt (word(shapes, k) + 1) ps 0.6 lc rgb word(colours, k) title word(titles, k)
  }
}
unset multiplot
