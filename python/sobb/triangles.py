# SPDX-License-Identifier: Apache-2.0
"""Triangles for the C interface, from arrays, a mesh or a scene."""

import os
from collections.abc import Sequence
from typing import Any

import numpy as np

from sobb import structs
from sobb.library import Handle, point
from sobb.scene import Scene


class TriangleArgument:
    """A sobb_triangles, and references that keep its memory alive."""

    def __init__(self, triangles: Any, faces: Any = None, origin: Sequence[float] | None = None):
        """Checks shapes and types, and converts what the C interface does not take as it is.

        triangles: a Scene; a mesh with `vertices` and `faces`, such as trimesh's, or a scene of
            such meshes; or vertices, (n, 3). float32 rows are not copied, and may lie apart, as a
            slice of wider rows does; other types are converted.
        faces: (m, 3) vertex indices, not copied if they are uint32 and contiguous; None where
            `triangles` has its own.
        origin: a point, (3,), that is subtracted from the vertices in float64, before they are
            rounded to float32; None for none.
        """
        if isinstance(triangles, Scene):
            if faces is not None:
                raise TypeError("a scene has its own faces")
            if origin is not None:
                raise TypeError("a scene is loaded with its origin: Scene.load(..., origin=)")
            self._keep: tuple[Handle | np.ndarray, ...] = (triangles.handle,)
            self.struct = triangles.triangles()
            return
        if faces is None:
            triangles, faces = _arrays_of(triangles)
        elif hasattr(triangles, "vertices") and hasattr(triangles, "faces"):
            raise TypeError("a mesh has its own faces")
        vertices = _vertices(triangles, origin)
        indices = _indices(faces)
        self._keep = (vertices, indices)
        self.struct = structs.Triangles(
            vertices=vertices.ctypes.data,
            vertex_count=len(vertices),
            vertex_stride=vertices.strides[0] if len(vertices) > 1 else 12,
            indices=indices.ctypes.data,
            triangle_count=len(indices),
        )


def _arrays_of(mesh: Any) -> tuple[Any, Any]:
    """Returns the vertices and faces of a mesh, or of all meshes of a scene such as trimesh's."""
    if isinstance(mesh, np.ndarray | list | tuple):
        raise TypeError("vertices need faces: two arrays, (n, 3) and (m, 3)")
    if isinstance(mesh, str | os.PathLike):
        raise TypeError(f"{mesh!r} is a path or a name: load it with sobb.Scene.load()")
    name = f"{type(mesh).__module__}.{type(mesh).__qualname__}"
    if not hasattr(mesh, "vertices"):
        if hasattr(mesh, "to_mesh"):
            mesh = mesh.to_mesh()
        elif hasattr(mesh, "geometry") and hasattr(mesh, "dump"):  # trimesh before it had to_mesh()
            mesh = mesh.dump(concatenate=True)
    faces = getattr(mesh, "faces", None)
    if faces is None:
        faces = getattr(mesh, "triangles", None)  # as Open3D calls them
    if not hasattr(mesh, "vertices") or faces is None:
        raise TypeError(
            f"a {name} has no `vertices` and `faces`: pass its points, (n, 3), and the corners of "
            "its triangles, (m, 3), as two arrays"
        )
    return mesh.vertices, faces


def _vertices(values: Any, origin: Sequence[float] | None) -> np.ndarray:
    if origin is not None:
        values = np.asarray(values, np.float64) - point(origin)
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
