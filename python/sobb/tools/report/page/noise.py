# SPDX-License-Identifier: Apache-2.0
"""The section on noise: how much the repetitions of timed figures differ."""

from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median
from typing import Any

from sobb.tools.report.method import variants
from sobb.tools.report.results import Figure, Key, Results
from sobb.tools.report.scene import titles
from sobb.tools.shared.cells import number

_TIMED = ("mrays_s", "build_ms")
_SHOWN = 8


@dataclass(frozen=True)
class Variation:
    """A figure that was repeated, with its scene and variant."""

    scene: str
    variant: str
    key: Key
    figure: Figure
    variation: float


def variations(results: Results) -> list[Variation]:
    """Returns all timed figures that were repeated, the noisiest first."""
    title, named = titles(results.done), variants(results.done)
    found = [
        Variation(title[case.case_id], named[case.case_id].title, key, figure, figure.variation)
        for case in results.done
        for key, figure in case.figures.items()
        if key.metric in _TIMED and figure.variation is not None
    ]
    return sorted(found, key=lambda v: (-v.variation, v.scene, v.variant))


def section(found: Sequence[Variation]) -> dict[str, Any]:
    """Returns the text and the rows of the section."""
    if not found:
        return {"text": "Nothing was measured more than once.", "rows": []}
    typical, high = median(v.variation for v in found), found[len(found) // 20].variation
    text = (
        f"Of {len(found):,} figures that were measured more than once, half vary by less than "
        f"{_percent(typical)} (coefficient of variation of the repetitions), 95 in 100 by less "
        f"than {_percent(high)}. A ratio says little if it is nearer to 1 than about twice that."
    )
    rows = [
        {
            "scene": v.scene,
            "variant": v.variant,
            "figure": " ".join(
                part for part in (_METRICS[v.key.metric], v.key.rays, v.key.call) if part
            ),
            "median": number(v.figure.median),
            "variation": _percent(v.variation),
            "repetitions": v.figure.repetitions,
        }
        for v in found[:_SHOWN]
    ]
    return {"text": text, "rows": rows}


_METRICS = {"mrays_s": "Mrays/s", "build_ms": "build, ms"}


def _percent(share: float) -> str:
    return f"{100 * share:.1f} %"
