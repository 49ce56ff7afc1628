#!/usr/bin/env bash
# A model of one's own: the example, the same model as a program, programs that fail in every way, a run that is killed.
source "$(dirname "$0")/support.sh"
cp -r "$source/data/examples" data/examples
export TMPDIR=$work/tmp
mkdir -p "$TMPDIR"
own="$bin/own_model --evaluations 2600 --quiet"

$own --output whole.csv --netcdf whole.nc
check "a row per sample and a header" test "$(wc -l <whole.csv)" -gt 1000
check "the true stiffnesses are within 4 standard deviations" awk -F, '
  NR > 1 { n++; for (j = 1; j <= 2; j++) { s[j] += $j; q[j] += $j * $j } }
  END { for (j = 1; j <= 2; j++) { mean = s[j] / n; sd = sqrt(q[j] / n - mean * mean); z = (mean - (j == 1 ? 0.9 : 1.2)) / sd; if (z * z > 16) exit 1 } }' whole.csv
check "nothing is left beside the results" test "$(ls | tr '\n' ' ')" = "data tmp whole.csv whole.nc "
$own --threads 1 --output threads.csv --netcdf again.nc
check "threads change nothing" cmp -s whole.csv threads.csv
check "the NetCDF file has the same bytes" cmp -s whole.nc again.nc

# Readers that are not ours.
if command -v ncdump >/dev/null; then
  header=$(ncdump -h whole.nc)
  for text in 'group: posterior' 'group: sample_stats' 'group: log_likelihood' 'group: observed_data' 'group: constant_data' \
    'double stiffness_1(chain, draw)' 'chain = 1 ;' 'double lp(chain, draw)' 'double frequency_hz(chain, draw, observation)' \
    'double frequency_hz(observation)' 'double mode(observation)'; do
    check "ncdump: $text" grep -qF "$text" <<<"$header"
  done
  check "no joint log-likelihood under the name of the pointwise one" test -z "$(grep -F ' log_likelihood(' <<<"$header")"
  numbers_of() { ncdump -p 17,17 -v "$1" whole.nc | sed -n "/ ${1##*/} = *$/,/;/p" | sed 's/.* = *$//' | tr -d ' ;}' | tr ',' '\n' | grep .; }
  check "ncdump: the pointwise log-likelihoods of a sample add up to the joint one" awk -F, '
    FILENAME == ARGV[1] { point[n++] = $1 + 0; next } FILENAME == ARGV[2] { joint[m++] = $1 + 0; next }
    END { if (m < 1000 || n != 16 * m) exit 1
          for (i = 0; i < m; i++) { sum = 0; for (k = 0; k < 16; k++) sum += point[16 * i + k]
            if ((sum - joint[i]) ^ 2 > 1e-18) exit 1 } }' <(numbers_of log_likelihood/frequency_hz) <(numbers_of sample_stats/lp)
  check "ncdump reads the samples" awk -v a="$(awk -F, 'NR == 2 { print $1 }' whole.csv)" -v b="$(ncdump -v posterior/stiffness_1 -p 17,17 whole.nc |
    sed -n '/stiffness_1 = *$/,$p' | grep -oE '[0-9]+\.[0-9]+' | head -n 1)" 'BEGIN { exit !(a + 0 == b + 0 && a > 0) }'
else echo 'ncdump is not installed: left out'; fi
if /usr/bin/python3 -c 'import xarray' 2>/dev/null; then
  check "xarray" /usr/bin/python3 - <<'PY'
import csv, xarray
posterior = xarray.open_dataset("whole.nc", group="posterior", engine="h5netcdf")
rows = list(csv.DictReader(open("whole.csv")))
assert posterior.sizes == {"chain": 1, "draw": len(rows)}
for name in ("stiffness_1", "stiffness_2", "relative_noise"):
    assert [float(row[name]) for row in rows] == posterior[name].values[0].tolist()
statistics = xarray.open_dataset("whole.nc", group="sample_stats", engine="h5netcdf")
joint = statistics["lp"].values[0]
assert [float(row["log_likelihood"]) for row in rows] == joint.tolist()
assert "log_likelihood" not in statistics
observed = xarray.open_dataset("whole.nc", group="observed_data", engine="h5netcdf")
assert list(observed.data_vars) == ["frequency_hz"] and observed["frequency_hz"].values[8] == 11.7691
assert xarray.open_dataset("whole.nc", group="constant_data", engine="h5netcdf")["mode"].values.tolist() == 8 * [1] + 8 * [2]
pointwise = xarray.open_dataset("whole.nc", group="log_likelihood", engine="h5netcdf")["frequency_hz"]
assert pointwise.dims == ("chain", "draw", "observation") and pointwise.sizes["observation"] == 16
assert abs(pointwise.sum("observation").values[0] - joint).max() < 1e-9
PY
else echo 'xarray is not installed: left out'; fi

