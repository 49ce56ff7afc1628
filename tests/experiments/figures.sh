#!/usr/bin/env bash
# own_model: figures of the samples and their tables, and separate modes in the report.
source "$(dirname "$0")/support.sh"

own="$bin/own_model --evaluations 8000"
$own --runs 2 --output samples.csv --figures drawn/here >report.txt 2>err
check "ends with 0: $(cat err)" test $? = 0
for figure in samples_corner samples_marginals samples_stages; do
  for format in pdf png; do check "$figure.$format" test -s drawn/here/$figure.$format; done
done
check "a row a parameter" test "$(wc -l <drawn/here/corner_summary.csv)" = 4
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
check "without gnuplot: tables and a warning" test $? = 0 -a -s bare/corner.csv -a "$(grep -c '^warning: .*gnuplot' err)" = 1
finish
