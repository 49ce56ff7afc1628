#!/usr/bin/env bash
# Answers that need no sampler: known numbers on Table 1, known truth on generated data, and errors that are one line.
source "$(dirname "$0")/support.sh"

# near NAME VALUE EXPECTED TOLERANCE
near() { check "$1: $2, expected $3 +- $4" awk -v x="$2" -v e="$3" -v t="$4" 'BEGIN {d=x-e; exit !(x==x+0 && d*d <= t*t)}'; }
# cell FILE COLUMN KEY [KEY2]: the column of the row whose first cell (and second) are these.
cell() {
  awk -F, -v column="$2" -v key="$3" -v key2="${4-}" 'NR==1 {for (i=1; i<=NF; i++) at[$i]=i; next}
    $1==key && (key2=="" || $2==key2) {print $at[column]; exit}' "$1"
}

# Table 1: computed twice elsewhere, by independent quadratures; natural frequency and log-evidence with the prior as
# printed.
prior=data/published/table2_prior.csv
"$bin/exact_posterior" --prior $prior --exceedance 1.0864 --quiet --output exact.csv --summary-output summary.csv
near "F_mu" "$(cell exact.csv mean friction_force_n)" 0.98189 5e-6
near "its sd" "$(cell exact.csv sd friction_force_n)" 0.03048 5e-6
near "omega_n" "$(cell exact.csv mean natural_frequency_hz)" 3.08145 5e-6
near "its sd" "$(cell exact.csv sd natural_frequency_hz)" 0.01139 5e-6
near "sigma_phase" "$(cell exact.csv mean phase_noise_deg)" 3.063 5e-4
near "its sd" "$(cell exact.csv sd phase_noise_deg)" 0.890 5e-4
near "sigma_r" "$(cell exact.csv mean frequency_ratio_noise)" 0.01513 5e-6
near "its sd" "$(cell exact.csv sd frequency_ratio_noise)" 0.00445 5e-6
near "P(F_mu > 1.0864 N)" "$(cell summary.csv value exceedance_probability)" 0.0018 1e-4
near "log-evidence" "$(cell summary.csv value log_evidence)" -11.114 1e-3
check "quantiles ascend" awk -F, 'NR>1 && !($4<$5 && $5<$6 && $6<$7 && $7<$8) {bad=1} END {exit bad}' exact.csv
# The least-squares natural frequency is a ratio of sums.
near "least squares, omega_n" "$(cell exact.csv least_squares natural_frequency_hz)" \
  "$(awk -F, 'NR>1 {a+=$4*$4; b+=$2*$4} END {printf "%.10f", a/b}' data/published/table1_observations.csv)" 1e-7
# A tenth of the prior's width is a tenfold evidence.
sed 's/^friction_force,0.01,10,/friction_force,0.501,1.5,/' $prior >narrow_prior.csv
"$bin/exact_posterior" --prior narrow_prior.csv --quiet --summary-output narrow.csv
near "evidence, narrower prior" "$(cell narrow.csv value log_evidence)" \
  "$(awk -v e="$(cell summary.csv value log_evidence)" 'BEGIN {printf "%.8f", e + log(10)}')" 1e-6

# Angles: a phase may be written with a turn more or less. Here every second one is, and the answers stay.
table1=data/published/table1_observations.csv
awk -F, -v OFS=, 'NR>1 && NR%2 {$5-=360} {print}' $table1 >turned.csv
"$bin/exact_posterior" --observations turned.csv --prior $prior --quiet --output turned_posterior.csv 2>said.txt
check "no warning of some negative phases" test ! -s said.txt
for column in mean sd laplace_mode laplace_sd least_squares; do
  near "turned phases, $column" "$(cell turned_posterior.csv $column friction_force_n)" "$(cell exact.csv $column friction_force_n)" 1e-8
done
for phases in turned usual; do
  [ $phases = turned ] && o=turned.csv || o=$table1
  "$bin/table1_observations" --observations $o --quiet --audit-output ${phases}_rows.csv --audit-summary-output ${phases}_audit.csv
  "$bin/model_validation" --observations $o --points 5 --error-points 2 --quiet --posterior-output ${phases}_stick_slip.csv
