#!/usr/bin/env bash
# What machines do to a run: full disks, read-only and vanishing directories, signals at any moment, damaged journals. Whatever
# happens, no half-made file stands under a result's name, and the same command again ends with the bytes of an undisturbed run.

# Disks of a few kilobytes need a mount namespace of one's own.
if [ -z "${OWN_MOUNTS-}" ] && unshare -rm true 2>/dev/null; then
  OWN_MOUNTS=1 exec unshare -rm bash "$0" "$@"
fi
source "$(dirname "$0")/support.sh"
RANDOM=20230903  # the seed of every random moment and place below

endless="$bin/replicated_study --runs 4 --samples 200 --quiet --studies 100000"
study="${endless%100000}30"
milliseconds() { echo $(($(date +%s%N) / 1000000)); }
temporary_files() { find "${1-.}" -name '.*.part'; }
rows_of() { if [ -e "$1" ]; then wc -l <"$1"; else echo 0; fi; }

has_open_output() { find "/proc/$pid/fd" -lname "$work/$1/#*(deleted)" 2>/dev/null | grep -q .; }  # DIRECTORY; has no name yet
has_rows() { [ "$(rows_of "$1")" -ge "$2" ]; }
pause() { sleep "$(awk -v m="$1" 'BEGIN {print m / 1000}')"; }
number_of() { kill -l "$1"; }

before=$(milliseconds)
$study --output whole.csv
study_time=$(($(milliseconds) - before))

# ---------------------------------------------------------------- disks

mkdir disk
if [ -n "${OWN_MOUNTS-}" ] && mount -t tmpfs -o size=16k tmpfs disk 2>/dev/null; then
  echo old >disk/samples.csv
  expect_error 2 'disk/samples.csv: cannot be written: No space left on device' \
    "$bin/sampling_study" --runs 2 --samples 200 --quiet --output disk/samples.csv
  check "a full disk leaves no temporary file" test -z "$(temporary_files disk)"
  $study --output disk/out.csv >said.txt 2>&1
  check "a journal on a full disk: status 2" test $? = 2
  check "says so in one line: $(cat said.txt)" test "$(grep -c 'disk/out.csv.*No space left on device' said.txt) $(rows_of said.txt)" = "1 1"
  check "keeps rows" has_rows disk/out.csv.journal 3
  check "makes no output" test ! -e disk/out.csv
  mount -o remount,size=1m disk
  $study --output disk/out.csv
  check "goes on once there is room" cmp -s whole.csv disk/out.csv
  check "without temporary files" test -z "$(temporary_files disk)"
  mount -o remount,ro disk
  for program in sampling_study replicated_study; do
    small_run="$bin/$program --runs 2 --samples 100 --quiet --output"
    expect_error 2 'disk/new.csv: cannot be opened for writing: Read-only file system' $small_run disk/new.csv
    expect_error 2 'disk/out.csv: cannot be opened for writing: Read-only file system' $small_run disk/out.csv
  done
  umount disk
else
  echo 'skipped: full and read-only disks, since no disk can be mounted here'
fi

# ---------------------------------------------------------------- temporary files that need a name from the start

# Without /proc they do, as on file systems that know no file without a name.
if [ -n "${OWN_MOUNTS-}" ] && mkdir named && mount -t tmpfs tmpfs /proc 2>/dev/null; then
  "$bin/sampling_study" --runs 1000 --samples 1000 --threads 1 --quiet --output named/out.csv 2>said.txt &
  pid=$!
  wait_for test -e "named/.out.csv.$pid.part"
  check "a temporary file with a name" test -e "named/.out.csv.$pid.part"
  kill -TERM $pid
  wait $pid; status=$?
  check "is removed at a signal: $status, $(cat said.txt)" test "$status $(ls -A named)" = '143 '
  "$bin/sampling_study" --runs 2 --samples 100 --threads 1 --quiet --output named/out.csv
  umount /proc
  "$bin/sampling_study" --runs 2 --samples 100 --threads 1 --quiet --output unnamed.csv
  check "and holds the same bytes" cmp -s named/out.csv unnamed.csv
  check "and nothing is beside it" test "$(ls -A named)" = out.csv
