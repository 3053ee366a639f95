"""Braking on a straight road (Bremsen)."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np

from manoeuvres.driving import PEDALS, Driving, Pedal, fallen, risen
from susp_mj.character import Character
from susp_mj.manoeuvre import ValueAndRate
from susp_mj.meaning import Input
from susp_mj.units import PositiveSpeed, PositiveTime


class Braking(Driving):
    """Brake pedal pressed along half a cosine and held, the steering wheel straight, until the car stands.

    For wheel load distribution, pitch, deceleration and stopping distance. There is no anti-lock system: a pedal
    pressed too far locks wheels.

    Attributes:
        pedal: position of the brake pedal, 0 to 1.
        rise_time: of the pedal [s].
        speed: at which the brakes are applied [m/s].
        start: [s].

    Source: thesis, table 7.1; ISO 21994:2007 for the speed; the pedal is ours.
    """

    character: ClassVar[Character] = Character("Braking", ("braking",), together=PEDALS)
    german: ClassVar[str] = "bremsen"
    needs: ClassVar[tuple[str, ...]] = ("brake_pedal",)

    kind: Literal["braking"] = "braking"
    duration: PositiveTime = 8.0
    speed: PositiveSpeed = 100 / 3.6
    pedal: Pedal = 0.5
    rise_time: PositiveTime = 0.2

    def drive(self, place: Input, time: np.ndarray) -> ValueAndRate | None:
        return braked(place.quantity, time, self.start, self.rise_time, self.pedal) or super().drive(place, time)


def braked(quantity: str, time: np.ndarray, start: float, rise_time: float, pedal: float) -> ValueAndRate | None:
    """Brake pedal pressed at `start` [s] within `rise_time` [s] while the speed controller lets go; None for other
    quantities."""
    if quantity == "brake_pedal":
        return risen(time, start, rise_time, pedal)
    return fallen(time, start, rise_time, 1.0) if quantity == "speed_control" else None


if __name__ == "__main__":
    from design.cli import manoeuvre_script

    manoeuvre_script("braking")
