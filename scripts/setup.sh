#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes everything that the demo needs, on a bare Debian 12 or 13: packages, the virtual environment
# .venv with the Python package, and the release build in build/release. Quick when all is there.
# usage: scripts/setup.sh [--tests] [--research]
#   --tests      builds the tests, too
#   --research   builds what `python -m sobb paper` and the studies run, too
# What a build folder once had stays in it.
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/packages.sh

packages=$build_packages
settings=()
# A new build folder: without what nobody asks for.
[[ -f build/release/build.ninja ]] || settings=(-DSOBB_BUILD_TESTS=OFF -DSOBB_BUILD_RESEARCH=OFF)
for option in "$@"; do
  case "$option" in
    --tests)
      packages+=" $test_packages"
      settings+=(-DSOBB_BUILD_TESTS=ON)
      ;;
    --research) settings+=(-DSOBB_BUILD_RESEARCH=ON) ;;
    *)
      echo "usage: scripts/setup.sh [--tests] [--research]" >&2
      exit 2
      ;;
  esac
done
# shellcheck disable=SC2086 # a list of words
need_packages $packages

# The stamp says for which pyproject.toml, and which place of the checkout, .venv was made.
stamp=.venv/made-for
made_for="$PWD $(sha256sum <python/pyproject.toml)"
if [[ ! -f $stamp || $(<"$stamp") != "$made_for" ]]; then
  echo "Making .venv"
  python3 -m venv --clear .venv
  .venv/bin/pip install --quiet --disable-pip-version-check -e 'python[test]'
  echo "$made_for" >"$stamp"
fi

use_ccache
((${#settings[@]} == 0)) || cmake --preset release "${settings[@]}" >/dev/null
cmake --build --preset release