done
near "turned phases, audit" "$(cell turned_rows.csv phase_residual_truth 2)" "$(cell usual_rows.csv phase_residual_truth 2)" 1e-10
near "turned phases, posterior with stick-slip" "$(cell turned_stick_slip.csv mean_friction_force_n computed)" \
  "$(cell usual_stick_slip.csv mean_friction_force_n computed)" 1e-8
# A doubtful unit or sign: the result is that of degrees that lag, with one line that says so.
awk -F, -v OFS=, 'NR>1 {$5*=3.14159265/180} {print}' $table1 >radians.csv
awk -F, -v OFS=, 'NR>1 {$5=-$5} {print}' $table1 >leads.csv
for doubt in "radians as degrees, not as radians" "leads positive phase is taken as the lag"; do
  "$bin/least_squares_baseline" --observations ${doubt%% *}.csv --quiet --output fit.csv 2>said.txt
  check "${doubt%% *}: one line of warning" test "$(wc -l <said.txt) $(grep -c "^warning: ${doubt%% *}.csv: .*${doubt#* }" said.txt)" = "1 1"
done

# Fits that determine no noise: one row, equal rows, and a frequency without error.
head -2 $table1 >one_row.csv
awk 'NR==1 || NR==4 {print} NR==4 {print; print}' $table1 >equal_rows.csv
for rows in one_row equal_rows; do
  "$bin/least_squares_baseline" --observations $rows.csv --output fit.csv >report.txt
  check "$rows: undefined, with the reason" test "$(grep -c 'the fitted noise is undefined: ' report.txt)" = 2
  check "$rows: no likelihood" grep -q '^largest log-likelihood undefined$' report.txt
  check "$rows: no infinity and no error of 0" test "$(grep -cE 'inf|[+]- 0 ' report.txt)" = 0
  for parameter in friction_force_n natural_frequency_hz; do
    check "$rows: nan for $parameter" test "$(cell fit.csv standard_error_ml $parameter)" = nan
  done
  check "$rows: nan for the noise itself" test "$(cell fit.csv estimate phase_noise_deg)" = nan
  "$bin/exact_posterior" --observations $rows.csv --prior $prior --output exact_of_few.csv >report.txt
  check "$rows: the posterior is defined" test "$(cell exact_of_few.csv mean friction_force_n)" != nan
  check "$rows: Laplace is not" test "$(cell exact_of_few.csv laplace_sd friction_force_n) $(grep -c 'Laplace undefined' report.txt)" = "nan 1"
  "$bin/table1_observations" --observations $rows.csv --audit-summary-output audit.csv >report.txt
  check "$rows: no interval with the noise unknown" test "$(cell audit.csv noise_unknown_low friction_force_n "least squares")" = nan
  check "$rows: the audit says why" grep -q 'the unknown noise is undefined: ' report.txt
done

# The samplers against the exact answer: bias plus exact is the mean, and the rows are all there.
"$bin/sampling_study" --runs 4 --samples 300 --quiet --output samples.csv --runs-output runs.csv
"$bin/exact_posterior" --runs-input runs.csv --samples-input samples.csv --quiet --samplers-output samplers.csv \
  --histogram-output histograms.csv --marginals-output marginals.csv
check "9 rows a sampler" test "$(grep -c '^TMCMC,' samplers.csv) $(grep -c '^TMCMC-II,' samplers.csv)" = "9 9"
near "mean of the runs" "$(cell samplers.csv mean TMCMC mean_friction_force_n)" "$(awk -F, '
  NR==1 {for (i=1; i<=NF; i++) at[$i]=i; next} $1=="TMCMC" {s+=$at["mean_friction_force_n"]; n++}
  END {printf "%.10f", s/n}' runs.csv)" 1e-9
check "bias, spread and rmse agree" awk -F, 'NR==1 {for (i=1; i<=NF; i++) at[$i]=i; next} {
    b=$at["bias"]; d=b-($at["mean"]-$at["exact"]); s=$at["spread"]; n=$at["runs"]; r=b*b+s*s*(n-1)/n-$at["rmse"]^2
    if (d*d > 1e-16 || r*r > 1e-14*$at["rmse"]^4) bad=1 } END {exit bad || NR < 10}' samplers.csv
