"""Braking in a turn with the steering wheel held (Bremsen in der Kurve)."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np
from pydantic import model_validator

from manoeuvres.braking import braked
from manoeuvres.driving import Angle, Driving, Pedal, risen
from susp_mj.character import Character
from susp_mj.description import wrong
from susp_mj.manoeuvre import ValueAndRate
from susp_mj.meaning import Input
from susp_mj.units import PositiveSpeed, PositiveTime


class BrakingInTurn(Driving):
    """Steering wheel turned and held until the turn is steady, then the brakes are applied with the wheel still held.

    Attributes:
        angle: of the steering wheel [rad], positive to the left.
        steer_time: how long the wheel takes to get there [s].
        start: when the driver begins to steer [s].
        brake_start: when the brakes are applied [s], after the turn has become steady.
        pedal: position of the brake pedal, 0 to 1.
        rise_time: of the pedal [s].
        speed: before braking [m/s].

    Source: ISO 7975:2006: a radius of 100 m at about 5 m/s²; here the angle is given instead of the radius.
    """

    character: ClassVar[Character] = Character(
        "Braking in turn",
        ("braking", "turn", "course"),
        together=(
            "speed",
            "longitudinal_acceleration",
            "yaw_rate",
            "lateral_acceleration",
            "rear_side_slip_angle",
            "roll_angle",
        ),
    )
    german: ClassVar[str] = "bremsen_in_der_kurve"
    begins: ClassVar[str] = "brake_start"
    needs: ClassVar[tuple[str, ...]] = ("steering_wheel_angle", "brake_pedal")

    kind: Literal["braking_in_turn"] = "braking_in_turn"
    duration: PositiveTime = 12.0
    speed: PositiveSpeed = 80 / 3.6
    angle: Angle = np.radians(50.0)
    steer_time: PositiveTime = 1.0
    brake_start: PositiveTime = 5.0
    pedal: Pedal = 0.25
    rise_time: PositiveTime = 0.2

    @model_validator(mode="after")
    def _in_order(self) -> BrakingInTurn:
        if self.brake_start < self.start + self.steer_time:
            turned = self.start + self.steer_time
            raise wrong(
                f"{self.brake_start:g} s is not allowed; the wheel is turned only after {turned:g} s", "brake_start"
            )
        if self.brake_start >= self.duration:
            raise wrong(f"{self.brake_start:g} s is not allowed; the run ends after {self.duration:g} s", "brake_start")
        return self

    def drive(self, place: Input, time: np.ndarray) -> ValueAndRate | None:
        if place.quantity == "steering_wheel_angle":
            return risen(time, self.start, self.steer_time, self.angle)
        return braked(place.quantity, time, self.brake_start, self.rise_time, self.pedal) or super().drive(place, time)


if __name__ == "__main__":
    from design.cli import manoeuvre_script

    manoeuvre_script("braking_in_turn")
