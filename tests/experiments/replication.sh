#!/usr/bin/env bash
# Replicated studies: killed at any moment and started again, or shared between processes, the bytes are the same.
source "$(dirname "$0")/support.sh"

study="$bin/replicated_study --runs 5 --samples 300 --quiet"
$study --studies 20 --output whole.csv
check "20 studies of two samplers and a header" test "$(wc -l <whole.csv)" = 41

for delay in 0.05 0.2; do
  for signal in KILL TERM INT; do
    rm -f resumed.csv resumed.csv.journal
    attempts=0
    while [ ! -e resumed.csv ] && [ $attempts -lt 60 ]; do
      timeout --preserve-status -s $signal "$(awk "BEGIN {print $delay + $attempts * 0.15}")" $study --studies 20 --output resumed.csv 2>/dev/null
      attempts=$((attempts + 1))
    done
    check "killed ($signal) after $delay s" cmp -s whole.csv resumed.csv
    check "the journal is gone" test ! -e resumed.csv.journal
  done
done

# A row cut in the middle is made again.
rm -f resumed.csv
$study --studies 3 --output cut.csv
{ timeout -s KILL 0.2 $study --studies 20 --output resumed.csv; } 2>/dev/null
if [ -e resumed.csv.journal ]; then
  size=$(stat -c %s resumed.csv.journal)
  truncate -s $((size - 7)) resumed.csv.journal
fi
$study --studies 20 --output resumed.csv
check "a torn last row" cmp -s whole.csv resumed.csv

for cut in 1 13; do
  $study --studies $cut --output shard1.csv
  $study --first-study $cut --studies $((20 - cut)) --threads 1 --output shard2.csv
  check "shards at $cut" cmp -s whole.csv <(cat shard1.csv shard2.csv)
done
$study --studies 20 --threads 3 --output threads.csv
check "three threads" cmp -s whole.csv threads.csv
check "standard output" cmp -s whole.csv <($study --studies 20 --output -)

# The example of a job array. A task that is out of time goes back into the queue, and its next start goes on.
mkdir -p stub array
printf '#!/bin/sh\necho "$@" >>requeued\n' >stub/scontrol
chmod +x stub/scontrol
task() { cd array && STUDY=$bin/replicated_study PATH=$work/stub:$PATH SLURM_JOB_ID=7$1 SLURM_ARRAY_TASK_ID=$1 exec bash "$source/docs/examples/replicated_study.slurm" "${@:2}" --runs 5 --samples 300 --quiet; }
(task 1 10)
task 0 10000 2>/dev/null &  # takes too long
batch=$!
tries=0
until [ "$(wc -l <array/studies-00000.csv.journal)" -ge 3 ] || [ $tries = 1000 ]; do sleep 0.02; tries=$((tries + 1)); done 2>/dev/null
kill -TERM $batch
wait $batch
check "a task out of time: status" test $? = 1
check "a task out of time: back into the queue" test "$(cat array/requeued)" = "requeue 70"
check "a task out of time: no shard, but its journal" test ! -e array/studies-00000.csv -a -s array/studies-00000.csv.journal
(task 0 10)
check "a job array" cmp -s whole.csv <(cat array/studies-*.csv)

{ timeout -s KILL 0.15 $study --studies 20 --output other.csv; } 2>/dev/null
if [ -e other.csv.journal ]; then
  expect_error 2 'other inputs or options' $study --studies 20 --seed 2 --output other.csv
  expect_error 2 'other inputs or options' $study --studies 20 --cov-target 0.9 --output other.csv
fi
expect_error 2 'missing/out.csv' $study --studies 2 --output missing/out.csv

# Verdicts: a printed number moved out of its interval flips; N/4 is not N/2.
mkdir -p data/generated
"$bin/sampling_study" --runs 20 --samples 200 --quiet --runs-output runs.csv
"$bin/pbox_floor" --runs 20 --samples 200 --studies 5 --quiet --output floor.csv
"$bin/replicated_study" --runs 20 --samples 200 --studies 40 --quiet --output null.csv
"$bin/replicated_study" --runs 20 --samples 200 --studies 40 --ess-fraction 0.25 --quiet --output quarter.csv
verdict() {  # CLAIM REPLICATED TABLE3
  "$bin/verdicts" --replicated "$2" --table3 "$3" --runs-input runs.csv --floor floor.csv --quiet --markdown-output words.md >/dev/null
  awk -F ' [|] ' -v id="| $1" '$1 == id {print $4}' words.md
}
table3=data/published/table3_pbox_area.csv
check "N/2 against CoV = 1 takes no fewer iterations" test "$(verdict C4 null.csv $table3)" != "**contradicted**"
check "N/4 takes fewer iterations" test "$(verdict C4 quarter.csv $table3)" = "**contradicted**"
compared() { "$bin/fig9_null_distributions" --replicated null.csv --table3 "$1" --quiet --printed-output - | awk -F, '$1 == "TMCMC" && $2 == "friction_force_n" {print $6}'; }
median=$("$bin/fig9_null_distributions" --replicated null.csv --quiet --output - | awk -F, '$1 == "TMCMC" && $2 == "friction_force_n" {print $3}' | sort -g | sed -n 20p)
sed "s/^TMCMC,0.08151/TMCMC,$median/" $table3 >median.csv
sed "s/^TMCMC,0.08151/TMCMC,9.9/" $table3 >moved.csv
check "the median is typical" awk -v p="$(compared median.csv)" 'BEGIN {exit !(p > 0.5)}'
check "a moved number is not" awk -v p="$(compared moved.csv)" 'BEGIN {exit !(p < 0.05)}'

# Few studies decide less, but another seed never says the opposite.
"$bin/replicated_study" --runs 20 --samples 200 --studies 40 --seed 2 --quiet --output seed2.csv
words() { "$bin/verdicts" --replicated "$1" --runs-input runs.csv --floor floor.csv --quiet --markdown-output words.md >/dev/null; awk -F ' [|] ' 'FNR > 2 {print $3 "|" $4}' words.md; }
check "verdicts with another seed" awk -F '|' '
  function other(a, b) { return a != b && a !~ /undecided/ && b !~ /undecided/ }
  { if (other($1, $3) || other($2, $4)) bad = 1; n++ } END {exit bad || n != 15}' <(paste -d '|' <(words null.csv) <(words seed2.csv))

# The printed iteration table: that of one of the studies is typical, and all runs in another category is not.
mkdir -p typical moved
cp data/published/*.csv typical && cp data/published/*.csv moved
awk -F, '$1 == 0 {print $NF}' null.csv | awk '
  { for (i = 1; i <= NF; i++) { split($i, cell, ":"); runs[NR, cell[1]] = cell[2]; seen[cell[1]] = 1 } }
  END { print "iterations,TMCMC,TMCMC-II"; for (k in seen) print k "," runs[1, k] + 0 "," runs[2, k] + 0 }' >typical/table4_iteration_counts.csv
printf 'iterations,TMCMC,TMCMC-II\n30,20,20\n' >moved/table4_iteration_counts.csv
table4_verdict() {
  "$bin/compare_published" --published "$1" --table1 "$1/table1_observations.csv" --table3 "$1/table3_pbox_area.csv" \
    --table4 "$1/table4_iteration_counts.csv" --replicated null.csv --quiet --output - |
    awk -F, '$1 == "joint" && $2 == "counts" {print $NF}' | tr -d '"' 
}
check "a replicated iteration table" test "$(table4_verdict typical)" = compatible
check "a moved iteration table" test "$(table4_verdict moved)" != compatible
finish
