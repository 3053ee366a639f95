"""Channels by names that do not depend on the model: ``fl suspension_deflection`` is found in any run."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from susp_mj.errors import InputError, choices
from susp_mj.names import AXLES, CORNERS, QUANTITIES, axle_of, channel_name, stand_ins
from susp_mj.run import Run

_HEAVE = {
    f"body_{motion}": (f"pitch_{angle}", f"roll_{angle}")
    for motion, angle in (("displacement", "angle"), ("velocity", "rate"), ("acceleration", "acceleration"))
}
"""Vertical motion of the body's centre of gravity -> the pitch and roll that move its other points."""


@dataclass(frozen=True)
class Found:
    """A channel that was asked for.

    Attributes:
        values: (n,) over the run's time.
        quantity: what it measures.
        unit: SI unit.
        note: what stands for it, where the run has no channel of just that name; else empty.
    """

    values: np.ndarray
    quantity: str
    unit: str
    note: str = ""


def channel_of(run: Run, name: str) -> Found:
    """The channel that a name means in a run, whatever its model.

    A name is a quantity, with a station before it where it has one: ``fl suspension_deflection``, ``roll_angle``. A
    wheel's is that of the wheel, else of its axle, else of the only wheel if that is on this axle; an axle's is the
    mean of left and right. The vertical motion of the body at a station is that above it, ``z - x pitch + y roll``
    with x, y from the centre of gravity.

    Raises:
        InputError: the run has no such channel; the text lists those it has.
    """
    asked = "_".join(name.split())
    if asked in run.channels:
        channel = run.channels[asked]
        return Found(channel.values, channel.quantity, channel.unit)
    station, quantity = _taken_apart(asked)
    found = _of_body(run, station, quantity) if quantity in _HEAVE and station else _of_wheels(run, station, quantity)
    if found is None:
        raise InputError(f"no channel '{name}'; {choices(run.channels, asked)}", source="run")
    return found


def _taken_apart(asked: str) -> tuple[str, str]:
    """Station and quantity of a name; both empty of one that is none."""
    station, _, quantity = asked.partition("_")
    if asked in QUANTITIES:
        return "", asked
    return (station, quantity) if station in (*CORNERS, *AXLES) and quantity in QUANTITIES else ("", "")


def _stations(run: Run, quantity: str) -> dict[str, str]:
    """Stations at which a run has a quantity; the only wheel under the name of its axle."""
    axles = run.meta.get("axles", {})
    return {station or axles.get("", ""): station for station in run.stations(quantity)}


def _of_wheels(run: Run, station: str, quantity: str) -> Found | None:
    offered = _stations(run, quantity)
    names = [channel_name(offered[each], quantity) for each in stand_ins(station, offered)] if station else []
    if not names:
        return None
    unit = run.channels[names[0]].unit
    what = names[0] if len(names) == 1 else f"the mean of {' and '.join(names)}"
    return Found(np.mean([run[each] for each in names], axis=0), quantity, unit, f"{station} {quantity}: {what}")


def _of_body(run: Run, station: str, quantity: str) -> Found | None:
    """Vertical motion of the body above a wheel or the middle of an axle."""
    axles, places = run.meta.get("axles", {}), run.meta.get("places", {})
    here = [places[each] for each, axle in axles.items() if station in (each, axle) or axle_of(station) == axle == each]
    if not here and "" in axles and axles[""] == axle_of(station):
        here = [places[""]]
    if not here or quantity not in run.channels:
        return None
    facts = run.meta["facts"]
    x, y = np.mean(here, axis=0) - [facts["cg_x"], facts.get("cg_y", 0.0)]
    values, terms = run[quantity].copy(), [quantity]
    for lever, part in zip((-x, y), _HEAVE[quantity], strict=True):
        if part in run.channels and abs(lever) > 1e-9:
            values += lever * run[part]
            terms.append(f"{lever:+.3f} m {part}")
    return Found(values, quantity, QUANTITIES[quantity][0], f"{station} {quantity}: {' '.join(terms)}")
