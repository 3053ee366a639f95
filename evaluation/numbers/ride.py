"""Numbers of vertical dynamics: body motion, suspension travel, wheel load.

Where a car has several wheels, the worst one counts and the note names
it.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from susp_mj.run import Run

from .number import Answer, Measure, Runs
from .runs import drives, is_a, on_rig, recorded

SETTLED_BAND = 0.05
"""Half-width of the settling band, as a share of the largest departure from the final value."""
INPUTS = ("road_height", "lateral_acceleration", "longitudinal_acceleration", "roll_target")
"""Quantities that drive a run."""
CONTACT_LOST = 1e-6
"""Wheel load [N] at or below which the wheel counts as off the road."""


def body_acceleration_max(run: Run) -> Answer:
    """Largest upward acceleration of the body [m/s²]."""
    return _extreme(run, "body_acceleration", np.argmax)


def body_acceleration_min(run: Run) -> Answer:
    """Largest downward acceleration of the body [m/s²], negative."""
    return _extreme(run, "body_acceleration", np.argmin)


def body_acceleration_rms(run: Run) -> Answer:
    """Root mean square of the body's vertical acceleration over the whole run [m/s²]."""
    return Answer(_rms(run["body_acceleration"]))


def body_displacement_max(run: Run) -> Answer:
    """Largest rise of the body above its initial height [m]."""
    displacement = run["body_displacement"]
    at = int(np.argmax(displacement))
    return Answer(float(displacement[at] - displacement[0]), f"at {run.time[at]:.3f} s")


def overshoot(run: Run) -> Answer:
    """Overshoot of the body over its final height, as a share of the final change: ``(z_max - z_end)/(z_end - z_0)``.

    Has no value where the body ends where it began, as after a bump.
    """
    displacement = run["body_displacement"] - run["body_displacement"][0]
    final = final_value(displacement)
    if abs(final) < 0.1 * float(np.abs(displacement).max()) or final == 0.0:
        return Answer(None, "the body returns to its initial height")
    return Answer(max(0.0, float((displacement / final).max()) - 1.0))


def settling_time(run: Run) -> Answer:
    """Time from the first input until the body stays within ±5 % of its largest departure from the final height, or
    where friction holds it [s].

    Friction holds the body where every spring's force differs by no more than the run's largest friction force from the
    final one: there it would rest, and what still moves is creep of the friction law.
    """
    displacement = run["body_displacement"]
    start = _first_input(run)
    departure = np.abs(displacement - final_value(displacement))
    band = SETTLED_BAND * float(departure.max())
    if band == 0.0 or start is None:
        return Answer(None, "nothing moves")
    outside = np.flatnonzero((departure > band) & ~_held_by_friction(run))
    if not len(outside) or outside[-1] < start:
        return Answer(0.0, "friction holds the body")
    if outside[-1] >= len(departure) - 2:
        return Answer(None, "not settled within the run")
    last = outside[-1] + 1
    within = f"within 5 % of {1000 * float(departure.max()):.1f} mm"
    if departure[last:].max() > band:
        within = f"friction holds it {1000 * float(departure[last]):.1f} mm from where it ends"
    return Answer(float(run.time[last] - run.time[start]), within)


def _held_by_friction(run: Run) -> np.ndarray:
    """(n,) whether friction can keep every spring from its final force; nowhere in a run without friction."""
    springs, frictions = run.stations("spring_force"), run.stations("friction_force")
    held = np.full(len(run.time), bool(springs) and springs.keys() == frictions.keys())
    for station, force in springs.items() if held.any() else ():
        held &= np.abs(force - final_value(force)) < np.abs(frictions[station]).max()
    return held


def wheel_load_min(run: Run) -> Answer:
    """Smallest wheel load [N]."""
    return _worst(run, "wheel_load", np.argmin, min)


def wheel_load_max(run: Run) -> Answer:
    """Largest wheel load [N]."""
    return _worst(run, "wheel_load", np.argmax, max)


def wheel_load_rms(run: Run) -> Answer:
    """Root mean square of the dynamic share of the wheel load, load minus initial load [N]."""
    return _choose({station: _rms(load - load[0]) for station, load in run.stations("wheel_load").items()}, max)


def contact_loss_time(run: Run) -> Answer:
    """Time for which a wheel is off the road, summed over the run [s]."""
    off = {
        station: float(np.sum(load <= CONTACT_LOST)) * run.step for station, load in run.stations("wheel_load").items()
    }
    found = _choose(off, max)
    return Answer(0.0, "the wheels keep contact") if found.value == 0.0 else found


