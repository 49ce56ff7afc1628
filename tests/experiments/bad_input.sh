#!/usr/bin/env bash
# Bad values in inputs and options: one clear line on stderr, status 2, nothing overwritten. What every executable has in
# common is in errors.sh.
source "$(dirname "$0")/support.sh"

# within SECONDS COMMAND...: ends a command that takes more processor time, which other programs do not lengthen.
within() { (ulimit -t "$1"; shift; exec "$@"); }

head='index,r_nominal,r_measured,driving_frequency_hz,phase_deg'
good='1,0.643,0.644,1.987,27.466'
observations() { printf '%s\n' "$@" >observations.csv; }
echo untouched >out.csv
study="$bin/sampling_study --runs 2 --samples 50 --output out.csv --observations observations.csv"
least_squares="$bin/least_squares_baseline --output out.csv --observations observations.csv"

for program in "$study" "$least_squares"; do
  observations "${head/,phase_deg/}" '1,0.643,0.644,1.987'
  expect_error 2 "phase_deg" $program
  observations "$head,r_measured" "$good,0.644"
  expect_error 2 "r_measured" $program
  observations "$head" "$good" '2,0.786,abc,2.447,29.968'
  expect_error 2 "observations.csv:3: column 'r_measured': value 'abc'" $program
  observations "$head" "$good" '2,0.786,0.793,2.447,NaN'
  expect_error 2 "observations.csv:3: column 'phase_deg': value 'NaN'" $program
  observations "$head" "$good" '2,0.786,0.793,,29.968'
  expect_error 2 "observations.csv:3: column 'driving_frequency_hz'" $program
  observations "$head" '1,0.643,0.644,-1.987,27.466'
  expect_error 2 "observations.csv:2: column 'driving_frequency_hz': value '-1.987'" $program
  observations "$head" '1,0.643,0.644,0,27.466'
  expect_error 2 "value '0'" $program
  for singular in 1 1.0 0.3333333333333333 0.2 0.14285714285714285; do
    observations "$head" "$good" "2,1,$singular,3.086,90"
    expect_error 2 "observations.csv:3: column 'r_measured': value '$singular'" $program
  done
  for value in 0 -0.643 1e-4 1e6 1e300 5e-324; do
    observations "$head" "1,$value,0.644,1.987,27.466"
    expect_error 2 "observations.csv:2: column 'r_nominal': value '$value': expected a ratio between" $program
  done
  for value in 1e-6 1e9 1e300 5e-324; do
    observations "$head" "$good" "2,0.786,0.793,$value,29.968"
    expect_error 2 "observations.csv:3: column 'driving_frequency_hz': value '$value': expected a frequency between" $program
  done
  observations "$head" "$good,7"
  expect_error 2 'observations.csv:2' $program
done
observations "$head" "$good"

prior() { printf '%s\n' 'parameter,lower,upper,unit' "$@" >prior.csv; }
full=('friction_force,0.01,10,N' 'natural_frequency,0.01,10,Hz' 'phase_noise,0.001,10,deg' 'frequency_ratio_noise,0.001,1,1')
study="$study --prior prior.csv"
prior 'friction_force,10,0.01,N' "${full[@]:1}"
expect_error 2 "prior.csv:2: column 'upper': value '0.01'" $study
prior 'friction_force,1,1,N' "${full[@]:1}"
expect_error 2 "prior.csv:2: column 'upper': value '1'" $study
for value in 1e101 1e300 1e308 1e-101; do
  prior "${full[0]}" "natural_frequency,0,$value,Hz" "${full[@]:2}"
  expect_error 2 "prior.csv:3: column 'upper': value '$value': expected a number from 1e-100 to 1e100" within 60 $study
done
prior 'friction_force,1,1.0000000000000002,N' "${full[@]:1}"
expect_error 2 "prior.csv:2: column 'upper': value '1.0000000000000002': expected a number above the lower bound 1, with others" $study
prior "${full[@]:0:3}"
expect_error 2 'frequency_ratio_noise' $study
prior "${full[@]}" 'friction_force,0.1,1,N'
expect_error 2 'prior.csv:6' $study
prior "${full[@]:1}" 'fricton_force,0.1,1,N'
expect_error 2 "prior.csv:5: column 'parameter': value 'fricton_force'" $study
prior 'friction_force,x,1,N' "${full[@]:1}"
expect_error 2 "prior.csv:2: column 'lower': value 'x'" $study
prior 'friction_force,8,10,N' "${full[@]:1}"
for reading in as_published as_worded corrected; do
  expect_error 2 'feasible' $study --reading $reading
