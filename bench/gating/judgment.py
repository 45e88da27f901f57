# SPDX-License-Identifier: MIT
"""What pairs of times say about a case.

A pair's figure is the logarithm of head / base. Each case has the median of its pairs' figures, a bootstrap interval
for it, and Wilcoxon's signed-rank test of no change. With m cases the interval is at the level 1 - alpha / m
(Bonferroni), and the p values are Holm's: among all cases one is called changed by chance with a probability of alpha
at most.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence

import numpy as np
from scipy import stats

ALPHA = 0.05
RESAMPLES = 4999


@dataclasses.dataclass(frozen=True)
class Estimate:
    """Head's time over base's, minus 1."""

    change: float
    low: float  # of the interval
    high: float
    p: float  # of no change
    pairs: int

    def slower(self, alpha: float = ALPHA) -> bool:
        """Whether the interval and the test both say so; `p` is one that was adjusted."""
        return self.low > 0 and self.p < alpha

    def faster(self, alpha: float = ALPHA) -> bool:
        """The opposite."""
        return self.high < 0 and self.p < alpha

    def unclear(self, threshold: float) -> bool:
        """Whether the interval is wider than the threshold, and holds both no change and one above the threshold."""
        return self.low <= 0 and self.high > threshold and self.high - self.low > threshold


def log_ratios(pairs: Sequence[tuple[float, float]]) -> np.ndarray:
    """Returns the logarithm of head / base for each pair of (base, head) times."""
    times = np.asarray(pairs, dtype=float)
    return np.log(times[:, 1] / times[:, 0])


def estimate(pairs: Sequence[tuple[float, float]], cases: int) -> Estimate:
    """Estimates one of `cases` cases from its pairs; `p` is not adjusted yet."""
    logs = log_ratios(pairs)
    if np.ptp(logs) == 0:  # nothing to resample: all the same
        low = high = logs[0]
    else:
        found = stats.bootstrap((logs,), np.median, confidence_level=1 - ALPHA / cases, n_resamples=RESAMPLES,
                                method="percentile", random_state=1)
        low, high = found.confidence_interval
    changed = logs[logs != 0]  # the test has no use for pairs that are equal
    p = stats.wilcoxon(changed).pvalue if changed.size else 1.0
    change, low, high = (float(np.expm1(value)) for value in (np.median(logs), low, high))
    return Estimate(change, low, high, float(p), len(logs))


def holm(p_values: Sequence[float]) -> list[float]:
    """Adjusted for their number, in the same order (Holm 1979)."""
    order = np.argsort(p_values)
    factors = len(p_values) - np.arange(len(p_values))
    adjusted = np.minimum(1, np.maximum.accumulate(np.asarray(p_values)[order] * factors))
    result = np.empty(len(p_values))
    result[order] = adjusted
    return result.tolist()


def estimates(pairs: dict[str, list[tuple[float, float]]]) -> dict[str, Estimate]:
    """Estimates all cases, with adjusted p values."""
    found = {case: estimate(of_case, len(pairs)) for case, of_case in pairs.items()}
    adjusted = holm([one.p for one in found.values()])
    return {case: dataclasses.replace(one, p=p) for (case, one), p in zip(found.items(), adjusted)}
