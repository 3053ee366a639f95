"""Circle of constant radius at slowly rising speed (Kreisfahrt)."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import model_validator

from manoeuvres.driving import Driving
from susp_mj.character import Character
from susp_mj.description import wrong
from susp_mj.elements.driver import Driver, Path, PreviewDriver
from susp_mj.features import Circle
from susp_mj.manoeuvre import ValueAndRate
from susp_mj.meaning import Input
from susp_mj.roads import Road
from susp_mj.units import PositiveSpeed, PositiveTime, Quantity


class SteadyCircle(Driving):
    """A driver keeps the car on a circle while the speed rises so slowly that every instant is a steady state.

    The target speed makes the lateral acceleration ``v²/R`` rise at a constant rate after `start`, so the steering
    wheel angle over it is the self-steering characteristic.

    Attributes:
        radius: R of the circle [m], positive to the left; it begins at x = 0.
        speed: at the beginning [m/s].
        increase: rate of the lateral acceleration [m/s³].
        limit: lateral acceleration at which the target stops rising [m/s²]; above what the car can do it drives to its
            limit.
        understeer: K of the driver, see `susp_mj.elements.driver.PreviewDriver`: with that of the car he stays closest
            to the circle.
        start: [s].

    Source: ISO 4138:2012, constant-radius method with continuous speed increase; the rate is ours.
    """

    character: ClassVar[Character] = Character(
        "Steady circle",
        ("turn", "tightened", "course"),
        average=2.0,
        together=("steering_wheel_angle", "speed", "lateral_acceleration", "path_deviation"),
    )
    german: ClassVar[str] = "kreisfahrt"
    needs: ClassVar[tuple[str, ...]] = ("speed_target",)

    kind: Literal["steady_circle"] = "steady_circle"
    duration: PositiveTime = 70.0
    radius: Annotated[float, Quantity("m")] = 100.0
    speed: PositiveSpeed = 20 / 3.6
    increase: Annotated[float, Quantity("m/s³", gt=0)] = 0.12
    limit: Annotated[float, Quantity("m/s²", gt=0)] = 12.0
    understeer: Annotated[float, Quantity("rad s²/m")] = 0.004
    start: Annotated[float, Quantity("s", ge=0)] = 5.0

    @model_validator(mode="after")
    def _a_circle(self) -> SteadyCircle:
        if abs(self.radius) < 5.0:
            raise wrong(f"{self.radius} m is not allowed; a car needs at least 5 m to either side", "radius")
        if self.speed**2 / abs(self.radius) > self.limit:
            raise wrong(
                f"{self.speed:.4g} m/s is not allowed; on this radius it is above the limit of {self.limit:.4g} m/s²",
                "speed",
            )
        return self

    def drive(self, place: Input, time: np.ndarray) -> ValueAndRate | None:
        if place.quantity != "speed_target":
            return super().drive(place, time)
        radius = abs(self.radius)
        wanted = self.speed**2 / radius + self.increase * np.maximum(time - self.start, 0.0)
        speed = np.sqrt(np.minimum(wanted, self.limit) * radius)
        rising = (time > self.start) & (wanted < self.limit)
        return speed, np.where(rising, self.increase * radius / (2 * speed), 0.0)

    def road(self) -> Road:
        return Road(features=(Circle(self.radius),))

    def driver(self) -> Driver:
        return PreviewDriver(Path(radius=self.radius), understeer=self.understeer)


if __name__ == "__main__":
    from design.cli import manoeuvre_script

    manoeuvre_script("steady_circle")
