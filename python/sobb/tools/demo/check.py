# SPDX-License-Identifier: Apache-2.0
"""Compares the hits of hierarchies with those of brute force over all triangles."""

from collections.abc import Callable, Sequence

import numpy as np

from sobb import rays as make
from sobb.hierarchy import Hierarchy
from sobb.oracle import brute_force
from sobb.scene import Scene
from sobb.surface import Surface
from sobb.view import View

_CHUNK = 100  # rays; between chunks Python sees Ctrl-C, and the bar moves


def mixed_rays(hierarchy: Hierarchy, view: View, count: int, seed: int) -> np.ndarray:
    """Makes primary rays of a view, diffuse bounces and random rays through the bounds.

    They are a third each; random rays take the place of bounces where too few primary rays hit.
    Returns ray_dtype (count,).
    """
    random = np.random.default_rng(seed)
    side = 256
    pixels = random.choice(side * side, count * 2 // 3, replace=False)
    primary = make.through_pixels(view, side, side, pixels)
    points = Surface(hierarchy).points(primary, hierarchy.intersect(primary))
    primary, bounces = primary[: count // 3], make.diffuse(points, seed)[: count // 3]
    info = hierarchy.info
    rest = count - len(primary) - len(bounces)
    through = make.random_in_box(info.bounds_min, info.bounds_max, rest, seed)
    return np.concatenate([primary, bounces, through])


def against_brute_force(
    hierarchies: Sequence[Hierarchy],
    scene: Scene,
    rays: np.ndarray,
    progress: Callable[[float], None] = lambda _: None,
) -> None:
    """Raises ValueError, which names the ray, unless all hits equal those of brute force.

    Every bit of primitive, t, u and v has to be equal.
    """
    for first in range(0, len(rays), _CHUNK):
        chunk = rays[first : first + _CHUNK]
        right = brute_force(scene, chunk)
        for hierarchy in hierarchies:
            found = hierarchy.intersect(chunk)
            # They are compared as bytes, so that -0.0 differs from 0.0.
            wrong = np.flatnonzero(right.view("V24") != found.view("V24"))
            if wrong.size:
                i = int(wrong[0])
                raise ValueError(
                    f"{hierarchy.info.volume}: ray {first + i} {chunk[i]} hits {found[i]}, "
                    f"by brute force {right[i]}"
                )
        progress((first + len(chunk)) / len(rays))
