# SPDX-License-Identifier: Apache-2.0
"""A hierarchy: building, saving, opening and tracing it."""

import os
from collections.abc import Callable, Sequence
from ctypes import byref, c_uint64, c_void_p
from pickle import PickleBuffer
from typing import Any, Literal, overload

import numpy as np

from sobb import interruptible, library, structs
from sobb.dtypes import count_dtype, hit_dtype, ray_dtype
from sobb.info import QUALITIES, STRATEGIES, TABLES, VOLUMES, HierarchyInfo, from_struct
from sobb.library import Handle, check, isa_number, number_of, unsigned
from sobb.triangles import TriangleArgument

_OPEN_MAP = 1
_TRACE_COHERENT = 1


class Hierarchy:
    """An immutable hierarchy, made by build(), Hierarchy.open() or Hierarchy.from_bytes().

    Any number of threads may use one at once. As a context manager it closes itself.
    """

    def __init__(self, handle: Handle):
        if not isinstance(handle, Handle):
            raise TypeError("a Hierarchy is made by build(), open() or from_bytes()")
        self._handle: Handle | None = handle

    @classmethod
    def open(
        cls,
        path: str | os.PathLike[str],
        map: bool = False,
        threads: int = 0,
        memory_limit: int = 0,
        progress: Callable[[float], None] | None = None,
    ) -> "Hierarchy":
        """Opens a .sobb file and proves it safe to trace.

        map: trace the file where it lies, instead of a private copy. Nobody may then change or
            truncate it while the hierarchy lives.
        threads: how many threads validate at most; 0 for all.
        memory_limit: in bytes; 0 for none.
        progress: as in build(); raising from it gives up a file that takes too long.
        """
        options = structs.OpenOptions(
            flags=_OPEN_MAP if map else 0,
            threads=unsigned("threads", threads),
            memory_limit=unsigned("memory_limit", memory_limit, 64),
        )

        def call(report: Any) -> "Hierarchy":
            options.progress = report
            out = c_void_p()
            check(library.core().sobb_open(library.path_bytes(path), byref(options), byref(out)))
            return cls(Handle(out, library.core().sobb_release))

        return interruptible.run(call, progress)

    @classmethod
    def from_bytes(cls, data: Any, threads: int = 0, memory_limit: int = 0) -> "Hierarchy":
        """Opens the bytes of a file, as open() does.

        data: anything with the buffer protocol; it is copied.
        """
        view = memoryview(data)
        content = np.frombuffer(view, np.uint8) if view.nbytes else np.empty(0, np.uint8)
        options = structs.OpenOptions(
            threads=unsigned("threads", threads),
            memory_limit=unsigned("memory_limit", memory_limit, 64),
        )
        out = c_void_p()
        check(
            library.core().sobb_open_memory(
                content.ctypes.data, content.size, byref(options), byref(out)
            )
        )
        return cls(Handle(out, library.core().sobb_release))

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the file atomically: whatever happens, `path` is the old file or the new one."""
        check(library.core().sobb_save(self.handle, library.path_bytes(path)))

    @property
    def bytes(self) -> memoryview:
        """The bytes that save() writes, not copied; the view keeps the hierarchy alive."""
        handle, data, size = self.handle, c_void_p(), c_uint64()
        check(library.core().sobb_bytes(handle, byref(data), byref(size)))
        return library.borrow(handle, data.value or 0, "|u1", (size.value,), None).data

    @property
    def info(self) -> HierarchyInfo:
        """The members of sobb_info, with names for volume, quality, strategy and table.

        Cost: O(nodes).
        """
        struct = structs.HierarchyInfo()
        check(library.core().sobb_get_info(self.handle, byref(struct)))
        return from_struct(HierarchyInfo, struct)

    @overload
    def intersect(
        self,
        rays: np.ndarray,
        coherent: bool = False,
        threads: int = 0,
        counts: Literal[False] = False,
        isa: str = "best",
        out: np.ndarray | None = None,
    ) -> np.ndarray: ...

    @overload
    def intersect(
        self,
        rays: np.ndarray,
        coherent: bool = False,
        threads: int = 0,
        *,
        counts: Literal[True],
        isa: str = "best",
        out: np.ndarray | None = None,
    ) -> tuple[np.ndarray, np.ndarray]: ...

    def intersect(self, rays, coherent=False, threads=0, counts=False, isa="best", out=None):
        """Finds the closest hit of each ray.

        rays: ray_dtype, any shape; not copied if contiguous.
        coherent: neighbours in the array are alike, so begin with packets. As `threads` and `isa`,
            this changes the speed and never the result.
        threads: how many threads trace at most; 0 for all.
        counts: return the work done for each ray as well.
        isa: the instruction set, "best", "sse4" or "avx2".
        out: the array that takes the hits, hit_dtype of the shape of `rays`, contiguous. A loop
            that passes one saves the time that new memory takes.

        Returns hits, hit_dtype of the shape of `rays`; with `counts`, (hits, counts), the second
        of count_dtype. A ray that is not valid gets primitive INVALID.
        """
        rays = contiguous_rays(rays)
        hits = _output(rays, hit_dtype, out)
        work = np.empty(rays.shape, count_dtype) if counts else None
        self._trace(library.core().sobb_intersect, rays, hits, work, coherent, threads, isa)
        return hits if work is None else (hits, work)

    def occluded(
        self,
        rays: np.ndarray,
        coherent: bool = False,
        threads: int = 0,
        isa: str = "best",
        out: np.ndarray | None = None,
    ) -> np.ndarray:
        """Tells whether each ray meets a triangle. The arguments are those of intersect().

        Returns uint8 of the shape of `rays`: 0 for a free ray, 1 for an occluded one,
        OCCLUDED_INVALID for one that is not valid.
        """
        rays = contiguous_rays(rays)
        occluded = _output(rays, np.dtype(np.uint8), out)
        self._trace(library.core().sobb_occluded, rays, occluded, None, coherent, threads, isa)
        return occluded

    def _trace(self, function, rays, out, counts, coherent, threads, isa) -> None:
        options = structs.TraceOptions(
            flags=_TRACE_COHERENT if coherent else 0,
            threads=unsigned("threads", threads),
            isa=isa_number(isa),
            counts=None if counts is None else counts.ctypes.data,
        )
        check(function(self.handle, rays.ctypes.data, rays.size, out.ctypes.data, byref(options)))

    @property
    def handle(self) -> Handle:
        """The reference that keeps the hierarchy's memory alive."""
        if self._handle is None:
            raise ValueError("the hierarchy is closed")
        return self._handle

    def close(self) -> None:
        """Drops the hierarchy. Its memory is freed when the views of its bytes are gone."""
        self._handle = None

    def __enter__(self) -> "Hierarchy":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def __copy__(self) -> "Hierarchy":
        """Returns another reference to the same memory, which is closed separately."""
        return Hierarchy(self.handle)

    def __deepcopy__(self, _memo: dict[int, Any]) -> "Hierarchy":
        return self.__copy__()  # what they share is immutable

    def __reduce_ex__(self, protocol: Any) -> tuple[Callable[..., "Hierarchy"], tuple[Any]]:
        """Pickles the bytes, from protocol 5 on out of band where the pickler asks for that.

        Unpickling validates them, as from_bytes() does.
        """
        content = PickleBuffer(self.bytes) if protocol >= 5 else bytes(self.bytes)
        return Hierarchy.from_bytes, (content,)

    def __repr__(self) -> str:
        if self._handle is None:
            return "<sobb.Hierarchy, closed>"
        return f"<sobb.Hierarchy, {len(self.bytes)} bytes>"


