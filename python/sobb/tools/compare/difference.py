# SPDX-License-Identifier: Apache-2.0
"""The ratio of two medians, and how sure it is."""

from dataclasses import dataclass

import numpy as np

SAME, FASTER, SLOWER = "same", "faster", "slower"

_RESAMPLES = 2000
_SEED = 20250607
_CONFIDENCE = 0.95


@dataclass(frozen=True)
class Difference:
    """B's speed over A's, and the interval that holds it with 95 % confidence."""

    ratio: float
    low: float
    high: float

    def verdict(self, threshold: float) -> str:
        """Faster or slower where the whole interval lies beyond 1, and the ratio by more than
        `threshold` (0.05: 5 %)."""
        if self.low > 1 and self.ratio > 1 + threshold:
            return FASTER
        if self.high < 1 and self.ratio < 1 / (1 + threshold):
            return SLOWER
        return SAME


def difference(a: np.ndarray, b: np.ndarray) -> Difference:
    """By bootstrap: both are drawn anew, with replacement, many times (B. Efron, 1979); the same
    samples give the same interval."""
    rng = np.random.default_rng(_SEED)
    ratios = _drawn_medians(b, rng) / _drawn_medians(a, rng)
    tail = (1 - _CONFIDENCE) / 2
    low, high = np.quantile(ratios, [tail, 1 - tail])
    return Difference(float(np.median(b) / np.median(a)), float(low), float(high))


def _drawn_medians(samples: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    return np.median(rng.choice(samples, (_RESAMPLES, len(samples))), axis=1)
