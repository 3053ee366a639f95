"""Rates of a vehicle as pure functions: springs in roll, and the bars that a roll angle needs."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from susp_mj.elements import GRAVITY, Spring
from susp_mj.errors import InputError
from susp_mj.names import AXLES
from susp_mj.roll import bar_rate, required_roll_stiffness

from .vehicle import DESIGN_LOAD, Vehicle


def static_deflection(spring: Spring, force: float) -> float:
    """Deflection [m] at which a spring and its stops carry `force` [N] at rest."""
    return _root(lambda x: carried(spring, x) - force, spring)


def carried(spring: Spring, deflection: float) -> float:
    """Force [N] of a spring and its stops."""
    return float(spring.force_at(deflection) + spring.stops.evaluate(deflection))


def _root(excess: Callable[[float], float], spring: Spring) -> float:
    """Where a force that rises with the deflection vanishes: between the stops, or as far beyond as it takes."""
    from scipy.optimize import brentq

    reach = spring.stops.compression - spring.stops.rebound
    low, high = spring.stops.rebound - reach, spring.stops.compression + reach
    while excess(low) > 0 or excess(high) < 0:
        low, high = 2 * low, 2 * high
    return float(brentq(excess, low, high, xtol=1e-12))  # pyright: ignore[reportArgumentType]


def rate_around(spring: Spring, deflection: float, reach: float = 1e-3) -> float:
    """Mean rate [N/m] of a spring and its stops over `reach` [m] to both sides of a deflection: at a kink the mean of
    its sides."""
    return (carried(spring, deflection + reach) - carried(spring, deflection - reach)) / (2 * reach)


def static_rate(vehicle: Vehicle, axle: str, load: str) -> float:
    """Mean rate [N/m] of one wheel's spring over ±1 mm around its static deflection in a load case."""
    spring = vehicle.axle(axle).spring
    return rate_around(spring, static_deflection(spring, vehicle.corner_mass(axle, load) * GRAVITY))


def damping_ratio(vehicle: Vehicle, axle: str, load: str, damping: float) -> float:
    """Damping ratio of the body on one wheel's spring, ``D/(2 sqrt(k m))``, k over ±1 mm around the static deflection.

    Friction is left out.

    Args:
        damping: D [N s/m], the mean of compression and rebound.
    """
    return damping / (2 * math.sqrt(static_rate(vehicle, axle, load) * vehicle.corner_mass(axle, load)))


def roll_lever(vehicle: Vehicle, load: str = DESIGN_LOAD) -> float:
    """Sprung mass times the height of its centre of gravity above the roll axis, m h [kg m].

    Raises:
        InputError: the vehicle tells no roll centres, no wheel radius or no centre of gravity.
    """
    height = vehicle.cg_height(load)
    if height is None:
        raise InputError("is required for the roll of the body", key="wheel_radius", source=vehicle.source)
    lever = 0.0
    for name in AXLES:
        centre = vehicle.axle(name).roll_centre_height
        if centre is None:
            raise InputError(
                "is required for the roll of the body", key=f"{name}.roll_centre_height", source=vehicle.source
            )
        lever += 2 * vehicle.corner_mass(name, load) * (height - centre)
    return lever


def secant_rate(spring: Spring, load: float, travel: float) -> float:
    """Secant rate [N/m] of one wheel's spring and stops in pure roll, ``(F(u + s) - F(u - s)) / 2 s``.

    Args:
        spring: of one wheel, with its preload.
        load: F_0 [N] that the spring of either wheel carries on average; the heave u keeps it, so that springs that are
            stiffer in compression lift the body.
        travel: s [m] of each wheel, half the track times the roll angle.
    """
    u = _root(lambda u: carried(spring, u + travel) + carried(spring, u - travel) - 2 * load, spring)
    return (carried(spring, u + travel) - carried(spring, u - travel)) / (2 * travel)


@dataclass(frozen=True)
class RollNeeds:
    """What a roll angle at a lateral acceleration asks of the axles.

    Attributes:
        lever: m h [kg m].
        stiffness: K [N m/rad] of the whole car.
        needed: rate at the wheel in pure roll [N/m] of springs and bar together, by axle.
        springs: secant rate of the springs over the roll angle [N/m], by axle.
        bars: rate at the wheel [N/m] that is left to the bars; negative where the springs alone exceed the need.
    """

    lever: float
    stiffness: float
    needed: Mapping[str, float]
    springs: Mapping[str, float]
    bars: Mapping[str, float]


def roll_needs(
    vehicle: Vehicle, angle: float, lateral_acceleration: float, front_share: float, load: str = DESIGN_LOAD
) -> RollNeeds:
    """Bars that complete the springs of a car: ``c = 2 q K/t² - k``, with K of `required_roll_stiffness`.

    Args:
        angle: of roll of the suspension [rad].
        lateral_acceleration: [m/s²] at which it is to be reached.
        front_share: q of the front axle, of the whole roll stiffness; the rear axle has the rest.

    Raises:
        InputError: the vehicle tells too little of its roll; see `roll_lever`; or has no track.
    """
    lever = roll_lever(vehicle, load)
    stiffness = required_roll_stiffness(lever, lateral_acceleration, angle)
    needed, springs, bars = {}, {}, {}
    for name, share in zip(AXLES, (front_share, 1 - front_share), strict=True):
        axle = vehicle.axle(name)
        if axle.track is None:
            raise InputError("is required for the roll of the body", key=f"{name}.track", source=vehicle.source)
        load_on_wheel = vehicle.corner_mass(name, load) * GRAVITY
        springs[name] = secant_rate(axle.spring, load_on_wheel, axle.track / 2 * angle)
        needed[name] = bar_rate(stiffness, share, axle.track, 0.0)
        bars[name] = bar_rate(stiffness, share, axle.track, springs[name])
    return RollNeeds(lever, stiffness, needed, springs, bars)
