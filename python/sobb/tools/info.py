# SPDX-License-Identifier: Apache-2.0
"""The command `info`: says what a scene or a .sobb file holds, to people or to machines."""

import json
from argparse import ArgumentParser, Namespace
from dataclasses import asdict
from typing import Any

from sobb.hierarchy import Hierarchy
from sobb.scene import Scene
from sobb.tools import arguments

HELP = "say what a scene or a .sobb file holds"
EXTRA = "commands"

_Facts = dict[str, Any]


def add_arguments(parser: ArgumentParser) -> None:
    """Declares the command's arguments."""
    parser.add_argument("source", metavar="SCENE_OR_FILE", help=arguments.SCENE_OR_FILE)
    parser.add_argument(
        "--json",
        action="store_true",
        help="print one JSON object, which lists every mesh and view",
    )


def run(options: Namespace) -> None:
    """Does the command's work."""
    if options.source.lower().endswith(".sobb"):
        facts = _of_hierarchy(Hierarchy.open(options.source))
    else:
        facts = _of_scene(Scene.load(options.source))
    if options.json:
        print(json.dumps(facts, indent=2))
        return
    notes = facts.pop("notes", [])
    for name, value in facts.items():
        print(f"{name:16}{_text(value)}")
    for note in notes:
        print(f"{'passed over':16}{note['count']} ({note['cause']}): {note['message']}")


def _of_scene(scene: Scene) -> _Facts:
    """Returns the triangles, vertices, bounds, meshes and views of a scene."""
    info = scene.info
    return {
        "kind": "scene",
        "triangles": info.triangle_count,
        "vertices": info.vertex_count,
        "degenerate": info.degenerate_count,
        "bounds_min": info.bounds_min,
        "bounds_max": info.bounds_max,
        "default_view": bool(info.default_view),
        "notes": [asdict(note) for note in scene.notes],
        "meshes": [asdict(mesh) for mesh in scene.meshes],
        "views": [asdict(view) for view in scene.views],
    }


def _of_hierarchy(hierarchy: Hierarchy) -> _Facts:
    """Returns all of sobb_info but the build's time and memory, which a file does not keep."""
    facts = asdict(hierarchy.info)
    of_the_build = {"topology_ms", "collapse_ms", "volume_ms", "total_ms", "peak_bytes"}
    shown = {name: value for name, value in facts.items() if name not in of_the_build}
    shown["source_hash"] = f"{facts['source_hash']:016x}"
    return {"kind": "hierarchy", **shown}


def _text(value: Any) -> str:
    """A value for people; a list is told by its length."""
    if isinstance(value, list):
        return str(len(value))
    if isinstance(value, tuple):
        return " ".join(_text(part) for part in value)
    if isinstance(value, float):
        return f"{value:.6g}"
    return str(value)
