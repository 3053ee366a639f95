"""Cosine bump driven over at constant speed (Bodenwelle)."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np

from manoeuvres.driving import held_speed
from manoeuvres.surface import check_length, sampled
from susp_mj import features
from susp_mj.character import Character
from susp_mj.manoeuvre import Manoeuvre, ValueAndRate
from susp_mj.meaning import Input
from susp_mj.roads import HeightAndSlope, Road, cosine_bump
from susp_mj.units import Length, PositiveLength, PositiveSpeed, PositiveTime, Time


class Bump(Manoeuvre):
    """Cosine bump ``z = h/2 (1 - cos(2 pi s/L))`` at constant speed; the rear axle meets it wheelbase/speed later.

    An oscillation model is given the road under its wheels over time, a car that drives freely the road itself.

    Attributes:
        height: h [m]; negative is a dip.
        length: L [m].
        speed: [m/s].
        start: when the front axle reaches the bump [s].

    Source: thesis, chapter 3 and appendix 1.
    """

    character: ClassVar[Character] = Character("Bump")
    german: ClassVar[str] = "bodenwelle"
    needs: ClassVar[tuple[str, ...]] = ("road_height",)

    kind: Literal["bump"] = "bump"
    duration: PositiveTime = 3.0
    height: Length = 0.08
    length: PositiveLength = 2.0
    speed: PositiveSpeed = 50 / 3.6
    start: Time = 0.2

    def drive(self, place: Input, time: np.ndarray) -> ValueAndRate | None:
        if place.quantity != "road_height":
            return held_speed(place.quantity, self.speed, time)
        height, slope = self.profile(self.speed * time + place.x)
        return height, slope * self.speed

    def profile(self, x: np.ndarray) -> HeightAndSlope:
        """Height [m] and slope at places x [m] along the road."""
        return cosine_bump(x - self.speed * self.start, self.height, self.length)

    def road(self) -> Road:
        check_length(self.length, "length")
        begin = self.speed * self.start
        end = begin + self.length
        shown = (features.Bump((begin, end), self.height),)
        return sampled(lambda x, y: self.profile(x)[0], begin, end, features=shown)


if __name__ == "__main__":
    from design.cli import manoeuvre_script

    manoeuvre_script("bump")
