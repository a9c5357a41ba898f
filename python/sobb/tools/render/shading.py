# SPDX-License-Identifier: Apache-2.0
"""Shaded pictures of a hierarchy: sky light with ambient occlusion, and a key light."""

from collections.abc import Callable

import numpy as np

from sobb import rays as make
from sobb.dtypes import is_hit
from sobb.hierarchy import Hierarchy
from sobb.surface import Surface, SurfacePoints, normalised
from sobb.tools.render.image import to_srgb
from sobb.view import View

Progress = Callable[[float], None]

_SAMPLES = 3  # per pixel, in each direction
_BOUNCES = 2  # ambient rays per sample
_BAND = 24 * _SAMPLES  # rows of samples traced at once: whole tiles, whole pixels
_AMBIENT_REACH = 0.15  # how far ambient rays go, in median distances from the eye
_KEY_REACH = 0.1  # how far rays to the key light go, in diagonals of the bounds: rooms are lit, too
_FLOOR = 0.15  # the share of ambient light that reaches where no sky is open
_SEED = 1
# Steps of an evenly spread sequence of points (M. Roberts, R2, 2018): powers of 1/plastic ratio.
_R2 = np.array([0.7548776662466927, 0.5698402909980532])

# Linear light.
_CLAY = np.array([0.64, 0.54, 0.43], np.float32)
_SKY = np.array([0.8, 0.95, 1.2], np.float32)
_GROUND = np.array([0.5, 0.42, 0.36], np.float32)
_KEY = np.array([1.0, 0.93, 0.82], np.float32)
_HORIZON = np.array([0.78, 0.83, 0.88], np.float32)
_ZENITH = np.array([0.24, 0.35, 0.5], np.float32)


def shaded(
    hierarchy: Hierarchy,
    view: View,
    width: int,
    height: int,
    progress: Progress = lambda _: None,
    colours: np.ndarray | None = None,
) -> np.ndarray:
    """Draws clay under a sky, with ambient occlusion: sRGB bytes, uint8 (height, width, 3).

    Each pixel takes 9 samples.
    progress: called with the fraction done, 0 to 1.
    colours: the colours of the triangles, by primitive, in place of the clay's: linear light,
        float32 (m, 3).
    """
    shader = _Shader(hierarchy, view, colours)
    across, down = width * _SAMPLES, height * _SAMPLES
    picture = np.empty((height, width, 3), np.float32)
    for top in range(0, down, _BAND):
        rows = min(_BAND, down - top)
        pixels = make.tile_order(across, rows) + top * across
        rays = make.through_pixels(view, across, down, pixels)
        samples = np.empty((rows * across, 3), np.float32)
        samples[pixels - top * across] = shader.colours(rays, _uniform(pixels, across))
        grid = samples.reshape(rows // _SAMPLES, _SAMPLES, width, _SAMPLES, 3)
        picture[top // _SAMPLES : (top + rows) // _SAMPLES] = grid.mean(axis=(1, 3))
        progress((top + rows) / down)
    return to_srgb(picture)


def _uniform(samples: np.ndarray, across: int) -> np.ndarray:
    """Returns two numbers in [0, 1) for each sample (y * across + x): (n, 2).

    They are evenly spread over the samples of a pixel, and random from pixel to pixel.
    """
    y, x = np.divmod(samples, across)
    pixel = y // _SAMPLES * (across // _SAMPLES) + x // _SAMPLES
    first = int(pixel.min())
    shift = np.random.default_rng((_SEED, first)).random((int(pixel.max()) - first + 1, 2))
    place = y % _SAMPLES * _SAMPLES + x % _SAMPLES
    return shift[pixel - first] + place[:, None] * _R2


class _Shader:
    def __init__(self, hierarchy: Hierarchy, view: View, colours: np.ndarray | None):
        self._hierarchy = hierarchy
        self._colours = colours
        self._surface = Surface(hierarchy)
        info = hierarchy.info
        diagonal = np.linalg.norm(np.subtract(info.bounds_max, info.bounds_min))
        self._key_reach = _KEY_REACH * float(diagonal)
        self._ambient_reach = _AMBIENT_REACH * self._median_distance(view)
        forward, up = (
            normalised(np.array([v], np.float32))[0]
            for v in (np.subtract(view.target, view.eye), view.up)
        )
        right = np.cross(forward, up)
        self._up = up
        # The key light comes over the photographer's left shoulder.
        self._key = normalised((-0.4 * forward - 0.6 * right + 0.65 * up)[None])[0]

    def _median_distance(self, view: View) -> float:
        hits = self._hierarchy.intersect(make.primary(view, 64, 64)[0])
        distances = hits["t"][is_hit(hits)]
        return float(np.median(distances)) if distances.size else 1.0

    def colours(self, rays: np.ndarray, uniform: np.ndarray) -> np.ndarray:
        """Returns linear light along rays (n,): float32 (n, 3).

        `uniform`, (n, 2), gives the directions of bounces.
        """
        hits = self._hierarchy.intersect(rays, coherent=True)
        hit = is_hit(hits)
        colours = np.empty((len(rays), 3), np.float32)
        colours[~hit] = self._background(rays["direction"][~hit])
        points = self._surface.points(rays, hits)
        light = self._light(points, rays["direction"][hit], uniform[hit])
        own = _CLAY if self._colours is None else self._colours[hits["primitive"][hit]]
        colours[hit] = own * light
        return colours

    def _background(self, directions: np.ndarray) -> np.ndarray:
        height = np.clip(directions @ self._up * 0.8 + 0.5, 0, 1)[:, None]
        return _HORIZON + (_ZENITH - _HORIZON) * height

    def _light(
        self, points: SurfacePoints, directions: np.ndarray, uniform: np.ndarray
    ) -> np.ndarray:
        open_sky = _FLOOR + (1 - _FLOOR) * self._openness(points, uniform)[:, None]
        upward = (0.5 + 0.5 * points.normal @ self._up)[:, None]
        ambient = (_GROUND + (_SKY - _GROUND) * upward) * open_sky
        key = self._key_light(points)[:, None] * _KEY
        facing = -np.einsum("ij,ij->i", points.normal, directions)[:, None]
        return 0.5 * ambient + 0.9 * key + 0.1 * facing * open_sky

    def _openness(self, points: SurfacePoints, uniform: np.ndarray) -> np.ndarray:
        """Returns the share of each point's ambient rays that meet nothing in reach."""
        free = np.zeros(len(points), np.float32)
        for bounce in range(_BOUNCES):
            spread = (uniform + bounce * _SAMPLES**2 * _R2) % 1
            rays = make.bounces(points, spread.astype(np.float32))
            rays["tmax"] = self._ambient_reach
            free += self._hierarchy.occluded(rays) == 0
        return free / _BOUNCES

    def _key_light(self, points: SurfacePoints) -> np.ndarray:
        """Returns the cosine to the key light, or 0 where something in reach hides it."""
        cosine = np.maximum(points.normal @ self._key, 0)
        lit = np.flatnonzero(cosine > 0)
        origins = points.lifted()[lit]
        rays = make.make_rays(origins, np.broadcast_to(self._key, origins.shape), self._key_reach)
        cosine[lit[self._hierarchy.occluded(rays, coherent=True) != 0]] = 0
        return cosine
