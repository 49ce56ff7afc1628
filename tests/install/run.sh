# run.sh BUILD_DIR SOURCE_DIR CMAKE CXX_COMPILER: installs, and builds and runs what a user would, outside the source tree:
# the consumer beside this script, and the program of src/tmcmc/README.md exactly as the page prints it.
set -euo pipefail
build=$1 source=$2 cmake=$3 compiler=$4
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { printf 'FAIL: %s\n' "$*"; exit 1; }
quietly() { "$@" >"$work/log" 2>&1 || { cat "$work/log"; fail "$*"; }; }

quietly "$cmake" --install "$build" --prefix "$work/first"
mv "$work/first" "$work/prefix"  # a package that names its prefix would break
prefix=$work/prefix
foreign=$(find "$prefix" -type f | sed "s|^$prefix/||" |
  grep -vE '^(include/(tmcmc|pbox|friction|portable_math|errors|names|io|models|storage)/(detail/)?[a-z_]+\.hpp|lib(/[^/]*)?/lib(tmcmc|pbox|friction|io|models|storage)\.a|lib(/[^/]*)?/cmake/tmcmc_companion/[a-z_-]+\.cmake|share/doc/tmcmc_companion/LICENSE)$' || true)
[ -z "$foreign" ] || fail "installed, but neither library, header, package file nor licence: $foreign"
cmp -s "$source/LICENSE" "$prefix/share/doc/tmcmc_companion/LICENSE" || fail 'no LICENSE'
if grep -rlFe "$source" -e "$build" -e "$work" --include='*.cmake' "$prefix"; then fail 'package files name this machine'; fi

configure=("$cmake" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_PREFIX_PATH="$prefix")

cp -r "$source/tests/install" "$work/consumer"
quietly "${configure[@]}" -DINCLUDE_DIR="$prefix/include" -S "$work/consumer" -B "$work/consumer/build"
quietly "$cmake" --build "$work/consumer/build" --parallel 2
"$work/consumer/build/friction_posterior"
(cd "$work/consumer/build" && ./components) || fail "the program with components ends with status $?"

page=$source/src/tmcmc/README.md
block() { awk -v fence='```' -v language="$1" '$0 == fence && inside { exit } inside { print } $0 == fence language { inside = 1 }' "$page"; }
mkdir "$work/guide"
block cmake >"$work/guide/CMakeLists.txt"
block cpp >"$work/guide/guide.cpp"
block text >"$work/guide/printed"
for file in CMakeLists.txt guide.cpp printed; do [ -s "$work/guide/$file" ] || fail "no $file in $page"; done
run_guide() {
  "$work/guide/build/guide" >"$work/guide/output" || fail "the program of $page ends with status $?"
  diff "$work/guide/printed" "$work/guide/output" || fail "the program of $page prints something else (>) than the page (<)"
}
quietly "${configure[@]}" -S "$work/guide" -B "$work/guide/build"
quietly "$cmake" --build "$work/guide/build"
run_guide

# For another instruction set: the same output, or no program at all where Eigen's memory differs.
quietly "${configure[@]}" -DCMAKE_CXX_FLAGS=-march=native -S "$work/guide" -B "$work/guide/build"
if "$cmake" --build "$work/guide/build" >"$work/log" 2>&1; then
  run_guide
else
  grep -q 'tmcmc was compiled for another instruction set' "$work/log" || { cat "$work/log"; fail 'no program with -march=native'; }
fi
echo 'installed headers, package and guide: all as they should be'
