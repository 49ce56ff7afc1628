#!/usr/bin/env bash
# own_model: figures of the samples and their tables, the posterior predictive of models with outputs, and separate modes in the report.
source "$(dirname "$0")/support.sh"

own="$bin/own_model --evaluations 8000"
$own --runs 2 --output samples.csv --figures drawn/here >report.txt 2>err
check "ends with 0: $(cat err)" test $? = 0
for figure in samples_corner samples_marginals samples_stages samples_predictive; do
  for format in pdf png; do check "$figure.$format" test -s drawn/here/$figure.$format; done
done
check "a row per parameter" test "$(wc -l <drawn/here/corner_summary.csv)" = 4
check "three pairs of parameters" test "$(wc -l <drawn/here/corner.csv)" = $((3 * 30 * 30 + 1))
check "the mean of the report" awk -F, -v x="$(awk '$1 == "stiffness_1" {print $2}' report.txt)" \
  '$1 == "stiffness_1" {exit !(($2 - x)^2 < 1e-8)}' drawn/here/corner_summary.csv
check "stages of both runs" test "$(tail -n +2 drawn/here/stages.csv | cut -d, -f1 | sort -u | tr '\n' ' ')" = "1 2 "
check "one mode goes without saying" test "$(grep -c 'separate modes' report.txt)" = 0

# With wide bounds the two frequencies have a second solution (docs/own_model.md).
printf '%s\n' parameter,lower,upper stiffness_1,0.1,3 stiffness_2,0.1,3 relative_noise,0.001,0.1 >wide.csv
"$bin/own_model" --prior wide.csv --output wide_samples.csv >modes.txt
check "two solutions are two modes" grep -q '^2 separate modes:' modes.txt
check "each with its weight and its means" test "$(grep -c '^  mode [12]: weight .* +- .* stiffness_1 = ' modes.txt)" = 2

touch file
expect_error 2 "--figures: value '" $own --output other.csv --figures file/below
PATH=/nowhere $own --output bare.csv --figures bare >report.txt 2>err
check "without gnuplot: tables and a warning" test $? = 0 -a -s bare/corner.csv -a -s bare/predictive.csv -a "$(grep -c '^warning: .*gnuplot' err)" = 1

# Ranges that a table has as powers of ten.
printf '%s\n' '#!/bin/sh' 'while read -r n; do head -n "$n" | awk -F, "{ print -0.5 * ((\$1 - 2e-5) / 1e-6) ^ 2 - 0.5 * ((\$2 - 3e17) / 1e15) ^ 2; fflush() }"; done' >tiny.sh
sed -i 's/head -n "$n" |/for i in $(seq "$n"); do read -r line; echo "$line"; done |/' tiny.sh
chmod +x tiny.sh
printf '%s\n' parameter,lower,upper tiny,1e-5,3e-5 huge,2.9e17,3.1e17 >scales.csv
"$bin/own_model" --worker ./tiny.sh --prior scales.csv --evaluations 5000 --quiet --figures scales 2>err
check "parameters of any scale are drawn: $(cat err)" test -s scales/samples_corner.png -a -s scales/samples_marginals.png -a ! -s err
check "a model without outputs has no posterior predictive" test ! -e scales/predictive.csv -a ! -e scales/samples_predictive.png

# ---- The posterior predictive of the frame: 16 frequencies of two modes.
check "what it costs is reported" grep -qx 'posterior predictive: 1[3-6] of 16 measurements in the central 95 % of a new one; 500 more evaluations' <($own --figures frame)
check "a row per measurement, with its label" test "$(cut -d, -f1-4 frame/predictive.csv | sed -n '1p;2p;17p' | tr '\n' ' ')" = \
  "quantity,number,label,observed frequency_hz,1,mode 1,4.3182 frequency_hz,16,mode 2,11.7533 "
check "nested bands around the median, and the same in standard deviations" awk -F, '
  NR > 1 { n++; if (!($8 < $6 && $6 < $5 && $5 < $7 && $7 < $9 && $10 > 0 && $10 < 1)) exit 1
           sd = ($9 - $5) / $15; for (k = 0; k < 4; k++) { from = k == 0 ? 4 : 5 + k; to = k == 0 ? 11 : 11 + k
             if (k > 0) { d = ($from - $5) / sd - $to; if (d * d > 1e-10) exit 1 } }
           d = ($4 - $5) / sd - $11; if (d * d > 1e-10) exit 1 }
  END { exit n != 16 }' frame/predictive.csv
$own --threads 1 --quiet --figures again
check "the same bytes with one thread" cmp frame/predictive.csv again/predictive.csv
"$bin/own_model" --built-in friction --observations data/published/table1_observations.csv --prior "$source/data/published/table2_prior.csv" \
  --evaluations 8000 --figures rig >report.txt 2>err
check "the rig has two quantities: $(cat err)" test "$(cut -d, -f1 rig/predictive.csv | sort | uniq -c | tr -s ' \n' ' ')" = " 10 phase_deg 1 quantity 10 r_nominal " -a -s rig/samples_predictive.png

