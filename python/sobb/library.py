# SPDX-License-Identifier: Apache-2.0
"""Finds and loads libsobb and libsobb_scene, and holds what every call into them shares.

A library is looked for in the folder that the environment's SOBB_LIBRARY_PATH names, and nowhere
else if that is set; then in native/lib of this package, where a wheel has it; then in
build/release/lib of the checkout that this package lies in; then where the system looks. Programs
lie in bin beside that lib. The first call that needs a library loads it.
"""

import ctypes
import os
from collections.abc import Callable, Mapping, Sequence
from ctypes import POINTER, c_char_p, c_int, c_uint32, c_uint64, c_void_p
from functools import cache
from operator import index
from pathlib import Path
from typing import Any

import numpy as np

from sobb import structs
from sobb.error import Error

_ABI_VERSION = 0  # SOBB_ABI_VERSION, the number in the soname
_PACKAGE = Path(__file__).resolve().parent
_FOLDERS = (_PACKAGE / "native" / "lib", _PACKAGE.parents[1] / "build" / "release" / "lib")

_ISAS = {"best": 0, "sse4": 1, "avx2": 2}

#: Function -> result, arguments.
_Signatures = Mapping[str, tuple[Any, list[Any]]]

_CORE_SIGNATURES: _Signatures = {
    "sobb_last_error": (c_char_p, []),
    "sobb_version": (c_uint32, []),
    "sobb_resolve_isa": (c_int, [c_int, POINTER(c_int)]),
    "sobb_build": (
        c_int,
        [POINTER(structs.Triangles), POINTER(structs.BuildOptions), POINTER(c_void_p)],
    ),
    "sobb_release": (None, [c_void_p]),
    "sobb_save": (c_int, [c_void_p, c_char_p]),
    "sobb_open": (c_int, [c_char_p, POINTER(structs.OpenOptions), POINTER(c_void_p)]),
    "sobb_open_memory": (
        c_int,
        [c_void_p, c_uint64, POINTER(structs.OpenOptions), POINTER(c_void_p)],
    ),
    "sobb_bytes": (c_int, [c_void_p, POINTER(c_void_p), POINTER(c_uint64)]),
    "sobb_get_info": (c_int, [c_void_p, POINTER(structs.HierarchyInfo)]),
    "sobb_intersect": (
        c_int,
        [c_void_p, c_void_p, c_uint64, c_void_p, POINTER(structs.TraceOptions)],
    ),
    "sobb_occluded": (
        c_int,
        [c_void_p, c_void_p, c_uint64, c_void_p, POINTER(structs.TraceOptions)],
    ),
    "sobb_brute_force": (
        c_int,
        [
            POINTER(structs.Triangles),
            c_void_p,
            c_uint64,
            c_void_p,
            POINTER(structs.TraceOptions),
        ],
    ),
}

_SCENE_SIGNATURES: _Signatures = {
    "sobb_scene_load": (c_int, [c_char_p, POINTER(structs.SceneOptions), POINTER(c_void_p)]),
    "sobb_scene_release": (None, [c_void_p]),
    "sobb_scene_get_info": (c_int, [c_void_p, POINTER(structs.SceneInfo)]),
    "sobb_scene_triangles": (c_int, [c_void_p, POINTER(structs.Triangles)]),
    "sobb_scene_get_note": (c_int, [c_void_p, c_uint64, POINTER(structs.SceneNote)]),
    "sobb_note_cause_name": (c_char_p, [c_uint32]),
    "sobb_scene_mesh": (c_int, [c_void_p, c_uint64, POINTER(structs.SceneMesh)]),
    "sobb_scene_view": (c_int, [c_void_p, c_uint64, POINTER(structs.SceneView)]),
}


@cache
def core() -> ctypes.CDLL:
    """libsobb: build, file, trace."""
    return _load("sobb", _CORE_SIGNATURES)


@cache
def scene() -> ctypes.CDLL:
    """libsobb_scene: the importers."""
    core()  # loaded first, so that the importers link to the same one
    return _load("sobb_scene", _SCENE_SIGNATURES)


