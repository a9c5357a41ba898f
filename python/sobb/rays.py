# SPDX-License-Identifier: Apache-2.0
"""Rays to trace: primary rays of a view, diffuse bounces, random rays through a box."""

import math
from collections.abc import Sequence

import numpy as np

from sobb.dtypes import ray_dtype
from sobb.surface import SurfacePoints, normalised
from sobb.view import View

TILE = 8
PACKET_SIDE = 4


def tile_order(width: int, height: int) -> np.ndarray:
    """Returns the pixels (y * width + x) of a picture in the order of its rays.

    Tiles of 8 x 8 follow each other row by row; in a tile, four squares of 4 x 4; in a square, the
    pixels row by row. If the sides of the picture are multiples of 4, any 16 rays from a multiple
    of 16 on are one square, which makes a coherent packet.
    """
    y, x = (axis.ravel() for axis in np.mgrid[:height, :width])
    keys = (x, y, x // PACKET_SIDE, y // PACKET_SIDE, x // TILE, y // TILE)
    return np.lexsort(keys)


def primary(view: View, width: int, height: int) -> tuple[np.ndarray, np.ndarray]:
    """Makes rays through the centres of a picture's pixels, directions of length 1, in tile order.

    Returns (rays, pixels): ray_dtype (width * height,), and the pixel y * width + x of each ray.
    """
    pixels = tile_order(width, height)
    return through_pixels(view, width, height, pixels), pixels


def through_pixels(view: View, width: int, height: int, pixels: np.ndarray) -> np.ndarray:
    """Makes the primary rays of some pixels (y * width + x) of a picture: ray_dtype (n,)."""
    eye, target, up = (np.array(v, np.float64) for v in (view.eye, view.target, view.up))
    forward = normalised((target - eye)[None])[0]
    right = normalised(np.cross(forward, up)[None])[0]
    above = np.cross(right, forward)
    tangent = math.tan(math.radians(view.vfov_degrees) / 2)
    y, x = np.divmod(pixels, width)
    across = ((2 * x + 1) / width - 1) * tangent * width / height
    upward = (1 - (2 * y + 1) / height) * tangent
    directions = forward + across[:, None] * right + upward[:, None] * above
    return make_rays(np.broadcast_to(eye, directions.shape), normalised(directions))


def make_rays(
    origins: np.ndarray, directions: np.ndarray, tmax: np.ndarray | float = np.inf
) -> np.ndarray:
    """Makes rays of origins (n, 3) and directions (n, 3), with tmin 0: ray_dtype (n,)."""
    rays = np.zeros(len(origins), ray_dtype)
    rays["origin"] = origins
    rays["direction"] = directions
    rays["tmax"] = tmax
    return rays


def diffuse(points: SurfacePoints, seed: int | Sequence[int]) -> np.ndarray:
    """Makes a bounce from each point; directions are distributed by the cosine to the normal.

    The same points and seed give the same rays. Origins are lifted off the surface by
    points.epsilon. Returns ray_dtype (n,).
    """
    return bounces(points, np.random.default_rng(seed).random((len(points), 2), np.float32))


def bounces(points: SurfacePoints, uniform: np.ndarray) -> np.ndarray:
    """Makes bounces as diffuse() does, from the caller's numbers, float32 (n, 2) in [0, 1).

    Numbers that are evenly spread give less noise than random ones.
    """
    # A point on the unit sphere around the tip of the normal: the sum has the cosine's density.
    z = 1 - 2 * uniform[:, 0]
    radius = np.sqrt(np.maximum(1 - z * z, 0))
    angle = np.float32(2 * math.pi) * uniform[:, 1]
    sphere = np.stack([radius * np.cos(angle), radius * np.sin(angle), z], axis=1)
    directions = points.normal + np.float32(0.999) * sphere  # never zero
    return make_rays(points.lifted(), normalised(directions))


def random_in_box(
    bounds_min: Sequence[float], bounds_max: Sequence[float], count: int, seed: int | Sequence[int]
) -> np.ndarray:
    """Makes rays through pairs of random points in a box, without an end: ray_dtype (count,)."""
    random = np.random.default_rng(seed).random((2, count, 3))
    low, high = np.array(bounds_min, np.float64), np.array(bounds_max, np.float64)
    start, end = low + random * (high - low)
    directions = end - start
    directions[~directions.any(axis=1)] = (1, 0, 0)
    return make_rays(start, directions)