else
  echo 'skipped: no /proc'
fi

# ---------------------------------------------------------------- a directory that goes away

mkdir gone
mkfifo fifo
start "$bin/sampling_study" --runs 2 --samples 100 --quiet --output gone/samples.csv --runs-output fifo
wait_for has_open_output gone
rm -r gone
timeout 60 cat fifo >/dev/null
wait $pid; status=$?
check "a directory removed during the run: status 2" test $status = 2
check "and one line: $(cat said.txt)" test "$(grep -c 'gone/samples.csv: .*No such file or directory' said.txt) $(rows_of said.txt)" = "1 1"

mkdir gone
start $endless --output gone/out.csv
wait_for has_rows gone/out.csv.journal 3
mv gone elsewhere && touch gone
check "Ctrl-C works without the directory" stop INT
check "and is a signal" test $status = $((128 + $(number_of INT)))
mv gone gone.file && mv elsewhere gone
check "rows were kept there" has_rows gone/out.csv.journal 3
$study --output gone/out.csv
check "what was kept there goes on" cmp -s whole.csv gone/out.csv

# ---------------------------------------------------------------- a library that calls exit

# No room for the stacks of the threads: libgomp says so and exits. Sanitizers do not start with so little memory.
mkdir exits
with_little_memory() { (ulimit -v 4000000 && OMP_STACKSIZE=1G exec "$@"); }
if with_little_memory "$bin/sampling_study" --version >/dev/null 2>&1; then
  with_little_memory "$bin/sampling_study" --runs 20 --samples 200 --threads 20 --quiet --output exits/out.csv >said.txt 2>&1
  status=$?
  check "threads that cannot start: status 1: $(cat said.txt)" test $status = 1
  check "leave nothing" test -z "$(ls -A exits)"
else
  echo 'skipped: threads that cannot start'
fi

# ---------------------------------------------------------------- a process of its own

start "$bin/scaling" --quiet --output scaling.csv
pause 1500
check "Ctrl-C ends scaling" stop INT
check "by the signal" test $status = $((128 + $(number_of INT)))
check "and says so once: $(cat said.txt)" test "$(rows_of said.txt)" = 1
start "$bin/scaling" --quiet --output scaling.csv
pause 500
kill -KILL $pid
wait $pid 2>/dev/null
pause 500
check "a killed scaling leaves no process" test "$(group_runs; echo $?)" = 1

# ---------------------------------------------------------------- signals, replicated studies

for signal in INT TERM KILL INT; do
  rm -f out.csv out.csv.journal
  start $study --output out.csv
  pause $((RANDOM * study_time / 32768))
  check "SIG$signal ends a study within seconds" stop $signal
  if [ ! -e out.csv ]; then
    check "SIG$signal ends it by the signal" test $status = $((128 + $(number_of $signal)))
    kept=$((($(rows_of out.csv.journal) - 1) / 2))
    if [ $signal != KILL ] && [ -s said.txt ]; then
      said=$(sed -nE 's/^replicated_study: interrupted: ([0-9]+) of 30 studies kept in out.csv.journal, run the same command again to go on$/\1/p' said.txt)
      check "SIG$signal says what is kept, $kept studies: $(cat said.txt)" test "${said:--9}" -le "$kept" -a "${said:--9}" -ge $((kept - 1))
    fi
  fi
  [ $signal = KILL ] || check "SIG$signal leaves no temporary file" test -z "$(temporary_files)"
  $study --output out.csv
  check "SIG$signal, and again: the same bytes" cmp -s whole.csv out.csv
  check "SIG$signal, and again: no journal" test ! -e out.csv.journal
  find . -name '.*.part' -delete
done

# A second signal does not keep the first one from cleaning up; `timeout` sends two.
mkdir twice
for _ in 1 2 3 4 5 6 7 8; do
  start "$bin/readings" --output twice/out.csv
  wait_for has_open_output twice
  pause $((RANDOM % 100))
  kill -TERM $pid; kill -TERM $pid
  wait $pid 2>/dev/null; status=$?
  check "two signals: the status is that of one: $status" test $status = $((128 + $(number_of TERM)))
  check "two signals: no temporary file" test -z "$(ls -A twice)"
  check "two signals, one line: $(cat said.txt)" test "$(grep -c interrupted said.txt)" = 1