def folder() -> Path | None:
    """Returns the folder of the libraries; None for where the system looks."""
    named = os.environ.get("SOBB_LIBRARY_PATH")
    if named:
        return Path(named)
    return next((folder for folder in _FOLDERS if (folder / _file_name("sobb")).exists()), None)


def _file_name(library: str) -> str:
    return f"lib{library}.so.{_ABI_VERSION}"


def _load(name: str, signatures: _Signatures) -> ctypes.CDLL:
    found = folder()
    try:
        library = ctypes.CDLL(os.path.join(found or "", _file_name(name)))
    except OSError as error:
        raise OSError(
            f"{error}. Build it (scripts/setup.sh), install it, or name its folder in "
            "SOBB_LIBRARY_PATH."
        ) from None
    for function, (result, arguments) in signatures.items():
        getattr(library, function).restype = result
        getattr(library, function).argtypes = arguments
    return library


def check(status: int) -> None:
    """Raises Error, with the library's message, unless `status` is OK."""
    if status != 0:
        raise Error(status, core().sobb_last_error().decode("utf-8", "replace"))


def version() -> str:
    """Returns the version of the loaded library, as "major.minor.patch"."""
    number = core().sobb_version()
    return f"{number >> 16}.{number >> 8 & 255}.{number & 255}"


def resolve_isa(isa: str = "best") -> str:
    """Returns the instruction set, "sse4" or "avx2", that calls with this `isa` use here.

    Raises Error (Status.UNSUPPORTED_CPU) where the machine lacks the one asked for.
    """
    out = c_int()
    check(core().sobb_resolve_isa(isa_number(isa), ctypes.byref(out)))
    return name_of(_ISAS, out.value)


class Handle:
    """A reference to an object of the library, released with the last Python reference to this."""

    def __init__(self, pointer: c_void_p, release: Callable[[c_void_p], None]):
        self._as_parameter_ = pointer
        self._release = release

    def __del__(self) -> None:
        self._release(self._as_parameter_)

    def __reduce__(self):
        raise TypeError("handles of the library cannot be pickled or deep-copied; save a file")


class _Memory:
    """Memory of the library, for NumPy and memoryview; it keeps its owner alive."""

    def __init__(self, owner: Handle, interface: dict[str, Any]):
        self.owner = owner
        self.__array_interface__ = interface


def borrow(
    owner: Handle, address: int, dtype: str, shape: tuple[int, ...], strides: tuple[int, ...] | None
) -> np.ndarray:
    """Returns a read-only array over memory that `owner` owns; nothing is copied."""
    interface = {
        "version": 3,
        "typestr": dtype,
        "shape": shape,
        "strides": strides,
        "data": (address, True),
    }
    return np.asarray(_Memory(owner, interface))


def path_bytes(path: str | os.PathLike[str]) -> bytes:
    """Returns a path as the C interface takes it."""
    encoded = os.fsencode(path)
    if b"\0" in encoded:
        raise ValueError(f"a path with a null byte: {path!r}")
    return encoded


def unsigned(name: str, value: int, bits: int = 32) -> int:
    """Returns `value` if it fits an unsigned integer; ctypes would wrap it silently."""
    number = index(value)
    if not 0 <= number < 1 << bits:
        raise ValueError(f"{name} is {number}: not from 0 to 2^{bits} - 1")
    return number


def point(origin: Sequence[float]) -> np.ndarray:
    """Returns an argument `origin` as float64 (3,)."""
    values = np.asarray(origin, np.float64)
    if values.shape != (3,) or not np.isfinite(values).all():
        raise ValueError(f"origin is {origin!r}: not three finite numbers")
    return values


def number_of(what: str, names: Mapping[str, int], name: str) -> int:
    """Returns the value of an enumeration that has this name."""
    if name not in names:
        raise ValueError(f"{what} is {name!r}: not one of {', '.join(names)}")
    return names[name]


def name_of(names: Mapping[str, int], number: int) -> str:
    """Returns the name of an enumeration's value, or its digits if it has none."""
    return next((name for name, value in names.items() if value == number), str(number))


def isa_number(isa: str) -> int:
    """Returns the sobb_isa that "best", "sse4" or "avx2" names."""
    return number_of("isa", _ISAS, isa)
