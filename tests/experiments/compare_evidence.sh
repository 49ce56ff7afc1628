#!/usr/bin/env bash
# Models compared by the files of their runs, as docs/comparison.md has it.
source "$(dirname "$0")/support.sh"

cp -r "$source/data/examples" data/examples
cell() { awk -F, -v m="$2" -v c="$3" 'NR==1 {for (i=1;i<=NF;i++) n[$i]=i; next} $1==m {print $n[c]}' "$1"; }
own="$bin/own_model --quiet --evaluations 4000"
$own --output two.csv --netcdf two.nc
$own --prior-correlation data/examples/frame_common_stiffness.csv --output common.csv --netcdf common.nc
"$bin/compare_evidence" two.nc common.nc --output table.csv >report.txt
check "a row per model" test "$(wc -l <table.csv)" = 3
check "two stiffnesses explain the frame better by far" awk -v b="$(cell table.csv common.nc log_bayes_factor)" 'BEGIN {exit !(b < -8 && b > -20)}'
check "probabilities add up to 1" awk -v a="$(cell table.csv two.nc probability)" -v b="$(cell table.csv common.nc probability)" \
  'BEGIN {exit !((a+b-1)^2 < 1e-16)}'
check "the report" grep -q 'two.nc .* +- ' report.txt
"$bin/compare_evidence" two.nc common.nc --prior 1,1e6 --quiet --output weighted.csv
check "prior probabilities count" awk -v a="$(cell table.csv common.nc probability)" -v b="$(cell weighted.csv common.nc probability)" \
  'BEGIN {r = b / (1 - b) / (a / (1 - a)) / 1e6; exit !((r-1)^2 < 1e-6)}'

for noise in unknown known; do
  options=""
  [ $noise = known ] && options="--prior $source/data/examples/friction_known_noise.csv"
  "$bin/own_model" "$source/examples/friction_rig.toml" --quiet --finish independent --evaluations 8000 $options --output $noise.csv --netcdf $noise.nc
done
"$bin/compare_evidence" unknown.nc known.nc --quiet --output noise.csv
check "the stated noise is the likelier one" awk -v b="$(cell noise.csv unknown.nc log_bayes_factor)" 'BEGIN {exit !(b < -4.5 && b > -5.7)}'

sed '2s/[0-9]$/9/' data/examples/frame_observations.csv >other.csv
$own --observations other.csv --output o.csv --netcdf other.nc
expect_error 2 "other.nc: attribute 'data_checksum': value" "$bin/compare_evidence" two.nc other.nc
check "at the user's word" "$bin/compare_evidence" two.nc other.nc --same-data --quiet
expect_error 2 "none.nc" "$bin/compare_evidence" two.nc none.nc
expect_error 2 "two.csv: " "$bin/compare_evidence" two.nc two.csv
expect_error 2 "At least 2 required" "$bin/compare_evidence" two.nc
expect_error 2 "--prior: 3 values: expected 2" "$bin/compare_evidence" two.nc common.nc --prior 1,2,3
expect_error 2 "expected positive numbers" "$bin/compare_evidence" two.nc common.nc --prior 1,0
finish
