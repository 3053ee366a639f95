"""The time by which a measured signal lies beside a simulated one."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

_MOST = 4000
_OVERLAP = 0.5


@dataclass(frozen=True)
class Trace:
    """An evenly sampled signal: (n,) time [s] and values."""

    time: np.ndarray
    values: np.ndarray

    @property
    def step(self) -> float:
        """Spacing of the samples [s]."""
        return float(self.time[1] - self.time[0])

    def shifted(self, shift: float) -> Trace:
        """The same signal `shift` [s] later."""
        return Trace(self.time + shift, self.values)


def correlation(first: Trace, second: Trace, shift: float = 0.0) -> float:
    """Correlation coefficient of one signal with another one `shift` [s] later, where they overlap.

    ``r = sum (a - mean a)(b - mean b) / sqrt(sum (a - mean a)² sum (b - mean b)²)``; -1 where less than half of the
    shorter one overlaps, or one of them does not change.
    """
    later = second.shifted(shift)
    low, high = max(first.time[0], later.time[0]), min(first.time[-1], later.time[-1])
    if high - low < _OVERLAP * min(np.ptp(first.time), np.ptp(later.time)):
        return -1.0
    time = np.linspace(low, high, min(_MOST, int((high - low) / first.step) + 2))
    a, b = (np.interp(time, each.time, each.values) for each in (first, later))
    a, b = a - a.mean(), b - b.mean()
    size = np.sqrt(np.sum(a * a) * np.sum(b * b))
    return float(np.sum(a * b) / size) if size > 0 else -1.0


def best_shift(first: Trace, second: Trace, window: float) -> float:
    """The shift [s] of the second signal, at most `window` either way, with which it is most like the first.

    The largest correlation coefficient of shifts as far apart as the samples, or a thousandth of the window, refined
    by a parabola.
    """
    steps = int(np.clip(round(window / first.step), 20, 1000))
    shifts = np.linspace(-window, window, 2 * steps + 1)
    likeness = np.array([correlation(first, second, each) for each in shifts])
    best = int(likeness.argmax())
    if best in (0, len(shifts) - 1):
        return float(shifts[best])
    left, middle, right = likeness[best - 1 : best + 2]
    curvature = left - 2 * middle + right
    part = 0.5 * (left - right) / curvature if curvature < 0 else 0.0
    return float(shifts[best] + part * (shifts[1] - shifts[0]))
