# SPDX-License-Identifier: Apache-2.0
"""The chart: the speed of secondary rays with each method, over AABBs, scene by scene."""

import io
from collections.abc import Sequence
from dataclasses import dataclass

from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, NullLocator

from sobb.tools.paper.table import COLUMNS, Group, Measured, groups
from sobb.tools.shared.methods import TITLES as METHODS
from sobb.tools.shared.palette import BLUE, GREEN, ORANGE, PURPLE

_TITLES = {"binary": "Binary nodes", "wide": "Nodes of 8 children"}
_SECONDARY = [column.key for column in COLUMNS].index("secondary_mrays")
_INK, _GRID, _BAND, _PAPER = "#222222", "#d9d9d6", "#f4f4f2", "#ffffff"
_TICKS = [2.0**i * m for i in range(-6, 7) for m in (1.0, 1.5)]


@dataclass(frozen=True)
class _Mark:
    """How a method's points are drawn."""

    colour: str
    shape: str
    filled: bool
    offset: float  # from the middle of its scene's row, in rows, so that few marks cover others


_MARKS = {
    "14-dop": _Mark(ORANGE.light, "v", True, -0.27),
    "obb": _Mark(GREEN.light, "s", True, -0.27),
    "sobb32d": _Mark(BLUE.light, "<", False, 0.0),
    "sobb32i": _Mark(BLUE.light, "<", True, 0.27),
    "sobb48d": _Mark(BLUE.light, "D", False, 0.0),
    "sobb48i": _Mark(BLUE.light, "D", True, 0.27),
    "sobb64d": _Mark(BLUE.light, "o", False, 0.0),
    "sobb64i": _Mark(BLUE.light, "o", True, 0.27),
    "sobb128": _Mark(PURPLE.light, "o", False, 0.0),
    "sobb256": _Mark(PURPLE.light, "s", False, 0.0),
}


def picture(scenes: Sequence[Measured], kind: str) -> bytes:
    """Draws the chart; returns the bytes of a file of this kind, png or svg."""
    panels = {title: groups(scenes, layout) for layout, title in _TITLES.items()}
    rows = max(len(shown) for shown in panels.values())
    figure = Figure(figsize=(9, 1.7 + 0.36 * rows), facecolor=_PAPER, layout="constrained")
    axes = figure.subplots(1, 2, sharex=True, sharey=True)
    for axis, (title, shown) in zip(axes, panels.items(), strict=True):
        axis.set_title(title, fontsize=9.5, color=_INK)
        _draw_scenes(axis, shown)
        _draw_methods(axis, shown)
    _draw_scale(axes[0])
    figure.suptitle("Speed of secondary rays: how many times that with AABBs", fontsize=11)
    handles, labels = axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=5, frameon=False, fontsize=8.5)
    out = io.BytesIO()
    # Equal figures make equal files: without a date, and with a fixed salt for the SVG's names.
    with rc_context({"svg.hashsalt": "sobb"}):
        dated = {"Date": None} if kind == "svg" else None
        figure.savefig(out, format=kind, dpi=200, metadata=dated)
    return out.getvalue()


def _draw_scenes(axis: Axes, shown: Sequence[Group]) -> None:
    axis.set_yticks(range(len(shown)), [group.title for group in shown])
    axis.set_ylim(len(shown) - 0.5, -0.5)
    axis.tick_params(colors=_INK, labelsize=8.5, length=0)
    for row in range(0, len(shown), 2):
        axis.axhspan(row - 0.5, row + 0.5, color=_BAND, linewidth=0, zorder=0)
    if len(shown) > 1:  # the last row has the means
        axis.axhline(len(shown) - 1.5, color=_INK, linewidth=0.8)
    for side in axis.spines.values():
        side.set_visible(False)


def _draw_methods(axis: Axes, shown: Sequence[Group]) -> None:
    axis.axvline(1, color=_INK, linewidth=1, zorder=1)
    for method, mark in _MARKS.items():
        points = []
        for row, group in enumerate(shown):
            ratio = group.rows[method][_SECONDARY].ratio if method in group.rows else None
            points += [(ratio, row + mark.offset)] if ratio else []
        axis.scatter(
            [ratio for ratio, _ in points],
            [height for _, height in points],
            s=20,
            marker=mark.shape,
            facecolors=mark.colour if mark.filled else _PAPER,
            edgecolors=mark.colour,
            linewidths=1.1,
            label=METHODS[method],
            zorder=3,
        )


def _draw_scale(axis: Axes) -> None:
    """Draws the scale that both panels share."""
    axis.set_xscale("log")
    low, high = axis.get_xlim()
    axis.set_xlim(min(low, 0.7), max(high, 1.45))
    for panel in axis.figure.axes:
        panel.xaxis.set_major_locator(FixedLocator(_TICKS))
        panel.xaxis.set_major_formatter(FuncFormatter(lambda ratio, _: f"{ratio:.2g}×"))
        panel.xaxis.set_minor_locator(NullLocator())
        panel.grid(axis="x", color=_GRID, linewidth=0.6)
        panel.set_axisbelow(True)
        panel.set_xlabel("faster →", loc="right", fontsize=8.5, color=_INK)
