#!/usr/bin/env bash
# Under mpirun: the same bytes with any number of ranks, errors in one line wherever they happen, and a start after a rank
# has died goes on to the same bytes.
source "$(dirname "$0")/../../experiments/support.sh"

# More ranks than processors, as root, and without reading each other's memory: what containers ask for.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_btl_vader_single_copy_mechanism=none
export OMPI_MCA_rmaps_base_oversubscribe=1
ranks() { local n=$1; shift; mpirun -np "$n" "$@"; }
errors() { grep -c 'error: ' "$1"; }

# ---- a log-likelihood that all ranks evaluate
run=$bin/shared_run
for moves in resample-move waste-free threads; do
  "$run" $moves none $moves.whole whole.checkpoint
  check "$moves without mpirun" test -s $moves.whole
  for n in 1 2 3; do
    ranks $n "$run" $moves none $moves.$n run.checkpoint
    check "$moves on $n ranks: same bytes" cmp $moves.whole $moves.$n
    check "$moves on $n ranks: every rank has evaluated" test "$(cat $moves.$n.rows.* | grep -cv '^0$')" = $n
    check "$moves on $n ranks: no row twice" test "$(cat $moves.$n.rows.* | awk '{n += $1} END {print n}')" = "$(cat $moves.whole.rows.0)"
  done
done
check "calls from three threads change nothing" cmp resample-move.whole threads.whole

for fault in nan throw; do
  for n in 1 2 3; do
    ranks $n "$run" resample-move $fault failed run.checkpoint 2>$fault.$n
    check "$fault on $n ranks ends with an error" test $? != 0
    check "$fault on $n ranks: one line" test "$(errors $fault.$n)" = 1
    check "$fault on $n ranks: the line of one rank" cmp <(grep 'error: ' $fault.1) <(grep 'error: ' $fault.$n)
    check "$fault: no result, nothing left" test ! -e failed -a ! -e run.checkpoint -a -z "$(ls -A | grep part)"
  done
done
check "NaN: the line names the point" grep -q 'log-likelihood is -\?nan at (-[2-5]' nan.1
check "an exception: the line is the model's" grep -q 'the model failed at (-[2-5]' throw.1

for death in 1:20 2:300 0:400 1:900; do
  ranks 3 "$run" resample-move die:$death died run.checkpoint 2>died.err
  check "rank:row $death dies: status" test $? != 0
  check "rank:row $death dies: mpirun says which" grep -q "rank ${death%:*} .*signal 9" died.err
  check "rank:row $death dies: no result, nothing half-written" test ! -e died -a -z "$(ls -A | grep part)"
  check "rank:row $death dies: a checkpoint after the first stage" test "$death" = 1:20 -o -s run.checkpoint
  ranks 2 "$run" resample-move none resumed run.checkpoint
  check "rank:row $death dies: the next start ends with the same bytes" cmp resample-move.whole resumed
  rm -f resumed* died*
done

# ---- replicated studies
study="$bin/replicated_study --runs 10 --samples 400 --threads 1 --quiet --studies"
$study 30 --output whole.csv
for n in 1 2 3; do
  ranks $n $study 30 --output ranks.csv
  check "studies on $n ranks" cmp whole.csv ranks.csv
done
check "to standard output" cmp whole.csv <(ranks 2 $study 30 --output -)
check "the report once" test "$(ranks 3 "$bin/replicated_study" --runs 5 --samples 200 --studies 3 | grep -c 'studies of')" = 1
check "--help once" test "$(ranks 3 "$bin/replicated_study" --help | grep -c '^Usage')" = 1

one_error() {  # STATUS TEXT COMMAND...
  local status=$1 text=$2; shift 2
  ranks 3 "$@" >one.out 2>one.err
  check "status $status: $*" test $? = "$status"
  check "one line: $*: $(cat one.err)" test "$(errors one.err)" = 1
  check "'$text' in: $(cat one.err)" grep -qF -- "$text" one.err
  check "no output of: $*" test ! -e bad.csv
}
one_error 2 'none.csv: cannot be read' $study 30 --observations none.csv --output bad.csv
one_error 2 '--studies' "$bin/replicated_study" --studies none --output bad.csv
one_error 2 'missing/bad.csv' $study 30 --output missing/bad.csv
one_error 1 'TMCMC, run 0: ended at beta' $study 30 --max-stages 3 --output bad.csv
check "no journal of it but the line of its key" test "$(wc -l <bad.csv.journal)" = 1
rm -f bad.csv.journal

rank_pid() {  # RANK: process id of a rank of our mpirun
  local process
  for process in /proc/[0-9]*; do
    grep -qx "PPid:[[:space:]]*$mpi" "$process/status" 2>/dev/null &&
      tr '\0' '\n' <"$process/environ" 2>/dev/null | grep -qx "OMPI_COMM_WORLD_RANK=$1" && echo "${process#/proc/}"
  done
}
$study 80 --output whole.csv
for victim in 1 0 2; do
  rm -f resumed.csv resumed.csv.journal
  mpirun -np 3 $study 200 --output resumed.csv 2>died.err &
  mpi=$!
  for ((waited = 0; waited < 1000; waited++)); do
    [ -e resumed.csv.journal ] && [ "$(wc -l <resumed.csv.journal)" -ge 5 ] && break
    sleep 0.02
  done
  kill -KILL "$(rank_pid $victim)"
  wait $mpi
  check "rank $victim killed: status" test $? != 0
  check "rank $victim killed: no output, but a journal" test ! -e resumed.csv -a -s resumed.csv.journal
  lines=$(wc -l <resumed.csv.journal)
  ranks 2 $study 80 --output resumed.csv
  echo "rank $victim killed after $((lines - 1)) of 160 rows"
  check "rank $victim killed: the next start ends with the same bytes" cmp whole.csv resumed.csv
  check "the journal is gone" test ! -e resumed.csv.journal
done

# ---- the example of a batch job: out of time, it is put back into the queue, and its next start goes on
mkdir -p stub
printf '#!/bin/sh\necho "$@" >>requeued\n' >stub/scontrol
chmod +x stub/scontrol
job=("$source/docs/examples/replicated_study.slurm" --runs 10 --samples 400 --output job.csv --studies)
export PATH=$PWD/stub:$PATH SLURM_JOB_ID=7 STUDY=$bin/replicated_study
bash "${job[@]}" 300 2>job.err &
batch=$!
for ((waited = 0; waited < 1000; waited++)); do
  [ -e job.csv.journal ] && [ "$(wc -l <job.csv.journal)" -ge 5 ] && break
  sleep 0.02
done
kill -TERM $batch
wait $batch
check "out of time: status" test $? != 0
echo "out of time after $(($(wc -l <job.csv.journal) - 1)) of 160 rows"
check "out of time: back into the queue" test "$(cat requeued)" = "requeue 7"
check "out of time: a journal and no output" test ! -e job.csv -a -s job.csv.journal
bash "${job[@]}" 80 --quiet
check "the requeued job: status" test $? = 0
check "the requeued job ends with the same bytes" cmp whole.csv job.csv
check "and is not put back again" test "$(wc -l <requeued)" = 1
finish
