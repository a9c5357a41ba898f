# SPDX-License-Identifier: Apache-2.0
"""Compares the figures that two files of results share; prints a table or JSON."""

import json
import sys
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import numpy as np

from sobb.tools.compare.difference import SLOWER, Difference, difference
from sobb.tools.sweep.store import Store

_QUESTION = """
SELECT case_id, name, view, method, coalesce(rays, ''), coalesce(call, ''), metric,
       list(value ORDER BY repetition)
FROM results WHERE status = 'done' AND metric IN ('mrays_s', 'build_ms')
GROUP BY ALL ORDER BY ALL
"""
_LABELS = "SELECT case_id, name || ', view ' || view || ', ' || method FROM cases"

#: What identifies a figure: case, name, view, method, rays, call, metric.
Key = tuple[str, str, int, str, str, str, str]


@dataclass(frozen=True)
class Row:
    """A figure that both files have."""

    case_id: str
    name: str
    view: int
    method: str
    rays: str
    call: str
    metric: str
    difference: Difference
    verdict: str


def run(a: Path, b: Path, threshold: float, as_json: bool) -> bool:
    """Prints how B differs from A; returns whether a figure got slower."""
    with Store(a, read_only=True) as first, Store(b, read_only=True) as second:
        old, new = _samples(first), _samples(second)
        labels = {**_labels(first), **_labels(second)}
    rows = [_row(key, old[key], new[key], threshold) for key in old if key in new]
    only_a, only_b = _only(old, new, labels), _only(new, old, labels)
    if not rows:
        raise ValueError(f"{a} and {b} have no case in common")
    if as_json:
        document = {"rows": [asdict(row) for row in rows], "only_a": only_a, "only_b": only_b}
        json.dump(document, sys.stdout, indent=1)
        print()
    else:
        _print(rows, {a: only_a, b: only_b})
    return any(row.verdict == SLOWER for row in rows)


def _samples(store: Store) -> dict[Key, np.ndarray]:
    rows = store.connection.execute(_QUESTION).fetchall()
    return {tuple(row[:-1]): np.asarray(row[-1]) for row in rows}


def _labels(store: Store) -> dict[str, str]:
    return dict(store.connection.execute(_LABELS).fetchall())


def _row(key: Key, a: np.ndarray, b: np.ndarray, threshold: float) -> Row:
    # A build's speed is the inverse of its time.
    ratio = difference(a, b) if key[-1] == "mrays_s" else difference(b, a)
    return Row(*key, ratio, ratio.verdict(threshold))


def _only(these: dict, others: dict, labels: dict[str, str]) -> list[str]:
    lacking = {key[0] for key in these} - {key[0] for key in others}
    return sorted(f"{labels[case]} ({case})" for case in lacking)


def _print(rows: Sequence[Row], alone: dict[Path, list[str]]) -> None:
    from rich.console import Console
    from rich.table import Table

    colours = {"faster": "green", "slower": "red"}
    table = Table("scene", "view", "method", "rays", "call", "speed", "95 %", "")
    for row in rows:
        if row.verdict not in colours:
            continue
        found = row.difference
        table.add_row(
            row.name, str(row.view), row.method, row.rays or "build", row.call,
            f"{found.ratio:.3f}", f"{found.low:.3f} to {found.high:.3f}", row.verdict,
            style=colours[row.verdict],
        )  # fmt: skip
    console = Console()
    if table.row_count:
        console.print(table)
    counts = {verdict: sum(row.verdict == verdict for row in rows) for verdict in colours}
    same = len(rows) - sum(counts.values())
    print(f"{counts['faster']} faster, {counts['slower']} slower, {same} within the noise")
    for path, cases in alone.items():
        for case in cases:
            print(f"only in {path}: {case}")
