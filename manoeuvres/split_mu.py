"""Braking with one side of the car on slippery ground (µ-split)."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

import numpy as np

from manoeuvres.braking import braked
from manoeuvres.driving import Driving, Pedal
from susp_mj.character import Character
from susp_mj.elements.driver import Driver, Path, PreviewDriver
from susp_mj.features import Patch
from susp_mj.manoeuvre import ValueAndRate
from susp_mj.meaning import Input
from susp_mj.roads import Road
from susp_mj.units import PositiveLength, PositiveSpeed, PositiveTime, Quantity

_HALF_WIDTH = 20.0  # m


class SplitMu(Driving):
    """Braking while the ground under the wheels of one side is slippery from where the brakes are applied.

    Attributes:
        friction: of the slippery side as a share of the dry road's.
        side: ``right`` or ``left``, the slippery side.
        length: of the slippery ground [m].
        steered: whether a driver keeps the car straight; otherwise the steering wheel is held.
        pedal: position of the brake pedal, 0 to 1.
        rise_time: of the pedal [s].
        speed: at which the brakes are applied [m/s].
        start: [s].

    Source: ISO 14512:1999; the values are ours.
    """

    character: ClassVar[Character] = Character(
        "Split friction",
        ("braking", "course"),
        together=(
            "speed",
            "longitudinal_acceleration",
            "yaw_rate",
            "yaw_angle",
            "steering_wheel_angle",
            "path_deviation",
        ),
    )
    german: ClassVar[str] = "mu_split"
    needs: ClassVar[tuple[str, ...]] = ("brake_pedal",)

    kind: Literal["split_mu"] = "split_mu"
    duration: PositiveTime = 8.0
    speed: PositiveSpeed = 80 / 3.6
    friction: Annotated[float, Quantity("", gt=0, le=2)] = 0.3
    side: Literal["right", "left"] = "right"
    length: PositiveLength = 500.0
    steered: bool = False
    pedal: Pedal = 0.25
    rise_time: PositiveTime = 0.2

    def drive(self, place: Input, time: np.ndarray) -> ValueAndRate | None:
        return braked(place.quantity, time, self.start, self.rise_time, self.pedal) or super().drive(place, time)

    def road(self) -> Road:
        begin = self.speed * self.start
        low, high = (-_HALF_WIDTH, 0.0) if self.side == "right" else (0.0, _HALF_WIDTH)
        return Road(patches=(Patch((begin, begin + self.length), (low, high), self.friction),))

    def driver(self) -> Driver | None:
        return PreviewDriver(Path()) if self.steered else None


if __name__ == "__main__":
    from design.cli import manoeuvre_script

    manoeuvre_script("split_mu")
