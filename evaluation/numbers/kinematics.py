"""Numbers of the kinematics rig, per axle: slopes over travel, roll and steering in the design position.

Over travel they hold within 20 mm of the design position, over angles within half the amplitude of the test. A wheel's
toe is positive inwards, its camber positive with the top outwards; left and right are averaged as mirror images.

Source: definitions as in ISO 8855:2011; W. Matschinsky, Radführungen der Straßenfahrzeuge.
"""

from __future__ import annotations

import math

import numpy as np

from susp_mj.run import Run

from .number import Answer, Measure, Runs
from .runs import facts, known, on_rig, parameter
from .turns import slope, stations_of

TRAVEL = 0.02
"""Travel to both sides of the design position within which slopes are fitted [m]."""
SHARE = 0.5
"""Share of a test's amplitude within which slopes over forces and angles are fitted."""


def bump_steer_front(run: Run) -> Answer:
    """Toe-in per travel of a front wheel, positive: toe-in in bump [rad/m]."""
    return _over_travel(run, "front", "steer_angle", mirrored=-1.0)


def bump_steer_rear(run: Run) -> Answer:
    """Toe-in per travel of a rear wheel, positive: toe-in in bump [rad/m]."""
    return _over_travel(run, "rear", "steer_angle", mirrored=-1.0)


def bump_camber_front(run: Run) -> Answer:
    """Camber against the body per travel of a front wheel, negative: the top moves inwards in bump [rad/m]."""
    return _over_travel(run, "front", "inclination_angle")


def bump_camber_rear(run: Run) -> Answer:
    """Camber against the body per travel of a rear wheel, negative: the top moves inwards in bump [rad/m]."""
    return _over_travel(run, "rear", "inclination_angle")


def wheel_rate_front(run: Run) -> Answer:
    """Wheel load per travel of a front wheel, both wheels moving alike [N/m]."""
    return _over_travel(run, "front", "wheel_load")


def wheel_rate_rear(run: Run) -> Answer:
    """Wheel load per travel of a rear wheel, both wheels moving alike [N/m]."""
    return _over_travel(run, "rear", "wheel_load")


def roll_centre_height_front(run: Run) -> Answer:
    """Height of the front roll centre above the ground [m]: ``t/2 dy/dz``, y the contact patch's movement outwards over
    travel z."""
    return _roll_centre(run, "front")


def roll_centre_height_rear(run: Run) -> Answer:
    """Height of the rear roll centre above the ground [m]: ``t/2 dy/dz``, y the contact patch's movement outwards over
    travel z."""
    return _roll_centre(run, "rear")


def path_angle_front(run: Run) -> Answer:
    """Angle of a front wheel's path, positive: anti-dive [rad]: ``atan(dx/dz)``, x the contact patch's movement
    forwards in bump."""
    return _path_angle(run, "front", 1.0)


def path_angle_rear(run: Run) -> Answer:
    """Angle of a rear wheel's path, positive: anti-lift [rad]: ``atan(-dx/dz)``, x the contact patch's movement
    forwards in bump."""
    return _path_angle(run, "rear", -1.0)


def roll_steer_front(run: Run) -> Answer:
    """Mean steer angle of the front wheels per roll angle [rad/rad], positive: roll steers them into the turn that
    causes it."""
    return _over_roll(run, "front", "steer_angle")


def roll_steer_rear(run: Run) -> Answer:
    """Mean steer angle of the rear wheels per roll angle [rad/rad], positive: roll steers them into the turn that
    causes it."""
    return _over_roll(run, "rear", "steer_angle")


def roll_camber_front(run: Run) -> Answer:
    """Mean camber of the front wheels to the road per roll angle [rad/rad]; 1: they lean with the body."""
    return _over_roll(run, "front", "camber_angle")


def roll_camber_rear(run: Run) -> Answer:
    """Mean camber of the rear wheels to the road per roll angle [rad/rad]; 1: they lean with the body."""
    return _over_roll(run, "rear", "camber_angle")


def roll_stiffness_front(run: Run) -> Answer:
    """Roll stiffness of the front suspension [N m/rad]: ``t/2 d(F_r - F_l)/d phi``, phi from the difference of the
    wheels' travels."""
    return _roll_stiffness(run, "front")


def roll_stiffness_rear(run: Run) -> Answer:
    """Roll stiffness of the rear suspension [N m/rad]: ``t/2 d(F_r - F_l)/d phi``, phi from the difference of the
    wheels' travels."""
    return _roll_stiffness(run, "rear")


