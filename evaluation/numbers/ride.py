"""Numbers of vertical dynamics: body motion, suspension travel, wheel load.

Every function takes a Run and returns a Number. Where a car has several wheels, the worst one counts and the note names
it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from susp_mj.names import QUANTITIES
from susp_mj.run import Run

from .number import Number
from .turns import RIG, drives, kind, stations_of

SETTLED_BAND = 0.05
"""Half-width of the settling band, as a share of the largest departure from the final value."""
INPUTS = ("road_height", "lateral_acceleration", "longitudinal_acceleration", "roll_target")
"""Quantities that drive a run."""
CONTACT_LOST = 1e-6
"""Wheel load [N] at or below which the wheel counts as off the road."""


def body_acceleration_max(run: Run) -> Number:
    """Largest upward acceleration of the body [m/s²]."""
    return _extreme(run, "body_acceleration", np.argmax)


def body_acceleration_min(run: Run) -> Number:
    """Largest downward acceleration of the body [m/s²], negative."""
    return _extreme(run, "body_acceleration", np.argmin)


def body_acceleration_rms(run: Run) -> Number:
    """Root mean square of the body's vertical acceleration over the whole run [m/s²]."""
    if "body_acceleration" not in run:
        return _missing("body_acceleration", "m/s²")
    if _is_smooth(run):
        return _not_shaken("m/s²")
    return Number(_rms(run["body_acceleration"]), "m/s²")


def body_displacement_max(run: Run) -> Number:
    """Largest rise of the body above its initial height [m]."""
    if "body_displacement" not in run:
        return _missing("body_displacement", "m")
    if _is_smooth(run):
        return _not_shaken("m")
    displacement = run["body_displacement"]
    at = int(np.argmax(displacement))
    return Number(float(displacement[at] - displacement[0]), "m", f"at {run.time[at]:.3f} s")


def overshoot(run: Run) -> Number:
    """Overshoot of the body over its final height, as a share of the final change: ``(z_max - z_end)/(z_end - z_0)``.

    Has no value where the body ends where it began, as after a bump.
    """
    if "body_displacement" not in run:
        return _missing("body_displacement", "1")
    if _is_smooth(run):
        return _not_shaken("1")
    if not _comes_to_rest(run):
        return Number(None, "1", "the road never comes to rest", applies=False)
    displacement = run["body_displacement"] - run["body_displacement"][0]
    final = _final(displacement)
    if abs(final) < 0.1 * float(np.abs(displacement).max()) or final == 0.0:
        return Number(None, "1", "the body returns to its initial height")
    return Number(max(0.0, float((displacement / final).max()) - 1.0), "1")


def settling_time(run: Run) -> Number:
    """Time from the first input until the body stays within ±5 % of its largest departure from the final height [s]."""
    if "body_displacement" not in run:
        return _missing("body_displacement", "s")
    if _is_smooth(run):
        return _not_shaken("s")
    if not _comes_to_rest(run):
        return Number(None, "s", "the road never comes to rest", applies=False)
    displacement = run["body_displacement"]
    start = _first_input(run)
    departure = np.abs(displacement - _final(displacement))
    band = SETTLED_BAND * float(departure.max())
    outside = np.flatnonzero(departure > band)
    if band == 0.0 or start is None:
        return Number(None, "s", "nothing moves")
    if outside[-1] >= len(departure) - 2:
        return Number(None, "s", "not settled within the run")
    return Number(
        float(run.time[outside[-1] + 1] - run.time[start]), "s", f"within 5 % of {1000 * float(departure.max()):.1f} mm"
    )


def wheel_load_min(run: Run) -> Number:
    """Smallest wheel load [N]."""
    return _worst(run, "wheel_load", np.argmin, min)


def wheel_load_max(run: Run) -> Number:
    """Largest wheel load [N]."""
    return _worst(run, "wheel_load", np.argmax, max)


def wheel_load_rms(run: Run) -> Number:
    """Root mean square of the dynamic share of the wheel load, load minus initial load [N]."""
    return _choose({station: _rms(load - load[0]) for station, load in run.stations("wheel_load").items()}, "N", max)


def contact_loss_time(run: Run) -> Number:
    """Time for which a wheel is off the road, summed over the run [s]."""
    off = {
        station: float(np.sum(load <= CONTACT_LOST)) * run.step for station, load in run.stations("wheel_load").items()
    }
    found = _choose(off, "s", max)
    return Number(0.0, "s", "the wheels keep contact") if found.value == 0.0 else found


def contact_loss_instant(run: Run) -> Number:
    """First instant at which a wheel leaves the road [s]; no value if none does."""
    lost = {station: load <= CONTACT_LOST for station, load in run.stations("wheel_load").items()}
    first = {station: float(run.time[np.argmax(off)]) for station, off in lost.items() if off.any()}
    if not lost:
        return _missing("wheel_load", "s")
    if not first:
        return Number(None, "s", "the wheels keep contact")
    station = min(first, key=lambda each: first[each])
    return Number(first[station], "s", station)


def travel_compression(run: Run) -> Number:
    """Largest suspension deflection in compression, from the design position [m]."""
    return _worst(run, "suspension_deflection", np.argmax, max)


def travel_rebound(run: Run) -> Number:
    """Largest suspension deflection in rebound, from the design position [m], negative."""
    return _worst(run, "suspension_deflection", np.argmin, min)


