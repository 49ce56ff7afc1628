# Style shared by the figures. A script sets width and height in cm, then loads this file; figures/draw presets format
# and output_file. One role has one colour, and one dash or symbol with it, in every figure.

pixels_per_cm = 100
font = 'Nimbus Sans,8.5'
# Line widths and font sizes are printer's points in both formats: these terminals take a font point for 1/54 inch, and
# a line of width 1 is half a point in a PDF and a pixel in a PNG.
if (format eq 'pdf') {
  set terminal pdfcairo size width cm, height cm enhanced color font font fontscale 0.75 \
      linewidth 2 dashlength 0.8 background 'white'
} else {
  scale = pixels_per_cm * 2.54 / 72
  set terminal pngcairo size int(width * pixels_per_cm + 0.5), int(height * pixels_per_cm + 0.5) enhanced color \
      font font fontscale 0.75 * scale linewidth scale pointscale scale dashlength 0.8 background 'white'
}
set output output_file
set encoding utf8

set datafile separator comma
set datafile missing 'nan'
set datafile columnheaders

# The values that made the measurements: Section 3 of the paper, and the noise of its Eqs. 22 and 23.
true_friction_force_n = 1.086
true_natural_frequency_hz = 3.086
true_phase_noise_deg = 2
true_frequency_ratio_noise = 0.01

blue = '#0072B2'
vermillion = '#D55E00'
green = '#009E73'
purple = '#CC79A7'
printed = 'white'
grey = '#808080'
pale = '#ECECEC'

TMCMC = 1
TMCMC_II = 2
TMCMC_RUN = 3
TMCMC_II_RUN = 4
TRUTH = 5
LEAST_SQUARES = 6
BOUNDARY = 7
EXACT = 8
OBSERVED = 9
MODEL = 10
set style line TMCMC lc rgb blue lw 1.1 pt 7 ps 0.35
set style line TMCMC_II lc rgb vermillion lw 1.1 dt (12, 4) pt 9 ps 0.4
# One run among many: thin and transparent.
set style line TMCMC_RUN lc rgb '#99'.blue[2:] lw 0.4 pt 7 ps 0.2
set style line TMCMC_II_RUN lc rgb '#99'.vermillion[2:] lw 0.4 pt 7 ps 0.2
set style line TRUTH lc rgb 'black' lw 1.1 dt (6, 5)
set style line LEAST_SQUARES lc rgb green lw 1.2 dt (16, 5, 3, 5)
set style line BOUNDARY lc rgb grey lw 1.1
set style line EXACT lc rgb purple lw 1.5
set style line OBSERVED lc rgb 'black' lw 0.8 pt 6 ps 0.6
set style line MODEL lc rgb 'black' lw 1.1

set style line 100 lc rgb '#404040' lw 0.5
set style line 101 lc rgb '#E2E2E2' lw 0.4
set border 3 back ls 100
set tics nomirror out scale 0.5, 0.3 textcolor rgb 'black'
set grid back ls 101
set key samplen 2.6 spacing 1.15 width 0 font ',8' noautotitle
