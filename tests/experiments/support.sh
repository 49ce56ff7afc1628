# Shared by the end-to-end tests: arguments BIN_DIR SOURCE_DIR, a scratch directory, and checks that count.
set -u
bin=$1 source=$2
work=$(mktemp -d)
trap 'chmod -R u+w "$work"; rm -rf "$work"' EXIT
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

finish() {
  echo "$passed passed, $failed failed"
  [ $failed = 0 ] && [ $passed -gt 0 ]
}