done
# What reads the prior a second time, as a density.
for force in 8,10 2.4,1000; do
  prior "friction_force,$force,N" "${full[@]:1}"
  expect_error 2 'friction forces up to 1.5' within 60 "$bin/calibration" --runs 20 --prior prior.csv --output out.csv
done
prior 'friction_force,0,1e100,N' "${full[@]:1}"
expect_error 2 'none of 1000000 draws' within 60 "$bin/calibration" --runs 20 --prior prior.csv --output out.csv
for program in exact_posterior pbox_floor cost_accuracy model_validation; do
  program="$bin/$program --prior prior.csv --output out.csv"
  prior "${full[0]}" 'natural_frequency,0,10,Hz' "${full[@]:2}"
  expect_error 2 "prior.csv:3: column 'lower': value '0': expected a positive number" $program
  prior "${full[@]:1}" 'friction_force,8,10,N'
  expect_error 2 "prior.csv:5: column 'lower': value '8': expected less than 1.5" $program
done
prior "${full[@]:0:2}" 'phase_noise,0,10,deg' "${full[3]}"
expect_error 2 ": phase_noise.lower = 0: expected a positive number" "$bin/exact_posterior" --prior <(cat prior.csv) --output out.csv
prior "${full[@]}"

study="$bin/sampling_study --output out.csv"
expect_error 2 "--runs: value '0'" $study --runs 0
expect_error 2 "--samples: value '0'" $study --samples 0
expect_error 2 "--samples: value '1'" $study --samples 1
expect_error 2 "--samples: value '-5'" $study --samples=-5
expect_error 2 "--samples: value 'many'" $study --samples many
expect_error 2 "--samples: value '1e400'" $study --samples 1e400
expect_error 2 "--driving-force: value '0'" $study --driving-force 0
expect_error 2 "--driving-force: value 'nan'" $study --driving-force nan
expect_error 2 "--ess-fraction: value '1.5'" $study --ess-fraction 1.5
expect_error 2 "--boundary: value 'bounce'" $study --boundary bounce
expect_error 2 'not expected: wo\trd\x1B[31m (see --help)' $study $'wo\trd\e[31m'

check "the output stayed" grep -q untouched out.csv

printf 'friction_force_n,frequency_ratio\n0.5,1\n' >points.csv
expect_error 2 "points.csv:2: column 'frequency_ratio': value '1'" "$bin/evaluate_model" --points points.csv
printf 'friction_force_n,frequency_ratio\n-0.5,0.8\n' >points.csv
expect_error 2 "points.csv:2: column 'friction_force_n': value '-0.5'" "$bin/evaluate_model" --points points.csv
for value in 0 -1 1e-100 5e-324 1e100 1e300; do
  printf 'friction_force_n,natural_frequency_hz,phase_noise_deg,frequency_ratio_noise\n1,3,2,0.02\n1,3,%s,0.02\n' $value >points.csv
  expect_error 2 "points.csv:3: column 'phase_noise_deg': value '$value'" "$bin/evaluate_model" --points points.csv
  printf 'friction_force_n,natural_frequency_hz,phase_noise_deg,frequency_ratio_noise\n1,3,2,%s\n' $value >points.csv
  expect_error 2 "points.csv:2: column 'frequency_ratio_noise': value '$value'" "$bin/evaluate_model" --points points.csv
done
printf 'friction_force_n\n0.5\n' >points.csv
expect_error 2 "frequency_ratio" "$bin/evaluate_model" --points points.csv
expect_error 2 "continuous" "$bin/table1_observations" --friction-force 2.4 --output out.csv
printf 'sampler,run,x\na,1,\n' >samples.csv
expect_error 2 "samples.csv:2: column 'x'" "$bin/table3_pbox_area" --input samples.csv --output out.csv
printf 'run,x\n1,2\n' >samples.csv
expect_error 2 "sampler" "$bin/table3_pbox_area" --input samples.csv --output out.csv

