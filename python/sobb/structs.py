# SPDX-License-Identifier: Apache-2.0
"""The option and information structs of sobb.h and scene.h for ctypes, member for member."""

import ctypes
from ctypes import c_char_p, c_double, c_float, c_int, c_uint32, c_uint64, c_void_p
from typing import Any

#: The callback `progress` of options: (user, fraction) -> non-zero to cancel.
Progress = ctypes.CFUNCTYPE(c_int, c_void_p, c_double)


class SizedStruct(ctypes.Structure):
    """A struct that begins with its own size, so that it can grow."""

    def __init__(self, **members: Any):
        super().__init__(struct_size=ctypes.sizeof(self), **members)


class Triangles(SizedStruct):
    _fields_ = [
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("vertices", c_void_p),
        ("vertex_count", c_uint64),
        ("vertex_stride", c_uint64),
        ("indices", c_void_p),
        ("triangle_count", c_uint64),
    ]


class BuildOptions(SizedStruct):
    _fields_ = [
        ("struct_size", c_uint32),
        ("volume", c_uint32),
        ("k", c_uint32),
        ("quality", c_uint32),
        ("strategy", c_uint32),
        ("width", c_uint32),
        ("threads", c_uint32),
        ("isa", c_uint32),
        ("memory_limit", c_uint64),
        ("allocator", c_void_p),
        ("scheduler", c_void_p),
        ("progress", Progress),
        ("progress_user", c_void_p),
        ("table", c_uint32),
        ("reserved", c_uint32),
    ]


class OpenOptions(SizedStruct):
    _fields_ = [
        ("struct_size", c_uint32),
        ("flags", c_uint32),
        ("threads", c_uint32),
        ("reserved", c_uint32),
        ("memory_limit", c_uint64),
        ("allocator", c_void_p),
        ("scheduler", c_void_p),
        ("progress", Progress),
        ("progress_user", c_void_p),
    ]


class TraceOptions(SizedStruct):
    _fields_ = [
        ("struct_size", c_uint32),
        ("flags", c_uint32),
        ("threads", c_uint32),
        ("isa", c_uint32),
        ("counts", c_void_p),
        ("invalid_rays", c_void_p),
        ("scheduler", c_void_p),
    ]


class HierarchyInfo(SizedStruct):
    _fields_ = [
        ("struct_size", c_uint32),
        ("format_version", c_uint32),
        ("volume", c_uint32),
        ("k", c_uint32),
        ("quality", c_uint32),
        ("strategy", c_uint32),
        ("width", c_uint32),
        ("depth", c_uint32),
        ("triangles", c_uint64),
        ("degenerate", c_uint64),
        ("references", c_uint64),
        ("nodes", c_uint64),
        ("leaves", c_uint64),
        ("blocks", c_uint64),
        ("axes_nodes", c_uint64),
        ("shared_nodes", c_uint64),
        ("own_nodes", c_uint64),
        ("bytes", c_uint64),
        ("node_bytes", c_uint64),
        ("triangle_bytes", c_uint64),
        ("source_hash", c_uint64),
        ("bounds_min", c_float * 3),
        ("bounds_max", c_float * 3),
        ("inner_area", c_double),
        ("leaf_area", c_double),
        ("topology_ms", c_double),
        ("collapse_ms", c_double),
        ("volume_ms", c_double),
        ("total_ms", c_double),
        ("peak_bytes", c_uint64),
        ("table", c_uint32),
        ("reserved", c_uint32),
    ]


class SceneOptions(SizedStruct):
    _fields_ = [
        ("struct_size", c_uint32),
        ("reserved", c_uint32),
        ("views_path", c_char_p),
        ("memory_limit", c_uint64),
        ("progress", Progress),
        ("progress_user", c_void_p),
        ("origin", c_double * 3),
    ]


class SceneInfo(SizedStruct):
    _fields_ = [
        ("struct_size", c_uint32),
        ("default_view", c_uint32),
        ("vertex_count", c_uint64),
        ("triangle_count", c_uint64),
        ("degenerate_count", c_uint64),
        ("mesh_count", c_uint64),
        ("view_count", c_uint64),
        ("bounds_min", c_float * 3),
        ("bounds_max", c_float * 3),
        ("note_count", c_uint64),
    ]


class SceneNote(SizedStruct):
    _fields_ = [
        ("struct_size", c_uint32),
        ("cause", c_uint32),
        ("count", c_uint64),
        ("message", c_char_p),
    ]


class SceneMesh(ctypes.Structure):
    _fields_ = [
        ("name", c_char_p),
        ("first_triangle", c_uint64),
        ("triangle_count", c_uint64),
    ]


class SceneView(ctypes.Structure):
    _fields_ = [
        ("eye", c_float * 3),
        ("target", c_float * 3),
        ("up", c_float * 3),
        ("vfov_degrees", c_float),
    ]
