# SPDX-License-Identifier: Apache-2.0
"""The data of the charts: a point for each case, kind of rays and call."""

from collections.abc import Iterable, Sequence
from statistics import geometric_mean
from typing import Any

from sobb.tools.report.method import BASE, Variant, bases, variants
from sobb.tools.report.results import Case, Key, Results
from sobb.tools.report.scene import names, order, titles

Point = dict[str, Any]


def points(results: Results) -> list[Point]:
    """Returns all that was traced, with the ratios to AABBs where these were measured as well."""
    cases, named, compared = results.done, variants(results.done), bases(results.done)
    curve, title = names(cases), titles(cases)
    return [
        {"scene": title[case.case_id], "curve": curve[case.case_id]}
        | _point(case, named[case.case_id], compared.get(case.case_id), rays, call)
        for case in sorted(cases, key=lambda case: (order(case), named[case.case_id]))
        for rays in results.rays()
        for call in results.calls()
        if case.value(Key("mrays_s", rays, call))
    ]


def _point(case: Case, variant: Variant, base: Case | None, rays: str, call: str) -> Point:
    key = Key("mrays_s", rays, call)
    return {
        "method": variant.method,
        "variant": variant.title,
        "base": variant.method == BASE,
        "rays": rays,
        "call": call,
        "triangles": case.triangles,
        "mrays": case.value(key),
        "ns": 1000 / case.value(key),
        "volumes": _work(case, "volumes_per_ray", rays, call),
        "tests": _work(case, "triangles_per_ray", rays, call),
        "speed": _ratio(case, base, key),
        "build": _ratio(case, base, Key("build_ms")),
    }


def _ratio(case: Case, base: Case | None, key: Key) -> float | None:
    own, other = case.value(key), base.value(key) if base is not None else None
    return own / other if own is not None and other else None


def _work(case: Case, metric: str, rays: str, call: str) -> float | None:
    """Returns the work per ray of this call, or else of single rays."""
    own = case.value(Key(metric, rays, call))
    return case.value(Key(metric, rays, "single")) if own is None else own


def gains(found: Iterable[Point]) -> list[Point]:
    """Returns each variant's geometric means of speed and build time over the scenes.

    `front` tells whether it is on the Pareto front: no other variant builds and traces at least as
    fast, and one of both faster.
    """
    groups: dict[tuple[str, str], dict[str, list[Point]]] = {}
    for point in found:
        if point["speed"] and point["build"]:
            group = groups.setdefault((point["rays"], point["call"]), {})
            group.setdefault(point["variant"], []).append(point)
    return [mean for group in groups.values() for mean in _means(list(group.values()))]


def _means(by_variant: Sequence[Sequence[Point]]) -> list[Point]:
    scenes = max(len(own) for own in by_variant)
    means = [
        own[0]
        | {
            "speed": geometric_mean(point["speed"] for point in own),
            "build": geometric_mean(point["build"] for point in own),
            "scenes": len(own),
        }
        for own in by_variant
        if len(own) == scenes  # means over different scenes cannot be compared
    ]
    return [mean | {"front": not any(_beats(other, mean) for other in means)} for mean in means]


def _beats(a: Point, b: Point) -> bool:
    ours, theirs = (a["speed"], -a["build"]), (b["speed"], -b["build"])
    return ours != theirs and ours[0] >= theirs[0] and ours[1] >= theirs[1]
