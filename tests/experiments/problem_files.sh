#!/usr/bin/env bash
# Problem files: those of examples/, keys against options, and what is wrong with a file, named by its line.
source "$(dirname "$0")/support.sh"
export PYTHONDONTWRITEBYTECODE=1
own="$bin/own_model"
examples=$source/examples
cp -r "$source/data/examples" data/examples
mkdir examples && cp "$source/examples/um_bridge_server.py" examples/

# The file and the command line say the same.
cat >frame.toml <<'TOML'
[run]
evaluations = 2600
seed = 3
runs = 2

[model]
built_in = "shear_frame"

[data]
file = "data/examples/frame_observations.csv"

[parameters]
relative_noise = {lower = 0.001, upper = 0.1}
stiffness_1 = {lower = 0.1, upper = 2}
stiffness_2 = {lower = 0.1, upper = 2}

[sampler]
independent_fraction = 0.25
cross_fit = true

[output]
samples = "of_file.csv"
netcdf = "of_file.nc"
summary = "of_file_summary.csv"
TOML
$own frame.toml >report.txt
printf 'parameter,lower,upper\nstiffness_1,0.1,2\nstiffness_2,0.1,2\nrelative_noise,0.001,0.1\n' >prior.csv
options="--evaluations 2600 --seed 3 --runs 2 --independent-fraction 0.25 --cross-fit yes --prior prior.csv --quiet"
$own $options --output options.csv --netcdf options.nc --summary options_summary.csv
for kind in .csv .nc _summary.csv; do check "file and options: $kind" cmp -s of_file$kind options$kind; done
check "nothing is left beside the results" test -z "$(find . -name '*.checkpoint*')"
check "two runs" test "$(cut -d, -f1 of_file.csv | sort -u | tr '\n' ' ')" = "1 2 run "
check "a row of the summary for each parameter" test "$(cut -d, -f1 of_file_summary.csv | tr '\n' ' ')" = "parameter stiffness_1 stiffness_2 relative_noise "
check "the table is printed" grep -q '^stiffness_2 .* [0-9]\.[0-9]*$' report.txt
check "the log-evidence too" grep -q '^log-evidence ' report.txt
check "the summary is that of the samples" awk -F, 'FNR == 1 { next } NR == FNR { mean[$1] = $3; q5[$1] = $5; q95[$1] = $7; next }
  { n++; s += $2; below += $2 < q5["stiffness_1"]; above += $2 > q95["stiffness_1"] }
  END { d = s / n - mean["stiffness_1"]; exit !(d * d < 1e-6 && below / n > 0.045 && below / n < 0.055 && above / n > 0.045 && above / n < 0.055) }' \
  of_file_summary.csv of_file.csv
if command -v ncdump >/dev/null; then check "runs are chains" grep -q 'chain = 2 ;' <(ncdump -h of_file.nc); fi
$own frame.toml --quiet --runs 1 --seed 4 --output one.csv --netcdf one.nc --summary one_summary.csv
$own ${options/--runs 2/--runs 1} --seed 4 --output other.csv 2>/dev/null || $own --evaluations 2600 --seed 4 --independent-fraction 0.25 --cross-fit yes --prior prior.csv --quiet --output other.csv
check "the command line wins" cmp -s one.csv other.csv
check "the first run of two is a run alone" cmp -s <($own frame.toml --quiet --runs 1 --output - --netcdf /dev/null --summary /dev/null) \
  <(grep -v '^2,' of_file.csv | cut -d, -f2-)
mkdir elsewhere
(cd elsewhere && $own ../frame.toml --quiet --runs 1)
check "paths of the file begin where it is" test -s of_file.csv -a -z "$(ls elsewhere)"
sed 's/^netcdf.*//; s/^samples.*/samples = "-"/; s/^summary.*//' frame.toml >printed.toml
check "'-' is standard output" cmp -s <($own printed.toml --quiet) options.csv

