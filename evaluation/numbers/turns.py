"""What the numbers of a car that drives freely share: which way it turns, values over lateral acceleration."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from susp_mj.features import Circle, Course, features_in
from susp_mj.run import Run

from .runs import character, driving, parameter

FIT = (1.0, 4.0)
"""Lateral accelerations [m/s²] between which gradients are fitted: tyres and springs are near linear there."""
LEFT = 0.03
"""Departure from a circle, as a share of its radius, at which the car no longer follows it."""
LOST = 0.1
"""Share of its speed after whose loss a car on a ramp of the steering wheel slides rather than turns."""
TIGHTENED = driving("tightened", "needs a slowly tightened turn")


def deviation(run: Run) -> np.ndarray | None:
    """How far the centre of gravity is to the left of the driver's path [m]; None where no driver follows one."""
    if "path_deviation" in run:
        return run["path_deviation"]
    x, y, radius = run["position_x"], run["position_y"], circle(run)
    if radius is not None:
        return (abs(radius) - np.hypot(x, y - radius)) * np.sign(radius)
    course = next((each for each in features_in(run.meta) if isinstance(each, Course)), None)
    if course is not None:
        return y - np.interp(x, course.x, course.y)
    return y if parameter(run, "steered", False) else None


def circle(run: Run) -> float | None:
    """Radius [m] of the circle that the driver follows, positive to the left; None if there is none."""
    return next((each.radius for each in features_in(run.meta) if isinstance(each, Circle)), None)


def followed(run: Run) -> int:
    """Number of records before the car leaves the turn that it shall drive: a circle by more than `LEFT`, the speed of
    a ramp by `LOST`.

    What comes after, a spin perhaps, is no steady turn any more. All records of any other run.
    """
    if run not in TIGHTENED:
        return len(run.time)
    radius, away = circle(run), deviation(run)
    if radius is None or away is None:
        left = first(run["speed"] < (1 - LOST) * run["speed"][0])
    else:
        left = first(np.abs(away) > LEFT * abs(radius))
    return len(run.time) if left is None else max(left, 2)


def turn(run: Run) -> float:
    """+1 for a turn to the left, -1 to the right: the side of the largest lateral acceleration."""
    acceleration = run["lateral_acceleration"][: followed(run)]
    return 1.0 if acceleration[int(np.argmax(np.abs(acceleration)))] >= 0 else -1.0


def inner(run: Run) -> tuple[str, str]:
    """Stations of the inner front and rear wheel of the turn."""
    return ("fl", "rl") if turn(run) > 0 else ("fr", "rr")


@dataclass(frozen=True)
class Tightening:
    """The part of a slowly tightened turn up to the largest lateral acceleration, with quick events averaged out.

    A shift of gears would otherwise be taken for a state at a higher lateral acceleration.

    Attributes:
        side: +1 for a turn to the left.
        width: of the average, in records.
        acceleration: (n,) averaged lateral acceleration [m/s²], positive, of the first n records.
    """

    side: float
    width: int
    acceleration: np.ndarray

    def part(self, values: np.ndarray) -> np.ndarray:
        """The first n of a channel's values, averaged in the same way."""
        return averaged(values, self.width)[: len(self.acceleration)]

    def at(self, values: np.ndarray, acceleration: float) -> float | None:
        """Value, of n, where the lateral acceleration first reaches a level [m/s²]; None if it never does."""
        reached = np.flatnonzero(self.acceleration >= acceleration)
        if not len(reached):
            return None
        i = int(reached[0])
        if i == 0:
            return float(values[0])
        share = (acceleration - self.acceleration[i - 1]) / (self.acceleration[i] - self.acceleration[i - 1])
        return float(values[i - 1] + share * (values[i] - values[i - 1]))

    def gradient(self, values: np.ndarray) -> float | None:
        """Slope of the straight line through n values over the lateral acceleration between the bounds of `FIT`."""
        inside = (self.acceleration >= FIT[0]) & (self.acceleration <= FIT[1])
        if self.acceleration.max() < FIT[1] or np.sum(inside) < 5:
            return None
        return slope(self.acceleration[inside], values[inside])


def tightening(run: Run) -> Tightening:
    """The tightening turn of a run that is `TIGHTENED`."""
    side, width = turn(run), max(round(character(run).average / run.step), 1)
    acceleration = side * averaged(run["lateral_acceleration"], width)[: followed(run)]
    return Tightening(side, width, acceleration[: int(np.argmax(acceleration)) + 1])


def averaged(values: np.ndarray, width: int) -> np.ndarray:
    """Centred moving average over an odd number of records near `width`; fewer, still centred, towards the ends."""
    half = np.minimum(np.arange(len(values)), width // 2)
    half = np.minimum(half, half[::-1])
    total = np.concatenate([[0.0], np.cumsum(values)])
    at = np.arange(len(values))
    return (total[at + half + 1] - total[at - half]) / (2 * half + 1)


def slope(x: np.ndarray, y: np.ndarray) -> float:
    """Slope of the straight line of least squares."""
    centred = x - x.mean()
    return float(centred @ (y - y.mean()) / (centred @ centred))


def first(where: np.ndarray) -> int | None:
    """Index of the first record at which something holds."""
    found = np.flatnonzero(where)
    return int(found[0]) if len(found) else None


def axle_load(run: Run, axle: str) -> np.ndarray:
    """Sum of an axle's wheel loads [N]."""
    return run[f"{axle[0]}l_wheel_load"] + run[f"{axle[0]}r_wheel_load"]


def load_transfer(run: Run, axle: str) -> np.ndarray:
    """Lateral load transfer of an axle to its outer wheel, half the difference, against the start [N]."""
    difference = run[f"{axle[0]}r_wheel_load"] - run[f"{axle[0]}l_wheel_load"]
    return turn(run) * (difference - difference[0]) / 2


def lasting(where: np.ndarray, step: float) -> float:
    """How long something holds in the run [s]."""
    return float(np.sum(where)) * step


def distance(run: Run) -> np.ndarray:
    """Way travelled since the beginning [m], (n,)."""
    speed = run["speed"]
    return np.concatenate([[0.0], np.cumsum((speed[1:] + speed[:-1]) / 2 * np.diff(run.time))])


def stations_of(axle: str) -> Sequence[str]:
    """Stations of an axle's wheels, left first."""
    return (f"{axle[0]}l", f"{axle[0]}r")