# The model as a program: the same posterior but for the rounding of another exponential and logarithm.
$own --command data/examples/two_storey_frame.py --output program.csv
check "the program gives the same posterior" awk -F, 'NR == FNR { for (j = 1; j <= 3; j++) a[FNR, j] = $j; next }
  FNR > 1 { for (j = 1; j <= 3; j++) if (($j - a[FNR, j]) ^ 2 > (1e-9 * $j) ^ 2) bad++ } END { exit bad > 0 }' whole.csv program.csv

# The same as a worker and behind UM-Bridge, to the byte, however many calls there are at a time.
$own --worker data/examples/two_storey_worker.py --output worker.csv
check "the worker gives the same bytes as the program" cmp -s program.csv worker.csv
$own --worker data/examples/two_storey_worker.py --parallel 3 --batch 7 --output batches.csv
check "three workers in batches of seven too" cmp -s program.csv batches.csv
mkdir examples && cp "$source/examples/um_bridge_server.py" examples/
data/examples/two_storey_um_bridge.py >address 2>server.log &
server=$! pid=$!
wait_for test -s address
bridge="$own --um-bridge $(cat address)"
$bridge --model posterior --parallel 8 --output bridge.csv
check "UM-Bridge gives the same bytes as the program" cmp -s program.csv bridge.csv
printf 'parameter,lower,upper\nstiffness_1,0.5,1.5\nstiffness_2,0.5,1.5\n' >forward_prior.csv
printf 'observation,standard_deviation\n4.5,0.05\n11.7,0.1\n' >forward_data.csv
$bridge --model forward --prior forward_prior.csv --observations forward_data.csv --parallel 4 --output forward.csv
check "outputs are compared with observations" awk -F, 'NR == 1 { exit $0 != "stiffness_1,stiffness_2,log_likelihood" }' forward.csv
expect_error 1 'expected one of ["posterior","forward"]' $bridge --model missing --output failed.csv
expect_error 1 'outputs of the sizes [2]: expected 1 in all' $bridge --model forward --prior forward_prior.csv --output failed.csv
expect_error 1 'inputs of the sizes [2]: expected 3 in all' $bridge --model forward --output failed.csv
expect_error 2 '--um-bridge, --model: expected both of them' $bridge --output failed.csv
expect_error 2 '--command, --worker, --um-bridge: expected one of them' $bridge --model posterior --worker ./w --output failed.csv
kill $server
wait $server 2>/dev/null
printf '#!/bin/sh\nread -r n; exit 5\n' >worker.sh
chmod +x worker.sh
expect_error 1 'ended with status 5: expected 0 after 0 of 200 log-likelihoods, as did the worker before it; the first of 200 points (stiffness_1 = ' \
  $own --threads 1 --worker ./worker.sh --output failed.csv

# Programs that fail. Each message names the program, what it did and a point; the directory of the points is gone.
script() { printf '#!/bin/sh\n%s\n' "$1" >program.sh; chmod +x program.sh; }
fails() {  # TEXT
  expect_error 1 "$1" $own --threads 1 --command ./program.sh --timeout 2 --output failed.csv
  check "the point is named ($1)" grep -q 'stiffness_1 = ' <($own --threads 1 --command ./program.sh --timeout 2 --output failed.csv 2>&1)
}
rows='echo log_likelihood >"$2"; awk "NR > 1 { print -NR }" "$1"'
script 'exit 3';                                   fails 'ended with status 3'
script 'kill -SEGV $$';                            fails 'was ended by signal 11'
script 'true';                                     fails 'wrote no log-likelihoods'
script "$rows | head -n 5 >>\"\$2\"";              fails 'wrote 5 log-likelihoods for 200 points; point 6 of 200'
script "$rows >>\"\$2\"; echo 1 >>\"\$2\"";        fails 'wrote 201 log-likelihoods for 200 points'
script "$rows | sed 4s/.*/abc/ >>\"\$2\"";         fails "wrote the log-likelihood 'abc': expected a number or -inf; point 4 of 200"
script 'echo nonsense >"$2"; echo 1 >>"$2"';       fails 'log_likelihood'
nap="sleep 60.$$"  # of this test alone
script "$nap & $nap";                              fails 'took more than 2 s and was killed'
check "nothing it started is left" test -z "$(pgrep -f "$nap" || true)"
for value in nan inf 1e400 +-5 '""'; do
  script "$rows | sed '4s/.*/$value/' >>\"\$2\"";  fails "wrote the log-likelihood '${value#\"\"}': expected a number or -inf; point 4 of 200"
