#!/usr/bin/env bash
# The replication report: its numbers are generated, and the check of that, and of the log of LaTeX, can fail.
source "$(dirname "$0")/support.sh"

# The numbers of the committed report come out of the committed tables.
"$bin/report_values" --values "$source/paper/values.csv" --tables "$source/paper/tables.csv" --paper "$source/paper" \
  --generated "$source/data/generated" --published "$source/data/published" --quiet --output values.tex
check "report_values ends with 0" test $? = 0
check "the committed values are these" cmp -s <(tail -n +2 values.tex) <(tail -n +2 "$source/paper/generated/values.tex")

expect_error 2 "missing.csv" "$bin/report_values" --values missing.csv --output values.tex
printf 'key,file,where,column,statistic,format\nk,generated/x.csv,,a,sum,\n' >list.csv
printf 'key,file,where,columns\nt,generated/x.csv,,a\n' >tables.csv
expect_error 2 "x.csv" "$bin/report_values" --values list.csv --tables tables.csv --output values.tex

# tools/check_report: the committed text passes; each of these changes to it does not.
fresh() { rm -rf paper && cp -r "$source/paper" paper; }
changed() {  # COMMAND WHAT FILE SED_SCRIPT TEXT: after the change to FILE the command fails and names TEXT
  fresh
  sed -i "$4" "paper/$3"
  check "$2: the change was made" test "$(cmp -s "paper/$3" "$source/paper/$3"; echo $?)" = 1
  $1 >out 2>&1
  check "$2 fails" test $? = 1
  check "$2 is named: $(head -n 2 out)" grep -qF -- "$5" out
}
inspect() { "$source/tools/check_report" paper; }
refused() { changed inspect "$@"; }
fresh
check "the text has no number typed by hand" inspect
refused "a number" sections/audit.tex '$s/$/ The force is 0.982 N./' "'0.982' is typed by hand"
refused "a single digit" sections/audit.tex '$s/$/ It takes $5$ steps./' "'5' is typed by hand"
refused "a number in words" sections/audit.tex '$s/$/ It takes five steps./' "'five' is typed by hand"
refused "a number in a caption" sections/cost.tex 's/\\caption{/\\caption{All 100 studies. /' "'100' is typed by hand"
refused "a number in an equation" sections/model.tex 's/\\sgn x/37\\sgn x/' "'37' is typed by hand"
refused "a decimal in an equation" sections/model.tex 's/\\sgn x/0.4\\sgn x/' "'0.4' is typed by hand"
refused "a long number in a derivation" sections/identity.tex 's/\$\\CoV=1\$/$\\CoV=1.05$/' "'1.05' is typed by hand"
refused "a value that is not listed" sections/audit.tex '$s/$/ \\val{no-such-value}/' "'no-such-value' is in none of the lists"
refused "a value that is not used" values.csv '$a unused,generated/x.csv,,a,sum,' "'unused' is not used"
refused "a constant that is not used" constants.txt '$a N+17\tunused' "'N+17' does not occur"
refused "a constant without a reason" constants.txt '$a 0.982 N' 'expected LITERAL, a tab and the reason'
refused "a constant that is a number alone" constants.txt '$a 0.982\twish' 'expected LITERAL, a tab and the reason'
fresh
sed -i '$s/$/ % 0.982 in a comment/' paper/sections/audit.tex
check "a number in a comment is none" inspect

# tools/build_report: the same bytes elsewhere; LaTeX's warnings are errors, and the PDF stays as it was.
if ! command -v pdflatex >/dev/null; then
  echo "pdflatex is not installed: the typesetting is not tested"
  finish
  exit
fi
build() { "$source/tools/build_report" paper/generated figures report.pdf; }
fresh
cp -r "$source/figures" figures
build >out 2>&1
check "the report is typeset: $(head -n 3 out)" test -s report.pdf
check "the committed report is this, byte by byte" cmp -s report.pdf "$source/paper/report.pdf"
cp report.pdf before.pdf
spoiled() {
  changed build "$@"
  check "$1 leaves the PDF" cmp -s report.pdf before.pdf
}
spoiled "a dangling reference" sections/audit.tex '$s/$/ \\ref{sec:none}/' "sec:none"
spoiled "an unknown citation" sections/audit.tex '$s/$/ \\citep{Nobody2000}/' "Nobody2000"
spoiled "an overfull box" sections/audit.tex '$s/$/ \\mbox{\\rule{100mm}{1pt}}/' "Overfull"
spoiled "a missing value" sections/audit.tex '$s/$/ \\val{no-such-value}/' "no-such-value"
spoiled "a missing figure" sections/cost.tex 's/fig7_pbox_floor/fig0_none/' "fig0_none"
spoiled "a bitmap font" sections/audit.tex '$s/$/ {\\fontfamily{cmtt}\\selectfont text}/' "Type 1"
finish
