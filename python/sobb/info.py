# SPDX-License-Identifier: Apache-2.0
"""The facts about hierarchies and scenes: sobb_info and sobb_scene_info as dataclasses."""

import ctypes
from dataclasses import dataclass, fields
from typing import Any, TypeVar

from sobb import structs
from sobb.library import name_of

VOLUMES = {"aabb": 1, "sobb": 2}
QUALITIES = {"low": 1, "medium": 2, "high": 3}
STRATEGIES = {"k": 1, "k2": 2, "k3": 3}
TABLES = {"spread": 1, "fitted": 2}

_NAMES = {"volume": VOLUMES, "quality": QUALITIES, "strategy": STRATEGIES, "table": TABLES}

Corner = tuple[float, float, float]
Info = TypeVar("Info")


@dataclass(frozen=True)
class HierarchyInfo:
    """The figures of a hierarchy.

    Areas are sums over all volumes, relative to the area of the input's box. The last five members
    describe the build, and are zero for a hierarchy that was opened.
    """

    format_version: int
    volume: str
    k: int  # planes of the direction table; 6 for the AABB
    quality: str
    strategy: str
    table: str
    width: int  # children per node, at most
    depth: int
    triangles: int  # in the input
    degenerate: int  # triangles without area
    references: int  # in leaves; more than triangles after spatial splits
    nodes: int
    leaves: int
    blocks: int  # of four triangles
    axes_nodes: int  # nodes whose shared basis is the axes, or a fitted table's frame
    shared_nodes: int  # nodes with another basis that all children share
    own_nodes: int  # nodes with a basis for each child
    bytes: int  # the size of the file, and in memory
    node_bytes: int
    triangle_bytes: int
    source_hash: int
    bounds_min: Corner
    bounds_max: Corner
    inner_area: float
    leaf_area: float
    topology_ms: float
    collapse_ms: float
    volume_ms: float
    total_ms: float
    peak_bytes: int


@dataclass(frozen=True)
class SceneInfo:
    """The figures of a scene; the bounds enclose the vertices that triangles use."""

    default_view: int  # 1 where the file had no view and one was made
    vertex_count: int
    triangle_count: int
    degenerate_count: int
    mesh_count: int
    view_count: int
    bounds_min: Corner
    bounds_max: Corner
    note_count: int


def from_struct(kind: type[Info], struct: structs.SizedStruct) -> Info:
    """Copies the members that `kind` has: arrays as tuples, enumerations as names."""
    members = [field.name for field in fields(kind)]  # type: ignore[arg-type]
    return kind(**{name: _value(name, getattr(struct, name)) for name in members})


def _value(name: str, value: Any) -> Any:
    if isinstance(value, ctypes.Array):
        return tuple(value)
    return name_of(_NAMES[name], value) if name in _NAMES else value
