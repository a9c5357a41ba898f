# SPDX-License-Identifier: Apache-2.0
"""The file of results: rows are read as written, a case is kept whole or not, errors are clear."""

import pytest

duckdb = pytest.importorskip("duckdb")

import example_results  # noqa: E402

from sobb.tools.sweep.records import Case, Sample  # noqa: E402
from sobb.tools.sweep.store import Store  # noqa: E402


def _count(store, table):
    return store.connection.execute(f"SELECT count(*) FROM {table}").fetchone()[0]


def test_example(tmp_path):
    with Store(example_results.write(tmp_path / "r.duckdb"), read_only=True) as store:
        assert _count(store, "cases") == 19
        assert _count(store, "results") == _count(store, "samples") > 0
        assert sorted(set(store.statuses().values())) == ["done", "failed"]


def test_a_case_is_replaced_whole(tmp_path):
    case = Case("a", "s", "s", 1, 0, "aabb")
    with Store(tmp_path / "r.duckdb") as store:
        store.add(1, case, [Sample("primary", "single", "mrays_s", i, 1.0) for i in range(5)])
        store.add(2, case, [Sample(None, None, "build_ms", 0, 2.0)])
        question = "SELECT run_id, rays, metric, value FROM results"
        assert store.connection.execute(question).fetchall() == [(2, None, "build_ms", 2.0)]


def test_both_or_none(tmp_path):
    with Store(tmp_path / "r.duckdb") as store:
        with pytest.raises(OSError, match="r.duckdb"):
            bad = [Sample(None, None, "build_ms", "no number", 1.0)]
            store.add(1, Case("a", "s", "s", 1, 0, "aabb"), bad)
        assert store.statuses() == {} and _count(store, "samples") == 0


def test_another_version(tmp_path):
    path = example_results.write(tmp_path / "r.duckdb")
    with Store(path) as store:
        store.connection.execute("UPDATE meta SET value = '2' WHERE key = 'schema'")
    with pytest.raises(ValueError, match="r.duckdb: .* version 2, this library knows 1"):
        Store(path)


def test_no_file_of_results(tmp_path):
    with pytest.raises(OSError, match="gone.duckdb"):
        Store(tmp_path / "gone.duckdb", read_only=True)
    (tmp_path / "text.duckdb").write_text("no database at all, but long enough to be looked at")
    with pytest.raises(OSError, match="text.duckdb"):
        Store(tmp_path / "text.duckdb")
    duckdb.connect(str(tmp_path / "other.duckdb")).execute("CREATE TABLE t(x INTEGER)").close()
    with pytest.raises(ValueError, match="other.duckdb: no file of results"):
        Store(tmp_path / "other.duckdb")