done
{ echo mode,frequency_hz; yes 1,2.345 | head -n 3000; yes 2,6.5 | head -n 3000; } >many.csv  # no noise at all
expect_error 1 'next stage beyond evaluation_budget: expected more --evaluations' $own --observations many.csv --output failed.csv --netcdf failed.nc
check "what is no posterior is not written" test "$(echo failed.*)" = 'failed.*'
expect_error 1 'missing.sh: No such file' $own --command ./missing.sh --output failed.csv
expect_error 1 'expected a program that can be run' $own --command ./whole.csv --output failed.csv
check "the directories of the points are gone" test -z "$(ls "$TMPDIR")"

# What keeps a program from being started is said: its interpreter, the ends of its lines, a first line that is missing.
starts_not() { chmod +x program.sh; expect_error "$@" $own --threads 1 --command ./program.sh --output failed.csv; }
printf '#!/bin/sh\r\nexit 0\r\n' >program.sh
starts_not 1 "the interpreter '/bin/sh\r' of its first line: No such file or directory; the line ends in CR LF, as on Windows"
printf '#! /no/such/python3 -u\nprint()\n' >program.sh
starts_not 1 "the interpreter '/no/such/python3' of its first line: No such file or directory: expected"
printf '#!%s/data\n' "$work" >program.sh
starts_not 1 "the interpreter '$work/data' of its first line: Permission denied"
printf '#!/usr/bin/env python3\r\nprint()\r\n' >program.sh
$own --threads 1 --command ./program.sh --output failed.csv 2>error.txt
check "env cannot find python3\\r: $(tail -1 error.txt)" grep -qF "ended with status 127 (a command that could not be run; the first line is '#!/usr/bin/env python3\r', which ends in CR LF" error.txt
printf 'print()\n' >program.sh
starts_not 1 'Exec format error: expected a first line that begins with #!, such as #!/bin/sh'
printf '\357\273\277#!/bin/sh\nexit 0\n' >program.sh
starts_not 1 'expected no byte order mark before the #! of the first line'
printf '\177ELF of another machine' >program.sh
starts_not 1 'expected an executable for this machine'
: >program.sh
starts_not 1 'Exec format error'
for directory in /no/such/directory "$work/whole.csv"; do
  TMPDIR=$directory expect_error 2 "$directory" $own --command data/examples/two_storey_frame.py --output failed.csv
done

# A program that writes its points back beside the results: columns with the names of parameters are compared.
echoes() { script "awk -F, -v OFS=, 'NR == 1 { print $1; next } { l = -(\$1 - 1) ^ 2 - (\$2 - 1) ^ 2; print $2 }' \"\$1\" ${3-} >\"\$2\""; }
echoes '"stiffness_2", "note", "log_likelihood"' '$2, "x", l'
check "points that are repeated" $own --command ./program.sh --output echo_all.csv
echoes '"log_likelihood"' 'l'
check "the same without" $own --command ./program.sh --output echo_none.csv
check "give the same samples" cmp -s echo_all.csv echo_none.csv
for digits in .3f .4g .5e .9g .0f; do
  echoes '"log_likelihood", "stiffness_1", "relative_noise"' "l, sprintf(\"%$digits\", \$1), sprintf(\"%$digits\", \$3)"
  check "points in the form %$digits" $own --command ./program.sh --output echo_digits.csv
  check "give the same samples (%$digits)" cmp -s echo_digits.csv echo_none.csv
done
echoes '$0, "log_likelihood"' '$0, l' '| { read -r header; echo "$header"; sort -t, -k2,2g; }'
fails ' where the point has '
check "the row of the point is named" grep -q 'wrote stiffness_1 = [0-9.]* where the point has \([0-9.]*\): expected the rows in the order of the points; point [0-9]* of 200 (stiffness_1 = \1,' \
  <($own --threads 1 --command ./program.sh --output failed.csv 2>&1)
