# SPDX-License-Identifier: Apache-2.0
"""The cases of a sweep: one process each."""

import hashlib
import itertools
import json
from collections.abc import Sequence
from dataclasses import asdict, dataclass
from typing import Any

from sobb.scenes import Source, split_turn
from sobb.sweep.spec import Spec

_EMBREE_ISAS = {"sse4": "sse4.2", "avx2": "avx2"}
# What a method does not depend on.
_MEANINGLESS: dict[str, tuple[str, ...]] = {
    "aabb": ("k", "strategy", "table_kind"),
    "embree": ("k", "strategy", "table_kind", "width"),
    "sobb": (),
}


@dataclass(frozen=True)
class Case:
    """A scene, a view, a method with its options, and the rays that are traced. What has no
    meaning for the method is None."""

    scene: str  # as asked for
    argument: str  # as the benchmark program takes it
    name: str
    subdivision: int
    view: int
    method: str
    k: int | None
    strategy: str | None
    table_kind: str | None
    quality: str
    width: int | None
    isa: str
    threads: int
    rays: tuple[str, ...]
    calls: tuple[str, ...]
    size: int
    repetitions: int
    cameras: str | None

    @property
    def case_id(self) -> str:
        """The same for the same case, whatever sweep it is of and wherever its scene lies."""
        named = {**asdict(self), "argument": None, "cameras": None}
        return hashlib.sha256(json.dumps(named, sort_keys=True).encode()).hexdigest()[:16]

    @property
    def title(self) -> str:
        options = (self.k and f"k={self.k}", self.strategy, self.table_kind, self.quality)
        times = f"^{self.subdivision}" if self.subdivision > 1 else ""
        width = self.width and f"{self.width}-wide"
        parts = (self.name + times, self.view and f"view {self.view}", self.method, *options)
        return " ".join(str(part) for part in (*parts, width, self.isa) if part)

    def row(self) -> str:
        """What the program calls the method."""
        return f"embree_{self.quality}" if self.method == "embree" else self.method

    def arguments(self) -> list[str]:
        """The program's command line."""
        base, turn = split_turn(self.argument)
        times = f"^{self.subdivision}" if self.subdivision > 1 else ""
        row = self.row()
        wanted = f"(build/{row}|({'|'.join(self.rays)})/{row}/({'|'.join(self.calls)}))"
        options: dict[str, Any] = {
            "scene": base + times + turn,
            "cameras": self.cameras,
            "view": self.view,
            "size": self.size,
            "k": self.k,
            "strategy": self.strategy,
            "table": self.table_kind,
            "quality": self.quality,
            "width": self.width,
            "threads": self.threads,
            "isa": self.isa,
            "embree-isa": _EMBREE_ISAS.get(self.isa),
            "benchmark_filter": f"^{wanted}(/manual_time)?$",
            "benchmark_repetitions": self.repetitions,
            "benchmark_min_time": 0.01,  # one pass, unless the rays are few
        }
        return [f"--{name}={value}" for name, value in options.items() if value is not None]


def expand(spec: Spec, sources: Sequence[Source]) -> list[Case]:
    """All cases of a sweep, each once, one scene after another."""
    dimensions = itertools.product(
        sources, spec.subdivisions, spec.views, spec.isas, spec.threads, spec.qualities,
        spec.methods, spec.widths, spec.k, spec.strategies, spec.tables,
    )  # fmt: skip
    cases: dict[Case, None] = {}
    for source, times, view, isa, threads, quality, method, width, k, strategy, table in dimensions:
        if method == "embree" and quality == "low":
            continue  # it has no such rows
        options: dict[str, Any] = dict(k=k, strategy=strategy, table_kind=table, width=width)
        options.update(dict.fromkeys(_MEANINGLESS[method]))
        case = Case(
            scene=source.asked,
            argument=source.argument,
            name=source.name,
            subdivision=times,
            view=view,
            method=method,
            quality=quality,
            isa=isa,
            threads=threads,
            rays=tuple(dict.fromkeys(spec.rays)),
            calls=tuple(dict.fromkeys(spec.calls)),
            size=spec.size,
            repetitions=spec.repetitions,
            cameras=spec.cameras,
            **options,
        )
        cases[case] = None
    return list(cases)
