#!/usr/bin/env bash
# docs/errors.md, row by row, for every executable that a row applies to: status, one line on stderr, and no file changed.
source "$(dirname "$0")/support.sh"

make_small_inputs
: >empty.csv
mkdir directory
mkfifo fifo
printf 'a,b\n' >header.csv
printf 'a;b\n1;2\n' >semicolons.csv
printf '\377\376a\0,\0b\0\n\0' >utf16.csv
printf 'a,b\n1\n' >short.csv
printf 'a,b\n1,2,3\n' >long.csv
printf 'a,b\n1,2\n' >other.csv
printf '# rig 2\na,b\n1,2\n' >comment.csv
printf 'a,b\n1,2\n# rig 2\n' >between.csv
printf ',a\n0.5,2\n' >unnamed.csv
echo parameter,friction_force,natural_frequency >correlation.csv
printf '[run]\nsede = 1\n' >unknown.toml
printf '[run]\nseed = "one"\n' >type.toml
printf '[run]\nseed =\n' >syntax.toml
printf '#!/no/such/sh\n' >interpreter.sh && chmod +x interpreter.sh
{ timeout -s KILL 1 "$bin/replicated_study" $small --studies 100000 --output kept.csv; } 2>/dev/null

# The first line of a file that the option takes, and a row of abc.
make_bad() {  # EXECUTABLE OPTION
  local from
  case $1$2 in
    *--prior-correlation) from=correlation.csv ;;
    own_model--*) from=$(grep -oE -- "$2 CSV=[^ ]+" "help/$1" | cut -d= -f2) ;;
    *--observations) from=data/published/table1_observations.csv ;;
    *--prior) from=data/published/table2_prior.csv ;;
    *--points) from=points.csv ;;
    *--runs-input) from=data/generated/sampling_study_runs.csv ;;
    *--samples-input) from=data/generated/sampling_study_samples.csv ;;
    *--replicated) from=data/generated/replicated_study.csv ;;
    *) from=$(grep -oE -- "$2 CSV=[^ ]+" "help/$1" | cut -d= -f2) ;;
  esac
  { head -1 "$from"; head -1 "$from" | sed 's/[^,]*/abc/g'; } >bad.csv
}

has_form() {  # TEXT FORM: in the form a * is any text
  local form=${2//\\/\\\\}
  form=${form//\[/\\[}; form=${form//\?/\\?}
  [[ $1 == $form ]]
}

# complain STATUS MESSAGE COMMAND: compares what the command does with the row.
complain() {
  local status=$1 message=$2 command=$3 got
  case $status in
    SIG*) interrupt "${status%% *}" "$command"; got="${status%% *} ($?)" ;;
    *) eval "$command" >out 2>err; got=$? ;;
  esac
  mapfile -t said <err
  if [ "$got" != "$status" ]; then fail "status $got, expected $status: $command: $(head -c 300 err)"
  elif [ ${#said[@]} != 1 ]; then fail "${#said[@]} lines, expected 1: $command: $(head -c 300 err)"
  elif has_form "${said[0]}" "$message"; then pass
  else fail "$command: '${said[0]}', expected '$message'"; fi
}

# interrupt SIGNAL COMMAND: sends the signal once the program handles it; one that writes to the fifo waits for a reader.
interrupt() {
  local pid program=${2%% *} tries=0
  set -m
  eval "exec $2" >out 2>err &
  pid=$!
  set +m
  until [ "$(readlink "/proc/$pid/exe")" = "$program" ] && grep -qs '^SigCgt:.*[2367abef]$' "/proc/$pid/status"; do
    [ $((tries += 1)) -lt 1000 ] || break
    sleep 0.02
  done
  case $2 in *on.csv*) until [ "$(wc -l <on.csv.journal)" -ge 2 ] || [ $((tries += 1)) -gt 1000 ]; do sleep 0.02; done ;; esac
  kill -s "${1#SIG}" $pid
  while kill -0 $pid 2>/dev/null && [ $((tries += 1)) -lt 3000 ]; do sleep 0.02; done
  kill -KILL $pid 2>/dev/null
  wait $pid 2>/dev/null
}

snapshot() { find . -type f ! -name bad.csv ! -name out ! -name err ! -path './on.csv*' -exec sha256sum {} + | sort -k 2; }
options_of() { sed -nE "s/^  (--[a-z0-9-]+) $2.*/\1/p" "help/$1"; }  # EXECUTABLE TYPE
# without OPTIONS COMMAND: the options, each with one value, that the command does not give itself
without() {
  local option value
  set -- "$2" $1
  local command=" $1 "; shift
  while [ $# -gt 0 ]; do
    option=$1 value=$2; shift 2
    case $command in *" $option "*) ;; *) printf '%s %s ' "$option" "$value" ;; esac
  done
}

# error, status, command and message of each row, between tabs
sed -nE 's/^\| ([^|]*) \| ([^|]*) \| `([^`|]*)` \| `([^`|]*)` \|$/\1\t\2\t\3\t\4/p' "$source/docs/errors.md" >rows
check "every row of the table is read" test "$(wc -l <rows)" = "$(grep -c '^| [^|]* | [^|]*`\|^| [^|]* | [0-9S]' "$source/docs/errors.md")"
check "there are rows" test "$(wc -l <rows)" -ge 25
mkdir help
declare -A needs applied
for e in $(executables); do
  "$bin/$e" --help >"help/$e"
  needs[$e]=$(small_options "$e")
done
snapshot >../before.$$

while IFS=$'\t' read -r error status command message; do
  for e in "${!needs[@]}"; do
    first=${command%% *} option='' arguments=${needs[$e]}
    case $first in PROGRAM) ;; "$e") [ "$first" != "$command" ] || arguments='' ;; *) continue ;; esac
    [ "$e $command" != 'own_model PROGRAM word' ] || continue
    [[ $command =~ --[A-Za-z-]+ ]] && option=${BASH_REMATCH[0]}
    case $option in
      --CSV) options=$(options_of "$e" CSV) ;;
      --FILE) options=$(options_of "$e" FILE) ;;
      --no-such-option | '') options=- ;;
      *) grep -qE -- "^  $option( |$)" "help/$e" || continue; options=- ;;
    esac
    text=${message//PROGRAM/$e}
    case $status in SIG*) ;; *) text="$e: error: $text" ;; esac
    for o in $options; do
      line=${command#"$first"}
      line=${line/--CSV/$o}; line=${line/--FILE/$o}
      case $line in *bad.csv*) make_bad "$e" "$o" ;; esac
      case "$e$line" in corner*other.csv) continue ;; esac  # any columns are parameters
      complain "$status" "$text" "$bin/$e $(without "$arguments" "$line")$line"
      applied[$error]=1
    done
  done
done <rows
while IFS=$'\t' read -r error _; do check "'$error' applies to an executable" test -n "${applied[$error]-}"; done <rows
check "no file was changed" cmp -s ../before.$$ <(snapshot)
check "/dev/full is still a device" test -c /dev/full
check "no temporary file is left" test -z "$(find . -name '*.part')"
rm -f ../before.$$
finish
