#!/usr/bin/env bash
# Every executable ends within a second of the first signal, by that signal, whatever standard output and error are and
# whatever signal comes second; nothing stands under a result's name and nothing is left beside it.
source "$(dirname "$0")/support.sh"
make_small_inputs
cp -r "$source/data/examples" data/examples
mkdir out tmp
export TMPDIR=$work/tmp
longest_ms=2500  # a second, on a machine with other work
now_ms() { echo $(($(date +%s%N) / 1000000)); }
listens() {  # the program, and no longer the shell that becomes it, to SIGTERM
  [ "$(readlink "/proc/$pid/exe")" = "$(realpath "${command%% *}")" ] && grep -qs '^SigCgt:.*[4567cdef]...$' "/proc/$pid/status"
}

# ends_by FIRST SECOND DELAY: both signals after the delay; FIRST has to end what was started, and leave nothing.
ends_by() {
  local begin what="$1 and $2 after $3 s: $command"
  wait_for listens 2>/dev/null
  sleep "$3"
  begin=$(now_ms)
  kill -s "$1" $pid 2>/dev/null
  sleep 0.05  # of signals that are pending together the system delivers the lowest number first
  [ "$2" = nothing ] || kill -s "$2" $pid 2>/dev/null
  wait $pid 2>/dev/null; status=$?
  local took=$(($(now_ms) - begin))
  case $status in 0 | 2) ended=$((ended + 1)); return ;; esac  # had done its work, with a report that cannot be printed
  check "status $status: $what" test $status = $((128 + $(kill -l "$1")))
  check "$took ms: $what" test $took -lt $longest_ms
  local left; left=$(ls -A out tmp | grep -v 'csv.journal$\|csv.checkpoint$\|^$\|:$')
  if [ "$left" = "$(printf 'out:\nout.csv')" ] || [ "$left" = out.csv ]; then  # the signal came after the work
    mv out/out.csv made.csv
    timeout 20 $command >/dev/null 2>&1
    cmp -s made.csv out/out.csv && left=
  fi
  check "left '$left': $what" test -z "$left"
  interrupted=$((interrupted + 1))
}

# Options with which the work lasts: many threads, large sizes.
long_options() {
  case $1 in
    report_values) echo ;;
    evaluate_model) echo --points points.csv ;;
    exact_posterior) echo --runs-input data/generated/sampling_study_runs.csv --samples-input data/generated/sampling_study_samples.csv ;;
    sampling_study) echo --samples 200000 --runs 1000 ;;
    replicated_study | readings | pbox_floor | forensics) echo --studies 100000 ;;
    calibration) echo --runs 1000000 ;;
    benchmark_problems | cost_accuracy) echo --runs 10000 ;;
    verdicts | fig9_null_distributions) echo --tables 100000000 ;;
    criterion_identity | endless_criterion) echo --samples 1000000 ;;
  esac
}
second=(nothing TERM HUP PIPE INT)
ended=0 interrupted=0 k=0
for e in $(executables); do
  for streams in closed broken full; do
    k=$((k + 1))
    command="$bin/$e $(long_options "$e")"
    grep -q -- '--output' <("$bin/$e" --help) && command="$command --output out/out.csv"
    set -m
    case $streams in
      closed) $command >&- 2>&- & ;;
      broken) $command >/dev/null 2> >(exec true) & ;;
      full) $command >/dev/full 2>/dev/full & ;;
    esac
    pid=$!
    set +m
    first=(TERM INT HUP)
    ends_by "${first[k % 3]}" "${second[k % 5]}" "0.$((k % 4 * 2))"
    rm -rf out/*
  done
done
echo "$interrupted runs interrupted, $ended were done before"
check "most were interrupted" test $interrupted -gt 30

# A program as the model, that does not listen to signals and has started another.
printf '#!/bin/sh\ntrap "" TERM INT HUP\nsleep 71 &\necho x >>%q/started\nsleep 71\n' "$work" >deaf.sh
chmod +x deaf.sh
for threads in 1 2; do
  for also in nothing HUP PIPE; do
    rm -f started
    command="$bin/own_model --command ./deaf.sh --evaluations 2600 --threads $threads --output out/out.csv"
    $command 2> >(exec true) &
    pid=$!
    wait_for test -s started
    check "the program has begun" test -s started
    ends_by TERM "$also" 0
    check "nothing runs on: $command" test -z "$(pgrep -f 'sleep 71')"
  done
done
finish
