"""Amplification over frequency, read from a vertical sine sweep by deconvolution.

The spectrum of a channel over that of the road is a transfer function; back in time it is an impulse response. Because
the sweep is exponential, the harmonics that a non-linear car adds end up well before time 0 in it and are cut away, so
what remains is the first harmonic: for a linear car its transfer function, for a non-linear one the describing function
at the sweep's amplitude.

Source: A. Farina, 108th AES Convention (2000), 5093.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from susp_mj.names import channel_name
from susp_mj.run import Run

from .number import Answer, Measure, Runs
from .runs import recorded

LOW_EDGE, HIGH_EDGE = 1.3, 1.09
"""Factors in frequency by which the evaluated band stays away from the ends of the sweep."""
LEAST = 1e-9
"""Amplification below which a quantity does not respond."""


@dataclass(frozen=True)
class Amplification:
    """First harmonic of a channel over that of the road.

    Attributes:
        frequency: (n,) [Hz].
        ratio: (n,) complex, channel's unit per metre of road.
    """

    frequency: np.ndarray
    ratio: np.ndarray


def amplification(run: Run, channel: str, station: str = "", points: int = 200) -> Amplification | None:
    """Amplification of a channel over the road height of `station`; None if that road is not swept.

    Args:
        points: number of frequencies, evenly spaced on a logarithmic axis.
    """
    if not road_swept(run):
        return None
    road = run.stations("road_height")
    reference = road[station] if station in road else next(iter(road.values()))
    swept = run["excitation_frequency"]
    low, high = float(swept[0]), float(swept[-1])
    if not np.any(reference):
        return None
    return deconvolved(reference, run[channel] - run[channel][0], run.step, (low, high), points)


def road_swept(run: Run) -> bool:
    """Whether the road is swept over frequency, under one wheel at least."""
    if "excitation_phase" not in run:
        return False
    swept = run["excitation_frequency"]
    return bool(swept[-1] > 2 * swept[0]) and any(np.any(road) for road in run.stations("road_height").values())


def deconvolved(
    reference: np.ndarray, response: np.ndarray, step: float, swept: tuple[float, float], points: int = 200
) -> Amplification:
    """First harmonic of a response over a reference that is an exponential sine sweep.

    Args:
        reference, response: (n,) samples, zero where nothing happens.
        step: their spacing [s].
        swept: frequencies from and to which the reference is swept [Hz].
        points: number of frequencies, evenly spaced on a logarithmic axis.
    """
    low, high = swept
    count = 2 ** int(np.ceil(np.log2(2 * len(reference))))
    spectrum = np.fft.rfftfreq(count, step)
    excitation = np.fft.rfft(reference, count)
    band = _band(spectrum, low, high)
    inside = band > 0
    ratio = np.zeros(len(spectrum), complex)
    ratio[inside] = band[inside] * np.fft.rfft(response, count)[inside] / excitation[inside]
    window = _window(np.fft.fftfreq(count, 1 / count) * step, (len(reference) - 1) * step, np.log(high / low))
    kept, reference_kept = (np.fft.rfft(np.fft.irfft(each, count) * window) for each in (ratio, band))
    frequency = np.geomspace(LOW_EDGE * low, high / HIGH_EDGE, points)
    found = np.interp(frequency, spectrum[inside], (kept[inside] / reference_kept[inside]))
    return Amplification(frequency, found)


def _band(frequency: np.ndarray, low: float, high: float) -> np.ndarray:
    """1 within the band that is evaluated, falling to 0 at the ends of the sweep along cosines over log frequency."""
    logarithm = np.log(np.maximum(frequency, 1e-12))
    rise = np.clip((logarithm - np.log(low)) / np.log(LOW_EDGE), 0.0, 1.0)
    fall = np.clip((np.log(high) - logarithm) / np.log(HIGH_EDGE), 0.0, 1.0)
    return (1 - np.cos(np.pi * rise)) / 2 * (1 - np.cos(np.pi * fall)) / 2


def _window(time: np.ndarray, duration: float, ratio: float) -> np.ndarray:
    """Around time 0 of the impulse response: up to where its second harmonic begins, and a third of the sweep behind.

    The k-th harmonic of an exponential sweep of length T appears ``T ln k / ln(f1/f0)`` before the origin.
    """
    before, after = 0.8 * duration * np.log(2) / ratio, duration / 3
    rise = np.clip((time + before) / (before / 2), 0.0, 1.0)
    fall = np.clip((after - time) / (after / 2), 0.0, 1.0)
    return (1 - np.cos(np.pi * rise)) / 2 * (1 - np.cos(np.pi * fall)) / 2


def body_resonance(run: Run) -> Answer:
    """Frequency of the largest amplification of the body's displacement [Hz]."""
    return _peak(run, "body_displacement", place=True)