# edit FILE LINE COLUMN VALUE: the copy edited.csv of a CSV file without quoted commas, with another value in one cell
edit() { awk -F, -v OFS=, -v line="$2" -v value="$4" -v name="$3" '
  NR == 1 { for (i = 1; i <= NF; ++i) if ($i == name) column = i } NR == line { $column = value } 1' "$1" >edited.csv; }
# refuse OPTION COMMAND...: a row a bad cell on standard input: file, line, column, value, what is expected
refuse() {
  local option=$1 file line column value expected; shift
  while IFS='|' read -r file line column value expected; do
    edit "$file" "$line" "$column" "$value"
    expect_error 2 "edited.csv:$line: column '$column': value '$value': expected $expected" within 60 "$@" "$option" edited.csv
  done
}
head -7 "$source/data/generated/replicated_study.csv" >studies.csv
head -4 "$source/data/generated/sampling_study_stages.csv" >stages.csv
head -4 "$source/data/generated/sampling_study_runs.csv" >runs.csv
mkdir data/generated
cp "$source"/data/generated/{table1_observations,table3_pbox_area,table4_iteration_counts,sampling_study_runs,pbox_floor}.csv data/generated
table3=data/published/table3_pbox_area.csv
table4=data/published/table4_iteration_counts.csv

for program in verdicts fig9_null_distributions; do
  refuse --replicated "$bin/$program" --output out.csv <<'ROWS'
studies.csv|2|study|-1|a whole number from 0 to 2^32 - 1
studies.csv|2|study|4294967296|a whole number from 0 to 2^32 - 1
studies.csv|3|sampler|TMCMC|each sampler once a study
studies.csv|4|study|7|a row of each sampler (TMCMC, TMCMC-II), not 1 of 2
studies.csv|5|area_friction_force_n|-0.1|a positive number
studies.csv|5|area_natural_frequency_hz|0|a positive number
studies.csv|5|standard_error_phase_noise_deg|-0.1|a number of at least 0
studies.csv|5|log_evidence_sd|-0.1|a number of at least 0
studies.csv|5|iterations|10:9000000000000000000|pairs such as 10:45
studies.csv|5|iterations|10:1000001|pairs such as 10:45
studies.csv|5|iterations|10:0|pairs such as 10:45
studies.csv|5|iterations|0:50|pairs such as 10:45
ROWS
done
sed 's/TMCMC-II/another/' studies.csv >edited.csv
expect_error 2 "edited.csv: column 'sampler': no row 'TMCMC-II'" "$bin/verdicts" --replicated edited.csv --output out.csv
head -5 studies.csv >edited.csv
expect_error 2 "edited.csv: column 'sampler': 2 rows 'TMCMC': expected at least 3 studies" "$bin/verdicts" --replicated edited.csv --output out.csv
sed -E '2,$s/,[0-9]+,/,0,/' $table4 >edited.csv
expect_error 2 "edited.csv:2: column 'TMCMC': value '0': expected at least one run in the column" "$bin/verdicts" --replicated studies.csv --table4 edited.csv --output out.csv
sed 's/,0\.1714/, +0.1714 /' $table3 >edited.csv
"$bin/fig9_null_distributions" --replicated studies.csv --tables 100 --quiet --printed-output plain.csv
"$bin/fig9_null_distributions" --replicated studies.csv --tables 100 --quiet --printed-output again.csv --table3 edited.csv
check "a plus sign and spaces change nothing: $(diff $table3 edited.csv | wc -l) lines" cmp -s plain.csv again.csv
check "they were there" test "$(grep -c '+0.1714 ' edited.csv)" = 1
rm plain.csv again.csv
# Files that are read without an option of their own.
expect_error 2 "--output: value 'data/published/table2_prior.csv': expected another file than that of --prior" \
  "$bin/sampling_study" --runs 1 --samples 50 --quiet --output data/published/table2_prior.csv
expect_error 2 "--output: value 'data/published/table3_pbox_area.csv': expected another file than that of --published" \
  "$bin/compare_published" --output data/published/table3_pbox_area.csv

for program in verdicts fig9_null_distributions readings; do
  case $program in readings) more='--studies 3 --runs 2' ;; *) more='--replicated studies.csv' ;; esac
  refuse --table3 "$bin/$program" --output out.csv $more <<ROWS
