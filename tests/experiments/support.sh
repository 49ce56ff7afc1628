# Shared by the end-to-end tests: arguments BIN_DIR SOURCE_DIR, a scratch directory, and checks that count.
set -u
bin=$1 source=$2
work=$(mktemp -d)
# A child of this shell that a signal ends before it has become a program would run the trap too.
trap 'if [ "$BASHPID" = $$ ]; then chmod -R u+w "$work"; rm -rf "$work"; fi' EXIT
passed=0 failed=0
cd "$work" || exit 1
mkdir -p data && cp -r "$source/data/published" data/published

pass() { passed=$((passed + 1)); }
fail() { failed=$((failed + 1)); printf 'FAIL: %s\n' "$*"; }
check() { local what=$1; shift; if "$@"; then pass; else fail "$what"; fi; }

# expect_error STATUS TEXT COMMAND...: the status, exactly one line on stderr that contains TEXT, and no change to
# any file of the scratch directory.
expect_error() {
  local status=$1 text=$2; shift 2
  find . -type f -exec sha256sum {} + | sort >../before.$$
  "$@" >../out.$$ 2>../err.$$
  local got=$?
  find . -type f -exec sha256sum {} + | sort >../after.$$
  local lines; lines=$(wc -l <../err.$$)
  if [ $got != "$status" ]; then fail "status $got, expected $status: $*: $(head -c 300 ../err.$$)"
  elif [ "$lines" != 1 ]; then fail "$lines lines on stderr, expected 1: $*: $(head -c 300 ../err.$$)"
  elif ! grep -qF -- "$text" ../err.$$; then fail "no '$text' in: $(cat ../err.$$) ($*)"
  elif ! cmp -s ../before.$$ ../after.$$; then fail "files changed: $*"
  else pass; fi
  rm -f ../before.$$ ../after.$$ ../out.$$ ../err.$$
}

executables() { (cd "$source" && ls experiments/*.cpp examples/own_model.cpp bench/scaling.cpp) | sed "s|.*/||; s|\.cpp$||"; }

# Inputs, made by small runs, with which every executable finds what it reads by default.
small="--runs 3 --samples 200"
make_small_inputs() {
  local made=data/generated
  mkdir -p $made
  "$bin/sampling_study" $small --quiet --output $made/sampling_study_samples.csv \
    --runs-output $made/sampling_study_runs.csv --stages-output $made/sampling_study_stages.csv
  "$bin/table3_pbox_area" --quiet --output $made/table3_pbox_area.csv
  "$bin/table4_iteration_counts" --quiet --output $made/table4_iteration_counts.csv
  "$bin/table1_observations" --quiet --output $made/table1_observations.csv
  "$bin/pbox_floor" $small --studies 3 --quiet --output $made/pbox_floor.csv
  "$bin/replicated_study" $small --studies 4 --quiet --output $made/replicated_study.csv
  printf '%s\n' friction_force_n,natural_frequency_hz,phase_noise_deg,frequency_ratio_noise,frequency_ratio \
    0.5,3,2,0.02,0.8 >points.csv
}

# small_options EXECUTABLE: options with which it ends soon.
small_options() {
  case $1 in
    evaluate_model) echo --points points.csv; return ;;
    benchmark_problems) printf -- '--rigs 1 --problem banana --evaluations 2000 ' ;;
    cost_accuracy) printf -- '--family resampling ' ;;
    exact_posterior)
      echo --runs-input data/generated/sampling_study_runs.csv --samples-input data/generated/sampling_study_samples.csv
      return ;;
    forensics) echo --runs 3 --studies 3 --samples 50; return ;;
    readings) echo --runs 3 --studies 3 --samples 50 --tables 500 --only as_published; return ;;
    prior_sensitivity) echo --runs 3; return ;;
    scaling) echo --most-samples 100 --most-threads 1 --repetitions 1; return ;;
  esac
  case $1 in verdicts | fig9_null_distributions) printf -- '--tables 1000 ' ;; esac
  local help; help=$("$bin/$1" --help)
  case $help in *"--runs "*) printf -- '--runs 3 ' ;; esac
  case $help in *"--studies "*) printf -- '--studies 3 ' ;; esac
  case $help in *"--samples "*) printf -- '--samples 200 ' ;; esac
}

finish() {
  echo "$passed passed, $failed failed"
  [ $failed = 0 ] && [ $passed -gt 0 ]
}

# start COMMAND...: in the background, as a process group of its own that listens to signals; output in said.txt
start() {
  set -m
  "$@" >said.txt 2>&1 &
  pid=$!
  set +m
}
# group_runs: whether a process of the group that was started still does. A shell may end before what it has started.
group_runs() { [ -n "$(ps -eo pgid=,stat= | awk -v g=$pid '$1 == g && $2 !~ /^Z/')" ]; }
# stop SIGNAL: to the process group, as the terminal does on Ctrl-C. False if it has not ended five seconds later.
stop() {
  local deadline=$((SECONDS + 5)) ended=0
  kill -s "$1" -- -$pid 2>/dev/null
  while group_runs && [ $SECONDS -le $deadline ]; do sleep 0.02; done
  group_runs && { ended=1; kill -KILL -- -$pid; }
  wait $pid 2>/dev/null; status=$?
  return $ended
}
wait_for() {  # CONDITION...: as long as what was started runs, and at most a minute
  local tries=0
  until "$@" || [ $tries = 3000 ] || ! kill -0 $pid; do sleep 0.02; tries=$((tries + 1)); done
}
