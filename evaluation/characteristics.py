"""Characteristics of a suspension, sampled from its spring and damper for plots and sheets."""

from __future__ import annotations

import inspect
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from susp_mj.elements import GRAVITY

from .tyre_curves import TyreCurves, tyre_curves

BEYOND_STOPS = 0.04
"""How far the samples reach beyond each stop, as a share of the travel."""
LARGEST_SPEED = 1.5
"""Damper speeds are sampled up to this, in compression and in rebound [m/s]."""


@dataclass(frozen=True)
class ElementNote:
    """Which law an element follows, for the equations of a report.

    Attributes:
        role: ``spring``, ``stops``, ``damper``, ``mount``, ``friction``, ``tyre`` or ``handling_tyre``.
        kind: its kind, as files write it.
        text: what its class says of itself.
    """

    role: str
    kind: str
    text: str


@dataclass(frozen=True)
class ComponentSpring:
    """The spring itself, where its motion ratio is known; arrays in SI, between the stops.

    Attributes:
        ratio: component travel per wheel travel in the design position.
        travel, force, rate: over the component's own travel from the design position, positive in compression.
    """

    ratio: float
    travel: Any
    force: Any
    rate: Any


@dataclass(frozen=True)
class ComponentDamper:
    """The damper itself, where its motion ratio is known, with the wheel in the design position; arrays in SI.

    Attributes:
        ratio: component travel per wheel travel in the design position.
        speed, force: of the component, positive in compression; hydraulic force.
    """

    ratio: float
    speed: Any
    force: Any


@dataclass(frozen=True)
class Characteristic:
    """Sampled characteristics of one suspension, for the F-x, rate, frequency and F-v plots; arrays in SI.

    Attributes:
        title: e.g. "rear axle".
        deflection, spring_force, spring_rate, spring_frequency: over the travel and a little beyond, the stops included
            in the force; rate and frequency belong to the spring alone and are not a number beyond the stops.
        speed, damper_force: hydraulic force over speed, without mount and friction.
        preload: [N].
        elements: what the suspension is made of.
        component_spring, component_damper: the same at the component, or None where no motion ratio is given.
        tyre: curves of the tyre with slip, or None where the car has none.
    """

    title: str
    deflection: Any
    spring_force: Any
    spring_rate: Any
    spring_frequency: Any
    speed: Any
    damper_force: Any
    preload: float
    elements: Sequence[ElementNote] = ()
    component_spring: ComponentSpring | None = None
    component_damper: ComponentDamper | None = None
    tyre: TyreCurves | None = None

    @property
    def stops(self) -> tuple[float, float]:
        """Deflections [m] of the rebound and the compression stop."""
        inside = self.deflection[np.isfinite(self.spring_rate)]
        return float(inside[0]), float(inside[-1])


def characteristic(title: str, axle: Any) -> Characteristic:
    """Sample the characteristics of one axle, effective at the wheel.

    Args:
        title: e.g. "rear axle".
        axle: what carries a ``spring`` with its preload and stops, and a ``damper``; ``friction``, ``tyre`` and
            ``handling_tyre`` may be None. A ``spring_ratio`` or ``damper_ratio`` adds the component's own
            characteristic.
    """
    spring, damper = axle.spring, axle.damper
    stops = spring.stops
    deflection = _deflections(stops.rebound, stops.compression)
    inside = (deflection >= stops.rebound) & (deflection <= stops.compression)
    speed = _speeds()
    return Characteristic(
        title=title,
        deflection=deflection,
        spring_force=spring.force_at(deflection) + stops.evaluate(deflection),
        spring_rate=np.where(inside, spring.rate_at(np.clip(deflection, stops.rebound, stops.compression)), np.nan),
        spring_frequency=np.where(
            inside, _frequency(spring, np.clip(deflection, stops.rebound, stops.compression)), np.nan
        ),
        speed=speed,
        damper_force=damper.force_at(speed),
        preload=float(spring.force_at(0.0)),
        elements=tuple(_notes(axle)),
        component_spring=_component_spring(spring, getattr(axle, "spring_ratio", None), deflection[inside]),
        component_damper=_component_damper(damper, getattr(axle, "damper_ratio", None), speed),
        tyre=_tyre(axle),
    )


def _tyre(axle: Any) -> TyreCurves | None:
    """Curves of the tyre with slip around the wheel load in the design position."""
    tyre = getattr(axle, "handling_tyre", None)
    if tyre is None:
        return None
    return tyre_curves(tyre, float(axle.spring.force_at(0.0)) + GRAVITY * (axle.unsprung_mass or 0.0))


def _component_spring(spring: Any, ratio: Any, deflection: np.ndarray) -> ComponentSpring | None:
    """The spring itself at wheel deflections [m] between the stops."""
    if ratio is None:
        return None
    force = spring.force_at(deflection)
    return ComponentSpring(
        ratio=float(ratio.at(0.0)),
        travel=ratio.component_travel(deflection),
        force=ratio.component_force(force, deflection),
        rate=ratio.component_rate(spring.rate_at(deflection), force, deflection),
    )


def _component_damper(damper: Any, ratio: Any, speed: np.ndarray) -> ComponentDamper | None:
    """The damper itself at wheel speeds [m/s], the wheel in the design position."""
    if ratio is None:
        return None
    return ComponentDamper(
        ratio=float(ratio.at(0.0)),
        speed=ratio.component_speed(speed),
        force=ratio.component_force(damper.force_at(speed), 0.0),
    )


def _deflections(rebound: float, compression: float) -> np.ndarray:
    """Sampled deflections [m]; the stops and the design position are among them."""
    reach = BEYOND_STOPS * (compression - rebound)
    ends = [rebound - reach, rebound, 0.0, compression, compression + reach]
    counts = (8, 120, 120, 9)
    return np.unique(
        np.concatenate([np.linspace(a, b, n) for a, b, n in zip(ends[:-1], ends[1:], counts, strict=True)])
    )


def _speeds() -> np.ndarray:
    """Sampled damper speeds [m/s], every centimetre per second, so that the usual zone limits are met."""
    count = round(LARGEST_SPEED * 100)
    return np.arange(-count, count + 1) / 100


def _frequency(spring: Any, deflection: np.ndarray) -> np.ndarray:
    """Natural frequency [Hz]; not a number where the spring carries nothing, or gives way."""
    carries = (spring.force_at(deflection) > 0) & (spring.rate_at(deflection) > 0)
    result = np.full(len(deflection), np.nan)
    result[carries] = spring.frequency_at(deflection[carries])
    return result


def _notes(axle: Any) -> Iterator[ElementNote]:
    """What the elements of an axle are, for the equations of the report."""
    for role in ("spring", "stops", "damper", "mount", "friction", "tyre", "handling_tyre"):
        holder = {"stops": axle.spring, "mount": axle.damper}.get(role, axle)
        element = getattr(holder, role, None)
        if element is not None:
            yield ElementNote(role, getattr(element, "kind", role), inspect.getdoc(type(element)) or "")
