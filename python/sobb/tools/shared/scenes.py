# SPDX-License-Identifier: Apache-2.0
"""Finds scenes by the names that commands take, and says what tables call them."""

import os
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

_BUILTIN = "builtin:"
_ENDINGS = (".glb", ".gltf", ".obj", ".ply", ".stl", ".off")
_TURN = re.compile(r"@[-+.\d]+$")
_TIMES = re.compile(r"\^\d+$")

# Triangles of the built-in scenes: sizes like those of the paper's scenes.
_SIZES = {
    "hairball": 2_900_000,
    "wool": 10_000_000,
    "pipes": 12_800_000,
    "city": 2_800_000,
    "foliage": 2_800_000,
}
_QUICK_SIZE = 20_000

# Models lie along the axes, which flatters the AABB, so some scenes are measured turned as well.
# A built-in scene takes the place of a real one that is not in SOBB_SCENES.
_ANGLE = "@30"
_IN_PLACE = {"crown": "hairball", "sponza-dabrovic": "pipes"}


@dataclass(frozen=True)
class Source:
    """A scene: the programs' argument for it, its name in tables, and the name asked for."""

    argument: str
    name: str
    asked: str


def resolve(names: Sequence[str]) -> list[Source]:
    """Finds scenes: paths, built-in scenes, and names of files in the folder SOBB_SCENES.

    Each may end in ^TIMES and @DEGREES; one string may name several, separated by commas. Raises
    OSError that names all that are missing.
    """
    found = [(name, _find(name)) for given in names for name in _one_by_one(given)]
    missing = [name for name, source in found if source is None]
    if missing:
        folder = _folder()
        where = f"in {folder}" if folder else "there (SOBB_SCENES names no folder of scenes)"
        raise OSError(f"no such file, nor a scene of that name {where}: {', '.join(missing)}")
    return [source for _, source in found if source is not None]


def default(turned: Sequence[str]) -> list[Source]:
    """Returns the built-in scenes at the paper's sizes, the .glb files of SOBB_SCENES, and the
    scenes `turned` by 30 degrees."""
    folder = _folder()
    files = sorted(path.stem for path in folder.glob("*.glb")) if folder else []
    there = (name if name in files else _IN_PLACE.get(name, name) for name in turned)
    names = [*_SIZES, *files, *(name + _ANGLE for name in there)]
    return resolve([_at_paper_size(name) for name in names])


def quick() -> list[Source]:
    """Returns small built-in scenes, and one of them turned."""
    small = [f"{_BUILTIN}{name}:{_QUICK_SIZE}" for name in _SIZES]
    return resolve([*small, f"{_BUILTIN}city:{_QUICK_SIZE}{_ANGLE}"])


def _at_paper_size(name: str) -> str:
    base, turn = split_turn(name)
    return f"{_BUILTIN}{base}:{_SIZES[base]}{turn}" if base in _SIZES else name


def _folder() -> Path | None:
    name = os.environ.get("SOBB_SCENES")
    if not name:
        return None
    if not Path(name).is_dir():
        raise OSError(f"SOBB_SCENES: {name} is no folder")
    return Path(name)


def _one_by_one(given: str) -> list[str]:
    return [given] if Path(given).is_file() else given.split(",")


def _find(name: str) -> Source | None:
    base = _TIMES.sub("", split_turn(name)[0])
    suffix = name[len(base) :]
    if base.startswith(_BUILTIN):
        return Source(name, base.removeprefix(_BUILTIN).split(":")[0] + suffix, name)
    if Path(name).is_file():
        return Source(name, Path(name).stem, name)
    path = Path(base)
    folder = _folder()
    if not path.is_file() and folder is not None and path.name == base:
        files = (folder / (base + ending) for ending in ("", *_ENDINGS))
        path = next(filter(Path.is_file, files), path)
    return Source(f"{path}{suffix}", path.stem + suffix, name) if path.is_file() else None


def unrefined(name: str) -> tuple[str, int]:
    """Splits a scene's name into the name without ^TIMES, and TIMES; 1 where it has none."""
    base, turn = split_turn(name)
    times = _TIMES.search(base)
    return (name, 1) if times is None else (base[: times.start()] + turn, int(times[0][1:]))


def refined(name: str, times: int) -> str:
    """Adds ^TIMES to a scene's name, unless they are 1."""
    base, turn = split_turn(name)
    return f"{base}^{times}{turn}" if times > 1 else name


def split_turn(name: str) -> tuple[str, str]:
    """Splits a scene's name into the name without @DEGREES, and @DEGREES; "" where it has none."""
    turn = _TURN.search(name)
    return (name, "") if turn is None else (name[: turn.start()], turn[0])