echoes '"stiffness_2", "log_likelihood"' '(NR == 4 ? "abc" : $2), l'
fails 'wrote stiffness_2 = abc where the point has'
echoes '"relative_noise", "log_likelihood"' '(NR == 7 ? 1.0001 * $3 : $3), l'
fails 'point 6 of 200'

# Another program has the parameters of the file of the prior: any number, any names, any sign.
script 'awk -F, '"'"'NR == 1 { print "log_likelihood"; next } { print -0.5 * (($1 + 3) ^ 2 / 0.01 + ($2 - 2) ^ 2 / 0.04) }'"'"' "$1" >"$2"; head -n 1 "$1" >header'
sed -i 's|>header|>"$HEADER"|' program.sh
printf 'parameter,lower,upper\n"offset, mm",-10,-0.5\nslope,-4,4\n' >two.csv
HEADER=$work/header $own --command ./program.sh --prior two.csv --output two_samples.csv --netcdf two.nc
check "the program sees their names" grep -qx '"offset, mm",slope' header
check "and so does who reads the samples" test "$(head -1 two_samples.csv)" = '"offset, mm",slope,log_likelihood'
check "two parameters of either sign: -3 +- 0.1 and 2 +- 0.2" awk -F, 'NR > 1 { n++; for (j = 1; j <= 2; j++) { s[j] += $j; q[j] += $j * $j } }
  END { a = s[1] / n; b = s[2] / n; u = sqrt(q[1] / n - a * a); v = sqrt(q[2] / n - b * b)
        exit !(a > -3.05 && a < -2.95 && b > 1.9 && b < 2.1 && u > 0.08 && u < 0.12 && v > 0.16 && v < 0.24) }' two_samples.csv
if command -v ncdump >/dev/null; then
  check "NetCDF: the parameters of the program" grep -qF 'double slope(chain, draw)' <(ncdump -h two.nc)
  check "NetCDF: no observations that the program has not named" test -z "$(ncdump -h two.nc | grep -E 'observed_data|constant_data|group: log_likelihood')"
fi
printf 'parameter,lower,upper\nx,-1,1\n' >one.csv
script 'awk '"'"'NR == 1 { print "log_likelihood"; next } { print -50 * $1 ^ 2 }'"'"' "$1" >"$2"'
check "one parameter" $own --command ./program.sh --prior one.csv --output one_samples.csv
printf 'parameter,lower,upper\nx,0,1\n' >other.csv
expect_error 2 "other.csv:2: column 'parameter': value 'x': expected stiffness_1, stiffness_2 or relative_noise" $own --prior other.csv --output failed.csv
# refuse_prior TEXT ROW: what cannot be the row of a parameter
refuse_prior() { printf 'parameter,lower,upper\nx,-1,1\n%s\n' "$2" >bad.csv; expect_error 2 "bad.csv:3: column $1" $own --command ./program.sh --prior bad.csv --output failed.csv --netcdf failed.nc; }
refuse_prior "'parameter': value 'x': expected each parameter once" 'x,0,1'
refuse_prior "'parameter': value '': expected a printable name other than log_likelihood" ',0,1'
refuse_prior "'parameter': value 'log_likelihood': expected a printable name other than log_likelihood" 'log_likelihood,0,1'
for name in a/b chain draw +a; do refuse_prior "'parameter': value '$name': expected a name that NetCDF allows" "$name,0,1"; done
refuse_prior "'upper': value '-2': expected a number above the lower bound -1" 'y,-1,-2'
refuse_prior "'lower': value '-1e101': expected a number from -1e100 to 1e100" 'y,-1e101,2'
refuse_prior "'upper': value '1e-200': expected a number at least 1e-100 above the lower bound 0" 'y,0,1e-200'
check "a name that only NetCDF refuses" $own --command ./program.sh --prior <(printf 'parameter,lower,upper\na/b,-1,1\n') --output one_samples.csv

# Breaks in the fifth call: what was done is kept, and the mended program goes on to the same result.
cat >program.sh <<'SH'
#!/bin/sh
echo call >>"$COUNTER"
[ -e "$MENDED" ] || [ "$(wc -l <"$COUNTER")" -lt 20 ] || exit 7
exec "$MODEL" "$@"
SH
export COUNTER=$work/counter MENDED=$work/mended MODEL=$work/data/examples/two_storey_frame.py
$own --threads 1 --command ./program.sh --output kept.csv 2>error.txt
check "status of a broken run" test $? = 1
check "says what is kept" grep -q 'ended with status 7.*the samples after stage [0-9]* .* are kept in kept.csv.checkpoint' error.txt
check "no result yet" test ! -e kept.csv
touch "$MENDED"
$own --threads 1 --command ./program.sh --output kept.csv
check "goes on to the same result" cmp -s program.csv kept.csv
check "the checkpoint is gone" test ! -e kept.csv.checkpoint