$table3|3|sampler|TMCMC|each sampler once
$table3|3|sampler|another|the name of a column of data/published/table4
$table3|3|sampler|iterations|the name of a column of data/published/table4
$table3|3|friction_force_n|0|a number from 1e-100 to 1e100
$table3|3|friction_force_n|1e-320|a number from 1e-100 to 1e100
ROWS
  refuse --table4 "$bin/$program" --output out.csv $more <<ROWS
$table4|3|iterations|9|each number of iterations once
$table4|2|iterations|0|a whole number of at least 1
$table4|2|TMCMC|-1|a number of runs from 0 to 10000
$table4|2|TMCMC|1000000000|a number of runs from 0 to 10000
ROWS
  head -2 $table3 >edited.csv
  expect_error 2 "edited.csv: column 'sampler': no row 'TMCMC-II'" "$bin/$program" --table3 edited.csv --output out.csv $more
done

sed 3d data/published/claims.csv >edited.csv
expect_error 2 "edited.csv: column 'id': no row 'C2': expected one row for each of C1 to C15" \
  "$bin/verdicts" --replicated studies.csv --claims edited.csv --output out.csv
refuse --claims "$bin/verdicts" --replicated studies.csv --output out.csv <<'ROWS'
data/published/claims.csv|3|id|C1|each claim once
data/published/claims.csv|3|id|C16|one of C1 to C15
ROWS

refuse --runs-input "$bin/verdicts" --replicated studies.csv --output out.csv <<'ROWS'
data/generated/sampling_study_runs.csv|2|iterations|0|a whole number of at least 1
data/generated/sampling_study_runs.csv|3|run|0|each run once a sampler
ROWS
refuse --floor "$bin/verdicts" --replicated studies.csv --output out.csv <<'ROWS'
data/generated/pbox_floor.csv|2|friction_force_n|0|a positive number
ROWS
refuse --prior "$bin/verdicts" --replicated studies.csv --output out.csv <<'ROWS'
data/published/table2_prior.csv|3|lower|0|a positive number
data/published/table2_prior.csv|2|lower|8|less than 1.5
ROWS

refuse --input "$bin/table4_iteration_counts" --output out.csv <<'ROWS'
runs.csv|2|iterations|0|a whole number of at least 1
runs.csv|3|run|0|each run once a sampler
ROWS
refuse --input "$bin/fig5_tempering" --output out.csv <<'ROWS'
stages.csv|2|stage|0|a whole number of at least 1
stages.csv|3|stage|1|each stage once a run
stages.csv|3|beta|1.5|a number from 0 to 1
stages.csv|3|beta|-0.1|a number from 0 to 1
ROWS
refuse --runs-input "$bin/exact_posterior" --output out.csv <<'ROWS'
runs.csv|3|run|0|each run once a sampler
runs.csv|3|sd_phase_noise_deg|-0.1|a number of at least 0
ROWS
for option in --areas --printed-areas; do
  refuse $option "$bin/fig4_areas_and_iterations" --output out.csv <<ROWS
$table3|3|sampler|TMCMC|each sampler once
$table3|3|natural_frequency_hz|-0.1|a number of at least 0
ROWS
done
for option in --counts --printed-counts; do
  refuse $option "$bin/fig4_areas_and_iterations" --output out.csv <<ROWS
$table4|3|iterations|9|each number of iterations once
$table4|3|iterations|0|a whole number of at least 1
$table4|3|TMCMC-II|-1|a number of at least 0
ROWS
done
refuse --table4 "$bin/compare_published" --output out.csv <<ROWS
$table4|3|iterations|9|each value once
$table4|3|iterations|ten|an integer
ROWS

check "the output stayed, to the end" grep -q untouched out.csv

# Tables of many names are read in time that grows with their size.
{ seq -s, 1 100000; seq -s, 1 100000; } >wide.csv
expect_error 2 "expected a column 'sampler'" within 5 "$bin/table4_iteration_counts" --input wide.csv --output out.csv
awk 'BEGIN { print "sampler,run,x"; for (i = 0; i < 300000; ++i) print "s" i ",0,1" }' >many.csv
check "300000 samplers are read in time" within 20 "$bin/table3_pbox_area" --quiet --input many.csv --output many_areas.csv
finish
