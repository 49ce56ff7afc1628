#!/usr/bin/env bash
# make rig: tables and figures of a reader's own rig, whatever its friction and its driving force; one line for what is wrong.
source "$(dirname "$0")/support.sh"

ln -s "$source/figures" figures
rig() { env BIN="$bin" RIG=out RUNS=4 SAMPLER=recommended "$@" "$source/tools/rig"; }
row() { awk -F, -v q="$2" -v c="$3" 'NR==1 {for (i=1;i<=NF;i++) n[$i]=i; next} $1==q {print $n[c]}' "$1"; }
within() { check "$1: $2 <= $3 <= $4" awk -v a="$2" -v x="$3" -v b="$4" 'BEGIN {exit !(a <= x && x <= b)}'; }

printf '%s\n' parameter,lower,upper friction_force,0.001,20 natural_frequency,0.1,50 phase_noise,0.01,20 \
  frequency_ratio_noise,0.0005,1 >prior.csv

# friction, natural frequency, driving force, phase noise, noise of the frequency ratio
seed=0
while read -r truth frequency force noise ratio_noise; do
  seed=$((seed + 1)) name="F_mu $truth N, driving force $force N"
  "$bin/table1_observations" --reading corrected --friction-force $truth --natural-frequency $frequency --driving-force $force \
    --phase-noise $noise --frequency-ratio-noise $ratio_noise --seed $seed --quiet --output rows.csv
  head -n 10 rows.csv >nine.csv
  rm -rf out
  rig OBSERVATIONS=nine.csv PRIOR=prior.csv DRIVING_FORCE=$force >report.txt 2>err
  check "$name: ends with 0 and says nothing: $(cat err)" test $? = 0 -a ! -s err
  for figure in phase pboxes marginals tempering corner; do
    for format in png pdf; do check "$name: $figure.$format" test -s out/$figure.$format; done
  done
  within "$name: posterior" "$(row out/exact_posterior.csv friction_force_n mean | awk -v s="$(row out/exact_posterior.csv friction_force_n sd)" '{print $1-4*s}')" \
    $truth "$(row out/exact_posterior.csv friction_force_n mean | awk -v s="$(row out/exact_posterior.csv friction_force_n sd)" '{print $1+4*s}')"
  inside=$(awk -F, 'NR==1 {for (i=1;i<=NF;i++) n[$i]=i; next} {k += $n["left_out"] >= 0.005 && $n["left_out"] <= 0.995} END {print k}' out/measurements.csv)
  within "$name: predictions of 18 measurements from the others, 99 %" 16 "$inside" 18  # fewer with probability 1e-4
  check "$name: settings" grep -qx "driving_force_n,$force" out/settings.csv
  check "$name: the truth of the paper is in no table" test -z "$(grep -l '1\.086\|3\.086' out/exact_summary.csv out/settings.csv out/predictive.txt)"
done <<'ROWS'
0.3 3 1 2 0.01
0.8 12 3 0.5 0.003
2.5 3 10 2 0.01
ROWS

# What is missing or bad: one line, and the results of the last time stay.
expect_error 2 "OBSERVATIONS: value ''" rig
expect_error 2 "OBSERVATIONS: value 'none.csv': expected a file that exists" rig OBSERVATIONS=none.csv
expect_error 2 "PRIOR: value 'none.csv': expected a file that exists" rig OBSERVATIONS=nine.csv PRIOR=none.csv
expect_error 2 "--driving-force: value 'strong'" rig OBSERVATIONS=nine.csv DRIVING_FORCE=strong
sed '3s/,[^,]*$/,abc/' nine.csv >bad.csv
expect_error 2 "bad.csv:3: column 'phase_deg': value 'abc'" rig OBSERVATIONS=bad.csv
check "nothing is left over" test -z "$(find . -maxdepth 1 -name 'out.*')"

# The paper's own threshold belongs to the paper's table.
check "no P(F_mu > 1.086 N) of another rig" test -z "$("$bin/exact_posterior" --observations nine.csv --driving-force 10 | grep 1.086)"
check "P(F_mu > 1.086 N) of Table 1" grep -q 'P(F_mu > 1.086 N) = 0.00' <("$bin/exact_posterior")
check "a truth of one's own does not audit the printed table" test -z "$("$bin/table1_observations" --friction-force 0.8 | grep Audit)"
check "measurements of one's own are audited" grep -q 'Audit of nine.csv' <("$bin/table1_observations" --friction-force 2.5 --observations nine.csv --driving-force 10)
finish
