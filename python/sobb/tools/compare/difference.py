# SPDX-License-Identifier: Apache-2.0
"""The ratio of two medians, and its confidence interval."""

from dataclasses import dataclass

import numpy as np

SAME, FASTER, SLOWER = "same", "faster", "slower"

_RESAMPLES = 2000
_SEED = 20250607
_CONFIDENCE = 0.95


@dataclass(frozen=True)
class Difference:
    """The speed of B over that of A, and its confidence interval of 95 %."""

    ratio: float
    low: float
    high: float

    def verdict(self, threshold: float) -> str:
        """Returns FASTER or SLOWER where the whole interval lies on one side of 1.

        The ratio has to differ from 1 by more than `threshold` as well (0.05 is 5 %).
        """
        if self.low > 1 and self.ratio > 1 + threshold:
            return FASTER
        if self.high < 1 and self.ratio < 1 / (1 + threshold):
            return SLOWER
        return SAME


def difference(a: np.ndarray, b: np.ndarray) -> Difference:
    """Estimates the interval by bootstrap (B. Efron, 1979).

    Both sets of samples are drawn anew many times, with replacement. The same samples always give
    the same interval.
    """
    rng = np.random.default_rng(_SEED)
    ratios = _drawn_medians(b, rng) / _drawn_medians(a, rng)
    tail = (1 - _CONFIDENCE) / 2
    low, high = np.quantile(ratios, [tail, 1 - tail])
    return Difference(float(np.median(b) / np.median(a)), float(low), float(high))


def _drawn_medians(samples: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    return np.median(rng.choice(samples, (_RESAMPLES, len(samples))), axis=1)
