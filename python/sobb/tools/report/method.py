# SPDX-License-Identifier: Apache-2.0
"""Methods and their options: their titles, their order, their colours."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from sobb.tools.report.results import Case
from sobb.tools.shared import isa, methods
from sobb.tools.shared.palette import AMBER, BLUE, GREEN, GREY, ORANGE, PURPLE, Colour

_COLOURS = {
    "aabb": GREY,
    "14-dop": ORANGE,
    "obb": GREEN,
    "sobb128": PURPLE,
    "sobb256": PURPLE,
    "embree": AMBER,
}
_TITLES = {**methods.TITLES, "sobb": "SOBB", "embree": "Embree"}
_ORDER = ("aabb", "14-dop", "obb", "sobb", *(m for m in methods.TITLES if "sobb" in m), "embree")

BASE = "aabb"
#: The library's own hierarchies and Embree's. Other volumes share one hierarchy and one traversal.
HIERARCHIES = (BASE, "sobb", "embree")

# Options that make several variants of a method: those compared within a method, and those
# compared over all methods.
_OF_METHOD = ("k", "strategy", "table_kind")
_OF_ALL = ("quality", "width", "isa", "threads")


@dataclass(frozen=True, order=True)
class Variant:
    """A method, with those of its options that differ between the results."""

    place: int
    method: str
    options: tuple[str, ...]

    @property
    def title(self) -> str:
        return ", ".join((_TITLES.get(self.method, self.method), *self.options))

    @property
    def colour(self) -> Colour:
        return _COLOURS.get(self.method, BLUE if self.method.startswith("sobb") else PURPLE)


def variants(cases: Sequence[Case]) -> dict[str, Variant]:
    """Returns the variant of each case, by the case's id."""
    varying = {option: _values(cases, option) for option in _OF_ALL}
    by_method: dict[str, dict[str, set]] = {}
    for name in {case.method for case in cases}:
        own = [case for case in cases if case.method == name]
        by_method[name] = varying | {option: _values(own, option) for option in _OF_METHOD}
    return {case.case_id: _variant(case, by_method[case.method]) for case in cases}


def bases(cases: Iterable[Case], method: str = BASE) -> dict[str, Case]:
    """Returns the case of `method` that each case is compared with, by the case's id.

    Both have the same scene, subdivision and view, and the same value of each option that both
    have.
    """
    places: dict[tuple[str, int, int], list[Case]] = {}
    for case in cases:
        places.setdefault(place(case), []).append(case)
    found = {}
    for group in places.values():
        candidates = [case for case in group if case.method == method]
        for case in group:
            base = next((base for base in candidates if not _differ(case, base)), None)
            if base is not None:
                found[case.case_id] = base
    return found


def place(case: Case) -> tuple[str, int, int]:
    """Returns what cases that are compared have in common."""
    return case.scene, case.subdivision, case.view


def _option(case: Case, name: str) -> str | int | None:
    """Returns an option's value; None for "best", which compares with any instruction set."""
    value = getattr(case, name)
    return None if value == "best" else value


def _differ(case: Case, other: Case) -> bool:
    pairs = ((_option(case, name), _option(other, name)) for name in _OF_ALL)
    return any(a is not None and b is not None and a != b for a, b in pairs)


def _values(cases: Iterable[Case], option: str) -> set:
    return {_option(case, option) for case in cases} - {None}


def _variant(case: Case, varying: dict[str, set]) -> Variant:
    options = (
        _spelt(option, value)
        for option, values in varying.items()
        if len(values) > 1 and (value := _option(case, option)) is not None
    )
    place = _ORDER.index(case.method) if case.method in _ORDER else len(_ORDER)
    return Variant(place, case.method, tuple(options))


def _spelt(option: str, value: str | int) -> str:
    match option:
        case "k":
            return f"k = {value}"
        case "strategy":
            return {"k": "k", "k2": "k²", "k3": "k³"}.get(str(value), str(value))
        case "table_kind":
            return f"{value} table"
        case "quality":
            return f"{value} quality"
        case "width":
            return f"{value} wide"
        case "isa":
            return isa.TITLES.get(str(value), str(value))
        case _:
            return f"{value} thread" if value == 1 else f"{value} threads"
