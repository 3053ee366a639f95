"""Numbers of the course over the ground: drift in wind and on a sloping road, cones of a lane change, the driver's
deviation."""

from __future__ import annotations

import numpy as np

from susp_mj.features import Cones, features_in
from susp_mj.run import Run

from .braking import sideways_from
from .number import Number
from .turns import deviation, drives, fact, first, kind, missing, parameter

DISTURBED = ("crosswind", "cross_slope")
"""Manoeuvres that push a car aside that shall go straight on."""


def lateral_drift_1s(run: Run) -> Number:
    """Departure to the side 1 s after the disturbance began [metre], without sign."""
    return _drift(run, 1.0)


def lateral_drift_2s(run: Run) -> Number:
    """Departure to the side 2 s after the disturbance began [metre], without sign (ISO 12021)."""
    return _drift(run, 2.0)


def disturbance_yaw_rate_max(run: Run) -> Number:
    """Largest yaw rate under the disturbance, to either side [rad/s], without sign."""
    begin = _disturbed(run)
    if begin is None:
        return missing("rad/s", "is not disturbed")
    rate = run["yaw_rate"][begin:]
    at = int(np.argmax(np.abs(rate)))
    return Number(abs(float(rate[at])), "rad/s", f"{run.time[begin + at] - run.time[begin]:.2f} s after it began")


def disturbance_steering_max(run: Run) -> Number:
    """Largest steering wheel angle that the driver needs against the disturbance [rad], without sign."""
    begin = _disturbed(run)
    if begin is None or not parameter(run, "steered", False):
        return missing("rad", "no driver steers against a disturbance")
    angle = run["steering_wheel_angle"][begin:] - run["steering_wheel_angle"][begin]
    return Number(float(np.abs(angle).max()), "rad")


def path_deviation_max(run: Run) -> Number:
    """Largest departure of the centre of gravity from the driver's path [metre], without sign."""
    away = deviation(run) if drives(run) else None
    if away is None or kind(run) == "steady_circle":
        return missing("metre", "no driver follows a path to its end")
    at = int(np.argmax(np.abs(away)))
    return Number(abs(float(away[at])), "metre", f"{'left' if away[at] > 0 else 'right'} of it at {run.time[at]:.2f} s")


def cones_hit(run: Run) -> Number:
    """How many cones of the lanes the car's outline touches."""
    track = cones(run)
    if track is None:
        return missing("1", "no lanes of cones")
    x, y = outline(run)
    points = np.array(track.points)
    hit = [_touches(run, point, (x, y), track.radius) for point in points]
    named = ", ".join(
        f"x = {point[0]:.0f} m {'left' if point[1] > 0 else 'right'}"
        for point, touched in zip(points, hit, strict=True)
        if touched
    )
    return Number(float(sum(hit)), "1", named) if named else _all_lanes(run, Number(0.0, "1", "none"))


def lane_departure(run: Run) -> Number:
    """How far a corner of the car gets beyond the limits of the lanes [m]; 0 if it stays inside."""
    track = cones(run)
    if track is None:
        return missing("m", "no lanes of cones")
    worst, where = 0.0, "stays inside"
    for number, lane in enumerate(track.lanes, 1):
        for x, y in corners(run).values():
            inside = (x >= lane.x[0]) & (x <= lane.x[1])
            beyond = np.where(inside, np.maximum(lane.y[0] - y, y - lane.y[1]), -np.inf)
            if beyond.max() > worst:
                worst, where = float(beyond.max()), f"in lane {number}"
    number = Number(worst, "m", where)
    return number if worst > 0.0 else _all_lanes(run, number)


def lane_entry_speed(run: Run) -> Number:
    """Speed at which the car enters the first lane [m/s]."""
    return _lane_speed(run, 0, 0)


def lane_exit_speed(run: Run) -> Number:
    """Speed at which the car leaves the last lane [m/s]."""
    return _lane_speed(run, -1, 1)


def cones(run: Run) -> Cones | None:
    """The lanes of cones of a run's road."""
    if not drives(run):
        return None
    return next((each for each in features_in(run.meta) if isinstance(each, Cones)), None)


def outline(run: Run) -> tuple[tuple[float, float], tuple[float, float]]:
    """The car's outline from its centre of gravity [m]: from rear to front, from right to left."""
    wheelbase, cg = fact(run, "wheelbase") or 3.0, fact(run, "cg_x") or -1.5
    front, rear = float(parameter(run, "front_overhang", 0.8)), float(parameter(run, "rear_overhang", 1.0))
    half = float(parameter(run, "vehicle_width", 1.8)) / 2
    return (-wheelbase - cg - rear, -cg + front), (-half, half)


def corners(run: Run) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Paths of the four corners of the car's outline over the ground [m], by name."""
    (rear, front), (right, left) = outline(run)
    x, y, yaw = run["position_x"], run["position_y"], run["yaw_angle"]
    places = {
        "front left": (front, left),
        "front right": (front, right),
        "rear left": (rear, left),
        "rear right": (rear, right),
    }
    return {
        name: (x + along * np.cos(yaw) - across * np.sin(yaw), y + along * np.sin(yaw) + across * np.cos(yaw))
        for name, (along, across) in places.items()
    }


def _touches(
    run: Run, point: np.ndarray, outline: tuple[tuple[float, float], tuple[float, float]], radius: float
) -> bool:
    """Whether the outline ever comes nearer to a point than a radius [m]."""
    yaw = run["yaw_angle"]
    dx, dy = point[0] - run["position_x"], point[1] - run["position_y"]
    along, across = dx * np.cos(yaw) + dy * np.sin(yaw), dy * np.cos(yaw) - dx * np.sin(yaw)
    (rear, front), (right, left) = outline
    outside = np.hypot(
        np.maximum(np.maximum(rear - along, along - front), 0.0),
        np.maximum(np.maximum(right - across, across - left), 0.0),
    )
    return bool((outside < radius - 1e-9).any())


def _all_lanes(run: Run, number: Number) -> Number:
    """The number if the car gets through all lanes; no value if the run ends before."""
    end = lane_exit_speed(run)
    return number if end.value is not None else Number(None, number.unit, end.note)


def _lane_speed(run: Run, lane: int, end: int) -> Number:
    track = cones(run)
    if track is None:
        return missing("m/s", "no lanes of cones")
    (_, front), _ = outline(run)
    place = track.lanes[lane].x[end]
    at = first(run["position_x"] + front - float(parameter(run, "front_overhang", 0.8)) >= place)
    if at is None:
        return Number(None, "m/s", f"does not get to x = {place:.0f} m")
    return Number(float(run["speed"][at]), "m/s", f"{3.6 * run['speed'][at]:.1f} km/h")


def _disturbed(run: Run) -> int | None:
    """Record at which the disturbance begins; None if there is none."""
    if not drives(run) or kind(run) not in DISTURBED:
        return None
    return first(run.time >= float(parameter(run, "start", 0.0)))


def _drift(run: Run, after: float) -> Number:
    begin = _disturbed(run)
    if begin is None or parameter(run, "steered", False):
        return missing("metre", "is not disturbed, or a driver steers against it")
    sideways = sideways_from(run, begin)
    at = round(after / run.step)
    if at >= len(sideways):
        return Number(None, "metre", "the run ends before")
    return Number(
        abs(float(sideways[at])),
        "metre",
        f"to the {'left' if sideways[at] > 0 else 'right'}" if abs(sideways[at]) > 1e-3 else "",
    )
