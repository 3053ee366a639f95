"""Characteristics of a suspension, sampled from its spring and damper for plots and sheets."""

from __future__ import annotations

import inspect
from collections.abc import Iterator
from typing import Any

import numpy as np

from susp_mj.elements import GRAVITY

from .compare import Characteristic, ComponentDamper, ComponentSpring, ElementNote
from .tyre_curves import TyreCurves, tyre_curves

BEYOND_STOPS = 0.04
"""How far the samples reach beyond each stop, as a share of the travel."""
LARGEST_SPEED = 1.5
"""Damper speeds are sampled up to this, in compression and in rebound [m/s]."""


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
    """Natural frequency [Hz]; not a number where the spring carries nothing."""
    carries = spring.force_at(deflection) > 0
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
