# SPDX-License-Identifier: Apache-2.0
"""A progress bar on the terminal; none where stderr is no terminal, or without rich."""

import importlib.util
import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager


@contextmanager
def bar(title: str) -> Iterator[Callable[[float], None]]:
    """Shows a bar on stderr; yields a function that any thread may call with the fraction done."""
    if not sys.stderr.isatty() or importlib.util.find_spec("rich") is None:
        yield lambda fraction: None
        return
    from rich.console import Console  # building needs NumPy alone
    from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn

    columns = TextColumn("{task.description}"), BarColumn(), TimeElapsedColumn()
    with Progress(*columns, console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task(title, total=1.0)
        yield lambda fraction: progress.update(task, completed=fraction)
