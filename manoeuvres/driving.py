"""Base of manoeuvres of a car that drives freely, and the courses of steering wheel and pedals that they share."""

from __future__ import annotations

from typing import Annotated, ClassVar

import numpy as np

from susp_mj.manoeuvre import Manoeuvre, ValueAndRate
from susp_mj.meaning import Input
from susp_mj.roads import cosine_ramp
from susp_mj.units import PositiveSpeed, Quantity, Time

Angle = Annotated[float, Quantity("rad")]
PositiveAngle = Annotated[float, Quantity("rad", gt=0)]
SteeringFrequency = Annotated[float, Quantity("Hz", gt=0, le=50)]
"""Up to what steps of 1 ms follow, twenty a period; nobody steers as fast."""
Pedal = Annotated[float, Quantity("", ge=0, le=1)]
TRANSIENT = (
    "steering_wheel_angle",
    "yaw_rate",
    "lateral_acceleration",
    "roll_angle",
    "pitch_angle",
    "body_displacement",
)
"""What is drawn together of a quick movement of the steering wheel."""
PEDALS = ("speed", "longitudinal_acceleration", "pitch_angle", "body_displacement")
"""The same of a pedal pressed on a straight road."""


class Driving(Manoeuvre):
    """A car that drives freely at a speed that its controller holds; a subclass adds what the driver does.

    Attributes:
        speed: held by the speed controller [m/s].
        start: when the driver begins [s].
        grip: friction of the whole road, as a factor on what the tyre was measured with: 1 a dry test surface, about
            0.7 wet.
    """

    default_model: ClassVar[str] = "handling"
    test_load: ClassVar[str] = "empty"
    needs: ClassVar[tuple[str, ...]] = ("steering_wheel_angle",)

    speed: PositiveSpeed = 72 / 3.6
    start: Time = 0.5
    grip: Annotated[float, Quantity("", gt=0, le=3)] = 1.0

    def drive(self, place: Input, time: np.ndarray) -> ValueAndRate | None:
        return held_speed(place.quantity, self.speed, time)


def constant(value: float, time: np.ndarray) -> ValueAndRate:
    """A value that never changes."""
    return np.full(time.shape, float(value)), np.zeros(time.shape)


def held_speed(quantity: str, speed: float, time: np.ndarray) -> ValueAndRate | None:
    """Target and switch of the speed controller that holds a speed [m/s]; None for any other quantity."""
    if quantity == "speed_target":
        return constant(speed, time)
    return constant(1.0, time) if quantity == "speed_control" else None


def risen(time: np.ndarray, start: float, duration: float, level: float) -> ValueAndRate:
    """Half a cosine from 0 to `level` within `duration` [s] after `start` [s], then constant."""
    value, slope = cosine_ramp((time - start) / duration, level)
    return value, slope / duration


def fallen(time: np.ndarray, start: float, duration: float, level: float) -> ValueAndRate:
    """Half a cosine from `level` to 0 within `duration` [s] after `start` [s]."""
    value, rate = risen(time, start, duration, level)
    return level - value, -rate
