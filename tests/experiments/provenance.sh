#!/usr/bin/env bash
# The manifest of generated files, and the words for a difference.
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

# A tree with one step of the pipeline.
mkdir -p data/generated
printf 'x\n1\n' >data/generated/in.csv
printf 'y\n2\n' >data/generated/out.csv
sum() { sha256sum <"$1" | cut -d' ' -f1; }
{ echo step,role,name,value
  echo 'double,command,,"double in.csv out.csv"'
  echo "double,input,data/generated/in.csv,$(sum data/generated/in.csv)"
  echo "double,output,data/generated/out.csv,$(sum data/generated/out.csv)"; } >manifest.csv
mkdir tools && cp "$source/tools/first_difference" tools
checked() { "$source/tools/check_manifest" manifest.csv; }
check "all agree" test "$(checked)" = 'manifest: all 2 files agree'
printf 'y\n3\n' >data/generated/out.csv
check "the file and its command" test "$(checked | head -n 2)" = \
  "$(printf 'data/generated/out.csv: other bytes than in the manifest\n  made by: double in.csv out.csv')"
git init -q . && printf 'y\n2\n' >data/generated/out.csv && git add data/generated && git -c user.name=t -c user.email=t commit -qm t
printf 'y\n3\n' >data/generated/out.csv
check "by how much, where git has the original" test "$(checked | head -n 1)" = \
  "data/generated/out.csv: line 2, column y: 3, expected 2 (1 cells differ, numbers by up to 0.33 relative)"
rm data/generated/in.csv
check "a file that is missing" test "$(checked | head -n 1)" = 'data/generated/in.csv: missing; the manifest has it'
check "the status of a difference" test "$(checked >/dev/null; echo $?)" = 1
check "no manifest" test "$("$source/tools/check_manifest" none.csv 2>&1)" = 'none.csv: no such file; make all writes it'

# The committed manifest holds every committed generated file.
listed=$(awk -F, '$2 == "output" { print $3 }' "$source/data/generated/manifest.csv" | sort)
for file in $(cd "$source" && ls data/generated/*.csv data/generated/*.md figures/*.pdf figures/*.png paper/report.pdf paper/generated/values.tex); do
  [ "$file" = data/generated/manifest.csv ] || check "$file in the manifest" grep -qxF "$file" <<<"$listed"
done
check "the seeds" grep -q '^replicated_study,option,seed,"1"$' "$source/data/generated/manifest.csv"
finish
