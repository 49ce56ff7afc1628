# How time and memory grow with samples, threads and observations on the machine that measured them (make scaling).
width = 17.4
height = 11.6
load 'figures/style.gp'

table = data.'/scaling.csv'
of(sweep, value) = strcol('sweep') eq sweep ? value : NaN
one_run = 'lc rgb blue lw 1.1 pt 7 ps 0.6'

set multiplot
do for [panel = 1:4] {
  left = panel % 2 == 1 ? 0.080 : 0.595
  set lmargin at screen left
  set rmargin at screen left + 0.390
  set tmargin at screen (panel <= 2 ? 0.975 : 0.465)
  set bmargin at screen (panel <= 2 ? 0.610 : 0.100)
  set label 1 sprintf('(%s)', 'abcd'[panel:panel]) at graph 0.02, 0.93 font 'Nimbus Sans:Bold,8.5' front
  unset logscale
  unset key
  set xtics autofreq
  set offsets 0, 0, 0, 0
  if (panel <= 2) {
    set logscale x
    set xrange [700:1.4e6]
    set xtics format '10^{%T}'
    set xlabel 'Samples {/:Italic N}' offset 0, 0.3
  }
  if (panel == 1) {
    set yrange [0:*]
    set ytics autofreq format '%g'
    set offsets 0, 0, graph 0.15, 0
    set ylabel 'Time of one run / {/:Italic N} (µs)' offset -0.6, 0
    plot table using 'samples':(of('samples', column('microseconds_per_sample'))) with linespoints @one_run
  }
  if (panel == 2) {
    set logscale y
    set yrange [0.1:400]
    set ytics autofreq format '%g'
    set ylabel 'Peak memory (MB)' offset 0.5, 0
    set key bottom right Left reverse
    plot table using 'samples':(200e-6 * column('samples')) with lines ls BOUNDARY title '200 bytes a sample', \
         table using 'samples':(of('samples', column('memory_bytes') > 0 ? 1e-6 * column('memory_bytes') : NaN)) \
             with linespoints @one_run title 'One run'
  }
  if (panel == 3) {
    set xrange [*:*]
    set offsets 0.5, 0.5, 0.2, 0
    set yrange [0:*]
    set xtics 1 format '%g'
    set ytics 0.5 format '%.1f'
    set xlabel 'Threads' offset 0, 0.3
    set ylabel 'Speed-up' offset 0.5, 0
    set key bottom right Left reverse
    plot table using 'threads':'threads' with lines ls BOUNDARY title 'Ideal', \
         table using 'threads':(of('study', column('speedup'))) with linespoints lc rgb vermillion lw 1.1 pt 9 ps 0.75 \
             title 'Study of 100 runs, {/:Italic N} = 10^3', \
         table using 'threads':(of('threads', column('speedup'))) with linespoints @one_run \
             title 'One run, {/:Italic N} = 10^5'
  }
  if (panel == 4) {
    set logscale xy
    set xrange [0.7:1400]
    set yrange [50:10000]
    set xtics format '%g'
    set ytics autofreq format '%g'
    set xlabel 'Observations' offset 0, 0.3
    set ylabel 'Time of the run per likelihood (ns)' offset 0.5, 0
    plot table using 'observations':(of('observations', column('nanoseconds_per_evaluation'))) with linespoints @one_run
  }
}
unset multiplot
