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

# ---- a model of one's own
cp -r "$source/data/examples" data/examples
own="$bin/own_model --evaluations 2600 --quiet"
$own --output whole.csv
$own --command data/examples/two_storey_frame.py --output program.csv
for n in 1 2 3; do
  ranks $n $own --output ranks.csv
  check "own_model on $n ranks" cmp whole.csv ranks.csv
done
ranks 2 $own --threads 2 --command data/examples/two_storey_frame.py --output ranks.csv
check "a program on 2 ranks" cmp program.csv ranks.csv
check "to standard output" cmp whole.csv <(ranks 2 $own --output -)
check "the report once" test "$(ranks 3 "$bin/own_model" --evaluations 2600 | grep -c '^log-evidence')" = 1
check "--help once" test "$(ranks 3 "$bin/own_model" --help | grep -c '^Usage')" = 1
rm -f ranks.csv

# The posterior predictive, whose evaluations all ranks share; a model that fails in it ends no rank too early.
cat >outputs.py <<'PY'
#!/usr/bin/env python3
import os, sys
for line in sys.stdin:
    n = int(line)
    points = [[float(x) for x in sys.stdin.readline().split(",")] for _ in range(n)]
    with open(f"{os.environ['ROWS']}.{os.environ.get('OMPI_COMM_WORLD_RANK', 0)}", "a") as file:
        file.write(f"{n}\n" * n)
    if "BREAKS" in os.environ and os.path.exists(os.environ["DRAWN"]):
        sys.exit(5)
    print(*[f"{a!r},{a + b!r}" for a, b in points], sep="\n", flush=True)
PY
chmod +x outputs.py
printf '%s\n' '[model]' 'worker = "outputs.py"' '[data]' 'observation = [1, 3]' 'standard_deviation = 0.1' '[parameters]' \
  'a = {lower = -5, upper = 5}' 'b = {lower = -5, upper = 5}' '[output]' 'samples = "outputs.csv"' >outputs.toml
outputs="$bin/own_model outputs.toml --evaluations 2600 --threads 1 --quiet --figures"
export ROWS=$work/rows DRAWN=$work/failed/samples_stages.png
$outputs alone
$own --figures frame
for n in 1 2 3; do
  rm -f rows.*
  ranks $n $outputs together
  check "posterior predictive on $n ranks" cmp alone/predictive.csv together/predictive.csv
  check "every rank evaluates: $(wc -l rows.*)" test "$(ls rows.* | wc -l)" = $n -a "$(tail -qn 1 rows.* | awk '$1 > 100 / '$n' + 1' | wc -l)" = 0
  ranks $n $own --figures together
  check "that of a model in C++ on $n ranks" cmp frame/predictive.csv together/predictive.csv
done
BREAKS=1 ranks 3 $outputs failed 2>err
check "a failure in it: status $?" test $? != 0
check "a failure in it: one line: $(cat err)" test "$(grep -c 'error: .*outputs.py: ended with status 5.*; all results but samples_predictive are in place$' err)" = 1
check "a failure in it: the results" test -s outputs.csv -a -s failed/samples_corner.png -a ! -e failed/predictive.csv
rm -rf outputs.csv*

one_error() {  # STATUSES TEXT COMMAND...: one of the statuses
  local status=$1 text=$2; shift 2
  "$@" >one.out 2>one.err
  local found=$?
  check "status $found, expected $status: $*" grep -qw "$found" <<<"$status"
  check "one line: $*: $(cat one.err)" test "$(errors one.err)" = 1
  check "'$text' in: $(cat one.err)" grep -qF -- "$text" one.err
  check "no output of: $*" test ! -e bad.csv
}
one_error 2 'none.csv: cannot be read' ranks 3 $own --observations none.csv --output bad.csv
one_error 2 '--evaluations' ranks 3 $own --evaluations none --output bad.csv
one_error 2 'missing/bad.csv' ranks 3 $own --output missing/bad.csv
printf '#!/bin/sh\nexit 3\n' >broken.sh && chmod +x broken.sh
one_error 1 'broken.sh: ended with status 3' ranks 3 $own --command ./broken.sh --output bad.csv
# mpirun gives the status of the rank that it hears of first: of rank 2 (2) or of rank 0, which ends the others (1).
one_error '1 2' 'rank 2 could not begin' mpirun -np 2 $own --output bad.csv : -np 1 $own --observations none.csv --output bad.csv

# Ctrl-C and the like: mpirun passes them on, and nothing runs on.
export TMPDIR=$work/tmp STARTED=$work/started
mkdir tmp
printf '#!/bin/sh\necho x >>"$STARTED"\nsleep 72\n' >slow.sh && chmod +x slow.sh
for signal in TERM INT; do
  rm -f started
  start mpirun -np 2 $own --command ./slow.sh --output bad.csv
  wait_for test -s started
  sleep 0.3
  kill -s $signal $pid
  begin=$(date +%s%N)
  wait $pid 2>/dev/null; status=$?
  check "SIG$signal: status $status" test $status != 0
  check "SIG$signal: soon" test $((($(date +%s%N) - begin) / 1000000)) -lt 5000
  check "SIG$signal: nothing runs on" test -z "$(pgrep -f 'sleep 72')"
  check "SIG$signal: no output" test ! -e bad.csv
done
finish
