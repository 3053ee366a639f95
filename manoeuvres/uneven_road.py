"""Road that differs between left and right: a cosine bump of its own on each side (einseitige Bodenwelle)."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np

from susp_mj.manoeuvre import Manoeuvre, ValueAndRate
from susp_mj.meaning import Input
from susp_mj.roads import cosine_bump
from susp_mj.units import Length, PositiveLength, PositiveSpeed, PositiveTime, Time


class UnevenRoad(Manoeuvre):
    """Left and right wheels meet cosine bumps of different height, the rear axle wheelbase/speed after the front.

    A model with one side drives on the left track.

    Attributes:
        left_height, right_height: [m]; negative is a dip. Opposite values twist the car, one zero lifts one side.
        length: of both bumps [m].
        speed: [m/s].
        start: when the front axle reaches them [s].

    Source: thesis, table 7.1, "uneven left-right input"; its shape is reconstructed.
    """

    needs: ClassVar[tuple[str, ...]] = ("road_height",)

    kind: Literal["uneven_road"] = "uneven_road"
    duration: PositiveTime = 3.0
    left_height: Length = 0.03
    right_height: Length = -0.03
    length: PositiveLength = 4.0
    speed: PositiveSpeed = 50 / 3.6
    start: Time = 0.2

    def drive(self, place: Input, time: np.ndarray) -> ValueAndRate | None:
        if place.quantity != "road_height":
            return None
        side = self.right_height if place.y < 0 else self.left_height
        height, slope = cosine_bump(self.speed * (time - self.start) + place.x, side, self.length)
        return height, slope * self.speed


if __name__ == "__main__":
    from design.cli import manoeuvre_script

    manoeuvre_script("uneven_road")
