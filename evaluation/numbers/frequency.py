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

from susp_mj.run import Run

from .number import Number

LOW_EDGE, HIGH_EDGE = 1.3, 1.09
"""Factors in frequency by which the evaluated band stays away from the ends of the sweep."""


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
    """Amplification of a channel over the road height of `station`; None if the run is not a sweep.

    Args:
        points: number of frequencies, evenly spaced on a logarithmic axis.
    """
    if "excitation_phase" not in run:
        return None
    road = run.stations("road_height")
    reference = road[station] if station in road else next(iter(road.values()))
    swept = run["excitation_frequency"]
    low, high = float(swept[0]), float(swept[-1])
    if not high > 2 * low or not np.any(reference):
        return None
    return deconvolved(reference, run[channel] - run[channel][0], run.step, (low, high), points)


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


def body_resonance(run: Run) -> Number:
    """Frequency of the largest amplification of the body's displacement [Hz]."""
    return _peak(run, "body_displacement", "Hz", place=True)


def body_amplification(run: Run) -> Number:
    """Largest amplification of the body's displacement over the road height."""
    return _peak(run, "body_displacement", "1")


def body_acceleration_amplification(run: Run) -> Number:
    """Largest acceleration of the body per metre of road height [1/s²]."""
    return _peak(run, "body_acceleration", "1/s²")


def suspension_amplification(run: Run) -> Number:
    """Largest amplification of the suspension deflection over the road height."""
    return _peak(run, "suspension_deflection", "1")


def wheel_load_amplification(run: Run) -> Number:
    """Largest wheel load amplitude per metre of road height [N/m]."""
    return _peak(run, "wheel_load", "N/m")


def pitch_amplification(run: Run) -> Number:
    """Largest pitch angle per metre of road height [rad/m]."""
    return _peak(run, "pitch_angle", "rad/m")


def roll_amplification(run: Run) -> Number:
    """Largest roll angle per metre of road height [rad/m]."""
    return _peak(run, "roll_angle", "rad/m")


def wheel_resonance(run: Run) -> Number:
    """Frequency of the largest wheel load amplitude per metre of road, for wheels with mass [Hz]."""
    if not run.stations("wheel_displacement"):
        return Number(None, "Hz", "the wheels have no mass", applies=False)
    return _peak(run, "wheel_load", "Hz", place=True)


def _peak(run: Run, quantity: str, unit: str, *, place: bool = False) -> Number:
    """Largest amplification of a quantity over all stations, or the frequency at which it occurs."""
    best: tuple[float, float, str] | None = None
    for station in run.stations(quantity):
        found = amplification(run, f"{station}_{quantity}" if station else quantity, station)
        if found is None:
            return Number(None, unit, "needs a sine sweep", applies=False)
        at = int(np.argmax(np.abs(found.ratio)))
        candidate = (float(np.abs(found.ratio[at])), float(found.frequency[at]), station)
        best = candidate if best is None or candidate[0] > best[0] else best
    if best is None:
        return Number(None, unit, f"the run has no {quantity}", applies=False)
    peak, frequency, station = best
    if peak < 1e-9:
        return Number(None if place else 0.0, unit, "does not respond")
    return Number(
        frequency if place else peak, unit, (station if place else f"{station} at {frequency:.2f} Hz").strip()
    )
