"""Double lane change of ISO 3888-1 with a driver (doppelter Fahrspurwechsel)."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

import numpy as np

from manoeuvres.driving import Driving
from susp_mj.character import Character
from susp_mj.elements.driver import Driver, Path, PreviewDriver
from susp_mj.features import Cones, Course, Lane
from susp_mj.roads import Road
from susp_mj.units import NonNegativeLength, PositiveLength, PositiveSpeed, PositiveTime, Quantity

SECTIONS = (15.0, 30.0, 25.0, 25.0, 15.0)
"""Lengths [m]: first lane, change to the left, second lane, change back, third lane."""
OFFSET = 3.5
"""From the right limit of the first lane to that of the second [m]."""
CONE = 0.15
"""Radius of a cone's base [m]; the limits of the lanes touch it from inside."""
_SPACING = 0.25


def cones_of(lane: Lane) -> list[tuple[float, float]]:
    """Centres of the cones on both sides of a lane, at its begin, middle and end [m]."""
    along = (lane.x[0], (lane.x[0] + lane.x[1]) / 2, lane.x[1])
    return [(x, y) for y in (lane.y[0] - CONE, lane.y[1] + CONE) for x in along]


class LaneChange(Driving):
    """A driver takes the car at constant speed through the three lanes of ISO 3888-1, to the left and back.

    Lane widths are ``1.1 b + 0.25 m``, ``1.2 b + 0.25 m`` and ``1.3 b + 0.25 m`` for a car of width b; the first begins
    at ``speed x start``, its middle on y = 0, and the right limits of the first and third lane are in line. The
    driver's path joins the lanes' middles along minimum-jerk curves, which begin and end `cut` inside the lanes.

    Attributes:
        vehicle_width: b [m], without mirrors.
        front_overhang, rear_overhang: of the body beyond its axles [m]; with the width, they tell where its corners
            are.
        cut: how far inside the lanes the path leaves and reaches their middle [m].
        preview_time, lag, understeer: of the driver, see `susp_mj.elements.driver.PreviewDriver`.
        speed: [m/s].
        start: when the front axle enters the first lane [s].

    Source: ISO 3888-1:2018; that the offset is between the right limits is our reading. Path and driver are ours.
    """

    character: ClassVar[Character] = Character(
        "Lane change",
        ("course",),
        together=(
            "steering_wheel_angle",
            "yaw_rate",
            "lateral_acceleration",
            "side_slip_angle",
            "roll_angle",
            "path_deviation",
        ),
    )
    german: ClassVar[str] = "doppelter_fahrspurwechsel"
    needs: ClassVar[tuple[str, ...]] = ("speed_target",)

    kind: Literal["lane_change"] = "lane_change"
    duration: PositiveTime = 8.0
    speed: PositiveSpeed = 80 / 3.6
    vehicle_width: PositiveLength = 1.87
    front_overhang: NonNegativeLength = 0.87
    rear_overhang: NonNegativeLength = 1.13
    cut: NonNegativeLength = 8.0
    preview_time: PositiveTime = 0.6
    lag: PositiveTime = 0.05
    understeer: Annotated[float, Quantity("rad s²/m")] = 0.004

    @property
    def lanes(self) -> tuple[Lane, Lane, Lane]:
        """The three lanes, in the inertial frame."""
        ends = self.speed * self.start + np.concatenate([[0.0], np.cumsum(SECTIONS)])
        first, second, third = (share * self.vehicle_width + 0.25 for share in (1.1, 1.2, 1.3))
        right = -first / 2
        return (
            Lane((float(ends[0]), float(ends[1])), (right, right + first)),
            Lane((float(ends[2]), float(ends[3])), (right + OFFSET, right + OFFSET + second)),
            Lane((float(ends[4]), float(ends[5])), (right, right + third)),
        )

    def path(self, x: np.ndarray) -> np.ndarray:
        """The driver's path y(x) [m]."""
        first, second, third = self.lanes
        there = _minimum_jerk((x - first.x[1] + self.cut) / (second.x[0] - first.x[1] + 2 * self.cut))
        back = _minimum_jerk((x - second.x[1] + self.cut) / (third.x[0] - second.x[1] + 2 * self.cut))
        return first.centre + (second.centre - first.centre) * there + (third.centre - second.centre) * back

    def road(self) -> Road:
        cones = Cones(tuple(cone for lane in self.lanes for cone in cones_of(lane)), CONE, self.lanes)
        x = np.linspace(0.0, self.lanes[2].x[1] + 30.0, 200)
        return Road(features=(cones, Course(tuple(x.tolist()), tuple(self.path(x).tolist()))))

    def driver(self) -> Driver:
        x = np.arange(0.0, self.lanes[2].x[1] + 60.0, _SPACING)
        return PreviewDriver(Path(x, self.path(x)), self.preview_time, self.lag, self.understeer)


def _minimum_jerk(progress: np.ndarray) -> np.ndarray:
    """From 0 to 1 with speed and acceleration zero at both ends: ``10 s³ - 15 s⁴ + 6 s⁵``."""
    s = np.clip(progress, 0.0, 1.0)
    return s**3 * (10 - 15 * s + 6 * s**2)


if __name__ == "__main__":
    from design.cli import manoeuvre_script

    manoeuvre_script("lane_change")
