# SPDX-License-Identifier: Apache-2.0
"""The table as LaTeX: a file to \\input, which needs the packages booktabs and longtable."""

from collections.abc import Sequence

from sobb.tools.paper.table import COLUMNS, LAYOUTS, Group, Measured, groups
from sobb.tools.shared.cells import Cell, number
from sobb.tools.shared.methods import TITLES as METHODS

_SPECIAL = {
    "\\": r"\textbackslash{}",
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "<": r"\textless{}",
    ">": r"\textgreater{}",
    "|": r"\textbar{}",
    **{character: f"\\{character}" for character in "&%$#_{}"},
}


def text(scenes: Sequence[Measured]) -> str:
    """Returns the whole file: a longtable for each layout."""
    tables = (_table(groups(scenes, layout), what) for layout, what in LAYOUTS.items())
    return "% \\usepackage{booktabs,longtable}\n" + "\n".join(tables)


def escape(name: str) -> str:
    """Escapes the characters that are commands."""
    return "".join(_SPECIAL.get(character, character) for character in name)


def _table(shown: Sequence[Group], what: str) -> str:
    # A value and its ratio are two columns, so that both line up.
    titles = (f"\\multicolumn{{2}}{{r}}{{{escape(column.title)}}}" for column in COLUMNS)
    lines = [
        f"\\begin{{longtable}}{{ll{'r@{~}r' * len(COLUMNS)}}}",
        f"\\caption{{Bounding volumes compared: {escape(what)}}} \\\\",
        "\\toprule",
        f"Scene [\\#triangles] & Method & {' & '.join(titles)} \\\\",
        "\\midrule",
        "\\endhead",
    ]
    for i, group in enumerate(shown):
        lines += ["\\midrule"] if i else []
        title = f"\\textbf{{{escape(group.title)}}}"
        for method, cells in group.rows.items():
            lines.append(f"{title} & {METHODS[method]} & {' & '.join(map(_cell, cells))} \\\\")
            title = ""
    return "\n".join([*lines, "\\bottomrule", "\\end{longtable}", ""])


def _cell(cell: Cell) -> str:
    value = "--" if cell.value is None else number(cell.value)
    ratio = "" if cell.ratio is None else f"({cell.ratio:.2f})"
    if cell.value is None and ratio:
        value = ""
    if cell.best:
        value, ratio = (f"\\textbf{{{part}}}" if part else "" for part in (value, ratio))
    return f"{value} & {ratio}"
