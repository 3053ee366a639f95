"""Numbers of the course over the ground: drift in wind and on a sloping road, cones of a lane change, the driver's
deviation."""

from __future__ import annotations

import numpy as np

from susp_mj.features import Cones, features_in
from susp_mj.run import Run

from .braking import sideways_from
from .number import Answer, Measure, Runs, no_question
from .runs import DRIVES, beginning, drives, driving, facts, is_a, parameter
from .turns import deviation, first


def lateral_drift_1s(run: Run) -> Answer:
    """Departure to the side 1 s after the disturbance began [metre], without sign."""
    return _drift(run, 1.0)


def lateral_drift_2s(run: Run) -> Answer:
    """Departure to the side 2 s after the disturbance began [metre], without sign (ISO 12021)."""
    return _drift(run, 2.0)


def disturbance_yaw_rate_max(run: Run) -> Answer:
    """Largest yaw rate under the disturbance, to either side [rad/s], without sign."""
    begin = beginning(run)
    rate = run["yaw_rate"][begin:]
    at = int(np.argmax(np.abs(rate)))
    return Answer(abs(float(rate[at])), f"{run.time[begin + at] - run.time[begin]:.2f} s after it began")


def disturbance_steering_max(run: Run) -> Answer:
    """Largest steering wheel angle that the driver needs against the disturbance [rad], without sign."""
    begin = beginning(run)
    angle = run["steering_wheel_angle"][begin:] - run["steering_wheel_angle"][begin]
    return Answer(float(np.abs(angle).max()))


def path_deviation_max(run: Run) -> Answer:
    """Largest departure of the centre of gravity from the driver's path [metre], without sign."""
    away = deviation(run)
    if away is None:
        return no_question("no driver follows a path")
    at = int(np.argmax(np.abs(away)))
    return Answer(abs(float(away[at])), f"{'left' if away[at] > 0 else 'right'} of it at {run.time[at]:.2f} s")


def cones_hit(run: Run) -> Answer:
    """How many cones of the lanes the car's outline touches."""
    track, size = cones(run), outline(run)
    points = np.array(track.points)
    hit = points[[_touches(run, point, size, track.radius) for point in points]]
    if not len(hit):
        return _all_lanes(run, Answer(0.0, "none"))
    sides = (f"x = {x:.0f} m {'left' if y > 0 else 'right'}" for x, y in hit)
    return Answer(float(len(hit)), ", ".join(sides))


def lane_departure(run: Run) -> Answer:
    """How far a corner of the car gets beyond the limits of the lanes [m]; 0 if it stays inside."""
    worst, where = 0.0, "stays inside"
    for number, lane in enumerate(cones(run).lanes, 1):
        for x, y in corners(run).values():
            inside = (x >= lane.x[0]) & (x <= lane.x[1])
            beyond = np.where(inside, np.maximum(lane.y[0] - y, y - lane.y[1]), -np.inf)
            if beyond.max() > worst:
                worst, where = float(beyond.max()), f"in lane {number}"
    answer = Answer(worst, where)
    return answer if worst > 0.0 else _all_lanes(run, answer)


def lane_entry_speed(run: Run) -> Answer:
    """Speed at which the car enters the first lane [m/s]."""
    return _lane_speed(run, 0, 0)


def lane_exit_speed(run: Run) -> Answer:
    """Speed at which the car leaves the last lane [m/s]."""
    return _lane_speed(run, -1, 1)


def has_cones(run: Run) -> bool:
    """Whether a freely driving car has lanes of cones on its road."""
    return drives(run) and any(isinstance(each, Cones) for each in features_in(run.meta))


def cones(run: Run) -> Cones:
    """The lanes of cones of a run's road that has some."""
    return next(each for each in features_in(run.meta) if isinstance(each, Cones))


def outline(run: Run) -> tuple[tuple[float, float], tuple[float, float]]:
    """The car's outline from its centre of gravity [m]: from rear to front, from right to left."""
    wheelbase, cg = facts(run).get("wheelbase", 3.0), facts(run).get("cg_x", -1.5)
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


def _all_lanes(run: Run, answer: Answer) -> Answer:
    """The answer if the car gets through all lanes; no value if the run ends before."""
    end = lane_exit_speed(run)
    return answer if end.value is not None else end


def _lane_speed(run: Run, lane: int, end: int) -> Answer:
    (_, front), _ = outline(run)
    place = cones(run).lanes[lane].x[end]
    at = first(run["position_x"] + front - float(parameter(run, "front_overhang", 0.8)) >= place)
    if at is None:
        return Answer(None, f"does not get to x = {place:.0f} m")
    return Answer(float(run["speed"][at]), f"{3.6 * run['speed'][at]:.1f} km/h")


def _drift(run: Run, after: float) -> Answer:
    sideways = sideways_from(run, beginning(run))
    at = round(after / run.step)
    if at >= len(sideways):
        return Answer(None, "the run ends before")
    side = f"to the {'left' if sideways[at] > 0 else 'right'}" if abs(sideways[at]) > 1e-3 else ""
    return Answer(abs(float(sideways[at])), side)


DISTURBED = driving("disturbance", "is not disturbed")
UNSTEERED = Runs(lambda run: not parameter(run, "steered", False), "a driver steers against the disturbance")
STEERED = Runs(lambda run: parameter(run, "steered", False), "no driver steers against the disturbance")
FOLLOWS = Runs(lambda run: not is_a(run, "tightened"), "follows its path only as long as it can")
BETWEEN_CONES = Runs(has_cones, "no lanes of cones")
NUMBERS = (
    Measure(lateral_drift_1s, "metre", DISTURBED & UNSTEERED),
    Measure(lateral_drift_2s, "metre", DISTURBED & UNSTEERED),
    Measure(disturbance_yaw_rate_max, "rad/s", DISTURBED),
    Measure(disturbance_steering_max, "rad", DISTURBED & STEERED),
    Measure(path_deviation_max, "metre", DRIVES & FOLLOWS),
    Measure(cones_hit, "1", BETWEEN_CONES),
    Measure(lane_departure, "m", BETWEEN_CONES),
    Measure(lane_entry_speed, "m/s", BETWEEN_CONES),
    Measure(lane_exit_speed, "m/s", BETWEEN_CONES),
)
