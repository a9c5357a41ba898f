#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Installs the Python package as a user does, into a new virtual environment, and proves that it
# works with NumPy alone, on the libraries and programs that it brought; that the source
# distribution has every source that these need, and no more; and that the wheel has no other
# program.
set -euo pipefail
cd "$(dirname "$0")/.."
source scripts/packages.sh
use_ccache

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
# With the flags of the release build the compilers' cache has all objects.
"$folder/venv/bin/pip" wheel --quiet --disable-pip-version-check --no-deps \
  --config-settings=cmake.define.SOBB_WERROR=ON --wheel-dir "$folder" ./python
"$folder/venv/bin/pip" install --quiet --disable-pip-version-check "$folder"/sobb-*.whl build
"$folder/venv/bin/python" -m build --sdist --outdir "$folder" python >/dev/null

# The studies, their charts and the tests of bench/research stay at home.
git ls-files bench capi cmake lib CMakeLists.txt LICENSE THIRD_PARTY_NOTICES.md python \
  ':!bench/research/'{charts,study,study_charts.py,tests} |
  sed 's|^python/|/|' | sort >"$folder/sources"
tar --list --file "$folder"/sobb-*.tar.gz | grep -v '/$' | sed 's|^[^/]*||; s|^/native/||' |
  grep -vx /PKG-INFO | sort >"$folder/shipped"
diff "$folder/sources" "$folder/shipped" ||
  { echo "< is not in the source distribution, > is there in vain" >&2; exit 1; }

size=$(stat --format %s "$folder"/sobb-*.whl)
echo "the wheel has $size bytes"
((size <= 6 << 20)) || { echo "more than 6 MiB" >&2; exit 1; }

package=$("$folder/venv/bin/python" -c 'import sobb; print(sobb.__path__[0])')
[[ $(ls "$package/native/bin" | xargs) == "sobb_bench sobb_bench_volumes" ]]
git ls-files python/sobb | while read -r file; do
  [[ -f $package/${file#python/sobb/} ]] || { echo "not in the wheel: $file" >&2; exit 1; }
done

cd "$folder" # where no checkout is found
venv/bin/python - <<'PYTHON'
import importlib.metadata
from pathlib import Path

import numpy as np

import sobb
from sobb.tools.shared.bench import find_program

assert importlib.metadata.version("sobb") == sobb.version()
with sobb.Scene.load("builtin:city:3000") as scene:
    hierarchy = sobb.build(scene, quality="low")
rays = np.zeros(100, sobb.ray_dtype)
rays["origin"][:, 1] = 100
rays["direction"] = (0, -1, 0)
rays["tmax"] = np.inf
assert (hierarchy.intersect(rays)["primitive"] < sobb.INVALID).all()

native = Path(sobb.__file__).parent / "native"
carried = {file.name for file in (native / "lib").iterdir()}
lines = Path("/proc/self/maps").read_text().splitlines()
loaded = {Path(line.split()[-1]) for line in lines if ".so" in line}
found = {file for file in loaded if file.name in carried}
assert {file.parent for file in found} == {native / "lib"}, sorted(found)
names = sorted(file.name.split(".so")[0] for file in found)
for start in ("libsobb_scene", "libtbb", "libtinygltf", "libOpenMeshCore"):
    assert any(name.startswith(start) for name in names), names
for start in ("libembree", "libhwy", "libxxhash"):
    assert not any(name.startswith(start) for name in carried), sorted(carried)
assert find_program("sobb_bench").parent == native / "bin"
assert len((native / "commit").read_text().strip().rstrip("+")) == 40
print("loaded from the wheel:", *names)
PYTHON
venv/bin/python -m sobb info builtin:city:3000 >/dev/null
venv/bin/python -m sobb build builtin:city:3000 -o city.sobb
if venv/bin/python -m sobb render city.sobb -o city.png 2>message; then
  echo "a picture without Pillow?" >&2
  exit 1
fi
grep -F 'sobb[commands]' message
for program in "$package"/native/bin/*; do
  "$program" --help >/dev/null
done
