#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Fuzzes the reader, the kernels and every importer (tests/fuzz/README.md) with libFuzzer under
# AddressSanitizer and UndefinedBehaviorSanitizer. What crashes, hangs or takes too much memory is
# kept in build/fuzz/crashes; the exit code is 0 where nothing did.
# usage: scripts/fuzz.sh [SECONDS [TARGET...]]   SECONDS for each target, 10 by default
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/packages.sh

seconds=${1:-10}
if [[ ! $seconds =~ ^[1-9][0-9]*$ ]]; then
  echo "usage: scripts/fuzz.sh [SECONDS [TARGET...]]" >&2
  exit 2
fi
shift || true
targets=("$@")
((${#targets[@]})) || targets=(open open_mended trace obj ply stl off gltf glb views)

# shellcheck disable=SC2086 # lists of words
need_packages $build_packages $test_packages $sanitizer_packages
use_ccache
cmake --preset asan >/dev/null
cmake --build --preset asan --target "${targets[@]/#/fuzz_}"

# Seeds are read only; what is found on the way stays in build/fuzz/corpus, for the next run.
seeds_of() {
  case $1 in
    open | open_mended | trace) echo tests/fuzz/corpus/sobb ;;
    *) echo "tests/fuzz/corpus/$1" ;;
  esac
}

log=$(mktemp)
trap 'rm -f "$log"' EXIT
inputs=0
crashes=0
mkdir -p build/fuzz/crashes

# One target: counts its inputs, and 1 crash where it ended early.
fuzz() {
  local target=$1 found=build/fuzz/corpus/$1
  local dictionary=tests/fuzz/dictionaries/${1/#glb/gltf}.dict # one JSON, one dictionary
  local options=(-max_total_time="$seconds" -max_len=16384 -timeout=20 -rss_limit_mb=2048
    -print_final_stats=1 -artifact_prefix="build/fuzz/crashes/$target-")
  [[ -f $dictionary ]] && options+=(-dict="$dictionary")
  mkdir -p "$found"
  if ! "build/asan/bin/fuzz_$target" "${options[@]}" "$found" "$(seeds_of "$target")" \
    >"$log" 2>&1; then
    crashes=$((crashes + 1))
    grep -vE '^#[0-9]+\s' "$log" | tail -n 40
  fi
  local ran
  ran=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  inputs=$((inputs + ${ran:-0}))
  echo "$target: ${ran:-0} inputs, $(grep -c . < <(ls "$found")) kept"
}

for target in "${targets[@]}"; do fuzz "$target"; done
((crashes == 0)) || echo "crashing inputs are in build/fuzz/crashes"
echo "targets ${#targets[@]}, inputs $inputs, crashes $crashes"
((crashes == 0))
