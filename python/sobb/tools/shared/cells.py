# SPDX-License-Identifier: Apache-2.0
"""The columns and cells of tables in the manner of the paper, and how their numbers are spelt."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass


@dataclass(frozen=True)
class Column:
    """A column of a table; its ratios are to the method `base`."""

    key: str
    title: str
    base: str = "aabb"
    best: Callable[[Iterable[float]], float] = min
    timed: bool = True  # a figure that is not timed is the same in every repetition


@dataclass(frozen=True)
class Cell:
    """A value, its ratio to the column's base, and whether no other prints as a better one."""

    value: float | None = None
    ratio: float | None = None
    best: bool = False

    def __str__(self) -> str:
        """The cell as the paper prints it: 56.7 (0.83)."""
        parts = [] if self.value is None else [number(self.value)]
        parts += [] if self.ratio is None else [f"({self.ratio:.2f})"]
        return " ".join(parts) or "–"


def number(value: float) -> str:
    """Spells a number with at most three digits that matter: 1,234, 56.7, 8.90."""
    digits = 0 if value >= 99.95 else 1 if value >= 9.995 else 2
    return f"{value:,.{digits}f}"


def short_count(count: int) -> str:
    """Spells a number of triangles as the paper does: 2.8M."""
    return f"{count / 1e6:.1f}M" if count >= 950_000 else f"{count / 1e3:.0f}k"
