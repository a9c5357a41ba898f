# SPDX-License-Identifier: Apache-2.0
"""The names of scenes on the page, and their order."""

from collections.abc import Iterable, Mapping

from sobb.tools.report.results import Case
from sobb.tools.shared.cells import short_count


def names(cases: Iterable[Case]) -> dict[str, str]:
    """Returns the name of each case's scene, by the case's id.

    Where two scenes have the same name, it is all that was asked for; where several views of a
    scene were measured, it has the view.
    """
    cases = list(cases)
    alike: dict[str, set[str]] = {}
    views: dict[str, set[int]] = {}
    for case in cases:
        alike.setdefault(case.name, set()).add(case.scene)
        views.setdefault(case.scene, set()).add(case.view)
    return {
        case.case_id: (case.name if len(alike[case.name]) == 1 else case.scene)
        + (f", view {case.view}" if len(views[case.scene]) > 1 else "")
        for case in cases
    }


def titles(cases: Iterable[Case]) -> Mapping[str, str]:
    """Returns the names with the subdivision and the number of triangles: hairball ×4 [240k]."""
    cases = list(cases)
    named = names(cases)
    return {case.case_id: named[case.case_id] + _size(case) for case in cases}


def order(case: Case) -> tuple[str, str, int, int]:
    """Returns a key that sorts scenes by name, and a scene's subdivisions after each other."""
    return case.name, case.scene, case.subdivision, case.view


def _size(case: Case) -> str:
    refined = f" ×{case.subdivision}" if case.subdivision > 1 else ""
    return refined + (f" [{short_count(case.triangles)}]" if case.triangles is not None else "")
