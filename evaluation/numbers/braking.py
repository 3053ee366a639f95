"""Numbers of braking and accelerating: deceleration, distances, times, wheel load distribution, how straight the car
stays.

Braking begins as the pedal leaves its rest.

Source: UN ECE R13-H, annex 3, for the mean fully developed deceleration; ISO 7975:2006 for braking in a turn.
"""

from __future__ import annotations

import numpy as np

from susp_mj.run import Run

from .number import Answer, Measure, Runs, no_question
from .runs import beginning, driving, facts, is_a, recorded
from .turns import axle_load, distance, first

STANDS = 0.1
"""Speed [m/s] below which the car counts as standing."""
LOCKED = 0.1
"""Speed of a wheel's tread, as a share of the car's speed, below which it counts as locked."""
HUNDRED = 100 / 3.6


def braking_deceleration(run: Run) -> Answer:
    """Mean fully developed deceleration [m/s²]: ``(v_b² - v_e²)/(2 s)`` over the way s from 80 to 10 % of the initial
    speed."""
    begin = beginning(run)
    found = _from_80_to_10(run, begin)
    if found is None:
        return Answer(None, "does not slow down to 10 % of the speed")
    speed, way = run["speed"], distance(run)
    b, e = found
    return Answer(
        float((speed[b] ** 2 - speed[e] ** 2) / (2 * (way[e] - way[b]))), f"from {3.6 * speed[begin]:.0f} km/h"
    )


def stopping_distance(run: Run) -> Answer:
    """Way from the first movement of the brake pedal until the car stands [metre]."""
    begin = beginning(run)
    stands = first(run["speed"][begin:] < STANDS)
    if stands is None:
        return Answer(None, f"still {3.6 * float(run['speed'][-1]):.0f} km/h at the end")
    way = distance(run)
    return Answer(float(way[begin + stands] - way[begin]), f"from {3.6 * run['speed'][begin]:.0f} km/h")


def braking_load_share_front(run: Run) -> Answer:
    """Front axle's mean share of the wheel loads while braking, from 80 to 10 % of the speed."""
    begin = beginning(run)
    found = _from_80_to_10(run, begin)
    if found is None:
        return Answer(None, "does not slow down to 10 % of the speed")
    front, rear = (axle_load(run, axle) for axle in ("front", "rear"))
    share = front / (front + rear)
    return Answer(float(share[found[0] : found[1]].mean()), f"{100 * share[begin]:.1f} % before")


def wheel_lock_time(run: Run) -> Answer:
    """Time for which a wheel is locked while the car moves faster than 2 m/s, the one that is locked longest [s]."""
    speed = run["speed"]
    times = {}
    for station, spin in run.stations("wheel_speed").items():
        radius = facts(run).get("wheel_radius_front" if station.startswith("f") else "wheel_radius_rear", 0.3)
        times[station] = float(np.sum((spin * radius < LOCKED * speed) & (speed > 2.0))) * run.step
    station = max(times, key=lambda each: times[each])
    return Answer(times[station], station) if times[station] > 0 else Answer(0.0, "no wheel locks")


def braking_yaw_deviation(run: Run) -> Answer:
    """Largest change of the heading while braking on a straight road, to either side [rad], without sign."""
    begin = beginning(run)
    yaw = run["yaw_angle"][begin:] - run["yaw_angle"][begin]
    at = int(np.argmax(np.abs(yaw)))
    return Answer(abs(float(yaw[at])), _side(float(yaw[at]), "turns") if abs(yaw[at]) > 1e-3 else "")


def braking_lateral_deviation(run: Run) -> Answer:
    """Largest sideways departure from the straight line while braking on a straight road [metre], without sign."""
    begin = beginning(run)
    sideways = sideways_from(run, begin)
    at = int(np.argmax(np.abs(sideways)))
    return Answer(abs(float(sideways[at])), _side(float(sideways[at]), "drifts") if abs(sideways[at]) > 0.01 else "")


