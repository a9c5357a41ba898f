# SPDX-License-Identifier: Apache-2.0
"""Parts that the charts and tables of all questions share."""

import math

from matplotlib import rc_context
from matplotlib.figure import Figure

# M. Okabe, K. Ito, "Color Universal Design" (2008): told apart by every kind of colour vision.
BLUE, ORANGE, GREEN, RED, INK = "#0072B2", "#E69F00", "#009E73", "#D55E00", "#222222"
MARKERS = "osD^vP"
GRID = "#DDDDDD"


def mean(values):
    """The geometric mean, which suits ratios."""
    values = list(values)
    return math.exp(sum(map(math.log, values)) / len(values))


def short(scene):
    """The name of a scene without its prefix or ending."""
    return scene.removeprefix("builtin:").replace(".glb", "")


def pretty(name):
    """A name as the documents spell it."""
    return name.replace("k2", "k²").replace("k3", "k³")


def print_table(title, head, rows):
    print(f"\n{title}\n")
    print("| " + " | ".join(map(pretty, head)) + " |")
    print("|---" * len(head) + "|")
    for row in rows:
        print(
            "| "
            + " | ".join(pretty(cell) if isinstance(cell, str) else f"{cell:.3f}" for cell in row)
            + " |"
        )


def dot_panel(axis, title, labels, series, reference=None):
    """Draws marks in rows. `series` lists (name, colour, values); a value may be None."""
    axis.set_title(title, fontsize=10, color=INK, loc="left")
    axis.set_yticks(range(len(labels)), list(map(pretty, labels)), fontsize=9)
    axis.set_ylim(len(labels) - 0.5, -0.5)
    axis.grid(axis="x", color=GRID, linewidth=0.7)
    axis.tick_params(length=0, labelsize=9, colors=INK)
    for row in range(0, len(labels), 2):
        axis.axhspan(row - 0.5, row + 0.5, color="#F5F5F5", linewidth=0, zorder=0)
    if reference is not None:
        axis.axvline(reference, color=INK, linewidth=1, zorder=1)
    crowd = [sum(values[row] is not None for _, _, values in series) for row in range(len(labels))]
    for i, (name, colour, values) in enumerate(series):
        shown = [(value, row) for row, value in enumerate(values) if value is not None]
        # One below the other within the row, so that equal values stay readable.
        step = 0.5 * (i / max(len(series) - 1, 1) - 0.5)
        axis.scatter(
            [value for value, _ in shown],
            [row + (step if crowd[row] > 1 else 0) for _, row in shown],
            s=34,
            color=colour,
            marker=MARKERS[i % len(MARKERS)],
            label=pretty(name),
            zorder=3,
        )
    for side in ("top", "right", "left"):
        axis.spines[side].set_visible(False)


def save(figure, axis, columns, path):
    handles, labels = axis.get_legend_handles_labels()
    figure.legend(
        handles, labels, loc="outside lower center", ncol=columns, fontsize=9, frameon=False
    )
    kind = path.suffix[1:]
    # Equal figures make equal files: no date, no random names.
    with rc_context({"svg.hashsalt": "sobb"}):
        figure.savefig(path, dpi=110, metadata={"Date": None} if kind == "svg" else None)


def figure_of(panels, rows, width=10.0):
    figure = Figure(figsize=(width, 1.6 + 0.42 * rows), facecolor="white", layout="constrained")
    return figure, figure.subplots(1, panels, sharey=True, squeeze=False)[0]
