"""Acceleration at full throttle on a straight road (Beschleunigung)."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

import numpy as np

from manoeuvres.driving import PEDALS, Driving, Pedal, fallen, risen
from susp_mj.character import Character
from susp_mj.manoeuvre import ValueAndRate
from susp_mj.meaning import Input
from susp_mj.units import PositiveTime, Quantity


class Acceleration(Driving):
    """Accelerator pressed and held on a straight road; the speed controller lets go as it is pressed.

    For wheel load distribution, pitch, and the time to a speed.

    Attributes:
        pedal: position of the accelerator, 0 to 1.
        rise_time: of the pedal [s].
        speed: at the beginning [m/s]; 0 is a standing start.
        start: [s].

    Source: thesis, table 7.1; the values are ours.
    """

    character: ClassVar[Character] = Character(
        "Acceleration", ("acceleration",), together=(*PEDALS, "engine_speed", "gear")
    )
    german: ClassVar[str] = "beschleunigung"
    needs: ClassVar[tuple[str, ...]] = ("accelerator",)

    kind: Literal["acceleration"] = "acceleration"
    duration: PositiveTime = 12.0
    speed: Annotated[float, Quantity("m/s", ge=0)] = 0.0
    pedal: Pedal = 1.0
    rise_time: PositiveTime = 0.2

    def drive(self, place: Input, time: np.ndarray) -> ValueAndRate | None:
        if place.quantity == "accelerator":
            return risen(time, self.start, self.rise_time, self.pedal)
        if place.quantity == "speed_control":
            return fallen(time, self.start, self.rise_time, 1.0)
        return super().drive(place, time)


if __name__ == "__main__":
    from design.cli import manoeuvre_script

    manoeuvre_script("acceleration")
