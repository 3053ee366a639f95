"""Hydraulic dampers from their resistances: laminar gaps, orifices, blow-off valves, in series and parallel (thesis
appendix 2).

A piston of effective area A that moves at v displaces the flow ``Q = A v`` through a hydraulic resistance, whose
pressure drop Δp acts back on it: ``F = A Δp``. Of a twin-tube damper, A is the ring area in rebound (piston valve) and
the rod's area in compression (bottom valve, the piston's check valve open); of a single-tube damper the ring area in
both. Gas force, cavitation and temperature are left out.
"""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, field, fields
from typing import Any

import numpy as np

from ..description import validate
from ..elements import TableDamper
from ..errors import InputError
from .given import positive

POINTS = 80
"""A characteristic is sampled at this many speeds in each direction, denser towards 0."""


class Resistance(ABC):
    """Pressure drop Δp [Pa] over the flow Q [m³/s], both from 0 upwards and rising together."""

    @abstractmethod
    def pressure(self, flow: float) -> float:
        """Δp [Pa] at Q [m³/s]."""

    @abstractmethod
    def flow(self, pressure: float) -> float:
        """Q [m³/s] at Δp [Pa]."""


def _quantity(unit: str, default: Any = None) -> Any:
    """Field of a resistance above 0 in SI `unit`; texts with a unit are read."""
    return field(metadata={"unit": unit}) if default is None else field(default=default, metadata={"unit": unit})


@dataclass(frozen=True)
class _Single(Resistance):
    """A resistance with dimensions of its own, read and checked when it is made."""

    def __post_init__(self) -> None:
        for each in fields(self):
            object.__setattr__(self, each.name, positive(getattr(self, each.name), each.metadata["unit"], each.name))


@dataclass(frozen=True)
class Laminar(_Single):
    """A round channel in laminar flow: ``Δp = 8 η l Q/(π r⁴)`` (Hagen-Poiseuille); a force in proportion to speed.

    Holds while ``2 ρ Q/(π r η)`` (Reynolds) stays below about 2300; several fine channels keep it there.

    Attributes:
        length: l [m].
        radius: r [m].
        viscosity: η [Pa s] of the oil, about 0.012 when it is warm.
    """

    length: float = _quantity("m")
    radius: float = _quantity("m")
    viscosity: float = _quantity("Pa s", 0.012)

    @property
    def resistance(self) -> float:
        """Δp/Q [Pa s/m³]."""
        return 8 * self.viscosity * self.length / (math.pi * self.radius**4)

    def pressure(self, flow: float) -> float:
        return self.resistance * flow

    def flow(self, pressure: float) -> float:
        return pressure / self.resistance


@dataclass(frozen=True)
class Orifice(_Single):
    """A sharp-edged hole in turbulent flow: ``Δp = ρ/2 (Q/(α A))²``; a force with the square of speed.

    Its slope at rest is 0: with a mount in series, put a laminar channel behind it, or the damper is infinitely fast
    there.

    Attributes:
        area: A [m²].
        coefficient: flow coefficient α.
        density: ρ [kg/m³] of the oil.
    """

    area: float = _quantity("m²")
    coefficient: float = _quantity("", 0.7)
    density: float = _quantity("kg/m³", 860.0)

    def pressure(self, flow: float) -> float:
        return self.density / 2 * (flow / (self.coefficient * self.area)) ** 2

    def flow(self, pressure: float) -> float:
        return self.coefficient * self.area * math.sqrt(2 * max(pressure, 0.0) / self.density)


@dataclass(frozen=True)
class BlowOff(_Single):
    """A preloaded valve: shut up to p0, then its plate lifts in proportion to the pressure until it is fully open at
    p1.

    ``Q = α A (Δp - p0)/(p1 - p0) sqrt(2 Δp/ρ)`` from p0 to p1, an orifice of area A above. The preload of its spring
    over the area of its plate is p0, the spring's rate decides p1. It needs a channel in parallel that is always open
    (a bleed).

    Attributes:
        opening_pressure: p0 [Pa].
        full_pressure: p1 [Pa], above p0.
        area: A [m²] when fully open.
        coefficient: flow coefficient α.
        density: ρ [kg/m³] of the oil.
    """

    opening_pressure: float = _quantity("Pa")
    full_pressure: float = _quantity("Pa")
    area: float = _quantity("m²")
    coefficient: float = _quantity("", 0.7)
    density: float = _quantity("kg/m³", 860.0)

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.full_pressure <= self.opening_pressure:
            message = (
                f"{self.full_pressure:g} Pa is not allowed; it must exceed the opening pressure of "
                f"{self.opening_pressure:g} Pa"
            )
            raise InputError(message, key="full_pressure")

    def pressure(self, flow: float) -> float:
        if flow <= 0:
            return self.opening_pressure
        wide = Orifice(self.area, self.coefficient, self.density).pressure(flow)
        return wide if wide >= self.full_pressure else _inverse(self.flow, flow, self.full_pressure)

    def flow(self, pressure: float) -> float:
        opened = (pressure - self.opening_pressure) / (self.full_pressure - self.opening_pressure)
        return min(max(opened, 0.0), 1.0) * Orifice(self.area, self.coefficient, self.density).flow(pressure)


