# SPDX-License-Identifier: Apache-2.0
"""The table as CSV: a line for each scene, layout and method, with its circumstances."""

import csv
import io
from collections.abc import Iterable
from typing import Any

from sobb.tools.paper.table import COLUMNS, LAYOUTS, Measured, figures, row_name, strategy_of
from sobb.tools.shared.methods import TITLES as METHODS

_WORK = [
    f"{kind}_{what}_per_ray"
    for kind in ("primary", "secondary")
    for what in ("nodes", "volumes", "triangles")
]
_BUILD = {
    "topology_ms": "topology_ms",
    "layout_ms": "layout_ms",
    "depth": "depth",
    "nodes": "node_count",
    "leaves": "leaf_count",
}
_CONTEXT = {
    "scene": "source",
    "view": "view",
    "size": "size",
    "primary_rays": "primary_rays",
    "secondary_rays": "secondary_rays",
    "brute_force_rays": "brute_force_rays",
    "threads": "threads",
    "isa": "isa",
    "processor": "processor",
    "sobb": "sobb_version",
    "date": "date",
}


def text(scenes: Iterable[Measured]) -> str:
    """Returns the whole file. Cells are empty where nothing was measured, or nothing repeated."""
    names = ["scene", "triangles", "layout", "method", "strategy"]
    for column in COLUMNS:
        names += [column.key, f"{column.key}_cv"] if column.timed else [column.key]
    names += ["node_bytes", *_WORK, *_BUILD.values(), *_CONTEXT.values()]
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(names)
    for scene in scenes:
        for layout in LAYOUTS:
            for method in METHODS:
                line = _line(scene, layout, method)
                if line is not None:
                    writer.writerow(line)
    return out.getvalue()


def _line(scene: Measured, layout: str, method: str) -> list[str] | None:
    found = figures(scene.report, method, layout)
    if not found:
        return None
    line: list[Any] = [scene.name, scene.triangles, layout, METHODS[method], strategy_of(method)]
    for column in COLUMNS:
        figure = found.get(column.key)
        line.append(None if figure is None else figure.value)
        if column.timed:
            line.append(None if figure is None else figure.variation)
    medians, context = scene.report.medians, scene.report.context
    line.append(medians.get(row_name("overhead", method, layout), {}).get("node_bytes"))
    for name in _WORK:
        kind, what, _ = name.split("_", 2)
        line.append(medians.get(row_name(kind, method, layout), {}).get(f"{what}/ray"))
    line += [medians.get(f"build/{layout}", {}).get(key) for key in _BUILD]
    line += [context.get(key) for key in _CONTEXT]
    return [_cell(value) for value in line]


def _cell(value: Any) -> str:
    if value is None:
        return ""
    if not isinstance(value, float):
        return str(value)
    return f"{value:.0f}" if value.is_integer() else f"{value:.7g}"
