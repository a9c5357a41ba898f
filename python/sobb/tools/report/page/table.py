# SPDX-License-Identifier: Apache-2.0
"""The table of the page: a row for each variant on each scene, and means over the scenes."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from statistics import geometric_mean

from sobb.tools.report.method import BASE, HIERARCHIES, Variant, bases, place, variants
from sobb.tools.report.results import Case, Key, Results
from sobb.tools.report.scene import order, titles
from sobb.tools.shared.cells import Cell, Column, number

# The overhead is the build time beyond that of AABBs, or the time to fit other volumes.
_OVERHEAD = "overhead_ms"
_OF_BUILD = (
    Column("build_ms", "Build [ms]"),
    Column(_OVERHEAD, "Overhead [ms]", base="obb"),
    Column("area_inner", "Area inner nodes", timed=False),
    Column("area_leaves", "Area leaf nodes", timed=False),
    Column("bytes_per_triangle", "Bytes per triangle", timed=False),
)


@dataclass(frozen=True)
class Row:
    """A variant on a scene."""

    scene: str
    variant: Variant
    cells: list[Cell]


@dataclass(frozen=True)
class Table:
    """The rows for one kind of call, and the geometric means of the ratios over the scenes."""

    call: str
    columns: list[Column]
    rows: list[Row]
    means: list[Row]


def tables(results: Results) -> list[Table]:
    """Returns a table for each kind of call."""
    return [_table(results, call) for call in results.calls()]


def _table(results: Results, call: str) -> Table:
    cases, title, named = results.done, titles(results.done), variants(results.done)
    speeds = [
        Column(rays, f"{_short(rays)} [Mrays/s]", best=max)
        for rays in results.rays()
        if any(Key("mrays_s", rays, call) in case.figures for case in cases)
    ]
    groups: dict[tuple[str, int, int], list[Case]] = {}
    for case in sorted(cases, key=lambda case: named[case.case_id]):
        groups.setdefault(place(case), []).append(case)
    columns = [*_OF_BUILD, *speeds]
    rows: list[Row] = []
    for _, group in sorted(groups.items(), key=lambda item: order(item[1][0])):
        cells = _cells(group, columns, call)
        rows += [Row(title[c.case_id], named[c.case_id], cells[c.case_id]) for c in group]
    shown = [i for i in range(len(columns)) if any(row.cells[i].value is not None for row in rows)]
    rows = [Row(row.scene, row.variant, [row.cells[i] for i in shown]) for row in rows]
    columns = [columns[i] for i in shown]
    return Table(call, columns, rows, _means(rows, columns) if len(groups) > 1 else [])


def _short(rays: str) -> str:
    """Spells diffuse7 as Diffuse 7."""
    return re.sub(r"(?<=[a-z])(?=\d)", " ", rays).capitalize()


def _value(case: Case, base: Case | None, column: Column, call: str) -> float | None:
    """Returns a figure of a case; `base` is the case with AABBs that it is compared with."""
    if column.key != _OVERHEAD:
        of_build = column in _OF_BUILD
        return case.value(Key(column.key) if of_build else Key("mrays_s", column.key, call))
    if case.method not in HIERARCHIES:
        return case.value(Key("fit_ms"))
    build = case.value(Key("build_ms"))
    own = base.value(Key("build_ms")) if base is not None else None
    ours = case.method not in (BASE, "embree")
    return build - own if ours and build is not None and own is not None else None


def _cells(group: Sequence[Case], columns: Sequence[Column], call: str) -> dict[str, list[Cell]]:
    """Returns the cells of one scene's cases, by the cases' ids."""
    cells: dict[str, list[Cell]] = {case.case_id: [] for case in group}
    to_aabb = bases(group)
    for column in columns:
        values = {c.case_id: _value(c, to_aabb.get(c.case_id), column, call) for c in group}
        known = [value for value in values.values() if value is not None]
        best = number(column.best(known)) if known else ""
        compared = bases(group, column.base)
        for name, value in values.items():
            own = values[compared[name].case_id] if name in compared else None
            ratio = value / own if value is not None and own is not None and own > 0 else None
            cells[name].append(Cell(value, ratio, value is not None and number(value) == best))
    return cells


def _means(rows: Sequence[Row], columns: Sequence[Column]) -> list[Row]:
    """Returns the means of those ratios that every scene has: others could not be compared."""
    scenes = {row.scene for row in rows}
    means: list[Row] = []
    for variant in sorted({row.variant for row in rows}):
        own = [row for row in rows if row.variant == variant]
        cells = []
        for i in range(len(columns)):
            ratios = [row.cells[i].ratio for row in own]
            whole = len(own) == len(scenes) and all(r is not None and r > 0 for r in ratios)
            cells.append(Cell(None, geometric_mean(ratios) if whole else None))
        means.append(Row(f"geometric mean of {len(scenes)}", variant, cells))
    return [_with_best(mean, means, columns) for mean in means]


def _with_best(mean: Row, means: Sequence[Row], columns: Sequence[Column]) -> Row:
    cells = []
    for i, column in enumerate(columns):
        ratios = [m.cells[i].ratio for m in means if m.cells[i].ratio is not None]
        best = f"{column.best(ratios):.2f}" if ratios else ""
        own = mean.cells[i].ratio
        cells.append(Cell(None, own, own is not None and f"{own:.2f}" == best))
    return Row(mean.scene, mean.variant, cells)
