# SPDX-License-Identifier: Apache-2.0
"""The figures of one scene: our speed by rays, call and quality, over Embree's fastest."""

from collections.abc import Iterable
from dataclasses import dataclass

from sobb.tools.shared.bench import Report, Rows
from sobb.tools.shared.scenes import Source

RAYS = ("primary", "shadow", "diffuse1", "diffuse7", "random")
CALLS = ("single", "packet", "array")


@dataclass(frozen=True)
class Quality:
    """The methods that are compared at one quality of our build."""

    sobb: str
    aabb: str
    peers: tuple[str, ...]
    same: str  # the peer whose memory is compared


QUALITIES = {
    "medium": Quality("sobb", "aabb", ("embree_medium",), "embree_medium"),
    "high": Quality("sobb_high", "aabb_high", ("embree_medium", "embree_high"), "embree_high"),
}
# Robust mode is shown beside, at one quality, since the qualities differ by little.
ROBUST = ("embree_high_robust",)
METHODS = (
    *dict.fromkeys(m for q in QUALITIES.values() for m in (q.aabb, q.sobb, *q.peers)),
    *ROBUST,
)


@dataclass(frozen=True)
class Figure:
    """Medians in million rays per second, and bytes per triangle."""

    scene: str  # the name that was asked for
    name: str
    triangles: int
    rays: str
    call: str
    quality: str
    sobb: float
    aabb: float
    embree: float
    embree_row: str  # METHOD/CALL of the fastest
    robust: float
    bytes: float
    embree_bytes: float

    @property
    def ratio(self) -> float:
        return self.sobb / self.embree

    def entry(self, threads: int, isa: str) -> dict[str, str | int | float]:
        """Returns the figure's entry in the JSON."""
        return {
            "scene": self.scene,
            "rays": self.rays,
            "call": self.call,
            "threads": threads,
            "isa": isa,
            "quality": self.quality,
            "ours_mrays_s": self.sobb,
            "embree_mrays_s": self.embree,
            "ratio": self.ratio,
            "aabb_mrays_s": self.aabb,
            "embree_row": self.embree_row,
            "embree_robust_mrays_s": self.robust,
            "bytes_per_triangle": self.bytes,
            "embree_bytes_per_triangle": self.embree_bytes,
        }


def row_filter() -> str:
    """Returns the filter for the rows that the figures need."""
    return f"^({'|'.join(RAYS)})/({'|'.join(METHODS)})/({'|'.join(CALLS)})(/manual_time)?$"


def figures(source: Source, report: Report) -> list[Figure]:
    """Returns all figures of a scene. Raises OSError where the program found no Embree."""
    rows = report.medians
    if not any("/embree_" in row for row in rows):
        raise OSError("sobb_bench measured no row of Embree's, which is not installed")
    found = []
    for rays in RAYS:
        robust, _ = _fastest(rows, rays, ROBUST)
        for call in CALLS:
            for name, quality in QUALITIES.items():
                embree, embree_row = _fastest(rows, rays, quality.peers)
                ours = rows[f"{rays}/{quality.sobb}/{call}"]
                found.append(
                    Figure(
                        scene=source.asked,
                        name=source.name,
                        triangles=int(report.context["triangles"]),
                        rays=rays,
                        call=call,
                        quality=name,
                        sobb=ours["Mrays/s"],
                        aabb=rows[f"{rays}/{quality.aabb}/{call}"]["Mrays/s"],
                        embree=embree,
                        embree_row=embree_row,
                        robust=robust,
                        bytes=ours["bytes/triangle"],
                        embree_bytes=rows[f"{rays}/{quality.same}/single"]["bytes/triangle"],
                    )
                )
    return found


def _fastest(rows: Rows, rays: str, methods: Iterable[str]) -> tuple[float, str]:
    names = (f"{method}/{call}" for method in methods for call in CALLS)
    # Embree 4 has no call that takes an array of rays.
    speeds = {name: rows[f"{rays}/{name}"]["Mrays/s"] for name in names if f"{rays}/{name}" in rows}
    best = max(speeds, key=speeds.__getitem__)
    return speeds[best], best
