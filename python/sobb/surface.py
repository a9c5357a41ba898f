# SPDX-License-Identifier: Apache-2.0
"""The triangles that a hierarchy carries, by primitive: a hierarchy is complete in itself."""

import numpy as np

from sobb import format
from sobb.dtypes import is_hit
from sobb.hierarchy import Hierarchy


class Surface:
    """Looks triangles up in a hierarchy's own blocks. Holds 4 bytes a triangle."""

    def __init__(self, hierarchy: Hierarchy):
        file = format.parts(hierarchy.bytes)
        self._vertex = file.blocks["vertex"]
        primitives = file.blocks["primitive"].ravel()
        lanes = np.flatnonzero(primitives != format.NO_PRIMITIVE)
        self._lane = np.zeros(int(file.header["triangle_count"]), np.uint32)
        self._lane[primitives[lanes]] = lanes

    def corners(self, primitives: np.ndarray) -> np.ndarray:
        """The corners of triangles (n,): float32 (n, corner, axis)."""
        lane = self._lane[primitives]
        return self._vertex[lane // format.LANES, :, :, lane % format.LANES]

    def points(self, rays: np.ndarray, hits: np.ndarray) -> "SurfacePoints":
        """The points of those of `hits` (hit_dtype, (n,)) that hit something, in their order."""
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
    """Points on a surface, as rays met them."""

    def __init__(self, position: np.ndarray, normal: np.ndarray, epsilon: np.ndarray):
        #: float32 (n, 3)
        self.position = position
        #: float32 (n, 3), unit, on the side that the ray came from
        self.normal = normal
        #: float32 (n,), the distance by which a ray that leaves is lifted off the surface: 64 units
        #: in the last place of the largest coordinate, or of the distance that the ray came
        self.epsilon = epsilon

    def __len__(self) -> int:
        return len(self.position)

    def lifted(self) -> np.ndarray:
        """Origins for rays that leave, float32 (n, 3)."""
        return self.position + self.epsilon[:, None] * self.normal


def length(vectors: np.ndarray) -> np.ndarray:
    """The lengths of vectors (n, 3): (n,)."""
    return np.sqrt(np.einsum("ij,ij->i", vectors, vectors))


def normalised(vectors: np.ndarray) -> np.ndarray:
    """Vectors (n, 3) at length 1; zero stays zero."""
    size = length(vectors)[:, None]
    return np.divide(vectors, size, out=np.zeros_like(vectors), where=size > 0)
