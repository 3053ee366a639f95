"""Numbers of compliance on the rig, per axle: slopes over forces and moments on the wheels, within half the amplitude.

Signs as in `kinematics`; left and right are averaged as mirror images.

Source: definitions as in ISO 8855:2011; W. Matschinsky, Radführungen der Straßenfahrzeuge.
"""

from __future__ import annotations

import numpy as np

from susp_mj.run import Run

from .kinematics import SHARE, average_of, slope_within, tested
from .number import Answer, Measure
from .runs import parameter
from .turns import stations_of

INWARDS = (-1.0, 1.0)
"""Signs of a steer angle on the left and on the right that is toe-in."""


def lateral_force_steer_front(run: Run) -> Answer:
    """Steer angle of a front wheel per lateral force on it [rad/N], positive: it turns towards where it is pushed."""
    return _over_force(run, "front", "lateral_force", "steer_angle")


def lateral_force_steer_rear(run: Run) -> Answer:
    """Steer angle of a rear wheel per lateral force on it [rad/N], positive: it turns towards where it is pushed."""
    return _over_force(run, "rear", "lateral_force", "steer_angle")


def lateral_force_camber_front(run: Run) -> Answer:
    """Camber of a front wheel per lateral force on it [rad/N], positive: it leans out of where it is pushed."""
    return _over_force(run, "front", "lateral_force", "camber_angle")


def lateral_force_camber_rear(run: Run) -> Answer:
    """Camber of a rear wheel per lateral force on it [rad/N], positive: it leans out of where it is pushed."""
    return _over_force(run, "rear", "lateral_force", "camber_angle")


def longitudinal_force_steer_front(run: Run) -> Answer:
    """Toe-in of a front wheel per forward force on it [rad/N]."""
    return _over_force(run, "front", "longitudinal_force", "steer_angle", INWARDS)


def longitudinal_force_steer_rear(run: Run) -> Answer:
    """Toe-in of a rear wheel per forward force on it [rad/N]."""
    return _over_force(run, "rear", "longitudinal_force", "steer_angle", INWARDS)


def aligning_moment_steer_front(run: Run) -> Answer:
    """Steer angle of a front wheel per moment about the vertical on it [rad/(N m)]."""
    return _over_force(run, "front", "aligning_moment", "steer_angle")


def aligning_moment_steer_rear(run: Run) -> Answer:
    """Steer angle of a rear wheel per moment about the vertical on it [rad/(N m)]."""
    return _over_force(run, "rear", "aligning_moment", "steer_angle")


def _over_force(run: Run, axle: str, force: str, quantity: str, signs: tuple[float, float] = (1.0, 1.0)) -> Answer:
    """Mean slope over a force on an axle's wheels; the quantity counts with a sign on the left and on the right."""
    slopes = []
    for station, sign in zip(stations_of(axle), signs, strict=True):
        pushed = run[f"{station}_{force}"]
        slopes.append(slope_within(pushed, sign * run[f"{station}_{quantity}"], SHARE * float(np.abs(pushed).max())))
    return average_of(slopes, "opposed" if parameter(run, "opposed", False) else "")


LATERAL, LONGITUDINAL, ALIGNING = tested("lateral_force"), tested("longitudinal_force"), tested("aligning_moment")
NUMBERS = (
    Measure(lateral_force_steer_front, "rad/N", LATERAL),
    Measure(lateral_force_steer_rear, "rad/N", LATERAL),
    Measure(lateral_force_camber_front, "rad/N", LATERAL),
    Measure(lateral_force_camber_rear, "rad/N", LATERAL),
    Measure(longitudinal_force_steer_front, "rad/N", LONGITUDINAL),
    Measure(longitudinal_force_steer_rear, "rad/N", LONGITUDINAL),
    Measure(aligning_moment_steer_front, "rad/(N m)", ALIGNING),
    Measure(aligning_moment_steer_rear, "rad/(N m)", ALIGNING),
)
