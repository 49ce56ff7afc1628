#!/usr/bin/env bash
# The executables whose runs share out their work, each kind once: the same bytes with one and with three threads. The thread
# sanitizer runs this in place of the other end-to-end tests, which need every executable.
source "$(dirname "$0")/support.sh"

printf '#!/bin/sh\nawk '\''NR == 1 { print "log_likelihood"; next } { print -50 * ($1 - 1) ^ 2 }'\'' "$1" FS=, >"$2"\n' >model
chmod +x model
options() {
  case $1 in
    own_model) echo --evaluations 3000 ;;
    program) echo --evaluations 2600 --command ./model ;;
    *) small_options "$1" ;;
  esac
}
for case in sampling_study replicated_study calibration pbox_floor own_model program; do
  executable=${case/program/own_model}
  for threads in 1 3; do
    "$bin/$executable" $(options $case) --threads $threads --quiet --output "$case.$threads.csv"
    check "$case with $threads threads" test $? = 0
  done
  check "$case: the same bytes" cmp -s "$case.1.csv" "$case.3.csv"
done
finish
