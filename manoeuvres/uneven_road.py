"""Road that differs between left and right: a cosine bump of its own on each side (einseitige Bodenwelle)."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np

from manoeuvres.driving import held_speed
from manoeuvres.surface import check_length, sampled
from susp_mj.character import Character
from susp_mj.features import Bump
from susp_mj.manoeuvre import Manoeuvre, ValueAndRate
from susp_mj.meaning import Input
from susp_mj.roads import HeightAndSlope, Road, cosine_bump
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

    character: ClassVar[Character] = Character("Uneven road")
    german: ClassVar[str] = "einseitige_bodenwelle"
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
            return held_speed(place.quantity, self.speed, time)
        height, slope = self.profile(self.speed * time + place.x, place.y)
        return height, slope * self.speed

    def profile(self, x: np.ndarray, y: float) -> HeightAndSlope:
        """Height [m] and slope at places x [m] along the road, left (y >= 0) or right."""
        return cosine_bump(x - self.speed * self.start, self.right_height if y < 0 else self.left_height, self.length)

    def road(self) -> Road:
        check_length(self.length, "length")
        begin = self.speed * self.start
        end = begin + self.length
        bumps = (Bump((begin, end), self.left_height, (0.0, 2.0)), Bump((begin, end), self.right_height, (-2.0, 0.0)))
        return sampled(lambda x, y: self.profile(x, y)[0], begin, end, (-0.1, 0.1), bumps)


if __name__ == "__main__":
    from design.cli import manoeuvre_script

    manoeuvre_script("uneven_road")
