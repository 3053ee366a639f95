"""What a comparison of a run with measurements found: errors, bands, inside or outside."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from susp_mj.signals import STANDARD_GRAVITY

from .standards import Allowed, Standard


@dataclass(frozen=True)
class PeakErrors:
    """Errors of the simulated peaks, as in table 6.3 of the thesis, and of the whole curve.

    Attributes:
        smallest, largest: of ``|s - m|`` at the highest and the lowest peak of every measurement, or at every point of
            a comparison that is not over time; in g of accelerations, else in the channel's unit.
        unit: of both.
        of_peak: largest of ``100 |s - m|/|m|`` at the larger measured peak, or at the largest measured point [%].
        of_any: ``100 max |s - m|/max |m|``, s and the mean m at the same abscissa [%].
        rms: ``sqrt(mean (s - m)²)`` in the channel's unit.
    """

    smallest: float
    largest: float
    unit: str
    of_peak: float
    of_any: float
    rms: float


@dataclass(frozen=True)
class Judgement:
    """One channel beside its measurements.

    Attributes:
        channel, quantity, unit: what is compared, in SI.
        abscissa: (n,) time [s] or values of `over`.
        simulated: (n,).
        measured: (k, n), a row a measurement.
        confidence: (n,) half width of the confidence interval of the mean; zero with one measurement.
        half: (n,) half width of the band around the mean.
        allowed: its tolerance.
        errors: see `PeakErrors`.
        notes: what else must be known, in phrases.
    """

    channel: str
    quantity: str
    unit: str
    abscissa: np.ndarray
    simulated: np.ndarray
    measured: np.ndarray
    confidence: np.ndarray
    half: np.ndarray
    allowed: Allowed
    errors: PeakErrors
    notes: tuple[str, ...] = ()

    @property
    def mean(self) -> np.ndarray:
        """Mean of the measurements."""
        return self.measured.mean(axis=0)

    @property
    def worst(self) -> int:
        """Where the simulated value is furthest out of the band, or closest to its edge."""
        return int(np.argmax(np.abs(self.simulated - self.mean) - self.half))

    @property
    def inside(self) -> bool:
        """Whether every simulated value lies in the band."""
        return bool((np.abs(self.simulated - self.mean) <= self.half).all())


@dataclass(frozen=True)
class Shift:
    """What was added to the time of a measurement [s], and the correlation that this gives; None if it was given."""

    measurement: str
    seconds: float
    correlation: float | None = None
    note: str = ""


@dataclass(frozen=True)
class Findings:
    """What a comparison found.

    Attributes:
        standard: by which.
        over: channel of the abscissa; empty for time.
        over_unit: its unit.
        filter: of both, in words.
        shifts: one for each measurement; none where nothing is compared over time.
        judgements: one for each channel.
        notes: what else must be known, in phrases.
    """

    standard: Standard
    over: str
    over_unit: str
    filter: str
    shifts: tuple[Shift, ...]
    judgements: tuple[Judgement, ...]
    notes: tuple[str, ...] = ()

    @property
    def inside(self) -> bool:
        """Whether every channel is inside."""
        return all(each.inside for each in self.judgements)


def peak_errors(simulated: np.ndarray, measured: np.ndarray, unit: str, *, over_time: bool) -> PeakErrors:
    """Errors of (n,) simulated values in an SI unit against (k, n) measured ones."""
    mean = measured.mean(axis=0)
    peaks: Callable[[np.ndarray], np.ndarray] = (
        (lambda values: np.stack([values.max(axis=-1), values.min(axis=-1)], axis=-1)) if over_time else np.asarray
    )
    own, theirs = peaks(simulated), peaks(measured)
    off = np.abs(own - theirs)
    larger = np.abs(theirs).argmax(axis=1, keepdims=True)
    at_larger, size = np.take_along_axis(off, larger, 1), np.abs(np.take_along_axis(theirs, larger, 1))
    scale = 1 / STANDARD_GRAVITY if unit == "m/s²" else 1.0
    return PeakErrors(
        float(off.min()) * scale,
        float(off.max()) * scale,
        "g" if unit == "m/s²" else unit,
        _percent(at_larger, size),
        _percent(np.abs(simulated - mean).max(), np.abs(mean).max()),
        float(np.sqrt(np.mean((simulated - mean) ** 2))),
    )


def _percent(error: np.ndarray, of: np.ndarray) -> float:
    """Largest error as a share of what it is held against [%]; not a number where that is zero."""
    return float(np.max(100 * error / of)) if np.all(np.asarray(of) > 0) else float("nan")
