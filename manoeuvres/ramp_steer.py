"""Steering wheel turned at a constant rate at constant speed (Zuziehen)."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

import numpy as np

from manoeuvres.driving import Driving, PositiveAngle
from susp_mj.character import Character
from susp_mj.manoeuvre import ValueAndRate
from susp_mj.meaning import Input
from susp_mj.units import PositiveTime, Quantity


class RampSteer(Driving):
    """Steering wheel turned at a constant rate up to `limit` and held there, the speed held: ever tighter, up to the
    tyres' limit.

    For the largest lateral acceleration, self-steering, roll, the wheel travel that is left, and wheels that lift.

    Attributes:
        rate: of the steering wheel [rad/s], positive to the left.
        limit: largest angle of the steering wheel, to either side [rad].
        speed: [m/s].
        start: [s].

    Source: thesis appendix 9, model-manoeuvre 3: 72 km/h, 25 °/s; limit and start are reconstructed.
    """

    character: ClassVar[Character] = Character(
        "Ramp steer",
        ("steering", "tightened"),
        average=0.1,
        together=(
            "steering_wheel_angle",
            "speed",
            "yaw_rate",
            "lateral_acceleration",
            "roll_angle",
            "rear_side_slip_angle",
        ),
    )
    german: ClassVar[str] = "zuziehen"

    kind: Literal["ramp_steer"] = "ramp_steer"
    duration: PositiveTime = 10.0
    rate: Annotated[float, Quantity("rad/s")] = np.radians(25.0)
    limit: PositiveAngle = np.radians(360.0)

    def drive(self, place: Input, time: np.ndarray) -> ValueAndRate | None:
        if place.quantity != "steering_wheel_angle":
            return super().drive(place, time)
        angle = self.rate * np.maximum(time - self.start, 0.0)
        turning = (time > self.start) & (np.abs(angle) < self.limit)
        return np.clip(angle, -self.limit, self.limit), np.where(turning, self.rate, 0.0)


if __name__ == "__main__":
    from design.cli import manoeuvre_script

    manoeuvre_script("ramp_steer")