def build(
    triangles: Any,
    faces: Any = None,
    *,
    origin: Sequence[float] | None = None,
    volume: str = "sobb",
    k: int = 64,
    quality: str = "medium",
    strategy: str = "k2",
    table: str | None = None,
    width: int = 8,
    threads: int = 0,
    isa: str = "best",
    memory_limit: int = 0,
    progress: Callable[[float], None] | None = None,
) -> Hierarchy:
    """Builds a hierarchy. The same input and options give the same bytes.

    triangles: a Scene; a mesh with `vertices` and `faces`, such as trimesh's, or a trimesh.Scene;
        or vertices, (n, 3), with faces, (m, 3). float32 and uint32 arrays are not copied.
    origin: a point that is subtracted from the vertices in float64, before they are rounded to
        float32: for large coordinates such as UTM's. Rays and hits are relative to it.
    volume: "sobb" or "aabb".
    k: planes of the k-DOP that SOBBs are chosen from, 32, 48 or 64.
    quality: "low", "medium" or "high".
    strategy: how a SOBB's directions are searched, "k", "k2" or "k3".
    table: the directions, "spread" evenly or "fitted" to the scene; None for fitted where the
        volume is SOBB.
    width: children per node, 4 or 8.
    threads: how many threads build at most; 0 for all.
    isa: the instruction set, as in intersect(); it changes only the speed.
    memory_limit: bytes that the build may hold; 0 for none.
    progress: called from time to time, on any thread but never on two at once, with the fraction
        done, 0 to 1. What it raises cancels the build and is raised here. So is the
        KeyboardInterrupt of Ctrl-C.
    """
    argument = TriangleArgument(triangles, faces, origin)
    options = structs.BuildOptions(
        volume=number_of("volume", VOLUMES, volume),
        k=unsigned("k", k),
        quality=number_of("quality", QUALITIES, quality),
        strategy=number_of("strategy", STRATEGIES, strategy),
        table=0 if table is None else number_of("table", TABLES, table),
        width=unsigned("width", width),
        threads=unsigned("threads", threads),
        isa=isa_number(isa),
        memory_limit=unsigned("memory_limit", memory_limit, 64),
    )

    def call(report: Any) -> Hierarchy:
        options.progress = report
        out = c_void_p()
        check(library.core().sobb_build(byref(argument.struct), byref(options), byref(out)))
        return Hierarchy(Handle(out, library.core().sobb_release))

    return interruptible.run(call, progress)


def contiguous_rays(rays: Any) -> np.ndarray:
    """Returns `rays`, copied only if they are not contiguous."""
    rays = np.asarray(rays)
    if rays.dtype != ray_dtype:
        raise TypeError(f"rays are {rays.dtype}, not sobb.ray_dtype")
    return rays if rays.flags.c_contiguous else np.ascontiguousarray(rays)


def _output(rays: np.ndarray, dtype: np.dtype, out: np.ndarray | None) -> np.ndarray:
    """Returns `out` if the results of `rays` fit it, or a new array if it is None."""
    if out is None:
        return np.empty(rays.shape, dtype)
    if out.dtype != dtype or out.shape != rays.shape:
        raise ValueError(f"out is {out.dtype} {out.shape}, not {dtype} {rays.shape}")
    if not (out.flags.c_contiguous and out.flags.writeable):
        raise ValueError("out is not contiguous and writable")
    if np.may_share_memory(out, rays):
        raise ValueError("out overlaps the rays")
    return out
