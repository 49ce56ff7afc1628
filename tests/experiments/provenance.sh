#!/usr/bin/env bash
# What a step of the pipeline makes again and what it trusts, the manifest, and the words for a difference.
source "$(dirname "$0")/support.sh"

printf 'name,value\n"a, b",1\nc,2.5\nd,x\n' >expected.csv
difference() { "$source/tools/first_difference" expected.csv "$1"; }
check "equal files" test -z "$(cp expected.csv same.csv; difference same.csv)"
sed 's/2.5/2.6/; s/,x/,y/' expected.csv >cell.csv
check "the first cell, how many and how much" test "$(difference cell.csv)" = \
  'cell.csv: line 3, column value: 2.6, expected 2.5 (2 cells differ, numbers by up to 0.038 relative)'
sed 's/"a, b"/"a; b"/' expected.csv >quoted.csv
check "a comma within quotes" test "$(difference quoted.csv)" = 'quoted.csv: line 2, column name: a; b, expected a, b (1 cells differ)'
head -n 2 expected.csv >short.csv
check "a file that ends early" test "$(difference short.csv)" = 'short.csv: ends after line 2, expected more'
check "the status" test "$(difference short.csv >/dev/null; echo $?)" = 1

# A pipeline of two steps in a tree of its own: in.csv -> mid.csv -> data/generated/out.csv, of which git does not keep mid.csv. The
# programs are scripts that note that they ran; tools/build notes what it was asked for.
unset MAKEFLAGS MFLAGS MAKELEVEL MAKE_GOALS NOTHING_TO_DO
rm -rf data
mkdir -p tree/data/generated tree/tools tree/src/scale tree/src/far tree/experiments tree/build/release/bin && cd tree || exit 1
cp "$source/tools/step" "$source/tools/first_difference" "$source/tools/floating_point.cmake" tools
printf '#!/bin/sh\necho "build $1" >>log.txt\n' >tools/build
cat >build/release/bin/twice <<'END'
#!/bin/sh
# twice --input FILE --times K --output FILE
case $* in
  *--version*) echo "twice 0.1.0"; exit ;;
  *--show-options*) printf 'input="%s"\ntimes=%s\nseed=1\n' "$2" "$4"; exit ;;
esac
echo "run ${0##*/}" >>log.txt
[ ! -e broken ] || exit 3
awk -v k="$4" 'NR == 1 { print; next } { print k * $1 }' "$2" >"$6"
END
sed 's/twice/thrice/' build/release/bin/twice >build/release/bin/thrice
chmod +x tools/build build/release/bin/*
cat >Makefile <<'END'
export MAKE_GOALS := $(MAKECMDGOALS)
STEP = @tools/step "$^"
TIMES := 2
.PHONY: all data/generated/mid.csv data/generated/out.csv
all: data/generated/out.csv
data/generated/mid.csv: in.csv
	$(STEP) $@ build/release/bin/twice --input $< --times $(TIMES) --output $@
data/generated/out.csv: data/generated/mid.csv
	$(STEP) $@ build/release/bin/thrice --input $< --times 3 --output $@
END
printf 'x\n7\n' >in.csv
printf '/// Twice.\n#include <string>\nconst char* home();\ndouble twice(double x, int k);\n' >src/scale/twice.hpp
printf '#include "scale/twice.hpp"\nconst char* home() { return "http://one"; }\ndouble twice(double x, int k) { return k * x; }\n' >src/scale/twice.cpp
printf '#pragma once\n' >src/far/far.hpp
printf '#include "scale/twice.hpp"\nint main() { return 0; }\n' >experiments/twice.cpp
printf 'int main() { return 0; }\n' >experiments/thrice.cpp
printf 'build/\nsaid.txt\nlog.txt\nbroken\ndata/generated/mid.csv\n' >.gitignore

# made WHAT STEPS [MAKE_ARGUMENTS...]: make ends with status 0 and has run these steps, each after its build.
made() {
  local what=$1 expected=$2 status; shift 2
  [ $# != 0 ] || set -- data/generated/out.csv
  : >log.txt
  make "$@" >said.txt 2>&1; status=$?
  check "$what: status $status, $(tail -n 1 said.txt)" test $status = 0
  check "$what: $(tr '\n' ';' <log.txt), expected $expected" \
    test "$(cat log.txt)" = "$(for step in $expected; do printf 'build %s\nrun %s\n' "$step" "$step"; done)"
}
result() { sed -n 2p data/generated/out.csv; }
made "the first time" "twice thrice"
check "the result" test "$(result)" = 42
made "the second time" ""
check "a record has command, version, options, inputs and outputs" test "$(grep -c '^twice,' data/generated/manifest.csv)" = 8
git init -q . && git add -A && git -c user.name=t -c user.email=t commit -qm t

fresh() { cd "$work" && rm -rf clone && git clone -q tree clone && cp -r tree/build clone && cd clone || exit 1; }
fresh
made "a fresh clone trusts what is committed" ""
check "and stays clean" test -z "$(git status --porcelain)"
check "and does without what is not committed" test ! -e data/generated/mid.csv
made "what is named is made" "twice" data/generated/mid.csv
fresh
made "all that is missing is made for all" "twice" all
check "the same manifest" test -z "$(git status --porcelain)"
made "make -B makes everything again" "twice thrice" -B all
check "to the same bytes" test -z "$(git status --porcelain)"
fresh
printf '// A note.\n#include <string>\n\nconst char* home();  /* where "it" is */\ndouble twice(double x,\n             int k);\n' >src/scale/twice.hpp
printf 'struct New {};\n' >>src/far/far.hpp
made "comments, formatting and code that the program does not include" ""
sed -i 's|//one|//two|' src/scale/twice.cpp
made "a string of what implements an included header" "twice"
fresh
echo 'int other() { return 1; }' >>experiments/thrice.cpp
made "a step whose input is not there has it made first" "twice thrice"
fresh
sed -i 's/-ffp-contract=off/-ffp-contract=fast/' tools/floating_point.cmake
made "flags of the compiler" "twice thrice"
fresh
printf 'x\n5\n' >in.csv
made "another input" "twice thrice"
check "another result" test "$(result)" = 30
fresh
made "another option" "twice thrice" TIMES=1 data/generated/out.csv
check "its result" test "$(result)" = 21
fresh
printf 'y\n1\n' >data/generated/out.csv
NOTHING_TO_DO=1 make data/generated/out.csv >said.txt 2>&1
check "NOTHING_TO_DO says what would be made: $(head -n 1 said.txt)" \
  grep -qF 'thrice would be made again: data/generated/out.csv is not what the step has made' said.txt
