# SPDX-License-Identifier: Apache-2.0
"""The triangles that a hierarchy holds, by primitive, and the points where rays hit them."""

import numpy as np

from sobb import format
from sobb.dtypes import is_hit
from sobb.hierarchy import Hierarchy


class Surface:
    """Looks triangles up in a hierarchy's own blocks. It holds 4 bytes per triangle."""

    def __init__(self, hierarchy: Hierarchy):
        file = format.parts(hierarchy.bytes)
        self._vertex = file.blocks["vertex"]
        primitives = file.blocks["primitive"].ravel()
        lanes = np.flatnonzero(primitives != format.NO_PRIMITIVE)
        self._lane = np.zeros(int(file.header["triangle_count"]), np.uint32)
        self._lane[primitives[lanes]] = lanes

    def corners(self, primitives: np.ndarray) -> np.ndarray:
        """Returns the corners of triangles (n,): float32 (n, corner, axis)."""
        lane = self._lane[primitives]
        return self._vertex[lane // format.LANES, :, :, lane % format.LANES]

    def points(self, rays: np.ndarray, hits: np.ndarray) -> "SurfacePoints":
        """Returns the points of those `hits` (hit_dtype, (n,)) that hit a triangle, in order."""
        hit = is_hit(hits)
        rays, hits = rays[hit], hits[hit]
        corners = self.corners(hits["primitive"])
        edge1, edge2 = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
        u, v = hits["u"][:, None], hits["v"][:, None]
        position = corners[:, 0] + u * edge1 + v * edge2
        normal = normalised(np.cross(edge1, edge2))
        behind = np.einsum("ij,ij->i", normal, rays["direction"]) > 0
        normal[behind] *= -1
        scale = np.abs(corners).max(axis=(1, 2)) + hits["t"] * length(rays["direction"])
        return SurfacePoints(position, normal, scale * np.float32(2.0**-18))


class SurfacePoints:
    """Points where rays hit a surface."""

    def __init__(self, position: np.ndarray, normal: np.ndarray, epsilon: np.ndarray):
        #: float32 (n, 3)
        self.position = position
        #: float32 (n, 3), unit, on the side that the ray came from
        self.normal = normal
        #: float32 (n,), the distance by which the origin of a next ray is lifted off the surface:
        #: 2^-18 times the sum of the triangle's largest coordinate and the distance the ray came
        self.epsilon = epsilon

    def __len__(self) -> int:
        return len(self.position)

    def lifted(self) -> np.ndarray:
        """Returns origins for rays that leave the surface, float32 (n, 3)."""
        return self.position + self.epsilon[:, None] * self.normal


def length(vectors: np.ndarray) -> np.ndarray:
    """Returns the lengths of vectors (n, 3): (n,)."""
    return np.sqrt(np.einsum("ij,ij->i", vectors, vectors))


def normalised(vectors: np.ndarray) -> np.ndarray:
    """Scales vectors (n, 3) to length 1; zero stays zero."""
    size = length(vectors)[:, None]
    return np.divide(vectors, size, out=np.zeros_like(vectors), where=size > 0)