# A program that is another than before, or gives other values: refused, and nothing is touched.
cat >module.sh <<'SH'
scale=1
SH
cat >changing.sh <<'SH'
#!/bin/sh
. "$MODULE"
echo call >>"$COUNTER"
[ -e "$MENDED" ] || [ "$(wc -l <"$COUNTER")" -lt 20 ] || exit 7
awk -F, -v s=$scale 'NR == 1 { print "log_likelihood"; next } { print -s * (($1 - 1) ^ 2 + ($2 - 1) ^ 2) / 0.01 }' "$1" >"$2"
SH
chmod +x changing.sh
rm -f "$COUNTER" "$MENDED"
export MODULE=$work/module.sh
echo 'seen by the program' >seen.txt
changing() { $own --threads 1 --command ./changing.sh --observations seen.txt --output changed.csv "$@"; }
changing 2>error.txt
check "stages are kept: $(cat error.txt)" test -s changed.csv.checkpoint
touch "$MENDED"
cp changing.sh before.sh
echo '# edited' >>changing.sh
expect_error 2 'changed.csv.checkpoint: checkpoint was made with model = program with checksum' changing
cp before.sh changing.sh
echo 'something else' >seen.txt
expect_error 2 'observations with checksum' changing
echo 'seen by the program' >seen.txt
echo scale=2 >module.sh
before=$(sha256sum changed.csv.checkpoint)
changing 2>error.txt
check "status of a model with another module" test $? = 2
check "one line says so: $(cat error.txt)" grep -qx 'own_model: error: changed.csv.checkpoint: the model has changed: the log-likelihood of a sample in the checkpoint was -.* and is now -.*: expected the same, or another file' error.txt
check "the checkpoint is untouched" test "$before" = "$(sha256sum changed.csv.checkpoint)"
check "no output" test ! -e changed.csv
echo scale=1 >module.sh
changing
check "the model of before goes on" test -s changed.csv
rm -f "$COUNTER"

# Killed at random moments, the same command ends with the same bytes.
rm -f "$COUNTER"
for delay in 0.2 0.5 0.9 1.4; do
  { timeout -s KILL "$delay" $own --threads 1 --command ./program.sh --output killed.csv; } 2>/dev/null
done
$own --threads 1 --command ./program.sh --output killed.csv
check "killed four times" cmp -s program.csv killed.csv

# Bad input.
expect_error 2 "column 'mode': value '3': expected 1 or 2" $own --observations <(printf 'mode,frequency_hz\n3,4\n') --output whole.csv
expect_error 2 "column 'frequency_hz': value '-4': expected a positive number" $own --observations <(printf 'mode,frequency_hz\n1,-4\n') --output whole.csv
sed 's/stiffness_1/stiffness_9/' data/examples/frame_prior.csv >prior.csv
expect_error 2 "prior.csv:2: column 'parameter': value 'stiffness_9'" $own --prior prior.csv --output whole.csv
expect_error 2 '--timeout' $own --timeout -1

# Ctrl-C while the program hangs: ends it too, says what is kept, and the same command goes on.
rm -f "$COUNTER" "$MENDED"
export HANGS=$work/hangs
sed -i 's/exit 7/{ touch "$HANGS"; exec sleep 61; }/' program.sh
start $own --threads 1 --command ./program.sh --checkpoint other --output other.csv
wait_for test -e "$HANGS"
check "ends on Ctrl-C" stop INT
check "status of Ctrl-C" test "$status" = 130
check "says what is kept" grep -qx 'own_model: interrupted: the stages so far are kept in other, run the same command again to go on' said.txt
check "the program has ended" test -z "$(pgrep -f 'sleep 61' || true)"
expect_error 2 'other: checkpoint was made with' $own --seed 2 --checkpoint other --output other.csv
touch "$MENDED"
$own --threads 1 --command ./program.sh --checkpoint other --output other.csv
check "goes on from Ctrl-C" cmp -s program.csv other.csv

