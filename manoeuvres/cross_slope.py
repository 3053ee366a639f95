"""Straight road that leans to one side (Querneigung)."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

import numpy as np

from manoeuvres.driving import Driving
from manoeuvres.surface import LONGEST
from susp_mj import features
from susp_mj.character import Character
from susp_mj.elements.driver import Driver, Path, PreviewDriver
from susp_mj.roads import Road, cosine_ramp
from susp_mj.units import PositiveSpeed, PositiveTime, Quantity

_SPACING = 0.5  # m
_HALF_WIDTH = 50.0  # m


class CrossSlope(Driving):
    """Driving along a road with a cross slope, the steering wheel held or a driver keeping the car straight.

    For the drift down the slope, or the steering that holds against it.

    Attributes:
        slope: rise per metre to the left; positive drifts to the right.
        transition: length over which the level road comes to lean [m].
        steered: whether a driver keeps the car straight; otherwise the steering wheel is held.
        speed: [m/s].
        start: when the front axle reaches the transition [s].

    Source: the values are ours; 2.5 % is the usual drainage slope of a road.
    """

    character: ClassVar[Character] = Character(
        "Cross slope",
        ("disturbance", "course"),
        together=("yaw_rate", "lateral_acceleration", "steering_wheel_angle", "path_deviation"),
    )
    german: ClassVar[str] = "querneigung"
    needs: ClassVar[tuple[str, ...]] = ("speed_target",)

    kind: Literal["cross_slope"] = "cross_slope"
    duration: PositiveTime = 6.0
    speed: PositiveSpeed = 100 / 3.6
    slope: Annotated[float, Quantity("", ge=-0.3, le=0.3)] = 0.025
    transition: Annotated[float, Quantity("m", gt=0, le=LONGEST)] = 20.0
    steered: bool = False

    def road(self) -> Road:
        begin = self.speed * self.start
        x = begin + _SPACING * np.arange(-2, int(np.ceil(self.transition / _SPACING)) + 3)
        lean, _ = cosine_ramp((x - begin) / self.transition, self.slope)
        y = np.array([-_HALF_WIDTH, _HALF_WIDTH])
        return Road(
            x,
            y,
            np.outer(lean, y),
            features=(features.CrossSlope((begin, begin + self.transition), self.slope),),
        )

    def driver(self) -> Driver | None:
        return PreviewDriver(Path()) if self.steered else None


if __name__ == "__main__":
    from design.cli import manoeuvre_script

    manoeuvre_script("cross_slope")