done

# ---------------------------------------------------------------- damaged journals

start $endless --output out.csv
wait_for has_rows out.csv.journal 20
check "a study is stopped" stop KILL
check "and has kept rows" has_rows out.csv.journal 20
cp out.csv.journal journal
first_line=$(head -1 journal | wc -c) size=$(stat -c %s journal)
resumes() {  # WHAT: what out.csv.journal now holds goes on to the bytes of an undisturbed run
  rm -f out.csv
  $study --output out.csv
  check "$1" cmp -s whole.csv out.csv
}
somewhere() { echo $(($1 + (RANDOM * 32768 + RANDOM) % ($2 - $1))); }
for _ in 1 2 3; do
  at=$(somewhere 0 "$size")
  head -c "$at" journal >out.csv.journal
  resumes "a journal cut off at byte $at of $size"
  at=$(somewhere "$first_line" "$size")
  cp journal out.csv.journal
  printf '~' | dd of=out.csv.journal bs=1 seek="$at" conv=notrunc status=none
  resumes "a journal damaged at byte $at of $size"
done
head -c $((size - $(tail -1 journal | wc -c) / 2)) journal >out.csv.journal
resumes "half a last line"
{ cat journal; head -c 4096 /dev/zero; } >out.csv.journal
resumes "a tail of zeros"
cp journal out.csv.journal
printf '~' | dd of=out.csv.journal bs=1 seek="$(somewhere 0 $((first_line - 1)))" conv=notrunc status=none
expect_error 2 'out.csv.journal:1: made with other inputs or options, or damaged' $study --output out.csv
rm -f out.csv.journal
printf 'notes without an end of line' >out.csv.journal
expect_error 2 'out.csv.journal:1: made with other inputs or options, or damaged' $study --output out.csv
rm -f out.csv.journal
mkfifo out.csv.journal
expect_error 2 'out.csv.journal: a pipe or a device: expected a journal, or no such file' timeout 20 $study --output out.csv
rm -f out.csv.journal

# ---------------------------------------------------------------- signals, make

unset MAKEFLAGS MFLAGS MAKELEVEL
tables="table1_observations fig2_phase_angle criterion_identity sampling_study_samples sampling_study_runs table3_pbox_area
  table4_iteration_counts replicated_study"
generated=data/generated
plant() {  # TREE: the pipeline without results, with the executables as they are
  (cd "$source" && tools/fresh_tree "$work/$1" "$bin/..") && printf '#!/bin/sh\n' >"$1/tools/build"
}
pipeline() {  # TREE: some of make's results
  make -C "$1" --no-print-directory STUDIES=1 $(for t in $tables; do echo "$generated/$t.csv"; done)
}
plant made
before=$(milliseconds)
pipeline made >make.txt 2>&1; status=$?
check "make: $(tail -2 make.txt)" test $status = 0
make_time=$(($(milliseconds) - before))
for signal in INT TERM KILL; do
  plant again
  start pipeline again
  pause $((RANDOM * make_time / 32768))
  check "SIG$signal ends make within seconds" stop $signal
  missing=$(for t in $tables; do [ -e "again/$generated/$t.csv" ] || echo "$t"; done)
  check "SIG$signal ends make by an error, unless all was done" test $status != 0 -o -z "$missing"
  for file in again/$generated/*.csv; do
    case $file in *'*'* | */manifest.csv) continue ;; esac
    check "SIG$signal: $file is whole" cmp -s "$file" "made/${file#again/}"
  done
  [ $signal = KILL ] || check "SIG$signal, make: no temporary file" test -z "$(find again -name '*.part')"
  pipeline again >make.txt 2>&1; status=$?
  check "SIG$signal, make again: $(tail -2 make.txt)" test $status = 0
  for t in $tables manifest; do
    check "SIG$signal, make again: $t" cmp -s "made/$generated/$t.csv" "again/$generated/$t.csv"
  done
done
finish
