# SPDX-License-Identifier: Apache-2.0
"""Reads a file of results: its runs, its cases, and the medians of their figures."""

import os
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field, fields, replace
from datetime import datetime
from pathlib import Path
from typing import Any, NamedTuple

import duckdb

from sobb.tools.sweep.records import DONE
from sobb.tools.sweep.store import Store

_CASES = "name, scene, subdivision, view, case_id"  # their order


@dataclass(frozen=True)
class Run:
    """A call of `sweep`: when, on which machine, with which versions."""

    run_id: int
    started: datetime | None
    finished: datetime | None
    host: str | None
    processor: str | None
    cores: int | None
    sobb_version: str | None
    embree_version: str | None
    git_commit: str | None
    python_version: str | None
    spec: str | None


class Key(NamedTuple):
    """What identifies a figure of a case; rays and call are None for a figure of the build."""

    metric: str
    rays: str | None = None
    call: str | None = None


@dataclass(frozen=True)
class Figure:
    """The repetitions of one figure, summed up."""

    median: float
    variation: float | None  # coefficient of variation, where it was measured more than once
    repetitions: int


@dataclass(frozen=True)
class Case:
    """What one process measured: a scene, a view, a method with its options; and how it ended."""

    case_id: str
    run_id: int
    scene: str
    name: str
    triangles: int | None
    subdivision: int
    view: int
    method: str
    k: int | None
    strategy: str | None
    table_kind: str | None
    quality: str | None
    width: int | None
    isa: str | None
    threads: int | None
    status: str
    error: str | None
    seconds: float | None
    host: str | None
    finished: datetime | None
    figures: Mapping[Key, Figure] = field(default_factory=dict, compare=False)

    def value(self, key: Key) -> float | None:
        """Returns the median of a figure; None where it was not measured."""
        figure = self.figures.get(key)
        return None if figure is None else figure.median


@dataclass(frozen=True)
class Results:
    """The whole file of results."""

    runs: list[Run]
    cases: list[Case]

    @property
    def done(self) -> list[Case]:
        return [case for case in self.cases if case.status == DONE]

    @property
    def failed(self) -> list[Case]:
        return [case for case in self.cases if case.status != DONE]

    def rays(self) -> list[str]:
        """Returns the kinds of rays that were measured, in the order of RAYS."""
        found = {key.rays for case in self.done for key in case.figures if key.rays is not None}
        return sorted(found, key=_place(RAYS))

    def calls(self) -> list[str]:
        """Returns the calls that were measured, in the order of CALLS."""
        found = {key.call for case in self.done for key in case.figures if key.call is not None}
        return sorted(found, key=_place(CALLS))


#: Kinds of rays and calls -> their names for people.
RAYS = {
    "primary": "primary",
    "shadow": "shadow",
    "diffuse1": "diffuse, 1 bounce",
    "diffuse7": "diffuse, 7 bounces",
    "random": "random",
}
CALLS = {"array": "arrays", "packet": "packets of 16", "single": "one ray per call"}


def read(path: str | os.PathLike[str]) -> Results:
    """Reads a file of results. Raises OSError or ValueError that names the file and the cause."""
    with Store(Path(path), read_only=True) as store:
        try:
            figures = _figures(store.connection)
            bare = [Case(*row) for row in _rows(store.connection, "cases", Case, _CASES)]
            cases = [replace(case, figures=figures.get(case.case_id, {})) for case in bare]
            runs = [Run(*row) for row in _rows(store.connection, "runs", Run, "run_id")]
        except duckdb.Error as error:
            raise OSError(f"{path}: {str(error).splitlines()[0]}") from None
    return Results(runs, cases)


def _rows(
    database: duckdb.DuckDBPyConnection, table: str, kind: type, order: str
) -> list[tuple[Any, ...]]:
    columns = ", ".join(f.name for f in fields(kind) if f.name != "figures")
    return database.execute(f"SELECT {columns} FROM {table} ORDER BY {order}").fetchall()


def _figures(database: duckdb.DuckDBPyConnection) -> dict[str, dict[Key, Figure]]:
    rows = database.execute(
        """
        SELECT case_id, metric, rays, call, median(value),
               stddev_samp(value) / nullif(abs(avg(value)), 0), count(*)
        FROM samples WHERE isfinite(value) GROUP BY case_id, metric, rays, call
        """
    ).fetchall()
    figures: dict[str, dict[Key, Figure]] = {}
    for case_id, metric, rays, call, *figure in rows:
        figures.setdefault(case_id, {})[Key(metric, rays, call)] = Figure(*figure)
    return figures


def _place(order: Iterable[str]) -> Callable[[str], tuple[int, str]]:
    """Makes a key that sorts names into an order; unknown names come last."""
    places = {name: i for i, name in enumerate(order)}
    return lambda name: (places.get(name, len(places)), name)
