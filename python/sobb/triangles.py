# SPDX-License-Identifier: Apache-2.0
"""Triangles for the C interface, from arrays, a mesh or a scene."""

from typing import Any

import numpy as np

from sobb import structs
from sobb.library import Handle
from sobb.scene import Scene


class TriangleArgument:
    """A sobb_triangles, and references that keep its memory alive."""

    def __init__(self, triangles: Any, faces: Any = None):
        """Checks shapes and types, and converts what the C interface does not take as it is.

        triangles: a Scene; a mesh with `vertices` and `faces`, such as trimesh's; or vertices,
            (n, 3). float32 rows are not copied, and may lie apart, as a slice of wider rows does;
            other types are converted.
        faces: (m, 3) vertex indices, not copied if they are uint32 and contiguous; None where
            `triangles` has its own.
        """
        if isinstance(triangles, Scene):
            if faces is not None:
                raise TypeError("a scene has its own faces")
            self._keep: tuple[Handle | np.ndarray, ...] = (triangles.handle,)
            self.struct = triangles.triangles()
            return
        if hasattr(triangles, "vertices") and hasattr(triangles, "faces"):
            if faces is not None:
                raise TypeError("a mesh has its own faces")
            triangles, faces = triangles.vertices, triangles.faces
        if faces is None:
            raise TypeError("vertices need faces")
        vertices = _vertices(triangles)
        indices = _indices(faces)
        self._keep = (vertices, indices)
        self.struct = structs.Triangles(
            vertices=vertices.ctypes.data,
            vertex_count=len(vertices),
            vertex_stride=vertices.strides[0] if len(vertices) > 1 else 12,
            indices=indices.ctypes.data,
            triangle_count=len(indices),
        )


def _vertices(values: Any) -> np.ndarray:
    with np.errstate(over="ignore"):  # becomes infinite, which the library refuses by index
        vertices = np.asarray(values, dtype=np.float32)
    if vertices.ndim != 2 or vertices.shape[1] != 3:
        raise ValueError(f"vertices have shape {vertices.shape}, not (n, 3)")
    whole = vertices.strides[1] == 4 and vertices.strides[0] >= 12 and vertices.strides[0] % 4 == 0
    return vertices if whole else np.ascontiguousarray(vertices)


def _indices(values: Any) -> np.ndarray:
    faces = np.asarray(values)
    if faces.ndim != 2 or faces.shape[1] != 3:
        raise ValueError(f"faces have shape {faces.shape}, not (m, 3)")
    if faces.size and faces.dtype.kind not in "iu":
        raise TypeError(f"faces are {faces.dtype}, not integers")
    if faces.dtype != np.uint32 and faces.size:
        wrong = (faces < 0) | (faces > 0xFFFFFFFF)
        if wrong.any():
            row, column = np.argwhere(wrong)[0]
            raise ValueError(f"faces[{row}, {column}] is {faces[row, column]}: not an index")
    return np.ascontiguousarray(faces, dtype=np.uint32)
