# SPDX-License-Identifier: Apache-2.0
"""What a scene or a hierarchy is, for people and for machines."""

import json
from dataclasses import asdict
from typing import Any

from sobb.hierarchy import Hierarchy
from sobb.scene import Scene

Facts = dict[str, Any]


def describe_scene(scene: Scene) -> Facts:
    """Triangles, vertices, bounds, meshes and views of a scene."""
    info = scene.info
    return {
        "kind": "scene",
        "triangles": info.triangle_count,
        "vertices": info.vertex_count,
        "degenerate": info.degenerate_count,
        "bounds_min": info.bounds_min,
        "bounds_max": info.bounds_max,
        "default_view": bool(info.default_view),
        "meshes": [asdict(mesh) for mesh in scene.meshes],
        "views": [asdict(view) for view in scene.views],
    }


def describe_hierarchy(hierarchy: Hierarchy) -> Facts:
    """All of sobb_info but the build's time and memory, which an opened file does not have."""
    facts = asdict(hierarchy.info)
    of_the_build = {"topology_ms", "collapse_ms", "volume_ms", "total_ms", "peak_bytes"}
    shown = {name: value for name, value in facts.items() if name not in of_the_build}
    shown["source_hash"] = f"{facts['source_hash']:016x}"
    return {"kind": "hierarchy", **shown}


def print_facts(facts: Facts, as_json: bool) -> None:
    """Facts on stdout: a line each, lists by their length; or all of them as one JSON object."""
    if as_json:
        print(json.dumps(facts, indent=2))
        return
    for name, value in facts.items():
        print(f"{name:16}{_text(value)}")


def _text(value: Any) -> str:
    if isinstance(value, list):
        return str(len(value))
    if isinstance(value, tuple):
        return " ".join(_text(part) for part in value)
    if isinstance(value, float):
        return f"{value:.6g}"
    return str(value)