def braking_yaw_ratio(run: Run) -> Answer:
    """Yaw rate 1 s after braking began in a turn, over that of the same circle at the lower speed.

    ``psi'(1 s)/(psi'_0 v(1 s)/v_0)``: above 1 the car turns in, below 1 it runs wide.
    """
    begin = beginning(run)
    later = begin + round(1.0 / run.step)
    if later >= len(run.time) or run["speed"][later] < 1.0 or abs(run["yaw_rate"][begin]) < 1e-3:
        return Answer(None, "the run or the turn ends before")
    same_circle = run["yaw_rate"][begin] * run["speed"][later] / run["speed"][begin]
    return Answer(
        float(run["yaw_rate"][later] / same_circle),
        f"at {abs(float(run['lateral_acceleration'][begin])):.1f} m/s² before",
    )


def acceleration_time_100(run: Run) -> Answer:
    """Time from the first movement of the accelerator to 100 km/h [s]."""
    return _to_hundred(run, run.time)


def acceleration_distance_100(run: Run) -> Answer:
    """Way from the first movement of the accelerator to 100 km/h [metre]."""
    return _to_hundred(run, distance(run))


def longitudinal_acceleration_max(run: Run) -> Answer:
    """Largest forward acceleration [m/s²]."""
    at = int(np.argmax(run["longitudinal_acceleration"]))
    return Answer(float(run["longitudinal_acceleration"][at]), f"at {3.6 * run['speed'][at]:.0f} km/h")


def sideways_from(run: Run, begin: int) -> np.ndarray:
    """Departure to the left [m] from the straight line along which the car is heading at a record, from there on."""
    heading = run["yaw_angle"][begin]
    x, y = (run[name][begin:] - run[name][begin] for name in ("position_x", "position_y"))
    return y * np.cos(heading) - x * np.sin(heading)


def _from_80_to_10(run: Run, begin: int) -> tuple[int, int] | None:
    """Records at which the speed falls below 80 and 10 % of what it was."""
    share = run["speed"][begin:] / max(float(run["speed"][begin]), STANDS)
    high, low = first(share <= 0.8), first(share <= 0.1)
    return None if high is None or low is None or low == high else (begin + high, begin + low)


def _to_hundred(run: Run, passed: np.ndarray) -> Answer:
    """How much of something, time or way, has passed between the accelerator's first movement and 100 km/h."""
    begin, speed = beginning(run), run["speed"]
    if speed[begin] >= HUNDRED:
        return no_question("is faster than 100 km/h from the beginning")
    reached = first(speed[begin:] >= HUNDRED)
    if reached is None:
        return Answer(None, f"reaches {3.6 * float(speed.max()):.0f} km/h")
    return Answer(float(passed[begin + reached] - passed[begin]))


def _side(value: float, verb: str) -> str:
    return f"{verb} to the {'left' if value > 0 else 'right'}"


BRAKES = driving("braking", "does not brake")
STRAIGHT = Runs(lambda run: not is_a(run, "turn"), "does not brake on a straight road")
IN_TURN = driving("turn", "does not brake in a turn")
ACCELERATES = driving("acceleration", "does not accelerate")
NUMBERS = (
    Measure(braking_deceleration, "m/s²", BRAKES),
    Measure(stopping_distance, "metre", BRAKES),
    Measure(braking_load_share_front, "1", BRAKES),
    Measure(wheel_lock_time, "s", BRAKES & recorded("wheel_speed")),
    Measure(braking_yaw_deviation, "rad", BRAKES & STRAIGHT),
    Measure(braking_lateral_deviation, "metre", BRAKES & STRAIGHT),
    Measure(braking_yaw_ratio, "1", BRAKES & IN_TURN),
    Measure(acceleration_time_100, "s", ACCELERATES & recorded("accelerator")),
    Measure(acceleration_distance_100, "metre", ACCELERATES & recorded("accelerator")),
    Measure(longitudinal_acceleration_max, "m/s²", ACCELERATES),
)
