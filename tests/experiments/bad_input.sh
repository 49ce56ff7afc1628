#!/usr/bin/env bash
# Bad values in inputs and options: one clear line on stderr, status 2, nothing overwritten. What every executable has in
# common is in errors.sh.
source "$(dirname "$0")/support.sh"

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
printf 'friction_force_n\n0.5\n' >points.csv
expect_error 2 "frequency_ratio" "$bin/evaluate_model" --points points.csv
expect_error 2 "continuous" "$bin/table1_observations" --friction-force 2.4 --output out.csv
printf 'sampler,run,x\na,1,\n' >samples.csv
expect_error 2 "samples.csv:2: column 'x'" "$bin/table3_pbox_area" --input samples.csv --output out.csv
printf 'run,x\n1,2\n' >samples.csv
expect_error 2 "sampler" "$bin/table3_pbox_area" --input samples.csv --output out.csv
finish
