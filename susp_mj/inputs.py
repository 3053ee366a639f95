"""What a manoeuvre gives a plant: values and rates of every input, checked."""

from __future__ import annotations

import numpy as np

from .elements import Driver
from .errors import InputError, short, wrong_answer
from .manoeuvre import Manoeuvre, ValueAndRate
from .plant import Plant
from .roads import Road


def road_and_driver(manoeuvre: Manoeuvre) -> tuple[Road | None, Driver | None]:
    """What a manoeuvre gives a car that drives freely.

    Raises:
        InputError: it gives something else.
    """
    road, driver = manoeuvre.road(), manoeuvre.driver()
    for method, given, kind in ((manoeuvre.road, road, Road), (manoeuvre.driver, driver, Driver)):
        if not (given is None or isinstance(given, kind)):
            raise wrong_answer(method, f"a {type(given).__name__}", f"a {kind.__name__} or None")
    return road, driver


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
            try:
                samples[:, i, 0], samples[:, i, 1] = driven
            except (TypeError, ValueError):
                wanted = f"({len(time)},) values and ({len(time)},) rates, or None"
                raise wrong_answer(manoeuvre.drive, f"{short(driven)} for {place.quantity}", wanted) from None
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
