#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Proves a build: sets up what is missing, builds the release, runs its tests and Python's, and checks
# the format; ten minutes on two cores from nothing. With --all everything that has to pass, which
# continuous integration runs: linters, the wheel, builds inside of other projects, the sanitizers
# and a short fuzz run besides.
# The last line counts tests and checks; the exit code is 0 where none failed.
# usage: scripts/test.sh [--all]
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/packages.sh

all=no
case "$#:${1:-}" in
  0:) ;;
  1:--all) all=yes ;;
  *) echo "usage: scripts/test.sh [--all]" >&2; exit 2 ;;
esac

jobs=$(nproc)
log=$(mktemp)
beside_log=$(mktemp)
trap 'jobs -p | xargs -r kill; rm -f "$log" "$beside_log"' EXIT
passed=0
failed=0

# check NAME COMMAND...: runs one check. Those after it run whatever it came to. Its output stands in
# $log meanwhile; where that counts tests, they are added, else the check counts as one.
check() {
  local name=$1 start=$SECONDS result=passed
  shift
  printf '\n== %s\n' "$name"
  "$@" 2>&1 | tee "$log" || result=FAILED
  count_tests "$result"
  echo "-- $name: $result, $((SECONDS - start)) s"
}

# beside NAME COMMAND...: starts a check that leaves cores idle. It runs beside the checks that follow,
# until finish_beside prints it as check does.
beside() {
  beside_name=$1
  shift
  "$@" >"$beside_log" 2>&1 &
}

finish_beside() {
  local status=0
  wait $! || status=$?
  check "$beside_name" replay "$status"
}

replay() {
  cat "$beside_log"
  return "$1"
}

# Reads the closing line of ctest ("..., 1 tests failed out of 9") or pytest ("1 failed, 8 passed").
count_tests() {
  local ran=0 bad=0 line
  line=$(grep -E '^[0-9]+% tests passed|^[0-9]+ (passed|failed).* in ' "$log" | tail -n 1 || true)
  if [[ $line =~ ([0-9]+)\ tests\ failed\ out\ of\ ([0-9]+) ]]; then
    bad=${BASH_REMATCH[1]}
    ran=${BASH_REMATCH[2]}
  elif [[ -n $line ]]; then
    [[ $line =~ ([0-9]+)\ failed ]] && bad=${BASH_REMATCH[1]}
    [[ $line =~ ([0-9]+)\ passed ]] && ran=$((BASH_REMATCH[1] + bad))
  fi
  if ((ran == 0)); then ran=1; fi
  if [[ $1 == FAILED ]] && ((bad == 0)); then bad=1; fi
  ((passed += ran - bad, failed += bad)) || true
}

build() {
  cmake --preset "$1" >/dev/null && cmake --build --preset "$1"
}

python_tests() {
  .venv/bin/python -m pytest -q python/tests
}

format() {
  git ls-files -z -- '*.c' '*.h' '*.cpp' | xargs -0 .venv/bin/clang-format --dry-run -Werror
}

# Over the sanitizer build's commands, which are clang's own. clang-tidy repeats each file's command
# and counts what it does not show: neither is wanted.
tidy() {
  run-clang-tidy -quiet -j "$jobs" -p build/asan "^$PWD/(lib|capi/src)/" 2>&1 |
    { grep -vE '^clang-tidy(-[0-9]+)? |^[0-9]+ warnings generated|^$' || true; }
}

# Scripts and charts lie outside the package, so they are told its settings.
ruff() {
  .venv/bin/ruff check python &&
    .venv/bin/ruff check --config python/pyproject.toml scripts bench/research &&
    .venv/bin/ruff format --check python &&
    .venv/bin/ruff format --check --config python/pyproject.toml scripts bench/research
}

# The package; python/pyproject.toml says which files.
types() {
  (cd python && ../.venv/bin/mypy)
}

if [[ $all == yes ]]; then
  # shellcheck disable=SC2086 # lists of words
  need_packages $build_packages $test_packages $sanitizer_packages $check_packages
fi
check "release build, g++" scripts/setup.sh --tests --research
use_ccache
beside "Python tests" python_tests # one process, and all cores but one for the rest
check "C++ tests" ctest --preset release -j "$jobs"
check "clang-format" format
if [[ $all == no ]]; then
  finish_beside
  printf '\nLeft out, --all runs them: linters, the wheel, other projects, sanitizers, the fuzzers.\n'
else
  check "ruff" ruff
  check "mypy" types
  check "wheel" scripts/wheel_check.sh
  finish_beside
  check "builds inside of other projects" scripts/guest_check.sh
  check "build without TBB" build no_tbb
  check "C++ tests without TBB" ctest --preset no_tbb -j "$jobs"
  check "sanitizer build, clang" build asan
  check "clang-tidy" tidy
  check "C++ tests under AddressSanitizer and UndefinedBehaviorSanitizer" \
    ctest --preset asan -j "$jobs"
  check "short fuzz run" scripts/fuzz.sh 2
  check "ThreadSanitizer build, clang" build tsan
  check "C++ tests under ThreadSanitizer" ctest --preset tsan -j "$jobs"
fi

printf '\n%d passed, %d failed\n' "$passed" "$failed"
((failed == 0))
