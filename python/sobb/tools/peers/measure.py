# SPDX-License-Identifier: Apache-2.0
"""Measures scene after scene, prints the figures of each, and a summary."""

import json
import os
from collections.abc import Sequence
from pathlib import Path

from sobb.tools.peers import console
from sobb.tools.peers.figures import Figure, figures, row_filter
from sobb.tools.peers.summary import lines
from sobb.tools.shared import atomic, bench, each_scene, scenes
from sobb.tools.shared.isa import EMBREE

_PROGRAM = "sobb_bench"
_TURNED = ("city", "sponza-dabrovic")


def run(
    names: Sequence[str] | None,
    cameras: str | None,
    threads: int,
    isa: str,
    size: int,
    repetitions: int,
    out: Path | None,
) -> None:
    """Measures the scenes and prints their figures.

    names: the scenes; None for the default ones.
    threads: how many threads trace; 0 for all. Builds take all.
    isa: the instruction set of both libraries.
    size: there are size x size primary rays.
    out: the file for the figures as JSON, written after every scene; None for no file.

    A scene that fails is reported on stderr, and the others are measured; OSError is raised at the
    end then. It is raised before anything is measured where a scene or program is missing.
    """
    sources = scenes.resolve(names) if names else scenes.default(_TURNED)
    bench.find_program(_PROGRAM)
    if out is not None and not out.parent.is_dir():
        raise OSError(f"{out}: no folder {out.parent}")
    threads = threads or len(os.sched_getaffinity(0))
    arguments = [f"--isa={isa}", f"--embree-isa={EMBREE[isa]}", f"--threads={threads}"]
    arguments += [f"--size={size}"] + ([f"--cameras={cameras}"] if cameras else [])
    arguments += [f"--benchmark_filter={row_filter()}", f"--benchmark_repetitions={repetitions}"]
    arguments += ["--benchmark_min_time=0.01"]  # one pass, unless there are few rays
    found: list[Figure] = []

    def measure(source: scenes.Source) -> bench.Report:
        return bench.run(_PROGRAM, [f"--scene={source.argument}", *arguments])

    def add(source: scenes.Source, report: bench.Report) -> None:
        of_scene = figures(source, report)
        found.extend(of_scene)
        if out is not None:
            entries = [figure.entry(threads, isa) for figure in found]
            atomic.write_bytes(out, (json.dumps(entries, indent=1) + "\n").encode())
        console.show_scene(of_scene)

    def sum_up() -> None:
        count = len({figure.scene for figure in found})
        if count > 1:
            console.show_summary(lines(found), count)

    each_scene.run(sources, measure, add, sum_up)
