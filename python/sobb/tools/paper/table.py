# SPDX-License-Identifier: Apache-2.0
"""The table's rows: a method's figures on a scene, their ratios, and which are the best."""

import math
from collections.abc import Iterable
from dataclasses import dataclass
from statistics import geometric_mean

from sobb.tools.shared.bench import Report
from sobb.tools.shared.cells import Cell, Column, number, short_count
from sobb.tools.shared.methods import TITLES as METHODS

#: Layouts of the nodes -> their descriptions.
LAYOUTS = {"binary": "binary nodes, as in the paper", "wide": "nodes of 8 children"}
STRATEGY = "k2"  # by which SOBBs are chosen


COLUMNS = (
    Column("build_ms", "Build [ms]"),
    Column("overhead_ms", "Overhead [ms]", base="obb"),
    Column("area_inner", "Area inner nodes", timed=False),
    Column("area_leaf", "Area leaf nodes", timed=False),
    Column("primary_mrays", "Primary [Mrays/s]", best=max),
    Column("secondary_mrays", "Secondary [Mrays/s]", best=max),
)


@dataclass(frozen=True)
class Measured:
    """A scene that was measured, and the program's report."""

    name: str
    report: Report

    @property
    def triangles(self) -> int:
        return int(self.report.context["triangles"])

    @property
    def title(self) -> str:
        return f"{self.name} [{short_count(self.triangles)}]"


@dataclass(frozen=True)
class Figure:
    """A median, and its coefficient of variation where it was measured more than once."""

    value: float
    variation: float | None = None


@dataclass(frozen=True)
class Group:
    """The rows of one scene: method -> a cell per column."""

    title: str
    rows: dict[str, list[Cell]]


def strategy_of(method: str) -> str:
    """Returns the strategy by which a method chose its volumes; "" where there is only one way."""
    return STRATEGY if method.startswith("sobb") else ""


def row_name(kind: str, method: str, layout: str) -> str:
    """Returns the name of the program's row."""
    return "/".join(filter(None, (kind, method, layout, strategy_of(method))))


def figures(report: Report, method: str, layout: str) -> dict[str, Figure]:
    """Returns a method's figures by the columns' keys; those that were not measured are missing."""
    overhead = row_name("overhead", method, layout)
    found = {
        "overhead_ms": _figure(report, overhead, "real_time"),
        "area_inner": _figure(report, overhead, "area_inner"),
        "area_leaf": _figure(report, overhead, "area_leaf"),
        "primary_mrays": _figure(report, row_name("primary", method, layout), "Mrays/s"),
        "secondary_mrays": _figure(report, row_name("secondary", method, layout), "Mrays/s"),
    }
    build = _figure(report, f"build/{layout}", "real_time")
    if method == "aabb":  # the conversion to AABBs is part of their build
        found["overhead_ms"] = None
        found["build_ms"] = build
    elif build is not None and found["overhead_ms"] is not None:
        found["build_ms"] = _sum(build, found["overhead_ms"])
    return {key: figure for key, figure in found.items() if figure is not None}


def groups(scenes: Iterable[Measured], layout: str) -> list[Group]:
    """Returns the rows of all scenes, and of several the geometric means of their ratios."""
    made = [_group(scene, layout) for scene in scenes]
    return [*made, _means(made)] if len(made) > 1 else made


def largest_variation(scenes: Iterable[Measured]) -> tuple[float, str] | None:
    """Returns the largest coefficient of variation of a time, and its row.

    Returns None if nothing was repeated.
    """
    return max(
        (
            (row["real_time"], f"{scene.name}, {name}")
            for scene in scenes
            for name, row in scene.report.variations.items()
        ),
        default=None,
    )


def _figure(report: Report, row: str, key: str) -> Figure | None:
    median = report.medians.get(row)
    if median is None or key not in median:
        return None
    return Figure(median[key], report.variations.get(row, {}).get(key))


def _sum(a: Figure, b: Figure) -> Figure:
    total = a.value + b.value
    if a.variation is None or b.variation is None or total == 0:
        return Figure(total)
    return Figure(total, math.hypot(a.value * a.variation, b.value * b.variation) / total)


def _group(scene: Measured, layout: str) -> Group:
    measured = {method: figures(scene.report, method, layout) for method in METHODS}
    rows: dict[str, list[Cell]] = {method: [] for method, found in measured.items() if found}
    for column in COLUMNS:
        base = measured[column.base].get(column.key)
        values = {m: measured[m][column.key].value for m in rows if column.key in measured[m]}
        # Values that print alike are equally good to whoever reads them.
        best = number(column.best(values.values())) if values else ""
        for method, cells in rows.items():
            value = values.get(method)
            if value is None:
                cells.append(Cell())
            else:
                ratio = value / base.value if base is not None and base.value > 0 else None
                cells.append(Cell(value, ratio, number(value) == best))
    return Group(scene.title, rows)


def _means(scenes: list[Group]) -> Group:
    rows: dict[str, list[Cell]] = {m: [] for m in METHODS if any(m in s.rows for s in scenes)}
    for i, column in enumerate(COLUMNS):
        ratios: dict[str, float] = {}
        for method in rows:
            found = [s.rows[method][i].ratio if method in s.rows else None for s in scenes]
            known = [ratio for ratio in found if ratio]
            if len(known) == len(found):  # means over different scenes cannot be compared
                ratios[method] = geometric_mean(known)
        best = f"{column.best(ratios.values()):.2f}" if ratios else ""
        for method, cells in rows.items():
            ratio = ratios.get(method)
            cells.append(Cell(None, ratio, ratio is not None and f"{ratio:.2f}" == best))
    return Group(f"geometric mean of {len(scenes)}", rows)
