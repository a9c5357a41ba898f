#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes everything that the demo needs, on a bare Debian 12: packages, the virtual environment
# .venv with the Python package, and the release build in build/release. Quick when all is there.
# usage: scripts/setup.sh [--tests]   --tests: the same with the tests and what they need
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/packages.sh

tests=OFF
case "${1:-}" in
  "") ;;
  --tests) tests=ON ;;
  *) echo "usage: scripts/setup.sh [--tests]" >&2; exit 2 ;;
esac

# shellcheck disable=SC2086 # lists of words
if [[ $tests == ON ]]; then
  need_packages $build_packages $test_packages
else
  need_packages $build_packages
fi

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
if [[ ! -f build/release/build.ninja || $tests == ON ]]; then
  cmake --preset release -DSOBB_BUILD_TESTS=$tests >/dev/null
fi
cmake --build --preset release
