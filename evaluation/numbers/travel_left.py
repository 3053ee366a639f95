"""Numbers of the travel that the wheels of a freely driving car keep to their stops, by axle."""

from __future__ import annotations

import numpy as np

from susp_mj.run import Run

from .number import Answer, Measure
from .runs import DRIVES
from .turns import stations_of


def travel_left_compression_front(run: Run) -> Answer:
    """Smallest distance that a front wheel of a freely driving car keeps to its compression stop [m]."""
    return _travel_left(run, "front", 1)


def travel_left_compression_rear(run: Run) -> Answer:
    """Smallest distance that a rear wheel of a freely driving car keeps to its compression stop [m]."""
    return _travel_left(run, "rear", 1)


def travel_left_rebound_front(run: Run) -> Answer:
    """Smallest distance that a front wheel of a freely driving car keeps to its rebound stop [m]."""
    return _travel_left(run, "front", 0)


def travel_left_rebound_rear(run: Run) -> Answer:
    """Smallest distance that a rear wheel of a freely driving car keeps to its rebound stop [m]."""
    return _travel_left(run, "rear", 0)


def _travel_left(run: Run, axle: str, stop: int) -> Answer:
    """Smallest distance of an axle's wheels to a stop, the worse wheel's, noting it and the instant."""
    sign = 1.0 if stop else -1.0
    left = {
        station: sign * (run.meta["travel"][station][stop] - run[f"{station}_suspension_deflection"])
        for station in stations_of(axle)
    }
    worst = min(left, key=lambda station: left[station].min())
    at = int(np.argmin(left[worst]))
    return Answer(float(left[worst][at]), f"{worst} at {run.time[at]:.2f} s")


NUMBERS = (
    Measure(travel_left_compression_front, "m", DRIVES),
    Measure(travel_left_compression_rear, "m", DRIVES),
    Measure(travel_left_rebound_front, "m", DRIVES),
    Measure(travel_left_rebound_rear, "m", DRIVES),
)
