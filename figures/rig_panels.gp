# Range, tics and label of one parameter of the rig. Call with its number, from 1, after loading panels.gp and style.gp.
parameter = int(ARG1)
own(value) = strcol('parameter') eq name(parameter) ? value : NaN
set xrange [low(parameter):high(parameter)]
set xtics tick(parameter) format '%g'
if (parameter == 1) { set xlabel 'Friction force {/:Italic F}_{/:Italic μ} (N)' offset 0, 0.3 }
if (parameter == 2) { set xlabel 'Natural frequency {/:Italic ω}_n (Hz)' offset 0, 0.3 }
if (parameter == 3) { set xlabel 'Phase noise {/:Italic σ}_{/:Italic φ} (deg)' offset 0, 0.3 }
if (parameter == 4) { set xlabel 'Frequency-ratio noise {/:Italic σ}_{/:Italic r}' offset 0, 0.3 }
