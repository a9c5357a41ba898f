#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Line coverage of lib/ and capi/ by the tests, C++ and Python: a table of the files, with the total
# in its last line. A line counts as run where any instruction set's kernel ran it. Fails where a
# test fails, and below 90 %.
# usage: scripts/coverage.sh [--lines FILE]   --lines: that file's lines with their counts besides
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/packages.sh

least=90
file=
case "$#:${1:-}" in
  0:) ;;
  2:--lines) file=$2 ;;
  *) echo "usage: scripts/coverage.sh [--lines FILE]" >&2; exit 2 ;;
esac

scripts/setup.sh --tests --research >/dev/null
# shellcheck disable=SC2086 # lists of words
need_packages $sanitizer_packages $coverage_packages

build=build/coverage
cmake --preset coverage >/dev/null
cmake --build --preset coverage

# One file of counts for each program and library, merged by all processes that run it.
counts=$PWD/$build/counts
rm -rf "$counts"
export LLVM_PROFILE_FILE=$counts/%m.profraw
ctest --preset coverage -j "$(nproc)" --output-log $build/tests.log >/dev/null ||
  { tail -n 20 $build/tests.log; exit 1; }
SOBB_LIBRARY_PATH=$build/lib .venv/bin/python -m pytest -q python/tests
llvm-profdata merge -o $build/all.profdata "$counts"/*.profraw

# What was compiled, as llvm-cov wants it: the first by itself, the others with -object.
objects=("$build"/lib/libsobb.so)
for object in "$build"/lib/libsobb_scene.so "$build"/bin/test_*; do objects+=(-object "$object"); done
sources=()
for folder in lib/{base,bounds,builder,format,scene,trace} capi/src; do
  sources+=("$PWD/$folder")
done
report() { llvm-cov "$1" "${objects[@]}" -instr-profile=$build/all.profdata "${@:2}"; }

if [[ -n $file ]]; then
  report show "$PWD/$file"
fi
# Columns 8 to 10 are lines, lines missed and the percentage.
report report "${sources[@]}" |
  awk -v least="$least" '
    /\.(cpp|h) / { printf "%-40s %6d lines %6d missed %8s\n", $1, $8, $9, $10 }
    /^TOTAL/ {
      printf "%-40s %6d lines %6d missed %8s\n", "total", $8, $9, $10
      exit $10 + 0 < least
    }'