def body_amplification(run: Run) -> Answer:
    """Largest amplification of the body's displacement over the road height."""
    return _peak(run, "body_displacement")


def body_acceleration_amplification(run: Run) -> Answer:
    """Largest acceleration of the body per metre of road height [1/s²]."""
    return _peak(run, "body_acceleration")


def suspension_amplification(run: Run) -> Answer:
    """Largest amplification of the suspension deflection over the road height."""
    return _peak(run, "suspension_deflection")


def wheel_load_amplification(run: Run) -> Answer:
    """Largest wheel load amplitude per metre of road height [N/m]."""
    return _peak(run, "wheel_load")


def pitch_amplification(run: Run) -> Answer:
    """Largest pitch angle per metre of road height [rad/m]."""
    return _peak(run, "pitch_angle")


def roll_amplification(run: Run) -> Answer:
    """Largest roll angle per metre of road height [rad/m]."""
    return _peak(run, "roll_angle")


def wheel_resonance(run: Run) -> Answer:
    """Frequency of the largest wheel load amplitude per metre of road, for wheels with mass [Hz]."""
    return _peak(run, "wheel_load", place=True)


def _peak(run: Run, quantity: str, *, place: bool = False) -> Answer:
    """Largest amplification of a quantity over all stations, or the frequency at which it occurs."""
    best = (0.0, 0.0, "")
    for station in run.stations(quantity):
        found = amplification(run, channel_name(station, quantity), station)
        if found is not None:
            at = int(np.argmax(np.abs(found.ratio)))
            peak = float(np.abs(found.ratio[at]))
            best = (peak, float(found.frequency[at]), station) if peak > best[0] else best
    peak, frequency, station = best
    if peak < LEAST:
        return Answer(None if place else 0.0, "does not respond")
    return Answer(frequency, station) if place else Answer(peak, f"{station} at {frequency:.2f} Hz".strip())


ROAD_SWEPT = Runs(road_swept, "needs a sine sweep")
WHEELS_WITH_MASS = Runs(lambda run: bool(run.stations("wheel_displacement")), "the wheels have no mass")
NUMBERS = (
    Measure(body_resonance, "Hz", ROAD_SWEPT & recorded("body_displacement")),
    Measure(body_amplification, "1", ROAD_SWEPT & recorded("body_displacement")),
    Measure(body_acceleration_amplification, "1/s²", ROAD_SWEPT & recorded("body_acceleration")),
    Measure(suspension_amplification, "1", ROAD_SWEPT & recorded("suspension_deflection")),
    Measure(wheel_resonance, "Hz", ROAD_SWEPT & WHEELS_WITH_MASS),
    Measure(wheel_load_amplification, "N/m", ROAD_SWEPT & recorded("wheel_load")),
    Measure(pitch_amplification, "rad/m", ROAD_SWEPT & recorded("pitch_angle")),
    Measure(roll_amplification, "rad/m", ROAD_SWEPT & recorded("roll_angle")),
)
