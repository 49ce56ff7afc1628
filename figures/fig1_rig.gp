# The rig, drawn by us: (a) a single-storey frame on a moving base, whose mass rubs on a fixed wall; (b) the same as a
# mass on a spring. A unit of the axes is a millimetre. The friction force is drawn for motion to the right.
width = 17.4
height = 6.3
load 'figures/style.gp'

set margins 0, 0, 0, 0
set xrange [0:174]
set yrange [3:66]
unset border
unset tics
unset grid
unset key

set style line 20 lc rgb 'black' lw 1.1
set style line 21 lc rgb 'black' lw 0.5
set style arrow 1 nohead ls 20
set style arrow 2 nohead ls 21
set style arrow 3 head filled size 2.4, 18 ls 20
set style rectangle fc rgb '#DCDCDC' fs solid border lc rgb 'black' lw 1.1
small = ",7.5"
bold = 'Nimbus Sans:Bold,8.5'

# Fixed surfaces, hatched: x from, x to, y, and the side of the hatching (1 above, -1 below).
surfaces = '6 66 8 -1  30 50 53 1  98 168 12 -1'
pitch = 2
do for [i = 1:words(surfaces):4] {
  from = word(surfaces, i) + 0
  to = word(surfaces, i + 1) + 0
  y = word(surfaces, i + 2) + 0
  foot = word(surfaces, i + 3) > 0 ? y : y - pitch
  set arrow from from, y to to, y as 1
  do for [x = from:to - pitch:pitch] {
    set arrow from x, foot to x + pitch, foot + pitch as 2
  }
}

# (a) Frame.
set label '(a)' at 2, 63 font bold
set object circle at 22, 9.5 size 1.5 fc rgb 'white' fs solid border lc rgb 'black' lw 1.1
set object circle at 48, 9.5 size 1.5 fc rgb 'white' fs solid border lc rgb 'black' lw 1.1
set object rectangle from 12, 11 to 58, 16
set object rectangle from 20, 39 to 60, 48
set object rectangle from 37, 48 to 43, 53 fc rgb '#606060'
set label 'base' at 35, 13.5 center font small front
set label '{/:Italic m}' at 40, 43.5 center front
set label '{/:Italic k}/2' at 18.5, 27.5 right
set label '{/:Italic k}/2' at 56, 27.5 left
set label 'fixed wall' at 51.5, 54.2 left font small
set arrow from 40, 65 to 40, 55.7 as 3
set label '{/:Italic N}' at 41.8, 61.5 left
set arrow from 36, 50.5 to 25, 50.5 as 3
set label '{/:Italic F}_{/:Italic μ}' at 23.2, 51.3 right
set arrow from 60, 43.5 to 71, 43.5 as 3
set label '{/:Italic X}({/:Italic t})' at 72.5, 43.5 left
set arrow from 58, 13.5 to 69, 13.5 as 3
set label '{/:Italic Y}({/:Italic t}) = {/:Italic Y}_b cos {/:Italic ω}_b{/:Italic t}' at 61, 17.5 left

# (b) Mass on a spring.
set label '(b)' at 94, 63 font bold
set object circle at 102, 13.5 size 1.5 fc rgb 'white' fs solid border lc rgb 'black' lw 1.1
set object circle at 108, 13.5 size 1.5 fc rgb 'white' fs solid border lc rgb 'black' lw 1.1
set object rectangle from 100, 15 to 110, 35
set object rectangle from 135, 12 to 157, 35
set label 'base' at 105, 25 center rotate by 90 font small front
set label '{/:Italic m}' at 146, 24 center front
set label '{/:Italic k}' at 122.5, 32 center
set label 'fixed wall' at 146, 7 center font small
set arrow from 146, 47 to 146, 35.5 as 3
set label '{/:Italic N}' at 147.8, 44 left
set arrow from 134.5, 13.7 to 124, 13.7 as 3
set label '{/:Italic F}_{/:Italic μ}' at 122.5, 14.5 right
set arrow from 157, 35.5 to 157, 43 as 2
set arrow from 157, 41 to 168, 41 as 3
set label '{/:Italic X}({/:Italic t})' at 162.5, 45 center
set arrow from 110, 35.5 to 110, 43 as 2
set arrow from 110, 41 to 121, 41 as 3
set label '{/:Italic Y}({/:Italic t}) = {/:Italic Y}_b cos {/:Italic ω}_b{/:Italic t}' at 110, 46.5 left

unset datafile columnheaders
$spring << EOD
110,26
114,26
115,29
117,23
119,29
121,23
123,29
125,23
127,29
129,23
130,26
135,26
EOD

set samples 60
sway(s) = 5 * s**2 * (3 - 2 * s)
plot sample [s = 0:1] '+' using (19 + sway(s)):(16 + 23 * s) with lines ls 20, \
     [s = 0:1] '+' using (51 + sway(s)):(16 + 23 * s) with lines ls 20, \
     $spring using 1:2 with lines ls 20