check "histograms hold the samples" awk -F, 'NR>1 {mass[$1 $2]+=($4-$3)*$5} END {for (k in mass) {n++
    if (mass[k] < 0.9 || mass[k] > 1+1e-6) bad=1}; exit bad || n != 8}' histograms.csv
check "densities integrate to 1" awk -F, 'NR>1 {if (p==$1) mass[$1]+=($2-x)*($3+y)/2; p=$1; x=$2; y=$3}
  END {for (k in mass) {n++; if (mass[k] < 0.9995 || mass[k] > 1.0001) bad=1}; exit bad || n != 4}' marginals.csv
expect_error 2 '--runs-input' "$bin/exact_posterior" --samplers-output s.csv
expect_error 2 '--samples-input' "$bin/exact_posterior" --histogram-output h.csv
expect_error 2 'mean_friction_force_n' "$bin/exact_posterior" --runs-input samples.csv --quiet --output out.csv
for program in exact_posterior pbox_floor model_validation table1_observations; do
  option=$("$bin/$program" --help | grep -oE -e '--[a-z]+(-[a-z]+)*-output' | tail -n 1)
  inputs=""
  [ $program = exact_posterior ] && inputs="--runs-input runs.csv --samples-input samples.csv"
  expect_error 2 'missing/x.csv' "$bin/$program" $inputs --quiet --output out.csv "$option" missing/x.csv
done

# Unseen data with another truth and nine rows; 500 rows from 50 seeds.
within_four_sd() {  # NAME FILE TRUTH
  check "$1: $3 within 4 sd of $(cell "$2" mean friction_force_n)" awk -v m="$(cell "$2" mean friction_force_n)" \
    -v s="$(cell "$2" sd friction_force_n)" -v t="$3" 'BEGIN {d=m-t; exit !(s > 0 && d*d <= 16*s*s)}'
}
for truth in 0.4 1.2; do
  "$bin/table1_observations" --friction-force $truth --natural-frequency 4 --phase-noise 1 --seed 5 --quiet --output rows.csv
  head -n 10 rows.csv >nine.csv
  for reading in as_published corrected; do
    "$bin/exact_posterior" --observations nine.csv --reading $reading --quiet --output nine_exact.csv
    within_four_sd "nine rows, $reading" nine_exact.csv $truth
    near "natural frequency" "$(cell nine_exact.csv mean natural_frequency_hz)" 4 0.08
  done
done
"$bin/table1_observations" --friction-force 0.9 --quiet --output many.csv
for seed in $(seq 2 50); do
  "$bin/table1_observations" --friction-force 0.9 --seed $seed --quiet --output - | tail -n +2 >>many.csv
done
"$bin/exact_posterior" --observations many.csv --quiet --output many_exact.csv
check "500 rows" test "$(wc -l <many.csv)" = 501
within_four_sd "500 rows" many_exact.csv 0.9
near "Laplace's sd is exact for many rows" "$(cell many_exact.csv laplace_sd friction_force_n)" \
  "$(cell many_exact.csv sd friction_force_n)" "$(awk -v s="$(cell many_exact.csv sd friction_force_n)" 'BEGIN {print 0.01*s}')"
near "the noise of the rows" "$(cell many_exact.csv mean phase_noise_deg)" 2 0.3
"$bin/pbox_floor" --observations many.csv --runs 5 --samples 50 --studies 2 --quiet --output many_floor.csv
check "floor of 500 rows" test "$(wc -l <many_floor.csv)" = 3

# No friction force of the prior has continuous motion.
sed 's/^friction_force,0.01,/friction_force,8,/' $prior >infeasible.csv
for program in exact_posterior pbox_floor model_validation; do
  expect_error 2 "infeasible.csv:2: column 'lower': value '8': expected less than 1.5" "$bin/$program" --prior infeasible.csv --quiet --output out.csv
done

# The floor: areas of independent draws, whatever the number of threads.
for threads in 1 2; do
  "$bin/pbox_floor" --studies 6 --threads $threads --quiet --output floor$threads.csv --pbox-output pbox$threads.csv
