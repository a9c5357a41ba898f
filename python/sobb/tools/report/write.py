# SPDX-License-Identifier: Apache-2.0
"""Reads the results, draws the scenes, and writes the page."""

import json
from pathlib import Path

from sobb.tools.report.page import page
from sobb.tools.report.pictures.draw import Picture, draw
from sobb.tools.report.results import Case, Results, read
from sobb.tools.shared import atomic, scenes
from sobb.tools.shared.progress import bar


def run(
    database: str, out: Path, pictures: bool, size: tuple[int, int], cameras: str | None
) -> None:
    """Writes the page of a file of results.

    database: the file, as `python -m sobb sweep` writes it.
    out: the folder for index.html.
    pictures: draw the scenes that can be loaded on this machine.
    size: the width and height of a picture.
    cameras: a JSON file of views; None for that of the sweep.

    Raises OSError or ValueError where the results cannot be read, or the page cannot be written.
    """
    results = read(database)
    out.mkdir(parents=True, exist_ok=True)
    drawn: list[Picture] = []
    if pictures:
        views = cameras or _cameras(results)
        firsts = {case.scene: case for case in reversed(results.cases)}
        for case in reversed(firsts.values()):
            drawn.append(_draw(case, views, size))
    text = page.html(results, drawn).encode("utf-8", "replace")
    atomic.write_bytes(out / "index.html", text)
    print(f"{out / 'index.html'}: {len(results.cases)} cases, {len(text) / 1e6:.1f} MB")


def _draw(case: Case, cameras: str | None, size: tuple[int, int]) -> Picture:
    try:
        [source] = scenes.resolve([case.scene])
    except (OSError, ValueError) as error:
        return Picture(case.name, str(error))
    with bar(f"draw {case.name}") as progress:
        return draw(case.name, source.argument, cameras, case.view, size, progress)


def _cameras(results: Results) -> str | None:
    """Returns the file of views that the last sweep was given, if this machine has it."""
    try:
        name = json.loads(results.runs[-1].spec or "").get("cameras")
    except (IndexError, ValueError, AttributeError):
        return None
    return name if isinstance(name, str) and Path(name).is_file() else None
