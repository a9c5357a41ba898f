# SPDX-License-Identifier: Apache-2.0
"""Two files of results compared: verdicts, exit codes, cases that only one has."""

import json

import numpy as np
import pytest

pytest.importorskip("duckdb")

import example_results  # noqa: E402

from sobb.tools.compare.difference import difference  # noqa: E402
from sobb.tools.sweep.store import Store  # noqa: E402


@pytest.fixture
def compare(cli, tmp_path):
    """Compares the example with one of other figures."""
    a = example_results.write(tmp_path / "a.duckdb")

    def run(*arguments, **figures):
        b = example_results.write(tmp_path / "b.duckdb", **figures)
        return cli("compare", a, b, *arguments)

    return run


def test_noise_is_no_difference(compare):
    done = compare(seed=8)
    assert done.returncode == 0, done.stderr + done.stdout
    assert "0 slower" in done.stdout


@pytest.mark.parametrize(("speed", "code", "verdict"), [(0.8, 3, "slower"), (1.25, 0, "faster")])
def test_differences(compare, speed, code, verdict):
    done = compare("--json", speed=speed, seed=8)
    assert done.returncode == code, done.stderr
    rows = json.loads(done.stdout)["rows"]
    traced = [row for row in rows if row["metric"] == "mrays_s"]
    assert len(traced) == 72 and all(row["verdict"] == verdict for row in traced)
    assert all(row["verdict"] == "same" for row in rows if row["metric"] == "build_ms")


def test_threshold(compare):
    assert compare("--threshold", "0.5", speed=0.8).returncode == 0
    assert compare(speed=0.8).returncode == 3


def test_cases_that_one_lacks(cli, tmp_path):
    a, b = (example_results.write(tmp_path / f"{name}.duckdb") for name in "ab")
    with Store(b) as store:
        store.connection.execute("DELETE FROM samples WHERE case_id = 'case00'")
    done = cli("compare", a, b)
    assert done.returncode == 0 and "a.duckdb: hairball, view 0, aabb (case00)" in done.stdout


def test_missing_file(cli, tmp_path):
    done = cli("compare", tmp_path / "a", tmp_path / "b")
    assert done.returncode == 1 and "no such file" in done.stderr


def test_the_interval_is_repeatable_and_holds_the_ratio(rng):
    a, b = rng.normal(10, 0.1, 9), rng.normal(11, 0.1, 9)
    found = difference(a, b)
    assert found == difference(a, b)
    assert found.low <= found.ratio <= found.high
    assert np.isclose(found.ratio, 1.1, rtol=0.03)
