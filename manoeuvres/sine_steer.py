"""One or more sine periods of the steering wheel at constant speed (Lenkeinsinus)."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import Field

from manoeuvres.driving import TRANSIENT, Angle, Driving, SteeringFrequency
from susp_mj.character import Character
from susp_mj.manoeuvre import ValueAndRate
from susp_mj.meaning import Input
from susp_mj.units import PositiveTime


class SineSteer(Driving):
    """One full sine of the steering wheel, to the left first where the amplitude is positive.

    For the amplification of roll, side slip and yaw: a quick change of lanes without a driver who corrects.

    Attributes:
        amplitude: of the steering wheel [rad].
        frequency: [Hz].
        periods: number of full periods.
        speed: [m/s].
        start: [s].

    Source: thesis, table 7.1; ISO 7401:2011, one period of sine. Amplitude, frequency and speed are reconstructed.
    """

    character: ClassVar[Character] = Character("Sine steer", ("steering",), together=TRANSIENT)
    german: ClassVar[str] = "lenkeinsinus"

    kind: Literal["sine_steer"] = "sine_steer"
    duration: PositiveTime = 6.0
    amplitude: Angle = np.radians(60.0)
    frequency: SteeringFrequency = 0.5
    periods: Annotated[int, Field(ge=1)] = 1

    def drive(self, place: Input, time: np.ndarray) -> ValueAndRate | None:
        if place.quantity != "steering_wheel_angle":
            return super().drive(place, time)
        w, since = 2 * np.pi * self.frequency, time - self.start
        inside = (since > 0) & (since < self.periods / self.frequency)
        return np.where(inside, self.amplitude * np.sin(w * since), 0.0), np.where(
            inside, self.amplitude * w * np.cos(w * since), 0.0
        )


if __name__ == "__main__":
    from design.cli import manoeuvre_script

    manoeuvre_script("sine_steer")
