# SPDX-License-Identifier: Apache-2.0
"""Draws the pictures of a scene: rendered, the work of its rays, the volumes of two levels."""

import base64
import io
from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from PIL import Image

from sobb import format
from sobb.error import Error
from sobb.hierarchy import build
from sobb.scene import Scene
from sobb.tools.render import heat, shading
from sobb.tools.report.pictures import boxes, levels
from sobb.view import View

_LEVELS = (13, 17)  # the levels of the paper's figure
_QUALITY = 84
_SEED = 5

Progress = Callable[[float], None]


@dataclass(frozen=True)
class Heat:
    """The work of each ray with one kind of volumes: the heat map, and its mean."""

    image: str
    mean: str


@dataclass(frozen=True)
class BoxPicture:
    """The volumes of one kind at a level; their area is relative to that of the scene's box."""

    name: str
    image: str
    area: float


@dataclass(frozen=True)
class Level:
    """A level of the hierarchy: its volumes, those that are leaves, and a picture per kind."""

    level: int
    volumes: int
    leaves: int
    boxes: list[BoxPicture]


@dataclass(frozen=True)
class Picture:
    """All pictures of a scene as data: addresses, or the problem that prevented them."""

    title: str
    problem: str = ""
    size: tuple[int, int] = (0, 0)
    triangles: int = 0
    rendered: str = ""
    heats: dict[str, Heat] = field(default_factory=dict)  # "aabb", "sobb"
    scale: int = 0  # the work at the top of the scale
    levels: list[Level] = field(default_factory=list)


def draw(
    title: str,
    source: str,
    cameras: str | None,
    view: int,
    size: tuple[int, int],
    progress: Progress,
) -> Picture:
    """Draws a scene; the picture of one that cannot be loaded or built says why."""
    try:
        with Scene.load(source, views=cameras) as scene:
            if view >= len(scene.views):
                return Picture(title, f"{source}: no view {view}, there are {len(scene.views)}")
            return _draw(title, scene, scene.views[view], size, progress)
    except (Error, OSError, MemoryError) as error:
        return Picture(title, str(error) or "out of memory")


def _draw(
    title: str, scene: Scene, view: View, size: tuple[int, int], progress: Progress
) -> Picture:
    with build(scene, volume="sobb") as sobb, build(scene, volume="aabb") as aabb:
        progress(0.1)
        rendered = shading.shaded(sobb, view, *size, lambda done: progress(0.1 + 0.3 * done))
        work = {"aabb": heat.work(aabb, view, *size), "sobb": heat.work(sobb, view, *size)}
    progress(0.5)
    scale = heat.shared_scale(*work.values())
    return Picture(
        title,
        size=size,
        triangles=scene.info.triangle_count,
        rendered=_address(rendered),
        heats={
            name: Heat(_address(heat.coloured(counts, scale)), f"{counts.mean():.1f}")
            for name, counts in work.items()
        },
        scale=scale,
        levels=_levels(scene, view, size, lambda done: progress(0.5 + 0.5 * done)),
    )


def _levels(scene: Scene, view: View, size: tuple[int, int], progress: Progress) -> list[Level]:
    """Draws the levels of one hierarchy: only the volumes differ, as in the paper."""
    drawn = []
    half = max(size[0] // 2, 1), max(size[1] // 2, 1)
    with build(scene, volume="sobb", table="spread", width=4) as hierarchy:
        file = format.parts(hierarchy.bytes)
        extent = file.record["bounds_max"].astype(np.float64) - file.record["bounds_min"]
        whole = 2 * float(extent @ np.roll(extent, 1)) or 1.0
        for i, level in enumerate(_LEVELS):
            cut = levels.cut(file, level)
            kinds = {
                "AABB": boxes.axis_aligned(cut),
                "OBB": boxes.oriented(cut),
                "SOBB": boxes.skewed(cut, file.directions),
            }
            pictures = [
                BoxPicture(name, _boxes(kind, view, half), float(kind.areas().sum()) / whole)
                for name, kind in kinds.items()
            ]
            drawn.append(Level(level, len(cut.first), cut.leaves, pictures))
            progress((i + 1) / len(_LEVELS))
    return drawn


def _boxes(drawn: boxes.Boxes, view: View, size: tuple[int, int]) -> str:
    """Draws boxes as solids; a subtree's box has one colour in every picture of its level."""
    colours = _colours(len(drawn.low)).repeat(boxes.TRIANGLES, axis=0)
    with build(*drawn.mesh(), volume="aabb") as hierarchy:
        return _address(shading.shaded(hierarchy, view, *size, colours=colours))


def _colours(count: int) -> np.ndarray:
    """Returns random hues of nearly one lightness: linear light, float32 (count, 3)."""
    random = np.random.default_rng(_SEED)
    hue = random.random((count, 1)) * 2 * np.pi
    wave = np.cos(hue - np.array([0, 2, 4]) * np.pi / 3)
    return ((0.42 + 0.26 * wave) * random.uniform(0.75, 1.15, (count, 1))).astype(np.float32)


def _address(picture: np.ndarray) -> str:
    """Encodes a picture, uint8 (height, width, 3), as a data: address."""
    data = io.BytesIO()
    Image.fromarray(picture).save(data, "webp", quality=_QUALITY, method=5)
    return "data:image/webp;base64," + base64.b64encode(data.getvalue()).decode()