# A linear model with a closed form: y = (a, a + b, a - b) has the mean (1, 3, -1), since the data agree with each other.
cat >linear.py <<'PY'
#!/usr/bin/env python3
import os, sys
counter = os.environ.get("COUNTER", os.devnull)
for line in sys.stdin:
    n = int(line)
    points = [[float(x) for x in sys.stdin.readline().split(",")] for _ in range(n)]
    with open(counter, "a") as file:
        file.write(f"{n}\n")
    if os.environ.get("BREAKS") and sum(map(int, open(counter))) > 8000:
        open(counter + ".broken", "w").close()
        if os.environ["BREAKS"] == "hangs":
            os.execvp("sleep", ["sleep", f"66.{os.getppid()}"])
        sys.exit(5)
    print(*[f"{a!r},{a + b!r},{a - b!r}" for a, b in points], sep="\n", flush=True)
PY
chmod +x linear.py
cat >linear.toml <<'TOML'
[run]
evaluations = 8000
[model]
worker = "linear.py"
[data]
observation = [1, 3, -1]
standard_deviation = [0.1, 0.2, 0.3]
[parameters]
a = {lower = -5, upper = 5}
b = {lower = -5, upper = 5}
[output]
samples = "linear.csv"
netcdf = "linear.nc"
figures = "linear"
TOML
linear="$bin/own_model linear.toml --quiet"
# within BOUND, in standard deviations of the model, of 500 draws: 4 standard errors of a median and of a quantile.
closed_form() {  # NOISE
  awk -F, -v noise="$1" 'BEGIN { split("0.0076471 0.0305882 0.0423529", v, " "); split("1 3 -1", mean, " "); z = 1.959964 }
    function off(x, expected, bound) { return (x - expected) ^ 2 > bound ^ 2 }
    NR > 1 { k = NR - 1; model = noise * sqrt(v[k]); new = sqrt(model ^ 2 + (noise * k / 10) ^ 2); n++
      if (off($5, mean[k], 0.22 * model) || off($6, mean[k] - z * model, 0.48 * model) || off($7, mean[k] + z * model, 0.48 * model) ||
          off($8, mean[k] - z * new, 0.2 * new) || off($9, mean[k] + z * new, 0.2 * new) || off($10, 0.5, 0.1)) { print; bad++ } }
    END { exit n != 3 || bad > 0 }' "$2"
}
COUNTER=$work/counter $linear
check "the bands of a linear model" closed_form 1 linear/predictive.csv
check "its NetCDF file, with the measurements" test -s linear.nc
check "500 evaluations more than the samples, in calls of at most 100" awk '{ n += $1; last[NR] = $1 } END { exit !(n <= 8500 && n > 8400 && last[NR] <= 100) }' counter
cp linear/predictive.csv whole.csv
$linear --parallel 3 --batch 7
check "the same bytes in other calls" cmp whole.csv linear/predictive.csv
sed 's/^b = /noise = {lower = 1.999, upper = 2.001}\nb = /; s/^standard_dev/noise = "noise"\nstandard_dev/' linear.toml >noisy.toml
"$bin/own_model" noisy.toml --quiet --figures noisy
check "a noise of 2 that is a parameter" closed_form 2 noisy/predictive.csv
rm -rf linear
$linear --predictive-draws 0
check "no draws, no posterior predictive" test -s linear/samples_corner.png -a ! -e linear/predictive.csv
check "20 draws in the problem file" grep -q '; 20 more evaluations$' <(sed 's/^figures/predictive_draws = 20\nfigures/' linear.toml >twenty.toml; "$bin/own_model" twenty.toml)
expect_error 2 "--predictive-draws: value '-1': expected a whole number from 0" $linear --predictive-draws -1

# A model that fails then loses nothing else; its checkpoint stays, and the same command goes on from it.
export COUNTER=$work/counter
for breaks in dies hangs; do
  rm -rf linear linear.csv counter*
  BREAKS=$breaks $linear --threads 1 --timeout 2 2>err
  check "it $breaks: status 1" test $? = 1
  check "it $breaks: $(tail -n 1 err)" grep -q '^own_model: error: .*linear.py: .*(a = .*; all results but samples_predictive are in place$' err
  check "it $breaks: the results" test -s linear.csv -a -s linear/samples_corner.pdf -a ! -e linear/predictive.csv -a -s linear.csv.checkpoint
  rm -f counter
  $linear
  check "it $breaks: the same command makes the rest" cmp whole.csv linear/predictive.csv
  check "it $breaks: with few evaluations" awk '{ n += $1 } END { exit n > 1000 }' counter
  check "it $breaks: the checkpoint is gone" test ! -e linear.csv.checkpoint
done
rm -rf linear linear.csv counter*
BREAKS=hangs start $linear --threads 1
wait_for test -e counter.broken
check "Ctrl-C" stop INT
check "says what is in place: $(cat said.txt)" grep -qx 'own_model: interrupted: all results but samples_predictive are in place' said.txt
check "and it is" test -s linear.csv -a -s linear/corner.csv -a ! -e linear/predictive.csv -a -z "$(find . -name '*.part')"

# Many measurements.
rm -f linear.csv*
sed -i 's/^    print.*/    print(*[",".join(repr(a + b * k \/ 200) for k in range(200)) for a, b in points], sep="\\n", flush=True)/' linear.py
{ echo y; seq 1 0.01 2.99; } >many.csv
"$bin/own_model" linear.toml --observations many.csv --observation y --standard-deviation 0.3 --quiet --figures many 2>err
check "200 measurements: $(cat err)" test "$(wc -l <many/predictive.csv)" = 201 -a -s many/samples_predictive.png -a ! -s err
finish
