# SPDX-License-Identifier: Apache-2.0
"""The sweep that the tests of sweeps run: twelve small cases."""

import pytest

SWEEP = """
scenes = ["builtin:city:500", "builtin:pipes:500", "builtin:terrain:500"]
methods = ["aabb", "sobb", "embree", "obb"]
rays = ["primary"]
size = 8
repetitions = 2
min_time = 0.001
"""


@pytest.fixture
def toml(tmp_path):
    path = tmp_path / "sweep.toml"
    path.write_text(SWEEP)
    return path
