# SPDX-License-Identifier: Apache-2.0
"""Prints a scene's rows: with the paper's bold on a terminal, plain into a file."""

import sys

from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from sobb.tools.paper.table import COLUMNS, Group
from sobb.tools.shared.methods import TITLES as METHODS

_PIPED_WIDTH = 120  # enough for all columns on one line


def show(group: Group, layout: str) -> None:
    """Prints one group."""
    table = Table(box=box.SIMPLE_HEAD, title_style="bold", pad_edge=False)
    table.title = Text(f"{group.title}: {layout}")
    table.add_column("Method", no_wrap=True)
    for column in COLUMNS:
        table.add_column(Text(column.title), justify="right")
    for method, cells in group.rows.items():
        texts = (Text(str(cell), "bold" if cell.best else "") for cell in cells)
        table.add_row(METHODS[method], *texts)
    Console(width=None if sys.stdout.isatty() else _PIPED_WIDTH, highlight=False).print(table)
