# SPDX-License-Identifier: Apache-2.0
"""Takes a scene all the way: load, build, save, open, check, draw, and compare with Embree."""

import os
from collections.abc import Callable
from pathlib import Path

from PIL import Image
from rich import box
from rich.console import Console
from rich.table import Table

from sobb.hierarchy import Hierarchy, build
from sobb.library import resolve_isa
from sobb.scene import Scene
from sobb.tools.demo import check
from sobb.tools.render import heat, image, shading
from sobb.tools.shared import bench
from sobb.tools.shared.progress import bar
from sobb.view import View

_SIZE = (960, 540)
_CHECKED_RAYS = 1000
_SEED = 2025
_COLUMNS = {"AABB": "aabb", "SOBB": "sobb", "Embree": "embree_medium"}
_KINDS = {"primary": "primary", "diffuse": "diffuse1"}
_CALLS = ("single", "packet", "array")


def run(source: str, out: Path, cameras: str | None) -> None:
    """Runs the demo on a scene file or a built-in scene; writes into the folder `out`."""
    out.mkdir(parents=True, exist_ok=True)
    with Scene.load(source, views=cameras) as scene:
        _say(f"{source}: {scene.info.triangle_count:,} triangles")
        view = scene.views[0]
        with bar("build AABB") as progress:
            aabb = build(scene, volume="aabb", progress=progress)
        with bar("build SOBB") as progress:
            sobb = build(scene, volume="sobb", progress=progress)
        sobb = _reopened(sobb, out / "scene.sobb")
        rays = check.mixed_rays(sobb, view, _CHECKED_RAYS, _SEED)
        with bar(f"check {_CHECKED_RAYS:,} rays by brute force") as progress:
            check.against_brute_force([aabb, sobb], scene, rays, progress)
        _say(f"{_CHECKED_RAYS:,} rays hit what brute force hits, bit by bit, with AABB and SOBB")
    _draw(aabb, sobb, view, out)
    triangles = sobb.info.triangles
    aabb.close()
    sobb.close()  # the benchmark takes the same memory once more
    _compare(source, cameras, triangles)


def _say(line: str) -> None:
    print(line, flush=True)


def _reopened(hierarchy: Hierarchy, path: Path) -> Hierarchy:
    """Saves a hierarchy, and returns it as its file gives it back."""
    hierarchy.save(path)
    opened = Hierarchy.open(path)
    if opened.bytes != hierarchy.bytes:
        raise ValueError(f"{path}: not the bytes that were saved")
    _say(f"{path}: {len(opened.bytes):,} bytes, saved, opened and proved")
    return opened


def _draw(aabb: Hierarchy, sobb: Hierarchy, view: View, out: Path) -> None:
    with bar("draw") as progress:
        picture = Image.fromarray(shading.shaded(sobb, view, *_SIZE, progress))
    image.write_png(out / "image.png", picture)
    work = {name: heat.work(h, view, *_SIZE) for name, h in (("aabb", aabb), ("sobb", sobb))}
    scale = heat.shared_scale(*work.values())
    for name, counts in work.items():
        image.write_png(out / f"heat-{name}.png", heat.picture(counts, scale, name.upper()))
    _say(f"{out}: image.png, heat-aabb.png, heat-sobb.png")


def _compare(source: str, cameras: str | None, triangles: int) -> None:
    threads = len(os.sched_getaffinity(0))
    methods = "|".join(_COLUMNS.values())
    names = f"build/({methods})|({'|'.join(_KINDS.values())})/({methods})/({'|'.join(_CALLS)})"
    arguments = [f"--scene={source}", f"--threads={threads}"]
    arguments += [f"--cameras={cameras}"] if cameras else []
    arguments += [f"--benchmark_filter=^({names})(/manual_time)?$"]
    arguments += ["--benchmark_repetitions=3", "--benchmark_min_time=0.1"]
    with bar("measure"):
        rows = bench.run("sobb_bench", arguments).medians
    table = _table(rows, triangles)
    table.title = f"{source}: {threads} threads, {resolve_isa()}"
    caption = (
        "Areas are relative to that of the scene's box. Volumes and triangles are those that "
        "single rays test. Mrays/s are by the fastest call: of one ray, of a packet or of an array."
    )
    if f"build/{_COLUMNS['Embree']}" not in rows:
        caption += " Embree is not installed, so it has no column."
    table.caption = caption
    Console(width=76, highlight=False).print(table)


def _table(rows: bench.Rows, triangles: int) -> Table:
    columns = {title: name for title, name in _COLUMNS.items() if f"build/{name}" in rows}
    table = Table("", *columns, box=box.SIMPLE_HEAD, title_style="bold", caption_justify="left")
    for column in table.columns[1:]:
        column.justify = "right"

    def add(title: str, cell: Callable[[str], float | None], digits: int) -> None:
        values = (cell(method) for method in columns.values())
        table.add_row(title, *("–" if v is None else f"{v:,.{digits}f}" for v in values))

    def built(counter: str) -> Callable[[str], float | None]:
        return lambda method: rows[f"build/{method}"].get(counter)

    def worked(kind: str, counter: str) -> Callable[[str], float | None]:
        return lambda method: rows[f"{kind}/{method}/single"].get(counter)

    def fastest(kind: str) -> Callable[[str], float | None]:
        def speed(method: str) -> float:
            # Embree 4 has no call that takes an array of rays.
            calls = (rows.get(f"{kind}/{method}/{call}") for call in _CALLS)
            return max(row["Mrays/s"] for row in calls if row is not None)

        return speed

    add("build, ms", built("real_time"), 0)
    add("bytes", lambda method: rows[f"build/{method}"]["bytes/triangle"] * triangles, 0)
    add("area of inner volumes", built("area_inner"), 1)
    add("area of leaf volumes", built("area_leaf"), 1)
    for title, kind in _KINDS.items():
        table.add_section()
        add(f"{title}: volumes per ray", worked(kind, "volumes/ray"), 1)
        add(f"{title}: triangles per ray", worked(kind, "triangles/ray"), 1)
        add(f"{title}: Mrays/s", fastest(kind), 2)
    return table
