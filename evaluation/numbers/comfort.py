"""Ride comfort after ISO 2631-1:1997: frequency-weighted acceleration, vibration dose, transient peak.

Man feels vertical vibration of 4 to 12 Hz most, horizontal below 2 Hz. A weighting is an analogue filter, here the
product of four transfer functions of ``s = 2 pi i f`` with ``w_n = 2 pi f_n`` (annex A of the standard):

- band limits ``s²/(s² + s w1/Q + w1²)`` and ``1/(1 + s/(Q w2) + (s/w2)²)``, ``Q = 1/sqrt(2)``;
- transition from acceleration to velocity ``(1 + s/w3)/(1 + s/(Q4 w4) + (s/w4)²)``;
- upward step ``(1 + s/(Q5 w5) + (s/w5)²)/(1 + s/(Q6 w6) + (s/w6)²) (w5/w6)²``.

Wk weights the vertical (seat and feet), Wd the horizontal of the seat, Wc the fore-and-aft of the backrest, We
rotations. For comfort the seat's three directions count with k = 1 (health: horizontal 1.4, vertical 1), the backrest's
x, y, z with 0.8, 0.5, 0.4, the feet's with 0.25, 0.25, 0.4, the seat's rotations with 0.63, 0.4, 0.2 m/rad about x, y,
z. The numbers below are of the vertical alone, Wk with k = 1; other directions are to be added as the root of the sum
of ``(k a)²``.

The standard means the seat surface. A model has no cushion and no occupant: ``seat_acceleration`` is that of the floor
under the driver's seat, and ``body_acceleration`` that of the body's centre of gravity.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from susp_mj.errors import InputError
from susp_mj.run import Run

from .number import Answer, Measure, Runs
from .runs import recorded

LEAST_SAMPLING = 500.0
"""Records per second [Hz] that a weighting needs: 2.5 times the band limit of 100 Hz lie below the Nyquist
frequency."""
RUNNING_WINDOW = 1.0
"""Length of the running rms [s]."""
SETTLING = 20.0
"""Zeros appended before a signal is filtered [s]; the slowest pole, 1.8 1/s, leaves 1e-15 of anything that wraps
around."""
_BUTTERWORTH = 1 / math.sqrt(2)


@dataclass(frozen=True)
class Weighting:
    """A frequency weighting: corner frequencies f1 … f6 [Hz] and resonant quality factors Q4 … Q6.

    Attributes:
        high_pass, low_pass: f1 and f2, the band limits.
        transition: f3, f4 and Q4; None leaves the band limits alone.
        step: f5, Q5, f6 and Q6; None has no step.
    """

    high_pass: float = 0.4
    low_pass: float = 100.0
    transition: tuple[float, float, float] | None = None
    step: tuple[float, float, float, float] | None = None

    def response(self, frequency: np.ndarray) -> np.ndarray:
        """Complex transfer function at frequencies [Hz] of any shape."""
        f = np.asarray(frequency, float)
        result = (1j * f / self.high_pass) ** 2 / _second_order(f, self.high_pass, _BUTTERWORTH)
        result = result / _second_order(f, self.low_pass, _BUTTERWORTH)
        if self.transition is not None:
            f3, f4, q4 = self.transition
            result = result * (1 + 1j * f / f3) / _second_order(f, f4, q4)
        if self.step is not None:
            f5, q5, f6, q6 = self.step
            result = result * _second_order(f, f5, q5) / _second_order(f, f6, q6) * (f5 / f6) ** 2
        return result


def _second_order(frequency: np.ndarray, corner: float, quality: float) -> np.ndarray:
    """``1 + s/(Q w) + (s/w)²``."""
    ratio = 1j * frequency / corner
    return 1 + ratio / quality + ratio**2


# ISO 2631-1:1997, tables A.1 and A.2
WEIGHTINGS: dict[str, Weighting] = {
    "band": Weighting(),
    "Wk": Weighting(transition=(12.5, 12.5, 0.63), step=(2.37, 0.91, 3.35, 0.91)),
    "Wd": Weighting(transition=(2.0, 2.0, 0.63)),
    "We": Weighting(transition=(1.0, 1.0, 0.63)),
    "Wc": Weighting(transition=(8.0, 8.0, 0.63)),
}

# ISO 2631-1:1997, C.2.3; the ranges overlap
_COMFORT = (
    (0.0, 0.315, "not uncomfortable"),
    (0.315, 0.63, "a little uncomfortable"),
    (0.5, 1.0, "fairly uncomfortable"),
    (0.8, 1.6, "uncomfortable"),
    (1.25, 2.5, "very uncomfortable"),
    (2.0, math.inf, "extremely uncomfortable"),
)


def weighted(values: np.ndarray, step: float, weighting: Weighting) -> np.ndarray:
    """A sampled signal after a weighting, exact up to the Nyquist frequency.

    The spectrum is multiplied by the analogue transfer function; zeros appended make it the response of a filter at
    rest before the first sample. What the signal holds above half the sampling frequency is folded before it comes
    here.

    Args:
        values: (n,) samples.
        step: spacing [s], at most 2 ms.

    Returns:
        (n,) samples in the unit of `values`.

    Raises:
        InputError: sampled too coarsely for the band limit of 100 Hz.
    """
    if not 0 < step * LEAST_SAMPLING <= 1 + 1e-9:
        raise InputError(
            f"{1 / step:.4g} samples a second are too few; frequency weighting needs {LEAST_SAMPLING:g}", key="step"
        )
    count = 2 ** math.ceil(math.log2(len(values) + SETTLING / step))
    spectrum = np.fft.rfft(values, count) * weighting.response(np.fft.rfftfreq(count, step))
    return np.fft.irfft(spectrum, count)[: len(values)]


def comfort_word(acceleration: float) -> str:
    """What the ISO's scale says of a weighted rms acceleration [m/s²]; its ranges overlap, so it may say two things.

    >>> comfort_word(0.2), comfort_word(0.55)
    ('not uncomfortable', 'a little uncomfortable to fairly uncomfortable')

    Source: ISO 2631-1:1997, C.2.3, "likely reactions in public transport"; for the total of all directions at the seat.
    """
    return " to ".join(word for low, high, word in _COMFORT if low <= acceleration < high)


def weighted_acceleration(run: Run) -> Answer:
    """Wk-weighted rms of the vertical acceleration at the body's centre of gravity [m/s²].

    ``a_w = sqrt(1/T ∫ a_w(t)² dt)`` over the whole run, k = 1; the note is the ISO's word for it. Compare runs of the
    same manoeuvre and duration only: standing still before and after a bump counts as comfort.
    """
    return _weighted_rms(run, "body_acceleration")


def weighted_seat_acceleration(run: Run) -> Answer:
    """Wk-weighted rms of the vertical acceleration at the driver's seat [m/s²].

    As `weighted_acceleration`, where heave, pitch and roll come together at the driver's place; the floor, not the
    cushion.
    """
    return _weighted_rms(run, "seat_acceleration")


def vibration_dose_value(run: Run) -> Answer:
    """Fourth-power vibration dose of the Wk-weighted vertical acceleration at the centre of gravity [m/s^1.75].

    ``VDV = (∫ a_w(t)⁴ dt)^(1/4)``, k = 1: it grows with time and heeds shocks more than the rms (ISO 2631-1:1997,
    6.3.2).
    """
    found = _weighted_channel(run, "body_acceleration")
    return found if isinstance(found, Answer) else Answer(_integral(found**4, run) ** 0.25)


def maximum_transient_vibration(run: Run) -> Answer:
    """Largest running rms over 1 s (MTVV) of the Wk-weighted vertical acceleration at the centre of gravity [m/s²].

    ``max over t of sqrt(1/τ ∫ from t-τ to t of a_w² dt)``, τ = 1 s, k = 1 (ISO 2631-1:1997, 6.3.1). Above 1.5 times
    the rms over the run, the rms alone underrates the shocks, and the note says so.
    """
    found = _weighted_channel(run, "body_acceleration")
    if isinstance(found, Answer):
        return found
    time = run.time - run.time[0]
    if time[-1] < RUNNING_WINDOW:
        return Answer(None, f"the run is shorter than {RUNNING_WINDOW:g} s")
    power = found**2
    energy = np.concatenate([[0.0], np.cumsum((power[1:] + power[:-1]) / 2 * np.diff(time))])
    end = np.append(time[time >= RUNNING_WINDOW], time[-1])
    inside = np.interp(end, time, energy) - np.interp(end - RUNNING_WINDOW, time, energy)
    at = int(np.argmax(inside))
    value = math.sqrt(inside[at] / RUNNING_WINDOW)
    shocks = "; shocks: heed it beside the rms" if value > 1.5 * math.sqrt(energy[-1] / time[-1]) else ""
    return Answer(value, f"in the second before {run.time[0] + end[at]:.3f} s{shocks}")


def _weighted_rms(run: Run, channel: str) -> Answer:
    found = _weighted_channel(run, channel)
    if isinstance(found, Answer):
        return found
    value = math.sqrt(_integral(found**2, run) / float(run.time[-1] - run.time[0]))
    return Answer(value, comfort_word(value))


def _weighted_channel(run: Run, channel: str) -> np.ndarray | Answer:
    """Wk-weighted values of a channel, or the answer that says why there are none."""
    try:
        return weighted(run[channel], run.step, WEIGHTINGS["Wk"])
    except InputError as error:
        return Answer(None, error.message)


def _integral(values: np.ndarray, run: Run) -> float:
    return float(np.trapezoid(values, run.time))


def _vibrates(run: Run) -> bool:
    """Whether a road shakes the car, or nothing is known of the road."""
    roads = run.stations("road_height").values()
    return not roads or any(np.ptp(road) > 0 for road in roads)


LASTS = Runs(lambda run: len(run.time) > 1, "the run is a single instant")
VIBRATES = LASTS & Runs(_vibrates, "needs a road that shakes the car")
NUMBERS = (
    Measure(weighted_acceleration, "m/s²", recorded("body_acceleration") & VIBRATES),
    Measure(weighted_seat_acceleration, "m/s²", recorded("seat_acceleration") & VIBRATES),
    Measure(vibration_dose_value, "m/s^1.75", recorded("body_acceleration") & VIBRATES),
    Measure(maximum_transient_vibration, "m/s²", recorded("body_acceleration") & VIBRATES),
)