made "an output that is another" "twice thrice"
check "is put right" test -z "$(git status --porcelain)"
touch broken; printf 'x\n9\n' >in.csv
check "a failure ends make" test "$(make data/generated/out.csv >said.txt 2>&1; echo $?)" = 2
rm broken
made "and is not recorded" "twice thrice"
printf '#include "scale/gone.hpp"\n' >>src/scale/twice.cpp
make data/generated/out.csv >said.txt 2>&1
check "an include that is not there: $(head -n 1 said.txt)" grep -qF 'src/scale/twice.cpp: the included file "scale/gone.hpp" is not there' said.txt

# The committed files against the manifest.
fresh
checked() { tools/step --check; }
check "all agree: $(checked)" test "$(checked | tail -n 1)" = 'manifest: all 2 files agree'
sed -i 's/42/43/' data/generated/out.csv
check "the file, by how much, and its command: $(checked)" test "$(checked | grep -A 1 '^data')" = \
  "$(printf 'data/generated/out.csv: line 2, column x: 43, expected 42 (1 cells differ, numbers by up to 0.023 relative)\n  made by: build/release/bin/thrice --input data/generated/mid.csv --times 3 --output data/generated/out.csv')"
check "the status of a difference" test "$(checked >/dev/null; echo $?)" = 1
git checkout -q . && rm in.csv
check "a file that is missing" grep -qxF 'in.csv: missing; the manifest has it' <<<"$(checked)"
git checkout -q . && sed -i 's/k \* x/x * k/' src/scale/twice.cpp
check "sources that have changed" grep -qxF \
  'twice: the sources of the program have changed since it made data/generated/mid.csv' <<<"$(checked)"
rm data/generated/manifest.csv
check "no manifest" test "$(checked 2>&1)" = 'data/generated/manifest.csv: no such file; make all writes it'

# The committed manifest holds every committed generated file.
listed=$(awk -F, '$2 == "output" { print $3 }' "$source/data/generated/manifest.csv" | sort)
for file in $(cd "$source" && ls data/generated/*.csv data/generated/*.md figures/*.pdf figures/*.png paper/report.pdf paper/generated/values.tex); do
  case $file in data/generated/manifest.csv | data/generated/environment.csv) continue ;; esac  # not results
  check "$file in the manifest" grep -qxF "$file" <<<"$listed"
done
check "the seeds" grep -qx 'replicated_study,option,seed,1' "$source/data/generated/manifest.csv"
finish
