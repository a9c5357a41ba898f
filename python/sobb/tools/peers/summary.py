# SPDX-License-Identifier: Apache-2.0
"""The summary of many scenes: a line for each kind of rays and call."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from statistics import geometric_mean

from sobb.tools.peers.figures import CALLS, QUALITIES, RAYS, Figure
from sobb.tools.shared.scenes import split_turn

#: Words in the names of scenes of thin, slanted triangles, for which skewed boxes are made.
_FIBRES = ("hair", "wool", "pipes")


@dataclass(frozen=True)
class Least:
    """The smallest of some ratios, and its scene."""

    value: float
    scene: str


@dataclass(frozen=True)
class Ratios:
    """Our speed over Embree's, at one quality."""

    least: Least
    mean: float  # geometric
    fibres: Least | None  # None without a scene of fibres


@dataclass(frozen=True)
class Line:
    """The ratios for one kind of rays and call, over all scenes."""

    rays: str
    call: str
    ratios: dict[str, Ratios]  # by quality
    over_aabb: Least  # our SOBBs over our AABBs, at any quality
    turned: Least | None  # a turned scene over the same unturned; None without such a pair


def lines(found: Iterable[Figure]) -> list[Line]:
    """Returns all lines for the figures of several scenes."""
    found = list(found)
    groups = ((rays, call) for rays in RAYS for call in CALLS)
    return [
        _line(rays, call, [f for f in found if (f.rays, f.call) == (rays, call)])
        for rays, call in groups
    ]


def _line(rays: str, call: str, found: Sequence[Figure]) -> Line:
    ratios = {quality: _ratios([f for f in found if f.quality == quality]) for quality in QUALITIES}
    over_aabb = _least(found, lambda f: f.sobb / f.aabb)
    # Random rays fill the scene's box, which changes when the scene is turned.
    turned = _turned(found) if rays != "random" else None
    return Line(rays, call, ratios, over_aabb, turned)


def _ratios(found: Sequence[Figure]) -> Ratios:
    fibres = [f for f in found if any(word in split_turn(f.name)[0] for word in _FIBRES)]
    return Ratios(
        least=_least(found, lambda f: f.ratio),
        mean=geometric_mean(f.ratio for f in found),
        fibres=_least(fibres, lambda f: f.ratio) if fibres else None,
    )


def _turned(found: Sequence[Figure]) -> Least | None:
    unturned = {(f.scene, f.quality): f for f in found}
    bases = {f: unturned.get((split_turn(f.scene)[0], f.quality)) for f in found}
    pairs = {f: base for f, base in bases.items() if base is not None and base is not f}
    return _least(pairs, lambda f: f.sobb / pairs[f].sobb) if pairs else None


def _least(found: Iterable[Figure], ratio: Callable[[Figure], float]) -> Least:
    return min((Least(ratio(f), f.name) for f in found), key=lambda least: least.value)