# A run that is killed goes on, run by run.
cat >worker.py <<'PY'
#!/usr/bin/env python3
import os, sys
count = 0
for line in sys.stdin:
    for _ in range(int(line)):
        x = float(sys.stdin.readline())
        count += 1
        if count == 4000 and not os.path.exists(os.environ["MENDED"]): sys.exit(5)
        print(-50 * (x - 0.5) ** 2)
    sys.stdout.flush()
PY
chmod +x worker.py
printf '[run]\nevaluations = 2600\nruns = 2\n[model]\nworker = "worker.py"\nparallel = 1\n[parameters]\nx = {lower = -1, upper = 1}\n' >worker.toml
export MENDED=$work/mended
$own worker.toml --output kept.csv >/dev/null 2>error.txt
check "a worker that dies is started again: $(cat error.txt)" test -s kept.csv
sed -i 's/sys.exit(5)/os.kill(os.getppid(), 9)/' worker.py
$own worker.toml --output killed.csv >/dev/null 2>&1
check "what is kept of a killed run" test "$(echo killed.csv*)" = "killed.csv.checkpoint killed.csv.checkpoint.2"
touch "$MENDED"
$own worker.toml --output killed.csv >/dev/null 2>error.txt
check "the same command goes on to the same bytes: $(cat error.txt)" cmp -s killed.csv kept.csv

# The examples.
sed 's/evaluations = .*/evaluations = 2600/' "$examples/shear_frame.toml" >"$work/short.toml"
sed -i "s|\.\./data|$source/data|" short.toml
check "shear_frame.toml" $own short.toml --quiet --output frame_cpp.csv
PATH=/usr/bin:$PATH $own short.toml --quiet --worker data/examples/two_storey_worker.py --output frame_python.csv
check "the worker of the command line replaces the model of the file" awk -F, 'NR == FNR { for (j = 1; j <= 4; j++) a[FNR, j] = $j; next }
  FNR > 1 { for (j = 2; j <= 4; j++) if (($j - a[FNR, j]) ^ 2 > (1e-9 * $j) ^ 2) bad++ } END { exit bad > 0 }' frame_cpp.csv frame_python.csv
check "friction_rig.toml" $own "$examples/friction_rig.toml" --evaluations 5000 --quiet --output rig.csv
check "its posterior: 0.98 +- 0.03 N, 3.08 +- 0.01 Hz" awk -F, 'NR > 1 { n++; f += $1; w += $2 }
  END { exit !(f / n > 0.95 && f / n < 1.01 && w / n > 3.06 && w / n < 3.1) }' rig.csv
check "eight_groups.toml" $own "$examples/eight_groups.toml" --evaluations 13000 --quiet --output groups.csv
check "its columns" test "$(head -1 groups.csv)" = mu,tau,theta_1,theta_2,theta_3,theta_4,theta_5,theta_6,theta_7,theta_8,log_likelihood
data/examples/two_storey_um_bridge.py >address 2>server.log &
server=$! pid=$!
wait_for test -s address
check "frame_um_bridge.toml" $own "$examples/frame_um_bridge.toml" --um-bridge "$(cat address)" --model forward --evaluations 2600 --quiet --output bridge.csv
check "the noise is a parameter" test "$(head -1 bridge.csv)" = stiffness_1,stiffness_2,noise,log_likelihood
kill $server
wait $server 2>/dev/null
if PATH=/usr/bin:$PATH python3 -c 'import numpy' 2>/dev/null; then
  export PATH=/usr/bin:$PATH
  bouc="$own $examples/bouc_wen.toml --evaluations 2600 --quiet"
  shorter="${bouc/2600/1000} --chains 10 --finish none"
  $bouc --output worker.csv
  check "bouc_wen.toml" test -s worker.csv
  $bouc --worker "$examples/bouc_wen/worker.py" --parallel 2 --batch 30 --output batches.csv
  check "two workers in batches of 30 give the same bytes" cmp -s worker.csv batches.csv
  $bouc --command "$examples/bouc_wen/program.py" --output program.csv
  check "the program gives the same bytes" cmp -s worker.csv program.csv
  "$examples/bouc_wen/um_bridge.py" >address.bouc 2>server.log &
  server=$! pid=$!
  wait_for test -s address.bouc
  $shorter --um-bridge "$(cat address.bouc)" --model bouc_wen --output bridge.csv
  $shorter --output worker.csv
  check "UM-Bridge gives the same bytes" cmp -s worker.csv bridge.csv
  kill $server
  wait $server 2>/dev/null
