# SPDX-License-Identifier: Apache-2.0
"""The text at the head and the end of the page: what was measured, when, where, with what."""

import json
from collections.abc import Iterable, Sequence
from datetime import datetime
from statistics import geometric_mean
from typing import Any

from sobb.tools.report.method import HIERARCHIES
from sobb.tools.report.page.points import Point
from sobb.tools.report.results import CALLS, RAYS, Results, Run


def lead(results: Results, found: Sequence[Point]) -> dict[str, Any]:
    """Returns the title, summary, tiles, facts and notes at the head of the page."""
    cases = results.cases
    scenes = {case.scene for case in cases}
    methods = {case.method for case in cases}
    count = f"{len(results.done):,} of {len(cases):,} cases"
    summary = (
        f"{_plural(len(methods), 'method')} on {_plural(len(scenes), 'scene')}: {count} measured."
        if cases
        else "The file holds no cases: the sweep has not measured anything yet."
    )
    tiles, note = _tiles(results, found)
    return {
        "title": "Bounding volumes compared",
        "summary": summary,
        "tiles": tiles,
        "tiles_note": note,
        "facts": _common_facts(results.runs),
        "notes": _notes(results),
    }


def runs(results: Results) -> list[dict[str, Any]]:
    """Returns the facts of all runs, in their order."""
    return [
        {
            "title": f"Run {run.run_id}, {_when(run.started)}",
            "facts": _facts(run),
            "spec": _spec(run),
        }
        for run in results.runs
    ]


def _tiles(results: Results, found: Sequence[Point]) -> tuple[list[dict[str, str]], str]:
    """Returns the mean gain of the fastest SOBBs for each kind of rays, and their build's cost."""
    call = next(iter(results.calls()), "")
    speeds: dict[str, dict[str, list[float]]] = {}
    builds: dict[str, list[float]] = {}
    for point in found:
        if point["method"].startswith("sobb") and point["call"] == call and point["speed"]:
            own = speeds.setdefault(point["variant"], {})
            own.setdefault(point["rays"], []).append(point["speed"])
            builds.setdefault(point["variant"], []).extend(
                [point["build"]] if point["build"] else []
            )
    if not speeds:
        return [], ""
    fastest = max(
        speeds, key=lambda v: geometric_mean(s for own in speeds[v].values() for s in own)
    )
    tiles = [_tile(own, RAYS.get(rays, rays)) for rays, own in speeds[fastest].items()]
    tiles += [_tile(builds[fastest], "build time")] if builds[fastest] else []
    which = f"{fastest}, the fastest of {len(speeds)}," if len(speeds) > 1 else fastest
    note = f"{which} over AABB: geometric means over the scenes, traced as {CALLS.get(call, call)}."
    return tiles, note


def _tile(ratios: Sequence[float], text: str) -> dict[str, str]:
    return {"value": f"{geometric_mean(ratios):.2f} ×", "text": text}


def _notes(results: Results) -> list[str]:
    methods = {case.method for case in results.done}
    notes = []
    if results.cases and not results.done:
        notes.append("No case was measured; the causes are listed below.")
    if len(methods) == 1:
        notes.append("Only one method was measured, so there is nothing to compare it with.")
    elif methods and "aabb" not in methods:
        notes.append("AABBs were not measured, so there are no ratios.")
    if methods - set(HIERARCHIES):
        notes.append(
            "AABB, SOBB and Embree are whole hierarchies, each with its own kernels. The other "
            "volumes share one hierarchy and one traversal. Their ratios to the AABB therefore "
            "compare volume and traversal together; ratios between them compare volumes alone."
        )
    unfinished = [run for run in results.runs if run.finished is None]
    if unfinished:
        notes.append(
            "The sweep was not finished: cases that are missing may not have been measured yet."
        )
    return notes


def _common_facts(all_runs: Sequence[Run]) -> list[tuple[str, str]]:
    """Returns the facts of all runs together; values that differ are listed."""
    facts: dict[str, list[str]] = {}
    for run in all_runs:
        for name, value in _facts(run):
            facts.setdefault(name, []).append(value)
    return [(name, _listed(values)) for name, values in facts.items()]


def _facts(run: Run) -> list[tuple[str, str]]:
    cores = f", {_plural(run.cores, 'core')}" if run.cores else ""
    facts = {
        "Measured": _span(run.started, run.finished),
        "Processor": f"{run.processor}{cores}" if run.processor else None,
        "Machine": run.host,
        "sobb": run.sobb_version,
        "Commit": (run.git_commit or "")[:12],
        "Embree": run.embree_version,
        "Python": run.python_version,
    }
    return [(name, value) for name, value in facts.items() if value]


def _spec(run: Run) -> str:
    """Returns the specification of the sweep, with a line for each of its values."""
    try:
        return json.dumps(json.loads(run.spec or ""), indent=1, ensure_ascii=False)
    except ValueError:
        return run.spec or ""


def _when(time: datetime | None) -> str:
    return "at an unknown time" if time is None else f"{time:%Y-%m-%d %H:%M}"


def _span(started: datetime | None, finished: datetime | None) -> str:
    if started is None or finished is None:
        return _when(started) + ", not finished"
    same_day = started.date() == finished.date()
    return f"{_when(started)} to {finished:{'%H:%M' if same_day else '%Y-%m-%d %H:%M'}}"


def _listed(values: Iterable[str]) -> str:
    return "; ".join(dict.fromkeys(values))


def _plural(count: int, what: str) -> str:
    return f"{count:,} {what}" if count == 1 else f"{count:,} {what}s"
