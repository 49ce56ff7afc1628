#!/usr/bin/env bash
# Every executable: --help, --version, --quiet, --output; same bytes with one, two and three threads.
source "$(dirname "$0")/support.sh"

experiments=$(executables)
make_small_inputs

same() {  # NAME FILE FILE: of measurements only the columns before the times repeat
  case $1 in scaling) cmp -s <(cut -d, -f1-7 "$2") <(cut -d, -f1-7 "$3") ;; *) cmp -s "$2" "$3" ;; esac
}

for e in $experiments; do
  check "$e --help" test "$("$bin/$e" --help | grep -c -e --output -e --quiet -e --version)" -ge 3
  check "$e --version" grep -qE '^[a-z0-9_]+ [0-9]+\.[0-9]+\.[0-9]+$' <("$bin/$e" --version)
  options=$(small_options "$e")
  with_threads() { case $("$bin/$e" --help) in *--threads*) echo "--threads $1" ;; esac; }
  "$bin/$e" $options $(with_threads 2) --output "$e.csv" >"$e.report" 2>"$e.err"
  check "$e ends with 0: $(cat "$e.err")" test $? = 0
  check "$e writes its output" test "$(wc -l <"$e.csv")" -ge 2
  check "$e reports" test -s "$e.report"
  check "$e is silent on stderr" test ! -s "$e.err"
  quiet_output=$("$bin/$e" $options --quiet $(with_threads 1) --output "$e.again.csv" 2>&1)
  check "$e --quiet is silent" test -z "$quiet_output"
  check "$e gives the same bytes again, with one thread" same "$e" "$e.csv" "$e.again.csv"
  check "$e --output -, with three threads" same "$e" "$e.csv" <("$bin/$e" $options --quiet $(with_threads 3) --output -)
  check "$e leaves no partial file" test -z "$(find . -name '*.part')"
done

"$bin/sampling_study" $small --seed 2 --quiet --output seed2.csv
check "another seed, another result" test "$(cmp -s data/generated/sampling_study_samples.csv seed2.csv; echo $?)" = 1

# The rows are passed on as they are, with results added; the reference values come from an independent program.
"$bin/evaluate_model" --reading as_published --points "$source/tests/data/phase_discrete_bin.csv" >phase.csv
check "phases" awk -F, 'FNR==NR {p[FNR]=$3; l[FNR]=$4; next}
  FNR==1 {next} {
    if (tolower(p[FNR]) == "nan" ? $3 != "nan" : ($3-p[FNR])^2 > 1e-18) bad=1
    if (($4-l[FNR])^2 > 1e-22) bad=1; n++ }
  END {exit bad || n < 30}' "$source/tests/data/phase_discrete_bin.csv" phase.csv
"$bin/evaluate_model" --reading as_published --points "$source/tests/data/log_likelihood_discrete_bin.csv" >ll.csv
check "log-likelihoods" awk -F, 'FNR==NR {l[FNR]=$5; next}
  FNR==1 {next} {d=($5-l[FNR])/l[FNR]; if (d*d > 1e-18) bad=1; n++} END {exit bad || n < 10}' \
  "$source/tests/data/log_likelihood_discrete_bin.csv" ll.csv

# Area metric, also with unequal numbers of samples: oracles.
area() {  # NAME EXPECTED VALUES... / VALUES...
  local expected=$1 run=0 v; shift
  echo sampler,run,x >area.csv
  for v in "$@"; do [ "$v" = / ] && { run=1; continue; }; echo "s,$run,$v" >>area.csv; done
  "$bin/table3_pbox_area" --input area.csv --quiet --output - | awk -F, -v e="$expected" 'NR==2 {d=$2-e; exit d*d > 1e-24}'
}
check "area 0" area 0 1 2 3 / 1 2 3
check "area 2" area 2 1 / 3 3 3
check "area 4" area 4 1 / 5
check "area 2.5" area 2.5 1 2 3 / 3 3 3 5 6 7
check "area 0.51" area 0.51 1 2.68 7.52 7.73 9.44 3.66 / 1.52 2.98 7.67 8.35 9.99 4.58
check "area 1.266" area 1.266111111111111 1 2.68 7.52 7.73 9.44 3.66 / 3.5 6.9 6.1 2.8 3.5 6.5 0.15 4.5 7.1
finish
