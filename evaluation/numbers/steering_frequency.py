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

from susp_mj.names import QUANTITIES
from susp_mj.run import Run

from ..display import quantity_text
from .frequency import deconvolved
from .number import Answer, Measure, Runs, no_question
from .runs import drives

SEGMENT = 2.0
"""Length of a segment of Welch's method, in periods of the lowest frequency."""
REFERENCE = 1.0
"""Frequency [Hz] at which phase and delay are given."""
LEAST = 1e-12
"""Gain below which a channel does not respond."""


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
    return _read(run, channel, points) if _steering_swept(run) and channel in run else None


def _steering_swept(run: Run) -> bool:
    """Whether the steering wheel of a freely driving car is swept over frequency."""
    if not drives(run) or "excitation_frequency" not in run:
        return False
    swept = run["excitation_frequency"]
    return bool(np.ptp(run["steering_wheel_angle"]) > 0.0 and swept[-1] > 1.5 * swept[0])


def _read(run: Run, channel: str, points: int = 200) -> Response:
    steering, values = (run[name] - run[name][0] for name in ("steering_wheel_angle", channel))
    swept = run["excitation_frequency"]
    low, high = float(swept[0]), float(swept[-1])
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


def yaw_rate_gain_peak(run: Run) -> Answer:
    """Largest yaw rate per steering wheel angle over frequency [1/s]."""
    return _peak(run, "yaw_rate")


def yaw_rate_peak_frequency(run: Run) -> Answer:
    """Frequency of the largest yaw rate per steering wheel angle [Hz]."""
    return _peak_frequency(run, "yaw_rate")


def yaw_rate_phase(run: Run) -> Answer:
    """Phase of the yaw rate against the steering wheel at 1 Hz [rad], negative: it lags."""
    return _phase(run, "yaw_rate")


def yaw_rate_delay(run: Run) -> Answer:
    """Equivalent time delay of the yaw rate [s]: ``-phase/(2 pi f)`` at 1 Hz."""
    return _delay(run, "yaw_rate")


def lateral_acceleration_gain_peak(run: Run) -> Answer:
    """Largest lateral acceleration per steering wheel angle over frequency [m/s²/rad]."""
    return _peak(run, "lateral_acceleration")


def lateral_acceleration_phase(run: Run) -> Answer:
    """Phase of the lateral acceleration against the steering wheel at 1 Hz [rad], negative: it lags."""
    return _phase(run, "lateral_acceleration")


def lateral_acceleration_delay(run: Run) -> Answer:
    """Equivalent time delay of the lateral acceleration [s]: ``-phase/(2 pi f)`` at 1 Hz."""
    return _delay(run, "lateral_acceleration")


def roll_angle_gain_peak(run: Run) -> Answer:
    """Largest roll angle per steering wheel angle over frequency [rad/rad]."""
    return _peak(run, "roll_angle")


def roll_angle_peak_frequency(run: Run) -> Answer:
    """Frequency of the largest roll angle per steering wheel angle [Hz]."""
    return _peak_frequency(run, "roll_angle")


def side_slip_gain_peak(run: Run) -> Answer:
    """Largest side slip angle of the centre of gravity per steering wheel angle over frequency [rad/rad]."""
    return _peak(run, "side_slip_angle")


def side_slip_peak_frequency(run: Run) -> Answer:
    """Frequency of the largest side slip angle of the centre of gravity per steering wheel angle [Hz]."""
    return _peak_frequency(run, "side_slip_angle")


def rear_side_slip_gain_peak(run: Run) -> Answer:
    """Largest side slip angle at the rear axle per steering wheel angle over frequency [rad/rad]."""
    return _peak(run, "rear_side_slip_angle")


_GAIN_UNITS = {"rad/s": "1/s", "m/s²": "m/s²/rad", "rad": "1"}


def gain_unit(quantity: str) -> str:
    """SI unit of a quantity per steering wheel angle."""
    return _GAIN_UNITS[QUANTITIES[quantity][0]]


def _peak(run: Run, channel: str) -> Answer:
    found = _read(run, channel)
    at = int(np.argmax(found.gain))
    if found.gain[at] < LEAST:
        return no_question("does not respond")
    slow = quantity_text(float(found.gain[0]), gain_unit(channel))
    return Answer(float(found.gain[at]), f"at {found.frequency[at]:.2f} Hz; {slow} at {found.frequency[0]:.2f} Hz")


def _peak_frequency(run: Run, channel: str) -> Answer:
    found = _read(run, channel)
    at = int(np.argmax(found.gain))
    if found.gain[at] < LEAST:
        return no_question("does not respond")
    if at in (0, len(found.gain) - 1):
        end = "lowest" if at == 0 else "highest"
        return Answer(None, f"no peak: largest at the {end} frequency, {found.frequency[at]:.2f} Hz")
    return Answer(float(found.frequency[at]))


def _phase(run: Run, channel: str) -> Answer:
    found = _read(run, channel)
    if found.gain.max() < LEAST:
        return no_question("does not respond")
    if not found.frequency[0] <= REFERENCE <= found.frequency[-1]:
        return Answer(None, f"the sweep does not cover {REFERENCE:g} Hz")
    return Answer(float(np.interp(REFERENCE, found.frequency, found.phase)))


def _delay(run: Run, channel: str) -> Answer:
    phase = _phase(run, channel)
    return phase if phase.value is None else Answer(-phase.value / (2 * math.pi * REFERENCE), phase.note)


SWEPT = Runs(_steering_swept, "needs a sine sweep of the steering wheel")
NUMBERS = (
    Measure(yaw_rate_gain_peak, gain_unit("yaw_rate"), SWEPT),
    Measure(yaw_rate_peak_frequency, "Hz", SWEPT),
    Measure(yaw_rate_phase, "rad", SWEPT),
    Measure(yaw_rate_delay, "s", SWEPT),
    Measure(lateral_acceleration_gain_peak, gain_unit("lateral_acceleration"), SWEPT),
    Measure(lateral_acceleration_phase, "rad", SWEPT),
    Measure(lateral_acceleration_delay, "s", SWEPT),
    Measure(roll_angle_gain_peak, gain_unit("roll_angle"), SWEPT),
    Measure(roll_angle_peak_frequency, "Hz", SWEPT),
    Measure(side_slip_gain_peak, gain_unit("side_slip_angle"), SWEPT),
    Measure(side_slip_peak_frequency, "Hz", SWEPT),
    Measure(rear_side_slip_gain_peak, gain_unit("rear_side_slip_angle"), SWEPT),
)
