# SPDX-License-Identifier: Apache-2.0
"""Boxes around the subtrees of a hierarchy: AABBs, OBBs and SOBBs, each as three slabs."""

import itertools
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from sobb.surface import normalised
from sobb.tools.report.pictures.levels import Cut

_FLAT = 1e-3  # the least |det|: directions nearly in one plane bound nothing

TRIANGLES = 12  # in the mesh of one box


class Boxes(NamedTuple):
    """Parallelepipeds: the points p with low <= normal @ p <= high."""

    normal: np.ndarray  # float64 (n, 3, 3)
    low: np.ndarray  # float64 (n, 3)
    high: np.ndarray

    def edges(self) -> np.ndarray:
        """Returns the three edges from a corner, as columns: (n, axis, edge)."""
        return np.linalg.inv(self.normal) * (self.high - self.low)[:, None, :]

    def areas(self) -> np.ndarray:
        """Returns the surface areas, (n,)."""
        a, b, c = np.moveaxis(self.edges(), 2, 0)
        pairs = ((a, b), (b, c), (c, a))
        return 2 * sum(np.linalg.norm(np.cross(u, v), axis=1) for u, v in pairs)

    def mesh(self) -> tuple[np.ndarray, np.ndarray]:
        """Returns vertices, float32 (8 n, 3), and faces, uint32 (12 n, 3), TRIANGLES per box."""
        corner = np.linalg.inv(self.normal) @ self.low[:, :, None]
        place = np.array([[i & 1, i >> 1 & 1, i >> 2] for i in range(8)], np.float64).T
        vertices = (corner + self.edges() @ place).transpose(0, 2, 1)
        faces = np.arange(len(self.low))[:, None, None] * 8 + _FACES
        return vertices.reshape(-1, 3).astype(np.float32), faces.reshape(-1, 3).astype(np.uint32)


# Bit j of a corner's number says on which side of slab j it lies.
_QUADS = ((0, 1, 3, 2), (4, 5, 7, 6), (0, 1, 5, 4), (2, 3, 7, 6), (0, 2, 6, 4), (1, 3, 7, 5))
_FACES = np.array([t for a, b, c, d in _QUADS for t in ((a, b, c), (a, c, d))])


def axis_aligned(cut: Cut) -> Boxes:
    """Returns the axis-aligned boxes of the subtrees' triangles."""
    return _around(cut, np.broadcast_to(np.eye(3), (len(cut.first), 3, 3)))


def oriented(cut: Cut) -> Boxes:
    """Returns oriented boxes: for each subtree the one with the least area over several frames.

    It is no exact minimum, which would need the convex hull of each subtree.
    """
    best = axis_aligned(cut)
    least = best.areas()
    for frame in _frames(cut):
        box = _around(cut, frame)
        areas = box.areas()
        better = areas < least
        least = np.where(better, areas, least)
        best = Boxes(
            *(
                np.where(better.reshape(-1, *[1] * (a.ndim - 1)), b, a)
                for a, b in zip(best, box, strict=True)
            )
        )
    return best


def skewed(cut: Cut, directions: np.ndarray) -> Boxes:
    """Returns skewed boxes from a file's table of directions, (K, 3), by the strategy k².

    It takes the narrowest slab, and the two others that make the area least.
    """
    directions = directions.astype(np.float64)
    low, high = _extents(cut, directions)
    width = high - low
    chosen = np.repeat(width.argmin(axis=1)[:, None], 3, axis=1)
    first, narrow = chosen[:, 0].copy(), width.min(axis=1)
    least = np.full(len(width), np.inf)
    for second, third in itertools.combinations(range(len(directions)), 2):
        determinant = np.abs(directions @ np.cross(directions[second], directions[third]))[first]
        b, c = width[:, second], width[:, third]
        sides = narrow * b + b * c + c * narrow
        flat = determinant < _FLAT
        area = np.divide(sides, determinant, out=np.full_like(sides, np.inf), where=~flat)
        better = area < least
        least[better] = area[better]
        chosen[better, 1:] = second, third
    row = np.arange(len(width))[:, None]
    return Boxes(directions[chosen], low[row, chosen], high[row, chosen])


def _frames(cut: Cut) -> Iterator[np.ndarray]:
    """Yields orthonormal frames, (n, 3, 3) each.

    They are the principal axes of the triangles, and the normal of the largest triangle with each
    of its edges.
    """
    edge = np.roll(cut.corners, -1, axis=1).astype(np.float64) - cut.corners
    normal = np.cross(edge[:, 0], edge[:, 1])
    weight = np.linalg.norm(normal, axis=1)
    yield _principal(cut, weight)
    largest = _largest(cut, weight)
    up = normalised(normal[largest])
    for side in range(3):
        along = normalised(edge[largest, side])
        frame = np.stack([up, along, np.cross(up, along)], axis=1)
        flat = weight[largest] == 0  # a triangle without area has no frame
        frame[flat] = np.eye(3)
        yield frame


def _principal(cut: Cut, weight: np.ndarray) -> np.ndarray:
    """Returns the axes of the covariance of the triangles' points, weighted by area."""
    middle = cut.corners.mean(axis=1, dtype=np.float64)
    weight = weight + weight.max() * 1e-12 + 1e-300  # where all are degenerate they count alike
    total = np.add.reduceat(weight, cut.first)
    mean = np.add.reduceat(middle * weight[:, None], cut.first) / total[:, None]
    owner = cut.owners()
    spread = np.zeros((len(cut.first), 3, 3))
    for corner in range(3):
        apart = cut.corners[:, corner] - mean[owner]
        products = apart[:, :, None] * apart[:, None, :] * weight[:, None, None]
        spread += np.add.reduceat(products, cut.first)
    return np.linalg.eigh(spread / total[:, None, None])[1].transpose(0, 2, 1)


def _largest(cut: Cut, weight: np.ndarray) -> np.ndarray:
    """Returns the index of each subtree's largest triangle."""
    most = np.maximum.reduceat(weight, cut.first)
    owner = cut.owners()
    candidates = np.flatnonzero(weight == most[owner])
    return candidates[np.searchsorted(owner[candidates], np.arange(len(cut.first)))]


def _around(cut: Cut, normal: np.ndarray) -> Boxes:
    """Returns the boxes with these normals, (n, 3, 3), around each subtree's triangles."""
    own = normal.astype(np.float32)[cut.owners()]
    along = np.einsum("tca,tja->tcj", cut.corners, own).reshape(-1, 3)
    return Boxes(normal, *_reach(cut, along))


def _extents(cut: Cut, directions: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the extents of each subtree along directions (K, 3): low and high, (n, K)."""
    points = cut.corners.reshape(-1, 3)
    reaches = [_reach(cut, points @ direction) for direction in directions.astype(np.float32)]
    low, high = zip(*reaches, strict=True)
    return np.stack(low, axis=1), np.stack(high, axis=1)


def _reach(cut: Cut, along: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Returns the least and the largest value of each subtree's corners, (3 m, ...)."""
    first = cut.first * 3
    low, high = np.minimum.reduceat(along, first), np.maximum.reduceat(along, first)
    return low.astype(np.float64), high.astype(np.float64)
