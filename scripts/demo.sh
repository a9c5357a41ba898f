#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# From triangles to pictures, a file and a comparison with Embree, from nothing:
#   scripts/demo.sh [--scene FILE | --scene builtin:NAME[:TRIANGLES][@DEGREES]] [--out DIR]
#                   [--cameras FILE]
# Sets up what it needs first (scripts/setup.sh); by default builtin:hairball into out/demo.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
"$root/scripts/setup.sh"
exec "$root/.venv/bin/python" -m sobb demo "$@"
