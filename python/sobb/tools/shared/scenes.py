# SPDX-License-Identifier: Apache-2.0
"""Which scenes a table is about, and what they are called in it."""

import os
import re
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

_BUILTIN = "builtin:"
_ENDINGS = (".glb", ".gltf", ".obj", ".ply", ".stl", ".off")
_TURN = re.compile(r"@[-+.\d]+$")
_TIMES = re.compile(r"\^\d+$")

# Sizes like those of the paper's scenes.
_SIZES = {
    "hairball": 2_900_000,
    "wool": 10_000_000,
    "pipes": 12_800_000,
    "city": 2_800_000,
    "foliage": 2_800_000,
}
_QUICK_SIZE = 20_000

# Models are drawn along the axes, which flatters the AABB: some are measured turned too. The real
# ones where they are at hand, else built-in ones in their place.
_ANGLE = "@30"
_IN_PLACE = {"crown": "hairball", "sponza-dabrovic": "pipes"}


@dataclass(frozen=True)
class Source:
    """A scene as the benchmark programs take it, its name in tables, and how it was asked for."""

    argument: str
    name: str
    asked: str


def resolve(names: Sequence[str]) -> list[Source]:
    """Paths, built-in scenes and names of files in the folder SOBB_SCENES, any of them with
    ^TIMES and @DEGREES, one by one or with commas between. Raises OSError naming all that are
    missing."""
    found = [(name, _find(name)) for given in names for name in _one_by_one(given)]
    missing = [name for name, source in found if source is None]
    if missing:
        folder = _folder()
        where = f"in {folder}" if folder else "there (SOBB_SCENES names no folder of scenes)"
        raise OSError(f"no such file, nor a scene of that name {where}: {', '.join(missing)}")
    return [source for _, source in found if source is not None]


def default(turned: Sequence[str]) -> list[Source]:
    """The built-in scenes at the paper's sizes, the .glb files of SOBB_SCENES, and those named in
    `turned`."""
    folder = _folder()
    files = sorted(path.stem for path in folder.glob("*.glb")) if folder else []
    there = (name if name in files else _IN_PLACE.get(name, name) for name in turned)
    names = [*_SIZES, *files, *(name + _ANGLE for name in there)]
    return resolve([_at_paper_size(name) for name in names])


def quick() -> list[Source]:
    """Small built-in scenes, one of them turned."""
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
    """A scene's name without ^TIMES, and those; 1 where it is not refined."""
    base, turn = split_turn(name)
    times = _TIMES.search(base)
    return (name, 1) if times is None else (base[: times.start()] + turn, int(times[0][1:]))


def refined(name: str, times: int) -> str:
    """With ^TIMES, unless they are 1."""
    base, turn = split_turn(name)
    return f"{base}^{times}{turn}" if times > 1 else name


def split_turn(name: str) -> tuple[str, str]:
    """A scene's name without @DEGREES, and those; nothing where it is not turned."""
    turn = _TURN.search(name)
    return (name, "") if turn is None else (name[: turn.start()], turn[0])