class _Several(Resistance):
    """Resistances together."""

    def __init__(self, *parts: Resistance) -> None:
        if not parts or not all(isinstance(part, Resistance) for part in parts):
            raise InputError("give the resistances one after another", key=type(self).__name__)
        self.parts = parts


class Series(_Several):
    """One behind the other: the same flow through all, their pressure drops add up."""

    def pressure(self, flow: float) -> float:
        return sum(part.pressure(flow) for part in self.parts)

    def flow(self, pressure: float) -> float:
        return _inverse(self.pressure, pressure, min(part.flow(pressure) for part in self.parts))


class Parallel(_Several):
    """Side by side: the same pressure drop over all, their flows add up."""

    def pressure(self, flow: float) -> float:
        least = min(part.pressure(0.0) for part in self.parts)
        return max(least, _inverse(self.flow, flow, min(part.pressure(flow) for part in self.parts)))

    def flow(self, pressure: float) -> float:
        return sum(part.flow(pressure) for part in self.parts)


def _inverse(function: Callable[[float], float], value: float, highest: float) -> float:
    """Argument in 0 … `highest` at which a rising function has a value; 0 if it has more there already."""
    from scipy.optimize import brentq

    if highest <= 0 or function(0.0) >= value:
        return 0.0
    if function(highest) <= value:
        return highest
    root: Any = brentq(lambda each: function(each) - value, 0.0, highest, xtol=1e-15 * highest)
    return float(root)


def ring_area(piston_diameter: Any, rod_diameter: Any) -> float:
    """``π/4 (D² - d²)`` [m²]: the piston's surface on the side of the rod.

    Raises:
        InputError: the rod is as thick as the piston.
    """
    piston, rod = positive(piston_diameter, "m", "piston_diameter"), positive(rod_diameter, "m", "rod_diameter")
    if rod >= piston:
        raise InputError(f"{rod:g} m is not allowed; it must be below the piston's {piston:g} m", key="rod_diameter")
    return math.pi / 4 * (piston**2 - rod**2)


def rod_area(rod_diameter: Any) -> float:
    """``π/4 d²`` [m²]: what the rod displaces."""
    return math.pi / 4 * positive(rod_diameter, "m", "rod_diameter") ** 2


def hydraulic_damper(
    compression: Resistance,
    rebound: Resistance,
    *,
    compression_area: Any,
    rebound_area: Any,
    friction: float = 0.0,
    mount: float | None = None,
    largest_speed: Any = 1.5,
) -> TableDamper:
    """The damper itself, from the resistance and the effective area in each direction: ``F = A Δp(A v)``.

    Args:
        compression, rebound: what the oil flows through in either direction.
        compression_area, rebound_area: A [m²], see `ring_area` and `rod_area`.
        friction: Coulomb friction of rod and piston [N].
        mount: rate of the rubber mount [N/m], or None.
        largest_speed: of the table [m/s]; the last slope is continued beyond.

    Returns:
        Force [N] over the damper's own speed [m/s], compression positive; `damper_at_wheel` takes it to the wheel.

    Raises:
        InputError: a value out of range, or a direction that stays shut up to some force.
    """
    speed = positive(largest_speed, "m/s", "largest_speed") * (np.arange(1, POINTS + 1) / POINTS) ** 1.5
    forces = []
    for key, resistance, given in (("compression", compression, compression_area), ("rebound", rebound, rebound_area)):
        area = positive(given, "m²", f"{key}_area")
        shut = resistance.pressure(0.0)
        if shut > 0:
            raise InputError(
                f"shut up to {shut * area:.0f} N ({shut / 1e5:.1f} bar); put a channel beside its blow-off valve",
                key=key,
            )
        forces.append(area * np.array([resistance.pressure(area * v) for v in speed]))
    data: dict[str, Any] = {
        "speed": np.concatenate([-speed[::-1], speed]).tolist(),
        "force": np.concatenate([-forces[1][::-1], forces[0]]).tolist(),
        "friction": friction,
        "mount": None if mount is None else {"rate": mount},
    }
    return validate(TableDamper, data, key="damper")
