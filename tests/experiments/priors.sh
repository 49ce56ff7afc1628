#!/usr/bin/env bash
# Priors from files: distributions, correlations, units, and every row that is refused.
source "$(dirname "$0")/support.sh"
cp -r "$source/data/examples" data/examples
own="$bin/own_model --evaluations 2600 --quiet"
good=data/examples/frame_prior_correlated.csv
matrix=data/examples/frame_correlations.csv

check "distributions and correlations" $own --prior $good --prior-correlation $matrix --output samples.csv --netcdf samples.nc
check "a row per sample" test "$(wc -l <samples.csv)" -gt 1000
check "the true stiffnesses are within 4 standard deviations" awk -F, '
  NR > 1 { n++; for (j = 1; j <= 2; j++) { s[j] += $j; q[j] += $j * $j } }
  END { for (j = 1; j <= 2; j++) { mean = s[j] / n; sd = sqrt(q[j] / n - mean * mean); z = (mean - (j == 1 ? 0.9 : 1.2)) / sd; if (z * z > 16) exit 1 } }' samples.csv
if command -v ncdump >/dev/null; then
  check "units in the NetCDF file" grep -qF 'stiffness_1:units = "1"' <<<"$(ncdump -h samples.nc)"
fi
check "uniform rows are what lower and upper alone are" bash -c "
  sed 's/\(.*\),\(.*\),\(.*\)/\1,uniform,\2,\3/; 1s/uniform/distribution/' data/examples/frame_prior.csv >named.csv
  $own --prior named.csv --output named_samples.csv && $own --output plain_samples.csv && cmp -s named_samples.csv plain_samples.csv"

# refuse SED TEXT: the good prior with one edit, and what is said of it
refuse() { sed "$1" $good >bad.csv; expect_error 2 "bad.csv:$2" $own --prior bad.csv --output failed.csv; }
refuse 's/0.9,0.3/0.9,-0.3/' "2: column 'sd': value '-0.3': expected a positive number"
refuse 's/0.9,0.3/0.9,x/' "2: column 'sd': value 'x': expected a finite number"
refuse 's/0.9,0.3/0.9,/' "2: column 'distribution': value 'log_normal': expected the arguments mu, sigma; or mean, sd; or median, cov, not mean"
refuse 's/0.9,0.3,/0.9,0.3,1/' "2: column 'lower': value '1': expected an empty cell, since log_normal is stated by"
refuse 's/log_normal/lognormal/' "2: column 'distribution': value 'lognormal': expected uniform, log_uniform, normal, "
refuse 's/log_normal/normal/' "2: column 'distribution': value 'normal': expected a distribution of positive numbers"
refuse 's/0.001,0.1/0.1,0.001/' "4: column 'upper': value '0.001': expected"
refuse 's/0.001,0.1/0,0.1/' "4: column 'lower': value '0': expected a positive number: from 0 on the density 1/x has no finite integral"
refuse 's/relative_noise/noise/' "4: column 'parameter': value 'noise'"

# the same of the matrix
refuse_matrix() { sed "$1" $matrix >bad.csv; expect_error 2 "bad.csv:$2" $own --prior $good --prior-correlation bad.csv --output failed.csv; }
refuse_matrix '2s/0.5/1.5/' "2: column 'stiffness_2': value '1.5': expected a number between -1 and 1"
refuse_matrix '2s/0.5/0.4/' "3: column 'stiffness_1': value '0.5': expected 0.4, as in line 2"
refuse_matrix '2s/,1,/,2,/' "2: column 'stiffness_1': value '2': expected 1, the correlation of a parameter with itself"
refuse_matrix '4d' " column 'normal_score': no row and column 'relative_noise'"
refuse_matrix '1s/normal_score/name/' "1: header 'name,"
refuse_matrix '2s/0$/0.9/; 3s/0$/-0.9/; 4s/0,0/0.9,-0.9/' " correlation: expected a positive definite matrix"

printf 'parameter,stiffness_1,stiffness_2,relative_noise\nstiffness_1,1,0,-0.95\nstiffness_2,0,1,0\nrelative_noise,-0.95,0,1\n' >bad.csv
expect_error 2 "bad.csv:4: column 'stiffness_1': value '-0.95': expected a number from -0." \
  $own --prior $good --prior-correlation bad.csv --output failed.csv

# The friction experiments: what cannot be integrated or approximated under such a prior says so.
printf '%s\n' parameter,distribution,lower,upper,mean,sd friction_force,,0.01,10,, natural_frequency,log_normal,,,3,1 \
  phase_noise,half_normal,,,,5 frequency_ratio_noise,log_uniform,0.001,1,, >friction.csv
check "the sampler takes it" "$bin/sampling_study" --runs 2 --samples 200 --quiet --prior friction.csv --output study.csv
check "so does the quadrature" bash -c "'$bin/exact_posterior' --prior friction.csv | grep -q 'The Laplace approximation is that of uniform priors'"
expect_error 2 "--prior: the posterior with stick-slip needs uniform priors, not friction_force uniform(0.01, 10), natural_frequency log_normal(" \
  "$bin/model_validation" --quiet --prior friction.csv --posterior-output failed.csv
printf '%s\n' parameter,friction_force,natural_frequency,phase_noise,frequency_ratio_noise friction_force,1,0.3,0,0 \
  natural_frequency,0.3,1,0,0 phase_noise,0,0,1,0 frequency_ratio_noise,0,0,0,1 >correlations.csv
expect_error 2 "--prior: the exact posterior needs independent parameters" \
  "$bin/exact_posterior" --quiet --prior friction.csv --prior-correlation correlations.csv --output failed.csv
finish
