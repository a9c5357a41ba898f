# SPDX-License-Identifier: Apache-2.0
"""Measures scene after scene, and writes the table anew after each."""

import os
import re
from collections.abc import Callable, Sequence
from pathlib import Path

from sobb.tools.paper import console, csv_table, latex, markdown
from sobb.tools.paper.table import LAYOUTS, STRATEGY, Measured, groups
from sobb.tools.shared import atomic, bench, each_scene, scenes

PROGRAM = "sobb_bench_volumes"
_TURNED = ("city", "foliage", "crown", "sponza-dabrovic")

# Twenty scenes of up to 13 million triangles take less than an hour on two cores.
_EFFORT = ["--size=256", "--cell-seconds=1"]
_QUICK_EFFORT = ["--size=64", "--cell-seconds=0.05"]


def run(
    names: Sequence[str] | None, out: Path, quick: bool, cameras: str | None, threads: int
) -> None:
    """Measures the scenes and writes the table.

    names: the scenes; None for the default ones.
    out: the folder for paper.md, .csv, .tex, .png, .svg and, in raw/, the program's JSON.
    quick: trace few rays, and small scenes by default.
    threads: how many threads build and trace; 0 for all.

    A scene that fails is reported on stderr, and the others are measured; OSError is raised at the
    end then. It is raised before anything is measured where a scene or program is missing.
    """
    sources = (
        scenes.resolve(names) if names else scenes.quick() if quick else scenes.default(_TURNED)
    )
    charts = _charts()
    bench.find_program(PROGRAM)
    (out / "raw").mkdir(parents=True, exist_ok=True)
    arguments = [*(_QUICK_EFFORT if quick else _EFFORT), f"--strategy={STRATEGY}", "--layout=both"]
    arguments.append(f"--threads={threads or len(os.sched_getaffinity(0))}")
    arguments += [f"--cameras={cameras}"] if cameras else []

    raws = dict(zip((s.argument for s in sources), _raw_names(sources), strict=True))
    measured: list[Measured] = []

    def measure(source: scenes.Source) -> bench.Report:
        scene = f"--scene={source.argument}"
        return bench.run(PROGRAM, [scene, *arguments], out / "raw" / raws[source.argument])

    def add(source: scenes.Source, report: bench.Report) -> None:
        measured.append(Measured(source.name, report))
        _write(measured, out, charts)
        _show(measured[-1:])

    def means() -> None:
        if len(measured) > 1:
            _show(measured)

    each_scene.run(sources, measure, add, means)
    print(f"{out}: paper.md, paper.csv, paper.tex, paper.png, paper.svg")


def _charts() -> Callable[[Sequence[Measured], str], bytes]:
    try:
        from sobb.tools.paper import chart
    except ImportError as error:
        raise OSError(f"the chart needs Matplotlib: pip install 'sobb[paper]' ({error})") from None
    return chart.picture


def _write(measured: Sequence[Measured], out: Path, charts) -> None:
    for name, text in (
        ("paper.md", markdown.text(measured)),
        ("paper.csv", csv_table.text(measured)),
        ("paper.tex", latex.text(measured)),
    ):
        atomic.write_bytes(out / name, text.encode())
    for kind in ("png", "svg"):
        atomic.write_bytes(out / f"paper.{kind}", charts(measured, kind))


def _show(measured: Sequence[Measured]) -> None:
    """Prints the rows of one scene, or the means of several."""
    for layout, what in LAYOUTS.items():
        console.show(groups(measured, layout)[-1], what)


def _raw_names(sources: Sequence[scenes.Source]) -> list[str]:
    """Makes file names of the scenes' names, so that measuring a scene again replaces its file.

    Scenes of the same name, from different folders, are numbered.
    """
    stems = [re.sub(r"[^\w@.+-]", "-", source.argument.split("/")[-1]) for source in sources]
    stems = [stem.removeprefix("builtin-") for stem in stems]
    again = [stems[:i].count(stem) for i, stem in enumerate(stems)]
    return [f"{s}-{n + 1}.json" if n else f"{s}.json" for s, n in zip(stems, again, strict=True)]