done
check "areas with 1 and 2 threads" cmp -s floor1.csv floor2.csv
check "p-boxes with 1 and 2 threads" cmp -s pbox1.csv pbox2.csv
near "area of F_mu" "$(awk -F, 'NR>1 {s+=$2; n++} END {print s/n}' floor1.csv)" 0.0075 5e-4
near "area of omega_n" "$(awk -F, 'NR>1 {s+=$3; n++} END {print s/n}' floor1.csv)" 0.0028 2e-4
check "lower <= upper" awk -F, 'NR>1 && !($4 <= $5) {bad=1} END {exit bad}' pbox1.csv

# Closed form and integration in time.
"$bin/model_validation" --quiet --output grid.csv --errors-output errors.csv --posterior-output posterior.csv
check "integrated = closed form" awk -F, 'NR>1 && tolower($5)!="nan" && $2 < 0.999*$3 {d=$5-$7; n++
  if (d*d > 1e-12) bad=1} END {exit bad || n < 1300}' grid.csv
check "no stop below the limit, stops beyond it" awk -F, 'NR>1 && $2 < 0.999*$3 && $8 != 0 {bad=1}
  NR>1 && $2 > 1.001*$3 && $2 < 1 && !($8 >= 2) {bad=1} END {exit bad}' grid.csv
check "at rest from a force ratio of 1" awk -F, 'NR>1 && $2 == 1 && tolower($7) != "nan" {bad=1} END {exit bad}' grid.csv
near "smallest limit" "$(awk -F, 'NR==2 {m=$3} NR>1 && $3<m {m=$3} END {printf "%.10f", 2.5*m}' grid.csv)" 1.501094 5e-7
near "the same on the grid" "$(awk -F, 'NR==2 {m=$4} NR>1 && $4<m {m=$4} END {printf "%.10f", 2.5*m}' grid.csv)" 1.543632 5e-7
near "phase error at r = 0.645" "$(cell errors.csv phase_error_deg 0.645)" -0.036 5e-4
near "stick-slip changes no mean" "$(cell posterior.csv mean_friction_force_n computed)" \
  "$(cell posterior.csv mean_friction_force_n excluded)" 1e-9
# A friction force near the limit, with much noise: there stick-slip has weight.
"$bin/table1_observations" --friction-force 1.45 --phase-noise 4 --seed 3 --reading corrected --quiet --output near.csv
"$bin/model_validation" --observations near.csv --points 3 --quiet --posterior-output near_posterior.csv
check "stick-slip has weight near the limit" awk -v p="$(cell near_posterior.csv stick_slip_probability computed)" \
  'BEGIN {exit !(p > 0.05 && p < 1)}'

# Audit of Table 1.
"$bin/table1_observations" --reading corrected --quiet --audit-output audit.csv --audit-summary-output audit_summary.csv
near "chi^2 of the stated truth" "$(cell audit_summary.csv chi_squared friction_force_n 'stated truth')" 46.2 0.1
near "chi^2 of 1.0 N" "$(cell audit_summary.csv chi_squared friction_force_n alternative)" 16.2 0.1
near "p of 1.0 N" "$(cell audit_summary.csv chi_squared_p friction_force_n alternative)" 0.09 0.005
check "p of the stated truth" awk -v p="$(cell audit_summary.csv chi_squared_p friction_force_n 'stated truth')" \
  'BEGIN {exit !(p > 1e-6 && p < 2e-6)}'
for rows in 1 2 3; do
  head -n $((rows + 1)) data/published/table1_observations.csv >few.csv
  "$bin/table1_observations" --observations few.csv --quiet --audit-output few_audit.csv --audit-summary-output few_summary.csv
  check "audit of $rows rows" test "$(wc -l <few_audit.csv) $(wc -l <few_summary.csv)" = "$((rows + 1)) 11"
  check "noise unknown needs two rows" test "$(cell few_summary.csv f_p friction_force_n 'stated truth' | grep -c nan)" = \
    $((rows == 1))
done
near "exact physics, whatever the reading" "$("$bin/table1_observations" --quiet --audit-summary-output - |
  awk -F, '$1 == "friction_force_n" && $2 == "stated truth" && $NF == "exact" {print $6}')" 46.195 0.001
expect_error 2 '--audit-summary-output' "$bin/table1_observations" --phase-noise 0 --audit-summary-output s.csv
finish