def steering_ratio(run: Run) -> Answer:
    """Steering wheel angle per mean steer angle of the front wheels about the centre."""
    steering, wheels = run["steering_wheel_angle"], _mean(run, "front", "steer_angle")
    found = slope_within(steering, wheels, SHARE / 5 * float(np.abs(steering).max()))
    return Answer(None, "the wheels do not turn") if not found else Answer(1 / found)


def _mean(run: Run, axle: str, quantity: str) -> np.ndarray:
    left, right = (run[f"{station}_{quantity}"] for station in stations_of(axle))
    return (left + right) / 2


def slope_within(x: np.ndarray, y: np.ndarray, reach: float) -> float | None:
    """Slope within ±reach of x; None where x does not cover a good part of that."""
    inside = np.abs(x) <= reach
    return slope(x[inside], y[inside]) if reach > 0 and np.sum(inside) > 5 and np.ptp(x[inside]) > reach / 2 else None


def _over_travel(run: Run, axle: str, quantity: str, *, mirrored: float = 1.0) -> Answer:
    """Mean slope over the travel of an axle's wheels; a mirrored quantity counts with that sign on the left, its
    opposite on the right."""
    signs = (mirrored, 1.0) if mirrored < 0 else (1.0, 1.0)
    slopes = [
        slope_within(run[f"{station}_suspension_deflection"], sign * run[f"{station}_{quantity}"], TRAVEL)
        for station, sign in zip(stations_of(axle), signs, strict=True)
    ]
    return average_of(slopes, f"within {1000 * TRAVEL:.0f} mm")


def _roll_centre(run: Run, axle: str) -> Answer:
    outwards = [
        slope_within(run[f"{station}_suspension_deflection"], sign * run[f"{station}_contact_y"], TRAVEL)
        for station, sign in zip(stations_of(axle), (1.0, -1.0), strict=True)
    ]
    found = average_of(outwards)
    return found if found.value is None else Answer(found.value * facts(run)[f"track_{axle}"] / 2)


def _path_angle(run: Run, axle: str, sign: float) -> Answer:
    found = _over_travel(run, axle, "contact_x")
    return found if found.value is None else Answer(math.atan(sign * found.value))


def _over_roll(run: Run, axle: str, quantity: str) -> Answer:
    roll = run["roll_angle"]
    found = slope_within(roll, _mean(run, axle, quantity), SHARE * float(np.abs(roll).max()))
    return Answer(found, "" if found is not None else "does not roll")


def _roll_stiffness(run: Run, axle: str) -> Answer:
    track = facts(run)[f"track_{axle}"]
    (left, right), (load_left, load_right) = (
        [run[f"{station}_{quantity}"] for station in stations_of(axle)]
        for quantity in ("suspension_deflection", "wheel_load")
    )
    angle = (right - left) / track
    found = slope_within(angle, track / 2 * (load_right - load_left), SHARE * float(np.abs(angle).max()))
    return Answer(found, "" if found is not None else "does not roll")


def average_of(slopes: list[float | None], note: str = "") -> Answer:
    """Mean of slopes; no value where one of them could not be fitted."""
    fitted = [each for each in slopes if each is not None]
    if len(fitted) < len(slopes):
        return Answer(None, "does not move far enough")
    return Answer(sum(fitted) / len(fitted), note)


def tested(test: str) -> Runs:
    """Runs of a test on the rig."""
    return Runs(lambda run: on_rig(run) and parameter(run, "test") == test, f"needs the test '{test}' on the rig")


BUMP, ROLL, STEER = tested("bump"), tested("roll"), tested("steer")
NUMBERS = (
    Measure(bump_steer_front, "rad/m", BUMP),
    Measure(bump_steer_rear, "rad/m", BUMP),
    Measure(bump_camber_front, "rad/m", BUMP),
    Measure(bump_camber_rear, "rad/m", BUMP),
    Measure(wheel_rate_front, "N/m", BUMP),
    Measure(wheel_rate_rear, "N/m", BUMP),
    Measure(roll_centre_height_front, "m", BUMP & known("track_front")),
    Measure(roll_centre_height_rear, "m", BUMP & known("track_rear")),
    Measure(path_angle_front, "rad", BUMP),
    Measure(path_angle_rear, "rad", BUMP),
    Measure(roll_steer_front, "1", ROLL),
    Measure(roll_steer_rear, "1", ROLL),
    Measure(roll_camber_front, "1", ROLL),
    Measure(roll_camber_rear, "1", ROLL),
    Measure(roll_stiffness_front, "N m/rad", ROLL & known("track_front")),
    Measure(roll_stiffness_rear, "N m/rad", ROLL & known("track_rear")),
    Measure(steering_ratio, "1", STEER),
)
