"""Numbers of wheels that lift in a turn: which one, when, at which lateral acceleration, for how long, and how near the
others come."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from susp_mj.run import Run

from .number import Answer, Measure, Runs, no_question
from .ride import CONTACT_LOST
from .runs import drives
from .turns import circle, first, followed, inner, lasting

TURNING = 1.0
"""Lateral acceleration [m/s²] from which on a wheel is an inner one."""
NONE_LIFTS = "no wheel lifts"


@dataclass(frozen=True)
class Lift:
    """A wheel that lifts.

    Attributes:
        station: the wheel.
        at: index of the first record off the road.
        time: when that is [s].
        acceleration: lateral acceleration there [m/s²], without sign.
        lasts: time off the road, summed over the run [s].
    """

    station: str
    at: int
    time: float
    acceleration: float
    lasts: float


def lifts(run: Run) -> list[Lift]:
    """Wheels that lift, in their order of time."""
    found = []
    for station, load in run.stations("wheel_load").items():
        off = load[: _watched(run)] <= CONTACT_LOST
        at = first(off)
        if at is not None:
            acceleration = abs(float(run["lateral_acceleration"][at]))
            found.append(Lift(station, at, float(run.time[at]), acceleration, lasting(off, run.step)))
    return sorted(found, key=lambda each: each.at)


def _watched(run: Run) -> int:
    """Number of records in which a lift counts: of a ramp all of them, a wheel may lift while the car slides."""
    return len(run.time) if circle(run) is None else followed(run)


def wheel_lift_time(run: Run) -> Answer:
    """Time for which a wheel is lifted, the one that is lifted longest [s]; 0 if none lifts."""
    longest = max(lifts(run), key=lambda each: each.lasts, default=None)
    return Answer(0.0, NONE_LIFTS) if longest is None else Answer(longest.lasts, longest.station)


def wheel_lift_instant(run: Run) -> Answer:
    """First instant at which a wheel lifts [s]; no value if none does."""
    found = lifts(run)
    return Answer(found[0].time, found[0].station) if found else Answer(None, NONE_LIFTS)


def wheel_lift_acceleration(run: Run) -> Answer:
    """Lateral acceleration at which the first wheel lifts [m/s²]; no value if none does."""
    found = lifts(run)
    return Answer(found[0].acceleration, found[0].station) if found else Answer(None, NONE_LIFTS)


def inner_lift_time_front(run: Run) -> Answer:
    """Time for which the inner front wheel is lifted [s]; 0 if it stays down."""
    return _inner_lift_time(run, 0)


def inner_lift_time_rear(run: Run) -> Answer:
    """Time for which the inner rear wheel is lifted [s]; 0 if it stays down."""
    return _inner_lift_time(run, 1)


def inner_lift_instant_front(run: Run) -> Answer:
    """First instant at which the inner front wheel lifts [s]; no value if it stays down."""
    return _inner_lift_instant(run, 0)


def inner_lift_instant_rear(run: Run) -> Answer:
    """First instant at which the inner rear wheel lifts [s]; no value if it stays down."""
    return _inner_lift_instant(run, 1)


def _inner_lift_time(run: Run, order: int) -> Answer:
    found = _inner_lift(run, order)
    return Answer(0.0, f"{inner(run)[order]} stays down") if found is None else Answer(found.lasts, found.station)


def _inner_lift_instant(run: Run, order: int) -> Answer:
    found = _inner_lift(run, order)
    if found is None:
        return Answer(None, f"{inner(run)[order]} stays down")
    return Answer(found.time, f"{found.station} at {found.acceleration:.2f} m/s²")


def _inner_lift(run: Run, order: int) -> Lift | None:
    """How an inner wheel lifts, of the front (0) or rear (1) axle."""
    return next((each for each in lifts(run) if each.station == inner(run)[order]), None)


def inner_wheel_load_front(run: Run) -> Answer:
    """Smallest load of the inner front wheel in the turn [N]."""
    return _inner_load(run, 0)


def inner_wheel_load_rear(run: Run) -> Answer:
    """Smallest load of the inner rear wheel in the turn [N]."""
    return _inner_load(run, 1)


def _inner_load(run: Run, order: int) -> Answer:
    """Smallest load of an inner wheel while the car turns to the side of its largest lateral acceleration."""
    station = inner(run)[order]
    last = _watched(run)
    acceleration = np.abs(run["lateral_acceleration"][:last])
    loads = np.where(acceleration >= TURNING, run[f"{station}_wheel_load"][:last], np.inf)
    at = int(np.argmin(loads))
    if acceleration[at] < TURNING:
        return no_question("does not follow its circle until it turns")
    return Answer(float(loads[at]), f"{station} at {acceleration[at]:.1f} m/s²")


def _turns(run: Run) -> bool:
    """Whether the car drives freely through a turn."""
    if not drives(run) or "fl_wheel_load" not in run:
        return False
    return bool(np.abs(run["lateral_acceleration"]).max() >= TURNING)


TURNS = Runs(_turns, "does not turn")
NUMBERS = (
    Measure(wheel_lift_time, "s", TURNS),
    Measure(wheel_lift_instant, "s", TURNS),
    Measure(wheel_lift_acceleration, "m/s²", TURNS),
    Measure(inner_lift_time_front, "s", TURNS),
    Measure(inner_lift_time_rear, "s", TURNS),
    Measure(inner_lift_instant_front, "s", TURNS),
    Measure(inner_lift_instant_rear, "s", TURNS),
    Measure(inner_wheel_load_front, "N", TURNS),
    Measure(inner_wheel_load_rear, "N", TURNS),
)
