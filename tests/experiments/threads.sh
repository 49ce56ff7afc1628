#!/usr/bin/env bash
# The executables whose runs share out their work, each kind once: the same bytes with one and with three threads. The thread
# sanitizer runs this in place of command_lines.sh, which needs every executable.
source "$(dirname "$0")/support.sh"

for e in sampling_study replicated_study calibration pbox_floor; do
  for threads in 1 3; do
    "$bin/$e" $(small_options $e) --threads $threads --quiet --output "$e.$threads.csv"
    check "$e with $threads threads" test $? = 0
  done
  check "$e: the same bytes" cmp -s "$e.1.csv" "$e.3.csv"
done
finish
