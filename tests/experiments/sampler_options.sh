#!/usr/bin/env bash
# The options of the sampler beyond the paper: each has its effect, and none without being given.
source "$(dirname "$0")/support.sh"

study="$bin/sampling_study --runs 2 --quiet --threads 1"
small="$study --samples 200 --reading corrected"
$small --output reference.csv --runs-output reference_runs.csv

# same WHAT OPTIONS...: the bytes of the reference; other WHAT OPTIONS...: other samples, as many rows or more.
same() { $small "$@" --output same.csv && check "$* changes nothing" cmp -s same.csv reference.csv; }
other() {
  $small "$@" --output other.csv
  check "$* ends with 0" test $? = 0
  check "$* changes the samples" test "$(cmp -s other.csv reference.csv; echo $?)" = 1
  check "$* gives 2 x 2 x 200 rows or more" test "$(wc -l <other.csv)" -ge 801
}
same --sampler published
same --resampling multinomial --scale-rule fixed --coordinates natural --random-subsets no --cross-fit no
same --independent-fraction 0 --mixing-correlation 0 --move resample-move
same --diagnose
for scheme in residual stratified systematic; do other --resampling $scheme; done
for rule in dimension target-acceptance acceptance-linked; do other --scale-rule $rule; done
other --move waste-free --chains 20
other --coordinates unbounded
other --random-subsets yes
other --independent-fraction 0.5
other --cross-fit yes
other --mixing-correlation 0.5 --max-move-steps 20
other --evaluation-budget 9000
$small --scale-rule target-acceptance --output a.csv
$small --scale-rule target-acceptance --target-acceptance 0.6 --output b.csv
check "--target-acceptance has an effect" test "$(cmp -s a.csv b.csv; echo $?)" = 1

# The recommended sampler is what the library recommends, and its parts can be changed.
recommended="$study --sampler recommended --evaluation-budget 13000"
$recommended --output recommended.csv --runs-output runs.csv
check "no run of it needs more than its budget" awk -F, 'NR > 1 && $5 > 13000 {bad=1} END {exit bad || NR < 5}' runs.csv
$recommended --output parts.csv --finish none
check "and without independent draws" test "$(cmp -s recommended.csv parts.csv; echo $?)" = 1
$recommended --output parts.csv --samples 1000 --chains 10 --move waste-free --resampling systematic \
  --scale-rule dimension --coordinates unbounded --random-subsets yes --independent-fraction 0.5 --boundary reject
check "the recommended sampler part by part" cmp -s recommended.csv parts.csv
$recommended --output none.csv --finish none
$recommended --output parts.csv --finish none --random-subsets no
check "without one of the parts of its moves" test "$(cmp -s none.csv parts.csv; echo $?)" = 1
$study --sampler recommended --output default.csv --runs-output runs.csv
check "31000 evaluations unless told" awk -F, 'NR > 1 && ($5 > 31000 || $5 < 30900) {bad=1} END {exit bad || NR < 5}' runs.csv

# --diagnose: in the report, and in columns after those that are always there.
$small --diagnose --runs-output diagnosed.csv
check "the columns before are the same" cmp -s reference_runs.csv <(cut -d, -f1-13 diagnosed.csv)
check "and further ones" grep -q 'bridge_log_evidence,log_evidence_standard_error,effective_sample_size_friction_force_n' diagnosed.csv
check "numbers in them" awk -F, 'NR > 1 && !($15 > 0 && $15 < 5 && $16 > 1 && $20 >= 0) {bad=1} END {exit bad || NF != 20}' diagnosed.csv
"$bin/sampling_study" --runs 2 --samples 200 --diagnose >report.txt
for text in 'bridge log-evidence' 'standard error of a run' 'smallest effective sample size' 'low effective sample size: '; do
  check "the report says $text" grep -q "$text" report.txt
done
check "not without --diagnose" test "$("$bin/sampling_study" --runs 2 --samples 200 | grep -c bridge)" = 0

# What does not go together, or would have no effect.
refuse() { local text=$1; shift; expect_error 2 "$text" $small "$@"; }
refuse "--resampling: value 'best'" --resampling best
refuse "--move: value 'waste'" --move waste
refuse "--chains: value '0'" --chains 0
refuse "--chains: value '5': expected only with --move waste-free" --chains 5
refuse "--chains: value '7': expected a divisor" --move waste-free --chains 7
refuse "--scale-rule: value 'auto'" --scale-rule auto
refuse "--scale-rule: value 'target-acceptance': expected another rule" --scale-rule target-acceptance --move growing-chains
refuse "--target-acceptance: value '1'" --target-acceptance 1
refuse "--target-acceptance: value '0.5': expected only with" --target-acceptance 0.5
refuse "--proposal-scale: value '0.5': expected only with" --proposal-scale 0.5 --scale-rule dimension
refuse "--coordinates: value 'log'" --coordinates log
refuse "--coordinates: value 'unbounded': expected only with --boundary reject" --boundary redraw --coordinates unbounded
refuse "--random-subsets: value 'yes': expected only with --boundary reject" --boundary redraw --random-subsets yes
refuse "--random-subsets: value 'maybe'" --random-subsets maybe
refuse "--cross-fit: value 'yes': expected no with growing chains" --cross-fit yes --move growing-chains
refuse "--independent-fraction: value '1.5'" --independent-fraction 1.5
refuse "--mixing-correlation: value '1'" --mixing-correlation 1
refuse "--mixing-correlation: value '0.5': expected only with --move resample-move" --mixing-correlation 0.5 --move growing-chains
refuse "--max-move-steps: value '9': expected only with" --max-move-steps 9
refuse "--max-move-steps: value '2': expected at least the least number of steps, 3" --mixing-correlation 0.5 --max-move-steps 2
refuse "--evaluation-budget: value '-1'" --evaluation-budget=-1
refuse "--move-steps: value '2': expected only with --move resample-move" --move waste-free --chains 20 --move-steps 2
refuse "--evaluation-budget: value '200': expected more than the number of samples, 200" --evaluation-budget 200
refuse "--sampler: value 'best'" --sampler best
refuse "--evaluation-budget: value '400': expected at least 500" --sampler recommended --evaluation-budget 400
expect_error 1 'evaluation_budget' $small --evaluation-budget 900 --output reference.csv
finish
