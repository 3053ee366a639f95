"""Numbers of braking and accelerating: deceleration, distances, times, wheel load distribution, how straight the car
stays.

Braking begins as the pedal leaves its rest.

Source: UN ECE R13-H, annex 3, for the mean fully developed deceleration; ISO 7975:2006 for braking in a turn.
"""

from __future__ import annotations

import numpy as np

from susp_mj.run import Run

from .number import Number
from .turns import axle_load, distance, drives, fact, first, kind, missing, parameter

BRAKED = {"braking": "start", "split_mu": "start", "braking_in_turn": "brake_start"}
"""Manoeuvre that brakes -> its parameter that says when."""
STANDS = 0.1
"""Speed [m/s] below which the car counts as standing."""
LOCKED = 0.1
"""Speed of a wheel's tread, as a share of the car's speed, below which it counts as locked."""
HUNDRED = 100 / 3.6


def braking_deceleration(run: Run) -> Number:
    """Mean fully developed deceleration [m/s²]: ``(v_b² - v_e²)/(2 s)`` over the way s from 80 to 10 % of the initial
    speed."""
    begin = _braking_begins(run)
    if begin is None:
        return missing("m/s²", "does not brake")
    found = _from_80_to_10(run, begin)
    if found is None:
        return Number(None, "m/s²", "does not slow down to 10 % of the speed")
    speed, way = run["speed"], distance(run)
    b, e = found
    return Number(
        float((speed[b] ** 2 - speed[e] ** 2) / (2 * (way[e] - way[b]))), "m/s²", f"from {3.6 * speed[begin]:.0f} km/h"
    )


def stopping_distance(run: Run) -> Number:
    """Way from the first movement of the brake pedal until the car stands [metre]."""
    begin = _braking_begins(run)
    if begin is None:
        return missing("metre", "does not brake")
    stands = first(run["speed"][begin:] < STANDS)
    if stands is None:
        return Number(None, "metre", f"still {3.6 * float(run['speed'][-1]):.0f} km/h at the end")
    way = distance(run)
    return Number(float(way[begin + stands] - way[begin]), "metre", f"from {3.6 * run['speed'][begin]:.0f} km/h")


def braking_load_share_front(run: Run) -> Number:
    """Front axle's mean share of the wheel loads while braking, from 80 to 10 % of the speed."""
    begin = _braking_begins(run)
    if begin is None or "fl_wheel_load" not in run:
        return missing("1", "does not brake")
    found = _from_80_to_10(run, begin)
    if found is None:
        return Number(None, "1", "does not slow down to 10 % of the speed")
    front, rear = (axle_load(run, axle) for axle in ("front", "rear"))
    share = front / (front + rear)
    return Number(float(share[found[0] : found[1]].mean()), "1", f"{100 * share[begin]:.1f} % before")


def wheel_lock_time(run: Run) -> Number:
    """Time for which a wheel is locked while the car moves faster than 2 m/s, the one that is locked longest [s]."""
    begin = _braking_begins(run)
    if begin is None or "fl_wheel_speed" not in run:
        return missing("s", "does not brake")
    speed = run["speed"]
    times = {}
    for station, spin in run.stations("wheel_speed").items():
        radius = fact(run, "wheel_radius_front" if station.startswith("f") else "wheel_radius_rear") or 0.3
        times[station] = float(np.sum((spin * radius < LOCKED * speed) & (speed > 2.0))) * run.step
    station = max(times, key=lambda each: times[each])
    return Number(times[station], "s", station) if times[station] > 0 else Number(0.0, "s", "no wheel locks")


def braking_yaw_deviation(run: Run) -> Number:
    """Largest change of the heading while braking on a straight road, to either side [rad], without sign."""
    begin = _braking_begins(run)
    if begin is None or kind(run) == "braking_in_turn":
        return missing("rad", "does not brake on a straight road")
    yaw = run["yaw_angle"][begin:] - run["yaw_angle"][begin]
    at = int(np.argmax(np.abs(yaw)))
    return Number(abs(float(yaw[at])), "rad", _side(float(yaw[at]), "turns") if abs(yaw[at]) > 1e-3 else "")


