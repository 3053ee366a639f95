"""Amplification over frequency, read from a vertical sine sweep by demodulation.

The sweep keeps its phase phi(t) with the run. A channel times ``exp(-i phi)``, averaged over a whole number of periods,
is its first harmonic at the momentary frequency: for a linear car the transfer function, for a non-linear one the
describing function at the sweep's amplitude.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from susp_mj.run import Run

from .number import Number

PERIODS = 4
"""Length of the averaging window, in periods of the excitation."""


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
    phase, frequency = run["excitation_phase"], run["excitation_frequency"]
    road = run.stations("road_height")
    reference = road[station] if station in road else next(iter(road.values()))
    cycles = phase / (2 * np.pi)
    first, last = 1 + PERIODS / 2, cycles[-1] - PERIODS / 2
    if last <= first:
        return None
    centres = np.interp(np.geomspace(np.interp(first, cycles, frequency), np.interp(last, cycles, frequency), points), frequency, cycles)
    response = _harmonic(run[channel] - run[channel][0], cycles, centres)
    excitation = _harmonic(reference, cycles, centres)
    return Amplification(np.interp(centres, cycles, frequency), response / excitation)


def _harmonic(values: np.ndarray, cycles: np.ndarray, centres: np.ndarray) -> np.ndarray:
    """First harmonic in a Hann window of `PERIODS` cycles around each centre, in phase space."""
    weight = np.gradient(cycles)
    turning = values * np.exp(-2j * np.pi * cycles) * weight
    results = np.empty(len(centres), complex)
    for i, centre in enumerate(centres):
        inside = slice(*np.searchsorted(cycles, [centre - PERIODS / 2, centre + PERIODS / 2]))
        window = 1 + np.cos(2 * np.pi * (cycles[inside] - centre) / PERIODS)
        results[i] = np.sum(turning[inside] * window) / np.sum(weight[inside] * window) * 2
    return results


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


def wheel_resonance(run: Run) -> Number:
    """Frequency of the largest wheel load amplitude per metre of road [Hz]."""
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
        return Number(None, unit, f"the model has no {quantity}")
    peak, frequency, station = best
    return Number(frequency if place else peak, unit, (station if place else f"{station} at {frequency:.2f} Hz").strip())