# Interrupted in its third call, alone or with its process group: all that the program has started ends with it, and no
# directory is left.
gone() { local tries=0; while pgrep -f "$1" >/dev/null && [ $tries -lt 100 ]; do sleep 0.02; tries=$((tries + 1)); done; ! pgrep -f "$1" >/dev/null; }
find . -name '.*.part' -delete  # of the kills above
rm -rf "${TMPDIR:?}"/*
for signal in INT TERM HUP; do
  for threads in 1 2; do
    for whom in process group; do
      rm -f started out.csv*
      script 'sh -c "sleep 62; sleep 62" & echo x >>"$STARTED"; sleep 62'
      STARTED=$work/started start $own --threads $threads --command ./program.sh --output out.csv
      wait_for test -s started
      sleep 0.1
      if [ $whom = process ]; then kill -s $signal $pid; wait $pid; status=$?; else stop $signal; fi
      check "SIG$signal to the $whom, $threads threads: ends by it" test $status = $((128 + $(kill -l $signal)))
      check "SIG$signal to the $whom, $threads threads: one line: $(cat said.txt)" test "$(wc -l <said.txt)" = 1
      check "SIG$signal to the $whom, $threads threads: nothing runs on" gone 'sleep 62'
      check "SIG$signal to the $whom, $threads threads: no directory is left" test -z "$(ls "$TMPDIR")"
      check "SIG$signal to the $whom, $threads threads: no temporary file" test -z "$(find . -name '.*.part')"
    done
  done
done

# A grandchild that outlives the program and holds its standard error does not hold up the run.
script "sleep 64 & exec \"$MODEL\" \"\$@\""
check "a grandchild holds up nothing" timeout 60 bash -c "$own --threads 1 --command ./program.sh --output held.csv 2>&1 | cat"
check "and changes nothing" cmp -s program.csv held.csv
check "and has ended" gone 'sleep 64'

# Only a file is taken for a checkpoint. The device is a copy in this directory; none can be made without root, or without
# permission to open it.
mkdir kept
is_busy() { [ -n "$(ls "$TMPDIR")" ]; }
checkpoint_of() { $own --checkpoint "$1" --output linked.csv; check "--checkpoint $1: the same bytes" cmp -s whole.csv linked.csv; rm -f linked.csv; }
ln -s kept/nothing dangling
checkpoint_of dangling
check "a dangling link stays" test -L dangling
check "and has no file again" test ! -e kept/nothing
start $own --threads 1 --command ./program.sh --checkpoint dangling --output linked.csv
wait_for test -s kept/nothing
check "the stages are in the link's file" stop KILL
rm -f linked.csv
check "a link with a file: resumed" $own --threads 1 --command ./program.sh --checkpoint dangling --output linked.csv
check "a link with a file: the same bytes" cmp -s program.csv linked.csv
check "the link stays" test -L dangling
check "its file goes" test ! -e kept/nothing
rm -rf "${TMPDIR:?}"/*
if mknod null c 1 3 2>/dev/null && { : >null; } 2>/dev/null; then
  checkpoint_of null
  check "a device stays" test -c null
  start $own --threads 1 --command ./program.sh --checkpoint null --output linked.csv
  wait_for is_busy
  check "a device keeps nothing" stop INT
  check "and nothing else is said: $(cat said.txt)" grep -qx 'own_model: interrupted: no unfinished output is kept' said.txt
  $own --output null
  check "--output to a device has no checkpoint" test ! -e null.checkpoint
  check "and the device stays" test -c null
else echo 'skipped: a device, since none can be made here'; fi
mkfifo fifo
cat fifo >from_fifo.csv &
$own --output fifo
wait $!
check "--output to a pipe" cmp -s whole.csv from_fifo.csv
check "has no checkpoint" test ! -e fifo.checkpoint
$own --output - >printed.csv
check "--output -" cmp -s whole.csv printed.csv
check "has no checkpoint either" test -z "$(find . -name '*.checkpoint')"

# NetCDF: opened before the work, in place with the CSV file.
export STARTED=$work/started
rm -f started
script 'echo x >>"$STARTED"; exit 9'
expect_error 2 'missing/out.nc: cannot be opened for writing' $own --command ./program.sh --output new.csv --netcdf missing/out.nc
check "no call before the outputs are open" test ! -e started
for same in both.csv.checkpoint ./both.csv.checkpoint; do
  expect_error 2 "--netcdf: value '$same': expected another file than the checkpoint" $own --output both.csv --netcdf $same
done
expect_error 2 "--netcdf: value 'both.nc': expected another file than" $own --checkpoint "$work/both.nc" --netcdf both.nc
finish
