#!/usr/bin/env bash
# The replication report: its numbers are generated, and the check of that, and of the log of LaTeX, can fail.
source "$(dirname "$0")/support.sh"

# The numbers of the committed report come out of the committed tables.
values() { "$source/tools/report_values" values.tex; }
mkdir paper && cp "$source"/paper/*.csv paper && cp -r "$source/data/generated" data/generated
values
check "report_values ends with 0" test $? = 0
check "the committed values are these" cmp -s values.tex "$source/paper/generated/values.tex"

# Each equation of the paper is where the appendix says.
check "the functions of the equations exist" python3 - "$source" <<'END'
import csv, os, re, sys
rows = list(csv.DictReader(open(f'{sys.argv[1]}/paper/equations.csv', encoding='utf-8')))
numbers = set()
for row in rows:
    text = open(os.path.join(sys.argv[1], row['file']), encoding='utf-8').read()
    code = re.sub(r'//[^\n]*', '', text)
    if not re.search(rf"\b{row['function']}\b *[({{]|class {row['function']}\b", code):
        sys.exit(f"{row['file']}: no function '{row['function']}' of {row['equation']}")
    bounds = [int(n) for n in re.findall(r'\d+', row['equation'])]
    if row['equation'][0].isdigit():
        numbers.update(range(bounds[0], bounds[-1] + 1) if ' to ' in row['equation'] else bounds)
missing = set(range(1, 26)) - numbers
sys.exit(f'equations {sorted(missing)} are in no row' if missing else 0)
END

# Values and tables of small lists, and what is refused in them.
value_header='key,file,where,column,statistic,format' table_header='key,file,where,columns'
printf '%s\n' sampler,run,area,low,word A,0,1,0.5,first_one A,1,2,0.5,x A,2,6,0.25,x 'B,0,4,nan,"100 %, P(F_mu > 1) & chi^2"' \
  >data/generated/data.csv
lists() {  # VALUES TABLES: rows of the lists
  { echo "$value_header"; printf '%b\n' "$1"; } >paper/values.csv
  { echo "$table_header"; printf '%b\n' "$2"; } >paper/tables.csv
}
good_value='g,generated/data.csv,,area,sum,' good_table='t,generated/data.csv,,area'
is() {  # TEX ROWS: the last of these values
  lists "$2" "$good_table"
  values 2>err.txt
  check "$2: $(grep reportvalue values.tex | tail -n 1) $(cat err.txt), expected $1" \
    test "$(sed -n 's/^\\reportvalue{k}{\(.*\)}$/\1/p' values.tex)" = "$1"
}
while read -r statistic expected; do is "$expected" "k,generated/data.csv,sampler=A,area,$statistic,"; done <<'END'
count 3.00
sum 9.00
mean 3.00
sd 2.65
min 1.00
max 6.00
median 2.00
q025 1.05
q975 5.80
END
is 6.00 'k,generated/data.csv,sampler=A;run=2,area,value,'
is 4.00 'k,generated/data.csv,sampler!=A,area,value,'
is 1.00 'k,generated/data.csv,word=first*,area,value,'
is 5.75 'k,generated/data.csv,low!=nan,low - area,max_abs,'
is '\ensuremath{-0.500}' 'k,generated/data.csv,low!=nan,low - area,max,'
is '100 \%, P($F_\mu$ \textgreater{} 1) \& $\chi^2$' 'k,generated/data.csv,sampler=B,word,value,text'
is '\columnname{first_one}' 'k,generated/data.csv,run=0;sampler=A,word,value,name'
two='a,generated/data.csv,sampler=A,area,mean,f0\nb,generated/data.csv,sampler=A,area,sd,f0\n'
is 1.134 "${two}k,,,a b,ratio,s4"
is 5.646 "${two}k,,,a b,sum,s4"
is 0.3542 "${two}k,,,a b,difference,s4"
is 7.937 "${two}k,,,a b,product,s4"
is no "${two}k,,,a b,less,"
is yes "${two}k,,,b a,less,"

# Formats: number, format, TeX.
while read -r number format expected; do
  printf 'x\n%s\n' "$number" >data/generated/one.csv
  is "$expected" "k,generated/one.csv,,x,value,${format#none}"
done <<'END'
0.99618 none 0.996
0.12 none 0.120
13.369 none 13.4
400.4 none 400
0.081514 s4 0.08151
0.9996 s3 1.00
9.96 s2 10
0 none 0
1.0358504 f3 1.036
2 f0 2
-1.5729 none \ensuremath{-1.57}
-0.004 f1 0.0
1.629e-6 s2 \ensuremath{1.6\times10^{-6}}
-1e10 s1 \ensuremath{-1\times10^{10}}
0.00012345 none 0.000123
0.000099996 s3 0.000100
999999 s3 \ensuremath{1.00\times10^{6}}
123456 s3 123\,456
1000 integer 1000
31000 integer 31\,000
1234567 integer 1\,234\,567
-20000 integer \ensuremath{-20\,000}
0.8469 percent 84.7
0.0753 percent2 7.5
END
lists "$good_value" 't,generated/data.csv,run=0,sampler:text area:integer low:f1'
values
check "a table has the rows in the order of the file" test "$(tail -n 4 values.tex)" = \
  "$(printf '\\reporttable{t}{%%\nA & 1 & 0.5 \\\\\nB & 4 & -- \\\\\n}')"

refused_list() {  # TEXT VALUES TABLES
  lists "$2" "$3"
  expect_error 2 "$1" "$source/tools/report_values" values.tex
}
refused_value() { refused_list "$1" "$2" "$good_table"; }
refused_value "values.csv:2: column 'key': value 'K'" 'K,generated/data.csv,,area,sum,'
refused_value "values.csv:3: column 'key'" "$good_value\n$good_value"
refused_value "column 'file': value 'elsewhere/data.csv'" 'k,elsewhere/data.csv,,area,sum,'
refused_value "column 'where': value 'sampler'" 'k,generated/data.csv,sampler,area,sum,'
refused_value "column 'where': value 'sampler=C'" 'k,generated/data.csv,sampler=C,area,sum,'
refused_value "one row meets, not 3" 'k,generated/data.csv,sampler=A,area,value,'
refused_value "column 'statistic': value 'mode'" 'k,generated/data.csv,,area,mode,'
refused_value "column 'statistic': value 'sum'" 'k,generated/data.csv,,word,sum,text'
refused_value "column 'format': value 'roman'" 'k,generated/data.csv,,area,sum,roman'
for format in s0 s16 s s2x f-1 digits; do refused_value "column 'format': value '$format'" "k,generated/data.csv,,area,sum,$format"; done
refused_value "an integer for the format 'integer'" 'k,generated/data.csv,sampler=A,low,max,integer'
refused_value "column 'column': value 'a b'" 'k,,,a b,sum,'
refused_value "column 'statistic': value 'power'" "$good_value\nk,,,g g,power,"
refused_value "column 'statistic': value 'less'" 'a,generated/data.csv,sampler=B,word,value,text\nk,,,a a,less,'
refused_value "column 'format'" 'a,generated/data.csv,sampler=B,run,value,\nk,,,a a,ratio,'
refused_value "data.csv:5: column 'low': value 'nan': expected a finite number" 'k,generated/data.csv,,low,sum,'
refused_value "data.csv:2: column 'word': value 'first_one': expected a number" 'k,generated/data.csv,,word,sum,'
refused_value "none.csv: cannot be read: No such file or directory" 'k,generated/none.csv,,low,sum,'
refused_value "data.csv:1: expected a column 'height'" 'k,generated/data.csv,,height,sum,'
refused_list "column 'columns'" "$good_value" 't,generated/data.csv,,'
refused_list "column 'columns': value 'area:roman'" "$good_value" 't,generated/data.csv,,area:roman'
printf 'a,b\n1\n' >data/generated/short.csv
refused_value "short.csv:2: expected 2 cells, as in the header, not 1" 'k,generated/short.csv,,a,sum,'
rm paper/values.csv
expect_error 2 "paper/values.csv: cannot be read" "$source/tools/report_values" values.tex

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
