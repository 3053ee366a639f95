"""What a manoeuvre gives a plant: values and rates of every input, checked."""

from __future__ import annotations

import numpy as np

from .errors import InputError
from .manoeuvre import Manoeuvre, ValueAndRate
from .plant import Plant
from .roads import Road


def sample_inputs(plant: Plant, manoeuvre: Manoeuvre, time: np.ndarray, road: Road | None = None) -> np.ndarray:
    """(samples, inputs, 2) values and rates of every input of the plant; a car that drives meets its `road` itself."""
    samples = np.zeros((len(time), len(plant.meaning.inputs), 2))
    over_ground = plant.meaning.driving and road is not None
    for i, place in enumerate(plant.meaning.inputs):
        if over_ground and place.quantity == "road_height":
            continue
        driven = manoeuvre.drive(place, time)
        if driven is None and plant.meaning.driving:
            driven = _holding(place.quantity, manoeuvre, time)
        if driven is not None:
            samples[:, i, 0], samples[:, i, 1] = driven
    if not np.isfinite(samples).all():
        raise InputError(f"manoeuvre {manoeuvre.kind} gives an input that is not finite", source="manoeuvre")
    if plant.car is not None:
        _check_steering(plant, float(plant.car.head.steering_limit), manoeuvre, samples)
    return samples


def _check_steering(plant: Plant, limit: float, manoeuvre: Manoeuvre, samples: np.ndarray) -> None:
    """Refuse a steering wheel that is turned further than it goes: the car would hold it at its limit and the run be
    another one."""
    for i, place in enumerate(plant.meaning.inputs):
        largest = float(np.abs(samples[:, i, 0]).max())
        if place.quantity == "steering_wheel_angle" and largest > limit * (1 + 1e-9):
            raise InputError(
                f"{manoeuvre.kind} turns the steering wheel by {largest:.4g} rad ({np.degrees(largest):.4g} deg); "
                f"it goes {limit:.4g} rad ({np.degrees(limit):.4g} deg) to either side "
                f"(steering.limit of {plant.meaning.source})",
                source="manoeuvre",
            )


def _holding(quantity: str, manoeuvre: Manoeuvre, time: np.ndarray) -> ValueAndRate | None:
    """A car keeps the speed of its manoeuvre, or stands braked, unless the manoeuvre says otherwise."""
    value = {"speed_target": manoeuvre.driving_speed(), "speed_control": 1.0}.get(quantity)
    return None if value is None else (np.full(len(time), value), np.zeros(len(time)))