def contact_loss_instant(run: Run) -> Answer:
    """First instant at which a wheel leaves the road [s]; no value if none does."""
    lost = {station: load <= CONTACT_LOST for station, load in run.stations("wheel_load").items()}
    first = {station: float(run.time[np.argmax(off)]) for station, off in lost.items() if off.any()}
    if not first:
        return Answer(None, "the wheels keep contact")
    station = min(first, key=lambda each: first[each])
    return Answer(first[station], station)


def travel_compression(run: Run) -> Answer:
    """Largest suspension deflection in compression, from the design position [m]."""
    return _worst(run, "suspension_deflection", np.argmax, max)


def travel_rebound(run: Run) -> Answer:
    """Largest suspension deflection in rebound, from the design position [m], negative."""
    return _worst(run, "suspension_deflection", np.argmin, min)


def travel_left_compression(run: Run) -> Answer:
    """Smallest distance left to the compression stop [m], negative when pressed into it."""
    return _choose(
        {s: run.meta["travel"][s][1] - float(x.max()) for s, x in run.stations("suspension_deflection").items()}, min
    )


def travel_left_rebound(run: Run) -> Answer:
    """Smallest distance left to the rebound stop [m], negative when pulled into it."""
    return _choose(
        {s: float(x.min()) - run.meta["travel"][s][0] for s, x in run.stations("suspension_deflection").items()}, min
    )


def stop_hits(run: Run) -> Answer:
    """How many times a hard stop is hit, all wheels and both directions together."""
    hits = 0
    for station, deflection in run.stations("suspension_deflection").items():
        rebound, compression = run.meta["travel"][station]
        for touching in (deflection > compression, deflection < rebound):
            hits += int(touching[0]) + int(np.sum(touching[1:] & ~touching[:-1]))
    return Answer(float(hits))


def _is_smooth(run: Run) -> bool:
    """Whether a car has a road that does not shake it, or a rig holds it, so that its body's vertical motion has other
    causes."""
    if on_rig(run) or is_a(run, "disturbance"):
        return True
    return drives(run) and not any(np.ptp(road) > 1e-9 for road in run.stations("road_height").values())


def _choose(values: dict[str, float], choose: Callable[..., str]) -> Answer:
    """The worst station's value, noting the station."""
    station = choose(values, key=lambda each: values[each])
    return Answer(values[station], station)


def _extreme(run: Run, channel: str, pick: Callable[..., Any]) -> Answer:
    values = run[channel]
    at = int(pick(values))
    return Answer(float(values[at]), f"at {run.time[at]:.3f} s")


def _worst(run: Run, quantity: str, pick: Callable[..., Any], choose: Callable[..., str]) -> Answer:
    """Extreme of a quantity over all stations, noting station and instant."""
    extremes = {s: (float(v[int(pick(v))]), float(run.time[int(pick(v))])) for s, v in run.stations(quantity).items()}
    station = choose(extremes, key=lambda each: extremes[each][0])
    value, time = extremes[station]
    return Answer(value, f"{station} at {time:.3f} s".strip())


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(values**2)))


def final_value(values: np.ndarray) -> float:
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


SHAKEN = Runs(lambda run: not _is_smooth(run), "the road does not shake the car")
COMES_TO_REST = Runs(_comes_to_rest, "the road never comes to rest")
ACCELERATED, DISPLACED = (recorded(name) & SHAKEN for name in ("body_acceleration", "body_displacement"))
LOADED, DEFLECTED = recorded("wheel_load"), recorded("suspension_deflection")
NUMBERS = (
    Measure(body_acceleration_max, "m/s²", ACCELERATED),
    Measure(body_acceleration_min, "m/s²", ACCELERATED),
    Measure(body_acceleration_rms, "m/s²", ACCELERATED),
    Measure(body_displacement_max, "m", DISPLACED),
    Measure(overshoot, "1", DISPLACED & COMES_TO_REST),
    Measure(settling_time, "s", DISPLACED & COMES_TO_REST),
    Measure(wheel_load_min, "N", LOADED),
    Measure(wheel_load_max, "N", LOADED),
    Measure(wheel_load_rms, "N", LOADED),
    Measure(contact_loss_time, "s", LOADED),
    Measure(contact_loss_instant, "s", LOADED),
    Measure(travel_compression, "m", DEFLECTED),
    Measure(travel_rebound, "m", DEFLECTED),
    Measure(travel_left_compression, "m", DEFLECTED),
    Measure(travel_left_rebound, "m", DEFLECTED),
    Measure(stop_hits, "1", DEFLECTED),
)
