# SPDX-License-Identifier: Apache-2.0
"""The specification of a sweep: the keys of its TOML file, their checks and defaults."""

import difflib
import os
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

#: Methods that sobb_bench measures: the library's own wide hierarchies, and Embree's.
HIERARCHIES = ("aabb", "sobb", "embree")
# Methods that sobb_bench_volumes measures: other volumes, all in one hierarchy.
_FORMS = tuple(f"sobb{k}{form}" for k in (32, 48, 64) for form in "di")
VOLUMES = ("14-dop", "obb", *_FORMS, "sobb128", "sobb256")

RAYS = ("primary", "shadow", "diffuse1", "diffuse7", "random")
CALLS = ("single", "packet", "array")

_TEXT, _WHOLE, _NUMBER = "a text", "a whole number", "a number"


def _memory_mib() -> int:
    """Returns three quarters of the machine's memory."""
    return os.sysconf("SC_PHYS_PAGES") * os.sysconf("SC_PAGE_SIZE") * 3 // 4 >> 20


@dataclass(frozen=True)
class _Key:
    """A key's type and its allowed values: names, or a range of numbers."""

    type: str
    default: Any
    names: Sequence[Any] = ()
    least: float = 0
    largest: float = (1 << 31) - 1
    many: bool = True  # a list, or one value that stands for a list of one


#: Key -> its allowed values. docs/sweeps.md says what each means.
KEYS: Mapping[str, _Key] = {
    "scenes": _Key(_TEXT, None),
    "subdivisions": _Key(_WHOLE, (1,), (1, 4, 16, 64)),
    "views": _Key(_WHOLE, (0,)),
    "methods": _Key(_TEXT, HIERARCHIES, (*HIERARCHIES, *VOLUMES)),
    "k": _Key(_WHOLE, (64,), (32, 48, 64)),
    "strategy": _Key(_TEXT, ("k2",), ("k", "k2", "k3")),
    "table": _Key(_TEXT, ("fitted",), ("spread", "fitted")),
    "quality": _Key(_TEXT, ("medium",), ("low", "medium", "high")),
    "width": _Key(_WHOLE, (8,), (4, 8)),
    "isa": _Key(_TEXT, ("best",), ("best", "sse4", "avx2")),
    "threads": _Key(_WHOLE, (1,), least=1, largest=1024),
    "rays": _Key(_TEXT, RAYS, RAYS),
    "calls": _Key(_TEXT, CALLS, CALLS),
    "cameras": _Key(_TEXT, None, many=False),
    "size": _Key(_WHOLE, 512, least=1, largest=8192, many=False),
    "repetitions": _Key(_WHOLE, 5, least=1, largest=1000, many=False),
    "min_time": _Key(_NUMBER, 0.1, least=1e-6, largest=3600, many=False),
    "time_limit": _Key(_NUMBER, 1800.0, least=1e-3, largest=1e7, many=False),
    "memory_limit": _Key(_WHOLE, _memory_mib(), least=1, many=False),
}


@dataclass(frozen=True)
class Spec:
    """A sweep with all defaults filled in; its members are the keys."""

    scenes: tuple[str, ...]
    subdivisions: tuple[int, ...]
    views: tuple[int, ...]
    methods: tuple[str, ...]
    k: tuple[int, ...]
    strategy: tuple[str, ...]
    table: tuple[str, ...]
    quality: tuple[str, ...]
    width: tuple[int, ...]
    isa: tuple[str, ...]
    threads: tuple[int, ...]
    rays: tuple[str, ...]
    calls: tuple[str, ...]
    cameras: str | None
    size: int
    repetitions: int
    min_time: float
    time_limit: float  # seconds per case
    memory_limit: int  # MiB per case


def read(path: str | Path, given: Mapping[str, Any]) -> Spec:
    """Reads a TOML file; the values of `given` replace those of the file.

    Raises ValueError that names the file and the key.
    """
    try:
        with open(path, "rb") as file:
            values = tomllib.load(file)
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise ValueError(f"{path}: {error}") from None
    return make({**values, **given}, str(path))


def make(values: Mapping[str, Any], source: str) -> Spec:
    """Makes a sweep of keys and values. Raises ValueError that names `source` and the key."""
    for key in values:
        if key not in KEYS:
            near = difflib.get_close_matches(key, KEYS, 1, 0)
            raise ValueError(f"{source}: unknown key '{key}', the nearest is '{near[0]}'")
    if "scenes" not in values:
        raise ValueError(f"{source}: the key 'scenes' is missing")
    checked = {
        key: _checked(values[key], rule, f"{source}: {key}") if key in values else rule.default
        for key, rule in KEYS.items()
    }
    return Spec(**{field.name: checked[field.name] for field in fields(Spec)})


def _checked(value: Any, rule: _Key, place: str) -> Any:
    if not rule.many:
        return _one(value, rule, place)
    values = value if isinstance(value, list | tuple) else [value]
    if not values:
        raise ValueError(f"{place}: the list is empty")
    return tuple(dict.fromkeys(_one(one, rule, place) for one in values))


def _one(value: Any, rule: _Key, place: str) -> Any:
    types: dict[str, Any] = {_TEXT: str, _WHOLE: int, _NUMBER: int | float}
    if not isinstance(value, types[rule.type]) or isinstance(value, bool):
        raise ValueError(f"{place}: {value!r} is not {rule.type}")
    if rule.names:
        if value not in rule.names:
            near = difflib.get_close_matches(str(value), map(str, rule.names), 1, 0)
            known = ", ".join(map(str, rule.names))
            raise ValueError(f"{place}: unknown {value!r}, the nearest is {near[0]} of {known}")
    elif not isinstance(value, str) and not rule.least <= value <= rule.largest:
        raise ValueError(f"{place}: {value} is not from {rule.least} to {rule.largest}")
    return float(value) if rule.type == _NUMBER else value
