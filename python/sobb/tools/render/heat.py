# SPDX-License-Identifier: Apache-2.0
"""Heat maps: the work of each ray as a colour, with a scale beside the picture."""

import math

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from sobb import rays as make
from sobb.hierarchy import Hierarchy
from sobb.tools.render.image import to_srgb
from sobb.view import View

_MARGIN = 12
_BAR = 18
_LEGEND = 92  # pixels, beside the map
_TEXT = 13
_PAPER = (18, 18, 20)
_INK = (225, 225, 225)


def work(hierarchy: Hierarchy, view: View, width: int, height: int) -> np.ndarray:
    """Counts volumes and triangles that each pixel's primary ray tests: uint32 (height, width)."""
    rays, pixels = make.primary(view, width, height)
    _, counts = hierarchy.intersect(rays, counts=True)
    picture = np.empty(width * height, np.uint32)
    picture[pixels] = counts["volumes"] + counts["triangles"]
    return picture.reshape(height, width)


def colour_map(size: int = 256) -> np.ndarray:
    """Returns colours from little work to much, uint8 (size, 3).

    In OKLab (B. Ottosson, 2020), lightness rises evenly, as the eye sees it, while the hue turns
    from blue over red to yellow.
    """
    s = np.linspace(0, 1, size)
    lightness = 0.12 + 0.83 * s
    chroma = 0.17 * np.sin(np.pi * np.clip(0.12 + 0.75 * s, 0, 1))
    hue = np.radians(-80 + 180 * s)
    a, b = chroma * np.cos(hue), chroma * np.sin(hue)
    cones = (
        np.stack(
            [
                lightness + 0.3963377774 * a + 0.2158037573 * b,
                lightness - 0.1055613458 * a - 0.0638541728 * b,
                lightness - 0.0894841775 * a - 1.2914855480 * b,
            ]
        )
        ** 3
    )
    to_rgb = np.array(
        [
            [4.0767416621, -3.3077115913, 0.2309699292],
            [-1.2684380046, 2.6097574011, -0.3413193965],
            [-0.0041960863, -0.7034186147, 1.7076147010],
        ]
    )
    return to_srgb((to_rgb @ cones).T)


def shared_scale(*maps: np.ndarray) -> int:
    """Returns the value at the top of a scale that several maps share.

    All but one pixel in 200 are below it. It is a multiple of 4, for the legend's marks.
    """
    much = max(float(np.percentile(work, 99.5)) for work in maps)
    return max(4, math.ceil(much / 4) * 4)


def coloured(work: np.ndarray, scale: int) -> np.ndarray:
    """Colours a map from 0 to `scale`, without a legend: uint8 (height, width, 3)."""
    index = np.minimum(work.astype(np.float64) * 255 / scale + 0.5, 255).astype(np.uint8)
    return colour_map()[index]


def picture(work: np.ndarray, scale: int, title: str) -> Image.Image:
    """Draws a map of work (height, width) with its legend, and `title` below."""
    height, width = work.shape
    result = Image.new("RGB", (width + _LEGEND, height + 2 * _TEXT), _PAPER)
    result.paste(Image.fromarray(coloured(work, scale)), (0, 0))
    _draw_legend(result, width, height, colour_map(), scale)
    caption = f"{title}: {work.mean():.1f} volumes and triangles per ray, on average"
    ImageDraw.Draw(result).text(
        (_MARGIN, height + _TEXT), caption, _INK, ImageFont.load_default(_TEXT), anchor="lm"
    )
    return result


def _draw_legend(result: Image.Image, left: int, height: int, colours: np.ndarray, scale: int):
    font = ImageFont.load_default(_TEXT)
    draw = ImageDraw.Draw(result)
    length = max(height - 2 * _MARGIN, 1)
    levels = np.linspace(255, 0, length).round().astype(int)
    bar = np.repeat(colours[levels][:, None], _BAR, axis=1)
    result.paste(Image.fromarray(bar), (left + _MARGIN, _MARGIN))
    marks = [] if length < 4 * _TEXT else range(5)
    for mark in marks:
        y = _MARGIN + (length - 1) * (4 - mark) / 4
        x = left + _MARGIN + _BAR
        draw.line([(x, y), (x + 4, y)], _INK)
        label = f"{scale * mark // 4}" + ("+" if mark == 4 else "")
        draw.text((x + 8, y), label, _INK, font, anchor="lm")
