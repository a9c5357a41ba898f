# SPDX-License-Identifier: Apache-2.0
"""A scene: the triangles and views of a file or of a built-in scene."""

import ctypes
import os
from collections.abc import Callable, Sequence
from ctypes import byref, c_void_p
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from sobb import interruptible, library, structs
from sobb.info import SceneInfo, from_struct
from sobb.library import Handle, borrow, check
from sobb.view import View


@dataclass(frozen=True)
class Mesh:
    """A mesh of the file, placed in the scene: a range of the scene's triangles."""

    name: str
    first_triangle: int
    triangle_count: int


@dataclass(frozen=True)
class Note:
    """What loading passed over for one cause."""

    cause: str  # such as "faces of fewer than three corners"
    count: int
    message: str  # the first of them, its place and fault


class Scene:
    """An immutable scene, made by Scene.load(). As a context manager it closes itself."""

    def __init__(self, handle: Handle):
        if not isinstance(handle, Handle):
            raise TypeError("a Scene is made by Scene.load()")
        self._handle: Handle | None = handle

    @classmethod
    def load(
        cls,
        source: str | os.PathLike[str],
        views: str | os.PathLike[str] | None = None,
        memory_limit: int = 0,
        progress: Callable[[float], None] | None = None,
        *,
        origin: Sequence[float] | None = None,
    ) -> "Scene":
        """Loads a scene file or makes a built-in scene.

        source: a .gltf, .glb, .obj, .ply, .stl or .off file, or "builtin:NAME[:TRIANGLES]".
            "^4", "^16" or "^64" behind it refines the scene to so many times its triangles;
            "@DEGREES" turns it and its views.
        views: a JSON file of views; None for a cameras.json beside the scene, if there is one.
        memory_limit: bytes that loading may hold at once; 0 for none.
        progress: as in sobb.build(); raising from it gives up a file that takes too long.
        origin: a point that is subtracted from positions and views in float64, before they are
            rounded to float32: for large coordinates such as UTM's.
        """
        options = structs.SceneOptions(
            views_path=None if views is None else library.path_bytes(views),
            memory_limit=library.unsigned("memory_limit", memory_limit, 64),
        )
        if origin is not None:
            options.origin[:] = library.point(origin)
        lib = library.scene()

        def call(report: Any) -> "Scene":
            options.progress = report
            out = c_void_p()
            check(lib.sobb_scene_load(library.path_bytes(source), byref(options), byref(out)))
            return cls(Handle(out, lib.sobb_scene_release))

        return interruptible.run(call, progress)

    @property
    def handle(self) -> Handle:
        """The reference that keeps the scene's memory alive."""
        if self._handle is None:
            raise ValueError("the scene is closed")
        return self._handle

    def close(self) -> None:
        """Drops the scene. Its memory is freed when the arrays taken from it are gone."""
        self._handle = None

    def __enter__(self) -> "Scene":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __repr__(self) -> str:
        if self._handle is None:
            return "<sobb.Scene, closed>"
        return f"<sobb.Scene, {self.info.triangle_count} triangles>"

    @property
    def vertices(self) -> np.ndarray:
        """The positions, float32 (n, 3), read-only, not copied; the array keeps the scene alive."""
        t = self.triangles()
        return borrow(
            self.handle, t.vertices or 0, "<f4", (t.vertex_count, 3), (t.vertex_stride or 12, 4)
        )

    @property
    def faces(self) -> np.ndarray:
        """The indices, uint32 (m, 3), read-only, not copied; the array keeps the scene alive."""
        t = self.triangles()
        return borrow(self.handle, t.indices or 0, "<u4", (t.triangle_count, 3), None)

    @cached_property
    def info(self) -> SceneInfo:
        """The members of sobb_scene_info."""
        info = structs.SceneInfo()
        check(library.scene().sobb_scene_get_info(self.handle, byref(info)))
        return from_struct(SceneInfo, info)

    @property
    def notes(self) -> list[Note]:
        """What loading passed over, a note per cause; empty for a file without faults."""
        lib, handle, note, notes = library.scene(), self.handle, structs.SceneNote(), []
        for i in range(self.info.note_count):
            check(lib.sobb_scene_get_note(handle, i, byref(note)))
            cause = lib.sobb_note_cause_name(note.cause).decode()
            message = (note.message or b"").decode("utf-8", "replace")
            notes.append(Note(cause, note.count, message))
        return notes

    @property
    def meshes(self) -> list[Mesh]:
        """The meshes, in the order of their triangles."""
        handle, mesh, meshes = self.handle, structs.SceneMesh(), []
        for i in range(self.info.mesh_count):
            check(library.scene().sobb_scene_mesh(handle, i, byref(mesh)))
            name = (mesh.name or b"").decode("utf-8", "replace")
            meshes.append(Mesh(name, mesh.first_triangle, mesh.triangle_count))
        return meshes

    @property
    def views(self) -> list[View]:
        """The views, at least one."""
        handle, view, views = self.handle, structs.SceneView(), []
        for i in range(self.info.view_count):
            check(library.scene().sobb_scene_view(handle, i, byref(view)))
            views.append(
                View(tuple(view.eye), tuple(view.target), tuple(view.up), view.vfov_degrees)
            )
        return views

    def triangles(self) -> structs.Triangles:
        """Returns the scene's sobb_triangles; valid while its handle lives."""
        triangles = structs.Triangles()
        check(library.scene().sobb_scene_triangles(self.handle, ctypes.byref(triangles)))
        return triangles
