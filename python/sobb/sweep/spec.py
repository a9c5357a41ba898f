# SPDX-License-Identifier: Apache-2.0
"""What a sweep is about: the keys of its TOML file, with their defaults."""

import difflib
import json
import os
from collections.abc import Mapping
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import Any

import tomllib

from sobb.hierarchy import QUALITIES, STRATEGIES, TABLES

METHODS = ("aabb", "sobb", "embree")
RAYS = ("primary", "shadow", "diffuse1", "diffuse7", "random")
CALLS = ("single", "packet", "array")
ISAS = ("best", "sse4", "avx2")
SUBDIVISIONS = (1, 4, 16, 64)

#: What a member of a list may be; any whole number from 0 on where it is not here.
_CHOICES: dict[str, tuple[Any, ...]] = {
    "methods": METHODS,
    "rays": RAYS,
    "calls": CALLS,
    "k": (32, 48, 64),
    "strategies": tuple(STRATEGIES),
    "tables": tuple(TABLES),
    "qualities": tuple(QUALITIES),
    "widths": (4, 8),
    "isas": ISAS,
    "subdivisions": SUBDIVISIONS,
}
_AT_LEAST = {"views": 0, "threads": 1, "size": 1, "repetitions": 1, "seconds": 1, "memory_mb": 0}


@dataclass(frozen=True)
class Spec:
    """A sweep. Lists are its dimensions: every combination that differs is a case."""

    scenes: list[str]
    subdivisions: list[int]  # times a scene's triangles, by Loop's scheme
    views: list[int]
    methods: list[str]
    k: list[int]
    strategies: list[str]
    tables: list[str]
    qualities: list[str]
    widths: list[int]
    isas: list[str]
    threads: list[int]
    rays: list[str]  # of every case, as the calls are
    calls: list[str]
    size: int  # primary rays: size x size
    repetitions: int
    seconds: int  # a case may take
    memory_mb: int  # a case may have; 0 for no limit
    cameras: str | None  # a JSON file of views

    def json(self) -> str:
        """The whole sweep, defaults filled in."""
        return json.dumps(asdict(self))


_DEFAULTS: dict[str, Any] = {
    "subdivisions": [1],
    "views": [0],
    "methods": list(METHODS),
    "k": [64],
    "strategies": ["k2"],
    "tables": ["fitted"],
    "qualities": ["medium"],
    "widths": [8],
    "isas": ["avx2"],
    "threads": [1],
    "rays": ["primary", "shadow", "diffuse1", "diffuse7"],
    "calls": ["single", "array"],
    "size": 256,
    "repetitions": 5,
    "seconds": 600,
    "memory_mb": 0,
    "cameras": None,
}
#: The keys, in the order in which they are documented.
KEYS = tuple(field.name for field in fields(Spec))
#: The keys whose value is a list.
LISTS = tuple(key for key in KEYS if key == "scenes" or isinstance(_DEFAULTS[key], list))


def read(path: str | os.PathLike[str]) -> dict[str, Any]:
    """The keys of a TOML file, checked. Raises OSError or ValueError naming file and key."""
    try:
        found = tomllib.loads(Path(path).read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ValueError(f"{path}: no TOML: {error}") from None
    check(found, str(path))
    return found


def check(given: Mapping[str, Any], where: str) -> None:
    """Raises ValueError for a key that there is not, or a value that it may not have."""
    for key, value in given.items():
        if key not in KEYS:
            near = difflib.get_close_matches(key, KEYS, 1, 0.5)
            hint = f"did you mean {near[0]!r}?" if near else f"there are {', '.join(KEYS)}"
            raise ValueError(f"{where}: no key {key!r}; {hint}")
        if key in LISTS:
            if not isinstance(value, list) or not value:
                raise ValueError(f"{where}: {key} is a list of at least one value, not {value!r}")
            for member in value:
                _check_value(key, member, where)
        else:
            _check_value(key, value, where)


def _check_value(key: str, value: Any, where: str) -> None:
    if key in _CHOICES:
        if type(value) is not type(_CHOICES[key][0]) or value not in _CHOICES[key]:
            choices = ", ".join(map(str, _CHOICES[key]))
            near = difflib.get_close_matches(str(value), map(str, _CHOICES[key]), 1, 0.5)
            hint = f"; did you mean {near[0]!r}?" if near else ""
            raise ValueError(f"{where}: {key}: {value!r} is none of {choices}{hint}")
    elif key in _AT_LEAST:
        if type(value) is not int or not _AT_LEAST[key] <= value < 1 << 31:
            raise ValueError(f"{where}: {key}: {value!r} is no number from {_AT_LEAST[key]} on")
    elif not isinstance(value, str) or not value:
        raise ValueError(f"{where}: {key}: {value!r} is no name")


def make(given: Mapping[str, Any], where: str) -> Spec:
    """The sweep of checked keys, and defaults. Raises ValueError where it has no scene."""
    if "scenes" not in given:
        raise ValueError(f"{where}: no scenes; a sweep needs at least one")
    return Spec(**{**_DEFAULTS, **given})