def braking_lateral_deviation(run: Run) -> Number:
    """Largest sideways departure from the straight line while braking on a straight road [metre], without sign."""
    begin = _braking_begins(run)
    if begin is None or kind(run) == "braking_in_turn":
        return missing("metre", "does not brake on a straight road")
    sideways = sideways_from(run, begin)
    at = int(np.argmax(np.abs(sideways)))
    return Number(
        abs(float(sideways[at])), "metre", _side(float(sideways[at]), "drifts") if abs(sideways[at]) > 0.01 else ""
    )


def braking_yaw_ratio(run: Run) -> Number:
    """Yaw rate 1 s after braking began in a turn, over that of the same circle at the lower speed.

    ``psi'(1 s)/(psi'_0 v(1 s)/v_0)``: above 1 the car turns in, below 1 it runs wide.
    """
    begin = _braking_begins(run)
    if begin is None or kind(run) != "braking_in_turn":
        return missing("1", "does not brake in a turn")
    later = begin + round(1.0 / run.step)
    if later >= len(run.time) or run["speed"][later] < 1.0 or abs(run["yaw_rate"][begin]) < 1e-3:
        return Number(None, "1", "the run or the turn ends before")
    same_circle = run["yaw_rate"][begin] * run["speed"][later] / run["speed"][begin]
    return Number(
        float(run["yaw_rate"][later] / same_circle),
        "1",
        f"at {abs(float(run['lateral_acceleration'][begin])):.1f} m/s² before",
    )


def acceleration_time_100(run: Run) -> Number:
    """Time from the first movement of the accelerator to 100 km/h [s]."""
    found = _to_hundred(run)
    if isinstance(found, str):
        return missing("s", found)
    begin, end = found
    return Number(None, "s", _not_reached(run)) if end is None else Number(float(run.time[end] - run.time[begin]), "s")


def acceleration_distance_100(run: Run) -> Number:
    """Way from the first movement of the accelerator to 100 km/h [metre]."""
    found = _to_hundred(run)
    if isinstance(found, str):
        return missing("metre", found)
    begin, end = found
    way = distance(run)
    return Number(None, "metre", _not_reached(run)) if end is None else Number(float(way[end] - way[begin]), "metre")


def longitudinal_acceleration_max(run: Run) -> Number:
    """Largest forward acceleration [m/s²]."""
    if not drives(run) or kind(run) != "acceleration":
        return missing("m/s²", "does not accelerate")
    at = int(np.argmax(run["longitudinal_acceleration"]))
    return Number(float(run["longitudinal_acceleration"][at]), "m/s²", f"at {3.6 * run['speed'][at]:.0f} km/h")


def sideways_from(run: Run, begin: int) -> np.ndarray:
    """Departure to the left [m] from the straight line along which the car is heading at a record, from there on."""
    heading = run["yaw_angle"][begin]
    x, y = (run[name][begin:] - run[name][begin] for name in ("position_x", "position_y"))
    return y * np.cos(heading) - x * np.sin(heading)


def _braking_begins(run: Run) -> int | None:
    """Index of the record at which the driver puts the brake on; None in a manoeuvre without braking."""
    begin = parameter(run, BRAKED.get(kind(run), ""))
    return first(run.time >= float(begin) - 1e-9) if drives(run) and begin is not None else None


def _from_80_to_10(run: Run, begin: int) -> tuple[int, int] | None:
    """Records at which the speed falls below 80 and 10 % of what it was."""
    share = run["speed"][begin:] / max(float(run["speed"][begin]), STANDS)
    high, low = first(share <= 0.8), first(share <= 0.1)
    return None if high is None or low is None or low == high else (begin + high, begin + low)


def _to_hundred(run: Run) -> tuple[int, int | None] | str:
    """Records at which the accelerator moves and at which 100 km/h are reached, or why this cannot be asked."""
    if not drives(run) or kind(run) != "acceleration" or "accelerator" not in run:
        return "does not accelerate"
    moved = first(run.time >= float(parameter(run, "start", 0.0)))
    begin = 0 if moved is None else moved
    if run["speed"][begin] >= HUNDRED:
        return "is faster than 100 km/h from the beginning"
    reached = first(run["speed"][begin:] >= HUNDRED)
    return begin, None if reached is None else begin + reached


def _not_reached(run: Run) -> str:
    return f"reaches {3.6 * float(run['speed'].max()):.0f} km/h"


def _side(value: float, verb: str) -> str:
    return f"{verb} to the {'left' if value > 0 else 'right'}"
