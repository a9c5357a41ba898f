# SPDX-License-Identifier: Apache-2.0
"""The table as Markdown, under a text that says what was measured, on what and how."""

import re
from collections.abc import Sequence

from sobb.tools.paper.table import COLUMNS, LAYOUTS, Group, Measured, groups, largest_variation
from sobb.tools.shared.cells import Cell
from sobb.tools.shared.methods import TITLES as METHODS

_HOW = """\
All rows of a scene share one hierarchy of AABBs, of medium quality, and one traversal: only the
volumes differ. The build time is that of the AABBs plus the overhead, which is the time to convert
them to the row's volumes. SOBBs are chosen by the strategy k², from the directions of
k = 32, 48, 64, 128 or 256; d is the direct form of 48 bytes, i the indexed one of 26 bytes. Areas
are sums over all children, relative to the area of the scene's box. Secondary rays are bounces
1 to 7 of a path tracer, distributed by the cosine, without Russian roulette, one path per pixel;
rays and times are summed. Figures are medians. In brackets is the ratio to the AABB, for the
overhead to the OBB. The best of a column is bold. All methods gave the same hits, bit by bit, on
all rays, and {brute_force_rays} rays of each scene hit what brute force hits."""


def text(scenes: Sequence[Measured]) -> str:
    """Returns the whole file."""
    context = scenes[0].report.context
    parts = [
        "# Bounding volumes compared",
        f"{context['processor']}, {context['threads']} threads, {context['isa']}; "
        f"sobb {context['sobb']}; {context['date'][:10]}. "
        f"{_views(context)}{_spread(scenes)}",
        _HOW.format(**context),
        "![Speed of secondary rays](paper.png)",
    ]
    for layout, what in LAYOUTS.items():
        parts += [f"## {what[0].upper()}{what[1:]}", _table(groups(scenes, layout))]
    return "\n\n".join(parts) + "\n"


def _views(context: dict) -> str:
    size = context["size"]
    return (
        f"Each scene is seen from its view {context['view']}, with {size} × {size} primary rays. "
    )


def _spread(scenes: Sequence[Measured]) -> str:
    largest = largest_variation(scenes)
    if largest is None:
        return "No time was measured more than once."
    return f"The largest coefficient of variation is {100 * largest[0]:.1f} % ({largest[1]})."


def _table(shown: Sequence[Group]) -> str:
    lines = [
        "| Scene [#triangles] | Method | " + " | ".join(c.title for c in COLUMNS) + " |",
        "|---|---|" + "--:|" * len(COLUMNS),
    ]
    for group in shown:
        title = f"**{_escape(group.title)}**"
        for method, cells in group.rows.items():
            lines.append(f"| {title} | {METHODS[method]} | {' | '.join(map(_cell, cells))} |")
            title = ""
    return "\n".join(lines)


def _cell(cell: Cell) -> str:
    return f"**{cell}**" if cell.best else str(cell)


def _escape(name: str) -> str:
    """Escapes the characters that mean something to Markdown; a scene's file may have any name."""
    return re.sub(r"([\\`*_|<>\[\]~])", r"\\\1", name)