else echo 'NumPy is not installed: left out'; fi

# What is wrong is named by file, line and key; no output is touched.
echo untouched >of_file.csv
refuse() {  # TEXT SED_SCRIPT
  sed "$2" frame.toml >wrong.toml
  expect_error 2 "wrong.toml:$1" $own wrong.toml
}
refuse "2: run.evaluations: value '0': expected a whole number from 500" 's/^evaluations.*/evaluations = 0/'
refuse "2: run.evaluations: value '2600.5': expected a whole number" 's/^evaluations.*/evaluations = 2600.5/'
refuse "2: run.evaluations: value '2600': expected a number" 's/^evaluations.*/evaluations = "2600"/'
refuse "2: run.evaluations: value 'true': expected a number" 's/^evaluations.*/evaluations = true/'
refuse "2: run.evaluation: unknown key: expected evaluations, runs, seed, threads" 's/^evaluations/evaluation/'
refuse "3: run.seed: value '-3': expected a whole number from 0" 's/^seed.*/seed = -3/'
refuse "6: modle: unknown key: expected the tables " 's/^\[model/[modle/'
refuse "7: model.built_in: value 'frame': expected shear_frame or friction" 's/^built_in.*/built_in = "frame"/'
refuse "7: model.built_in: value '3': expected a text in quotes" 's/^built_in.*/built_in = 3/'
refuse "7: model.worker: value './missing.py': expected a file that exists" 's|^built_in.*|worker = "./missing.py"|'
refuse " no model: expected built_in, command, worker or um_bridge" 's/^built_in.*//'
refuse " no data: expected file" 's/^file.*//'
refuse "10: data.file: value 'missing.csv': expected a file that exists" 's/^file.*/file = "missing.csv"/'
refuse "12: parameters: no stiffness_2: expected the parameters stiffness_1, stiffness_2, relative_noise" 's/^stiffness_2.*//'
refuse "15: parameters.stiffness: expected the parameters" 's/^stiffness_2/stiffness/'
refuse "14: parameters.stiffness_1.upper: value '2': expected a number, or the name of a parameter above" 's/^stiffness_1.*/stiffness_1 = {lower = 0.1, upper = "2"}/'
refuse "18: sampler.independent_fraction: value '2': expected a number in" 's/^independent_f.*/independent_fraction = 2/'
refuse "18: sampler.move_steps: value '3': expected only with --move" 's/^independent_f.*/move_steps = 3/'
refuse "19: sampler.cross_fit: value '1': expected a text in quotes" 's/^cross_fit.*/cross_fit = 1/'
refuse "19: sampler.cross_fit: value 'maybe': expected no or yes" 's/^cross_fit.*/cross_fit = "maybe"/'
refuse "4: " 's/^runs.*/runs = /'
refuse "24: output.summary: value '3': expected a text in quotes" 's/^summary.*/summary = 3/'
expect_error 2 "--output: value 'of_file.nc': expected another file than that of --netcdf" $own frame.toml --output of_file.nc
expect_error 2 'missing.toml: ' $own missing.toml
printf '[model]\nworker = "worker.py"\n[data]\nobservation = [1, 2]\nstandard_deviation = [0.1]\n[parameters]\nx = {lower = 0, upper = 1}\n' >wrong.toml
expect_error 2 "wrong.toml:5: data.standard_deviation" $own wrong.toml
sed -i 's/^standard.*/standard_deviation = 0/' wrong.toml
expect_error 2 "wrong.toml:5: data.standard_deviation: value '0': expected a positive number" $own wrong.toml
sed -i 's/^standard.*/noise = "y"/' wrong.toml
expect_error 2 "wrong.toml:5: data.noise: value 'y': expected one of the parameters x" $own wrong.toml
finish
