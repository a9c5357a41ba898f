# SPDX-License-Identifier: Apache-2.0
"""Prints the tables: one per scene, and one for all."""

import sys
from collections.abc import Sequence

from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from sobb.tools.peers.figures import QUALITIES, Figure
from sobb.tools.peers.summary import Least, Line
from sobb.tools.shared.cells import short_count

_PIPED_WIDTH = 160  # enough for all columns on one line


def show_scene(found: Sequence[Figure]) -> None:
    """Prints a row for each kind of rays and call; a row has both qualities."""
    medium, high = ([f for f in found if f.quality == quality] for quality in QUALITIES)
    table = _table(
        f"{high[0].name} [{short_count(high[0].triangles)}]",
        ("Scene", "Rays", "Call"),
        ("Mrays/s", "Embree", "fastest row", "ratio", "ratio, medium", "over robust", "over AABB"),
    )
    for m, h in zip(medium, high, strict=True):
        table.add_row(
            *map(Text, (h.name, h.rays, h.call)),
            f"{h.sobb:.2f}",
            f"{h.embree:.2f}",
            h.embree_row.removeprefix("embree_"),
            f"{h.ratio:.2f}",
            f"{m.ratio:.2f}",
            f"{h.sobb / h.robust:.2f}",
            f"{h.sobb / h.aabb:.2f}",
            end_section=h.call == "array",
        )
    bytes_by_quality = (
        f"{f.bytes:.1f} {f.quality} (Embree {f.embree_bytes:.1f})" for f in (medium[0], high[0])
    )
    table.caption = Text(f"bytes per triangle: {', '.join(bytes_by_quality)}")
    _print(table)


def show_summary(lines: Sequence[Line], scenes: int) -> None:
    """Prints the least and the mean ratios over all scenes."""
    columns = [f"{quality}: {what}" for quality in reversed(QUALITIES) for what in _RATIOS]
    table = _table(
        f"{scenes} scenes: our speed over Embree's fastest", ("Rays", "Call"), (*columns, *_OTHERS)
    )
    for line in lines:
        cells = [line.rays, line.call]
        for quality in reversed(QUALITIES):
            ratios = line.ratios[quality]
            cells += [_least(ratios.least), f"{ratios.mean:.2f}", _least(ratios.fibres)]
        cells += [_least(line.over_aabb), _least(line.turned)]
        table.add_row(*map(Text, cells), end_section=line.call == "array")
    _print(table)


_RATIOS = ("least", "mean", "fibres")
_OTHERS = ("over AABB", "turned")


def _least(least: Least | None) -> str:
    return "–" if least is None else f"{least.value:.2f} {least.scene}"


def _table(title: str, left: Sequence[str], right: Sequence[str]) -> Table:
    table = Table(box=box.SIMPLE_HEAD, title_style="bold", pad_edge=False)
    table.title = Text(title)
    for name in left:
        table.add_column(name, no_wrap=True)
    for name in right:
        table.add_column(name, justify="right")
    return table


def _print(table: Table) -> None:
    Console(width=None if sys.stdout.isatty() else _PIPED_WIDTH, highlight=False).print(table)