def travel_left_compression(run: Run) -> Number:
    """Smallest distance left to the compression stop [m], negative when pressed into it."""
    return _choose(
        {s: run.meta["travel"][s][1] - float(x.max()) for s, x in run.stations("suspension_deflection").items()},
        "m",
        min,
    )


def travel_left_rebound(run: Run) -> Number:
    """Smallest distance left to the rebound stop [m], negative when pulled into it."""
    return _choose(
        {s: float(x.min()) - run.meta["travel"][s][0] for s, x in run.stations("suspension_deflection").items()},
        "m",
        min,
    )


def travel_left_compression_front(run: Run) -> Number:
    """Smallest distance that a front wheel of a freely driving car keeps to its compression stop [m]."""
    return _travel_left(run, "front", 1)


def travel_left_compression_rear(run: Run) -> Number:
    """Smallest distance that a rear wheel of a freely driving car keeps to its compression stop [m]."""
    return _travel_left(run, "rear", 1)


def travel_left_rebound_front(run: Run) -> Number:
    """Smallest distance that a front wheel of a freely driving car keeps to its rebound stop [m]."""
    return _travel_left(run, "front", 0)


def travel_left_rebound_rear(run: Run) -> Number:
    """Smallest distance that a rear wheel of a freely driving car keeps to its rebound stop [m]."""
    return _travel_left(run, "rear", 0)


def stop_hits(run: Run) -> Number:
    """How many times a hard stop is hit, all wheels and both directions together."""
    deflections = run.stations("suspension_deflection")
    if not deflections:
        return _missing("suspension_deflection", "1")
    hits = 0
    for station, deflection in deflections.items():
        rebound, compression = run.meta["travel"][station]
        for touching in (deflection > compression, deflection < rebound):
            hits += int(touching[0]) + int(np.sum(touching[1:] & ~touching[:-1]))
    return Number(float(hits), "1")


def _travel_left(run: Run, axle: str, stop: int) -> Number:
    """Smallest distance of an axle's wheels to a stop, the worse wheel's, noting it and the instant."""
    if not drives(run):
        return Number(None, "m", "the car does not drive freely", applies=False)
    sign = 1.0 if stop else -1.0
    worst: tuple[float, str, float] | None = None
    for station in stations_of(axle):
        left = sign * (run.meta["travel"][station][stop] - run[f"{station}_suspension_deflection"])
        at = int(np.argmin(left))
        if worst is None or left[at] < worst[0]:
            worst = (float(left[at]), station, float(run.time[at]))
    return Number(None, "m", "no wheels") if worst is None else Number(worst[0], "m", f"{worst[1]} at {worst[2]:.2f} s")


def _is_smooth(run: Run) -> bool:
    """Whether a car has a road that does not shake it, or a rig holds it, so that its body's vertical motion has other
    causes."""
    if kind(run) in ("cross_slope", RIG):
        return True
    return drives(run) and not any(np.ptp(road) > 1e-9 for road in run.stations("road_height").values())


def _not_shaken(unit: str) -> Number:
    return Number(None, unit, "the road does not shake the car", applies=False)


def _missing(quantity: str, unit: str) -> Number:
    """Answer for a run that lacks a quantity."""
    return Number(None, unit, f"the run has no {quantity}", applies=False)


def _choose(values: dict[str, float], unit: str, choose: Callable[..., str]) -> Number:
    """The worst station's value, noting the station."""
    if not values:
        return Number(None, unit, "the run has no such channel", applies=False)
    station = choose(values, key=lambda each: values[each])
    return Number(values[station], unit, station)


def _extreme(run: Run, channel: str, pick: Callable[..., Any]) -> Number:
    if channel not in run:
        return _missing(channel, QUANTITIES[channel][0])
    if _is_smooth(run):
        return _not_shaken(QUANTITIES[channel][0])
    values = run[channel]
    at = int(pick(values))
    return Number(float(values[at]), run.channels[channel].unit, f"at {run.time[at]:.3f} s")


def _worst(run: Run, quantity: str, pick: Callable[..., Any], choose: Callable[..., str]) -> Number:
    """Extreme of a quantity over all stations, noting station and instant."""
    extremes = {s: (float(v[int(pick(v))]), float(run.time[int(pick(v))])) for s, v in run.stations(quantity).items()}
    unit = QUANTITIES[quantity][0]
    if not extremes:
        return _missing(quantity, unit)
    station = choose(extremes, key=lambda each: extremes[each][0])
    value, time = extremes[station]
    return Number(value, unit, f"{station} at {time:.3f} s".strip())


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def _final(values: np.ndarray) -> float:
    """Mean over the last 2 % of the run."""
    return float(values[-max(len(values) // 50, 1) :].mean())


def _comes_to_rest(run: Run) -> bool:
    """Whether the road stands still over the last 2 % of the run."""
    return all(np.ptp(road[-max(len(road) // 50, 2) :]) == 0.0 for road in run.stations("road_height").values())


def _first_input(run: Run) -> int | None:
    """Index of the last sample before any input moves, of the road or at the body."""
    driven = ("road_height",) if drives(run) else INPUTS
    inputs = [values for quantity in driven for values in run.stations(quantity).values()]
    moved = [np.flatnonzero(values != values[0]) for values in inputs]
    starts = [int(each[0]) for each in moved if len(each)]
    return max(min(starts) - 1, 0) if starts else None
