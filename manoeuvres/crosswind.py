"""Gust of wind from the side on a straight road (Seitenwind)."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import model_validator

from manoeuvres.driving import Driving, fallen, risen
from susp_mj.character import Character
from susp_mj.description import wrong
from susp_mj.elements.driver import Driver, Path, PreviewDriver
from susp_mj.features import Gust
from susp_mj.manoeuvre import ValueAndRate
from susp_mj.meaning import Input
from susp_mj.roads import Road
from susp_mj.units import PositiveLength, PositiveSpeed, PositiveTime, Quantity


class Crosswind(Driving):
    """A zone of wind across the road, with cosine flanks, through which the car drives with the steering wheel held.

    The whole car feels the wind of the place where its front axle is: the flanks are longer than what a zone does to a
    car as it dives into it.

    Attributes:
        wind: speed of the wind [m/s], positive to the left: it blows from the right.
        length: of the zone, half of each flank included [m].
        flank: length of each flank [m].
        steered: whether a driver keeps the car straight; otherwise the steering wheel is held.
        speed: of the car [m/s].
        start: when the car enters the zone [s].

    Source: ISO 12021:2010: 20 m/s at 100 km/h over at least 25 m; the flanks are ours.
    """

    character: ClassVar[Character] = Character(
        "Crosswind",
        ("disturbance", "course"),
        together=("wind_y", "yaw_rate", "lateral_acceleration", "roll_angle", "steering_wheel_angle", "path_deviation"),
    )
    german: ClassVar[str] = "seitenwind"
    needs: ClassVar[tuple[str, ...]] = ("wind_y",)

    kind: Literal["crosswind"] = "crosswind"
    duration: PositiveTime = 5.0
    speed: PositiveSpeed = 100 / 3.6
    wind: Annotated[float, Quantity("m/s", ge=-60, le=60)] = 20.0
    length: PositiveLength = 30.0
    flank: PositiveLength = 4.0
    steered: bool = False

    @model_validator(mode="after")
    def _fits(self) -> Crosswind:
        if self.flank > self.length:
            raise wrong(f"{self.flank:g} m is not allowed; it must not exceed the length, {self.length:g} m", "flank")
        return self

    def drive(self, place: Input, time: np.ndarray) -> ValueAndRate | None:
        if place.quantity != "wind_y":
            return super().drive(place, time)
        rise, leave = self.flank / self.speed, self.start + self.length / self.speed
        up, up_rate = risen(time, self.start, rise, self.wind)
        down, down_rate = fallen(time, leave, rise, self.wind)
        return up + down - self.wind, up_rate + down_rate

    def road(self) -> Road:
        begin = self.speed * self.start
        return Road(features=(Gust((begin, begin + self.length + self.flank), self.wind),))

    def driver(self) -> Driver | None:
        return PreviewDriver(Path()) if self.steered else None


if __name__ == "__main__":
    from design.cli import manoeuvre_script

    manoeuvre_script("crosswind")
