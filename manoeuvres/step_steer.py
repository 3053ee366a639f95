"""Step of the steering wheel angle at constant speed (Lenkwinkelsprung)."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

import numpy as np

from manoeuvres.driving import TRANSIENT, Angle, Driving, fallen, risen
from susp_mj.character import Character
from susp_mj.manoeuvre import ValueAndRate
from susp_mj.meaning import Input
from susp_mj.units import PositiveTime, Quantity


class StepSteer(Driving):
    """Steering wheel turned quickly to `angle` along half a cosine, which puts the car on a circle.

    For the build-up of yaw velocity, lateral acceleration and roll, and for response times and overshoot.

    Attributes:
        angle: of the steering wheel [rad], positive to the left.
        rate: mean rate of the steering wheel [rad/s].
        hold: how long the angle is held before the wheel is turned back at the same rate [s]; None holds it to the end.
        speed: [m/s].
        start: [s].

    Source: thesis appendix 9, model-manoeuvre 4: 85°; ISO 7401:2011, step input (200 to 500 °/s). The speed is
    reconstructed: that of the other manoeuvres.
    """

    character: ClassVar[Character] = Character("Step steer", ("steering", "steering_step"), together=TRANSIENT)
    german: ClassVar[str] = "lenkwinkelsprung"

    kind: Literal["step_steer"] = "step_steer"
    duration: PositiveTime = 6.0
    angle: Angle = np.radians(85.0)
    rate: Annotated[float, Quantity("rad/s", gt=0)] = np.radians(500.0)
    hold: PositiveTime | None = None

    @property
    def rise_time(self) -> float:
        """How long the turn takes [s]."""
        return max(abs(self.angle) / self.rate, 1e-3)

    def drive(self, place: Input, time: np.ndarray) -> ValueAndRate | None:
        if place.quantity != "steering_wheel_angle":
            return super().drive(place, time)
        angle, rate = risen(time, self.start, self.rise_time, self.angle)
        if self.hold is None:
            return angle, rate
        back, back_rate = fallen(time, self.start + self.rise_time + self.hold, self.rise_time, self.angle)
        return angle + back - self.angle, rate + back_rate


if __name__ == "__main__":
    from design.cli import manoeuvre_script

    manoeuvre_script("step_steer")
