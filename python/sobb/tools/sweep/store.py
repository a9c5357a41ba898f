# SPDX-License-Identifier: Apache-2.0
"""The file of results: tables in DuckDB, written by one process, with a transaction per case."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import astuple, fields
from datetime import UTC, datetime
from pathlib import Path

import duckdb

from sobb.tools.sweep.records import Case, Run, Sample

SCHEMA = "1"

_TABLES = """
CREATE TABLE meta(key VARCHAR PRIMARY KEY, value VARCHAR);
CREATE TABLE runs(
    run_id INTEGER PRIMARY KEY, started TIMESTAMP, finished TIMESTAMP, host VARCHAR,
    processor VARCHAR, cores INTEGER, sobb_version VARCHAR, embree_version VARCHAR,
    git_commit VARCHAR, python_version VARCHAR, spec VARCHAR);
CREATE TABLE cases(
    case_id VARCHAR PRIMARY KEY, run_id INTEGER, scene VARCHAR, name VARCHAR, triangles BIGINT,
    subdivision INTEGER, view INTEGER, method VARCHAR, k INTEGER, strategy VARCHAR,
    table_kind VARCHAR, quality VARCHAR, width INTEGER, isa VARCHAR, threads INTEGER,
    status VARCHAR, error VARCHAR, seconds DOUBLE, host VARCHAR, finished TIMESTAMP);
CREATE TABLE samples(
    case_id VARCHAR, rays VARCHAR, call VARCHAR, metric VARCHAR, repetition INTEGER, value DOUBLE);
CREATE VIEW results AS SELECT * FROM samples JOIN cases USING (case_id);
"""


class Store:
    """A file of results, and a context manager. Its errors are OSErrors that name the file."""

    def __init__(self, path: str | Path, read_only: bool = False):
        """Opens a file, or makes one unless it is only to be read.

        Raises ValueError for a file whose tables have another version, or that is no file of
        results.
        """
        self._path = Path(path)
        if read_only and not self._path.is_file():
            raise FileNotFoundError(f"{path}: no such file")
        is_new = not self._path.exists()
        try:
            with self._errors():
                self._connection = duckdb.connect(str(path), read_only=read_only)
        except OSError:
            if is_new:
                self._path.unlink(missing_ok=True)  # a full disk may have left part of a header
            raise
        try:
            with self._errors():
                self._check_or_make(read_only)
        except BaseException:
            self._connection.close()
            raise

    def __enter__(self) -> "Store":
        return self

    def __exit__(self, *_error) -> None:
        self.close()

    def close(self) -> None:
        with self._errors():
            self._connection.close()

    @property
    def connection(self) -> "duckdb.DuckDBPyConnection":
        """The connection, for queries in SQL."""
        return self._connection

    def begin_run(self, run: Run) -> int:
        """Adds a run that starts now; returns its number."""
        names = ", ".join(field.name for field in fields(run))
        marks = ", ".join("?" for _ in fields(run))
        with self._errors():
            row = self._connection.execute(
                f"INSERT INTO runs (run_id, started, {names}) "
                f"SELECT coalesce(max(run_id), 0) + 1, ?, {marks} FROM runs RETURNING run_id",
                [_now(), *astuple(run)],
            ).fetchone()
        assert row is not None
        return row[0]

    def end_run(self, run_id: int, embree_version: str | None = None) -> None:
        """Notes the end of a run, and the version of Embree, which only its cases report."""
        with self._errors():
            self._connection.execute(
                "UPDATE runs SET finished = ?, embree_version = coalesce(?, embree_version) "
                "WHERE run_id = ?",
                [_now(), embree_version, run_id],
            )

    def statuses(self) -> dict[str, str]:
        """Returns the status of every case, by case_id."""
        with self._errors():
            return dict(self._connection.execute("SELECT case_id, status FROM cases").fetchall())

    def add(self, run_id: int, case: Case, samples: Sequence[Sample]) -> None:
        """Keeps a case and its samples, both or neither; they replace those of an earlier try."""
        names = ["run_id", *(field.name for field in fields(case))]
        marks = ", ".join("?" for _ in names)
        values = list(zip(*(astuple(sample) for sample in samples), strict=True))
        with self._errors(), self._transaction():
            self._connection.execute(
                f"INSERT OR REPLACE INTO cases ({', '.join(names)}) VALUES ({marks})",
                [run_id, *astuple(case)],
            )
            self._connection.execute("DELETE FROM samples WHERE case_id = ?", [case.case_id])
            if values:
                self._connection.execute(
                    "INSERT INTO samples SELECT ?, unnest(?::VARCHAR[]), unnest(?::VARCHAR[]), "
                    "unnest(?::VARCHAR[]), unnest(?::INTEGER[]), unnest(?::DOUBLE[])",
                    [case.case_id, *map(list, values)],
                )

    def _check_or_make(self, read_only: bool) -> None:
        tables = {row[0] for row in self._connection.execute("SHOW TABLES").fetchall()}
        if not tables and not read_only:
            with self._transaction():
                self._connection.execute(_TABLES)
                self._connection.execute("INSERT INTO meta VALUES ('schema', ?)", [SCHEMA])
            return
        row = None
        if "meta" in tables:
            question = "SELECT value FROM meta WHERE key = 'schema'"
            row = self._connection.execute(question).fetchone()
        if row is None:
            raise ValueError(
                f"{self._path}: no file of results: its tables are not those of a sweep"
            )
        if row[0] != SCHEMA:
            raise ValueError(
                f"{self._path}: its tables have version {row[0]}, this library knows {SCHEMA}"
            )

    @contextmanager
    def _transaction(self) -> Iterator[None]:
        self._connection.execute("BEGIN")
        try:
            yield
        except BaseException:
            self._connection.execute("ROLLBACK")
            raise
        self._connection.execute("COMMIT")

    @contextmanager
    def _errors(self) -> Iterator[None]:
        try:
            yield
        except duckdb.Error as error:
            raise OSError(f"{self._path}: {str(error).splitlines()[0]}") from error


def _now() -> datetime:
    return datetime.now(UTC).replace(tzinfo=None)
