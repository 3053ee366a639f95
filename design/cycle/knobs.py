"""Knobs: what a cycle may turn at a car's springs, dampers and bars, read from a vehicle and written into one."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from susp_mj.elements import GRAVITY, ProgressiveSpring, ZonedDamper
from susp_mj.elements.dampers import ratio_of
from susp_mj.names import AXLES
from susp_mj.units import to_si
from vehicles.vehicle import Axle, Vehicle

Values = Mapping[str, "float | str"]
FIRST_LIMIT = 0.2
"""Speed [m/s] up to which the first damper rate holds where a car's damper has no zones."""


@dataclass(frozen=True)
class Knob:
    """Something that can be turned.

    Attributes:
        name: dotted, with its axle.
        unit: SI unit; empty for a ratio, which is a text like "1:2".
        part: of the axle that it belongs to: spring, damper, bar.
        text: what it is.
    """

    name: str
    unit: str
    part: str
    text: str

    def read(self, value: Any) -> float | str:
        """A value as files write it.

        Raises:
            ValueError: of another unit, not positive, or no ratio.
        """
        if self.unit == "":
            return ratio_text(ratio_of(value))
        number = to_si(value, self.unit)
        if number < 0 or (number == 0 and self.part != "bar"):
            raise ValueError(f"{number:g} {self.unit} is not allowed; it must be greater than 0")
        return number


_OF_AN_AXLE = (
    ("frequency", "Hz", "spring", "natural frequency in compression, at the design load"),
    ("rebound_rate", "N/m", "spring", "straight rate in rebound"),
    ("damping", "N s/m", "damper", "average damper rate up to the first zone limit"),
    ("ratio", "", "damper", "compression to rebound damping"),
    ("bar", "N/m", "bar", "rate of the anti-roll bar at the wheel"),
)
KNOBS: dict[str, Knob] = {
    f"{axle}.{name}": Knob(f"{axle}.{name}", unit, part, f"{axle} axle: {text}")
    for axle in AXLES
    for name, unit, part, text in _OF_AN_AXLE
}
REPAIRS = ("stiffer_compression", "stiffer_rebound", "softer_rebound", "more_damping")
"""What a missed target may ask for."""


def ratio_text(ratio: tuple[float, float]) -> str:
    """The ratio as a text, e.g. "1:2"."""
    return f"{ratio[0]:g}:{ratio[1]:g}"


def knobs_of(vehicle: Vehicle) -> dict[str, float | str]:
    """Where a car's own characteristics stand, whatever their kinds."""
    found: dict[str, float | str] = {}
    for name in AXLES:
        axle = vehicle.axle(name)
        spring, damper, speed = axle.spring, axle.damper, first_limit(axle)
        at_rest = float(spring.force_at(0.0))
        rise = float(spring.force_at(1e-4)) - at_rest
        stop = spring.stops.rebound
        compression, rebound = float(damper.force_at(speed)), -float(damper.force_at(-speed))
        found[f"{name}.frequency"] = (
            spring.frequency
            if isinstance(spring, ProgressiveSpring)
            else math.sqrt(rise / 1e-4 * GRAVITY / at_rest) / (2 * math.pi)
        )
        found[f"{name}.rebound_rate"] = (at_rest - float(spring.force_at(stop))) / -stop
        found[f"{name}.damping"] = (compression + rebound) / 2 / speed
        found[f"{name}.ratio"] = ratio_text(
            damper.ratio if isinstance(damper, ZonedDamper) else (compression / rebound, 1.0)
        )
        found[f"{name}.bar"] = axle.anti_roll_bar.rate if axle.anti_roll_bar is not None else 0.0
    return found


def first_limit(axle: Axle) -> float:
    """Speed [m/s] up to which the first damper rate holds."""
    damper = axle.damper
    return damper.limits[0] if isinstance(damper, ZonedDamper) and damper.limits else FIRST_LIMIT


def overrides(vehicle: Vehicle, values: Values, changed: set[str], above: tuple[float, float]) -> dict[str, Any]:
    """What to set in a vehicle file so that the changed knobs stand at their values; the rest stays the car's own.

    A spring becomes straight in rebound and of constant frequency in compression, keeping its own progression; a
    damper becomes one of zones, keeping mount, friction and first zone limit.

    Args:
        vehicle: the car that is changed.
        values: of all knobs.
        changed: names of those that are to be written.
        above: share of the first damper rate that holds beyond the first limit, and its least value [N s/m].
    """
    result: dict[str, Any] = {}
    for name in AXLES:
        axle = vehicle.axle(name)
        touched = {KNOBS[knob].part for knob in changed if knob.startswith(f"{name}.")}
        if "spring" in touched:
            result[f"{name}.spring"] = _spring(vehicle, axle, name, values)
        if "damper" in touched:
            result[f"{name}.damper"] = _damper(axle, name, values, above)
        if "bar" in touched:
            result[f"{name}.anti_roll_bar"] = {"rate": float(values[f"{name}.bar"])}
    return result


def _spring(vehicle: Vehicle, axle: Axle, name: str, values: Values) -> dict[str, Any]:
    spring = getattr(vehicle, name).spring  # as the file has it: without a preload of its own
    own = spring.model_dump(exclude_none=True) if isinstance(spring, ProgressiveSpring) else {}
    own.pop("rebound_force", None)
    return {
        **own,
        "kind": "progressive",
        "stops": axle.spring.stops.model_dump(exclude_none=True),
        "frequency": float(values[f"{name}.frequency"]),
        "rebound_rate": float(values[f"{name}.rebound_rate"]),
    }


def _damper(axle: Axle, name: str, values: Values, above: tuple[float, float]) -> dict[str, Any]:
    rate, (share, least) = float(values[f"{name}.damping"]), above
    kept = {key: value for key, value in axle.damper.model_dump(exclude_none=True).items() if key in _KEPT}
    return {
        **kept,
        "kind": "zoned",
        "rates": [rate, max(least, share * rate)],
        "limits": [first_limit(axle)],
        "ratio": str(values[f"{name}.ratio"]),
    }


_KEPT = ("friction", "mount")
"""Of a damper that is laid out anew."""
