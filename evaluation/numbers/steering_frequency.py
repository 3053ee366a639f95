"""Response to the steering wheel over frequency: gain, phase and coherence, read from a sine sweep of the steering
wheel.

The sweep is read by deconvolution, as in `frequency`: of an exponential one, what remains is the first harmonic; the
harmonics of a linear one stay in it as noise. The coherence is the share of a channel's power that follows from the
steering wheel linearly, by Welch's method.

Source: ISO 7401:2011 and ISO 8726:1988; A. Farina, AES Convention 108 (2000), 5093; P. D. Welch, IEEE Trans. Audio
Electroacoust. 15 (1967).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from susp_mj.run import Run

from ..display import quantity_text
from .frequency import deconvolved
from .number import Number
from .turns import drives, missing

SEGMENT = 2.0
"""Length of a segment of Welch's method, in periods of the lowest frequency."""
REFERENCE = 1.0
"""Frequency [Hz] at which phase and delay are given."""


@dataclass(frozen=True)
class Response:
    """Response of a channel to the steering wheel.

    Attributes:
        frequency: (n,) [Hz].
        ratio: (n,) complex, channel's unit per radian of the steering wheel.
        coherence: (n,) 0 to 1.
    """

    frequency: np.ndarray
    ratio: np.ndarray
    coherence: np.ndarray

    @property
    def gain(self) -> np.ndarray:
        """Magnitude of the ratio."""
        return np.abs(self.ratio)

    @property
    def phase(self) -> np.ndarray:
        """Phase [rad], continuous over the frequency; at the lowest one between -pi/2 and pi/2 where the gain's sign
        allows it.

        The sign of the ratio at low frequency, where a channel is opposed to the steering wheel, is not counted as
        phase.
        """
        sign = -1.0 if self.ratio[0].real < 0 else 1.0
        return np.unwrap(np.angle(sign * self.ratio))


def steering_response(run: Run, channel: str, points: int = 200) -> Response | None:
    """Response of a channel to the steering wheel over frequency; None if the run is not a sweep of the steering
    wheel."""
    if not drives(run) or "excitation_frequency" not in run or channel not in run:
        return None
    steering = run["steering_wheel_angle"] - run["steering_wheel_angle"][0]
    swept = run["excitation_frequency"]
    low, high = float(swept[0]), float(swept[-1])
    if not np.any(steering) or not high > 1.5 * low:
        return None
    values = run[channel] - run[channel][0]
    found = deconvolved(steering, values, run.step, (low, high), points)
    return Response(found.frequency, found.ratio, _coherence(steering, values, run.step, low, found.frequency))


def _coherence(reference: np.ndarray, values: np.ndarray, step: float, low: float, wanted: np.ndarray) -> np.ndarray:
    """Coherence at the wanted frequencies [Hz], by Welch's method."""
    from scipy.signal import csd, welch

    options = {"fs": 1 / step, "nperseg": min(math.ceil(SEGMENT / low / step), len(values)), "detrend": "constant"}
    frequency, cross = csd(reference, values, **options)
    product = welch(reference, **options)[1] * welch(values, **options)[1]
    coherence = np.divide(np.abs(cross) ** 2, product, out=np.zeros(len(frequency)), where=product > 0)
    return np.interp(wanted, frequency, coherence)


def yaw_rate_gain_peak(run: Run) -> Number:
    """Largest yaw rate per steering wheel angle over frequency [1/s]."""
    return _peak(run, "yaw_rate", "1/s")


def yaw_rate_peak_frequency(run: Run) -> Number:
    """Frequency of the largest yaw rate per steering wheel angle [Hz]."""
    return _peak_frequency(run, "yaw_rate")


def yaw_rate_phase(run: Run) -> Number:
    """Phase of the yaw rate against the steering wheel at 1 Hz [rad], negative: it lags."""
    return _phase(run, "yaw_rate")


def yaw_rate_delay(run: Run) -> Number:
    """Equivalent time delay of the yaw rate [s]: ``-phase/(2 pi f)`` at 1 Hz."""
    return _delay(run, "yaw_rate")


def lateral_acceleration_gain_peak(run: Run) -> Number:
    """Largest lateral acceleration per steering wheel angle over frequency [m/s²/rad]."""
    return _peak(run, "lateral_acceleration", "m/s²/rad")


def lateral_acceleration_phase(run: Run) -> Number:
    """Phase of the lateral acceleration against the steering wheel at 1 Hz [rad], negative: it lags."""
    return _phase(run, "lateral_acceleration")


def lateral_acceleration_delay(run: Run) -> Number:
    """Equivalent time delay of the lateral acceleration [s]: ``-phase/(2 pi f)`` at 1 Hz."""
    return _delay(run, "lateral_acceleration")


def roll_angle_gain_peak(run: Run) -> Number:
    """Largest roll angle per steering wheel angle over frequency [rad/rad]."""
    return _peak(run, "roll_angle", "1")


def roll_angle_peak_frequency(run: Run) -> Number:
    """Frequency of the largest roll angle per steering wheel angle [Hz]."""
    return _peak_frequency(run, "roll_angle")


def side_slip_gain_peak(run: Run) -> Number:
    """Largest side slip angle of the centre of gravity per steering wheel angle over frequency [rad/rad]."""
    return _peak(run, "side_slip_angle", "1")


def side_slip_peak_frequency(run: Run) -> Number:
    """Frequency of the largest side slip angle of the centre of gravity per steering wheel angle [Hz]."""
    return _peak_frequency(run, "side_slip_angle")


def rear_side_slip_gain_peak(run: Run) -> Number:
    """Largest side slip angle at the rear axle per steering wheel angle over frequency [rad/rad]."""
    return _peak(run, "rear_side_slip_angle", "1")


def _response(run: Run, channel: str) -> Response | None:
    found = steering_response(run, channel)
    return None if found is None or found.gain.max() < 1e-12 else found


def _peak(run: Run, channel: str, unit: str) -> Number:
    found = _response(run, channel)
    if found is None:
        return missing(unit, "needs a sine sweep of the steering wheel")
    at = int(np.argmax(found.gain))
    slow = quantity_text(float(found.gain[0]), unit)
    return Number(
        float(found.gain[at]), unit, f"at {found.frequency[at]:.2f} Hz; {slow} at {found.frequency[0]:.2f} Hz"
    )


def _peak_frequency(run: Run, channel: str) -> Number:
    found = _response(run, channel)
    if found is None:
        return missing("Hz", "needs a sine sweep of the steering wheel")
    at = int(np.argmax(found.gain))
    if at in (0, len(found.gain) - 1):
        return Number(
            None,
            "Hz",
            f"no peak: largest at the {'lowest' if at == 0 else 'highest'} frequency, {found.frequency[at]:.2f} Hz",
        )
    return Number(float(found.frequency[at]), "Hz")


def _phase(run: Run, channel: str) -> Number:
    found = _response(run, channel)
    if found is None:
        return missing("rad", "needs a sine sweep of the steering wheel")
    if not found.frequency[0] <= REFERENCE <= found.frequency[-1]:
        return Number(None, "rad", f"the sweep does not cover {REFERENCE:g} Hz")
    return Number(float(np.interp(REFERENCE, found.frequency, found.phase)), "rad")


def _delay(run: Run, channel: str) -> Number:
    phase = _phase(run, channel)
    value = None if phase.value is None else -phase.value / (2 * math.pi * REFERENCE)
    return Number(value, "s", phase.note, phase.applies)
