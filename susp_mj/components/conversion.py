"""Springs and dampers taken from the wheel to the component, and from the component to the wheel, as tables."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..description import validate
from ..elements import Damper, HydraulicDamper, Spring, TableDamper, TableSpring
from ..elements.element import FloatArray
from ..errors import InputError
from .motion_ratio import MotionRatio

POINTS = 201
"""A curve is sampled at this many travels between its stops, and at the points of its own table."""


def spring_at_component(spring: Spring, ratio: MotionRatio) -> TableSpring:
    """The spring itself, from its characteristic at the wheel: ``F_comp(s) = F_wheel(x)/i(x)`` over ``s(x) = ∫ i dx``.

    Args:
        spring: effective at the wheel, with its preload.
        ratio: of the spring.

    Returns:
        Force [N] over the spring's own travel [m] from the design position, its stops where the wheel's are. Their rate
        is divided by i² of the design position.

    Raises:
        InputError: the ratio rises so fast that the component would have to soften as it is compressed, or the spring
            has no preload yet.
    """
    x = _sampled(spring, ratio.travel)
    force = ratio.component_force(_force(spring, x), x)
    return _table(spring, ratio.component_travel(x), force, float(ratio.at(0.0)) ** -2, "component")


def spring_at_wheel(spring: Spring, ratio: MotionRatio) -> TableSpring:
    """A spring's characteristic effective at the wheel, from its own: ``F_wheel(x) = i(x) F_comp(s(x))``.

    Args:
        spring: of the component, its travel and stops [m] those of the component.
        ratio: of the spring.

    Raises:
        InputError: the ratio falls so fast that the wheel would lose force in compression, or the spring has no
            preload.
    """
    s = _sampled(spring, ratio.component_travel(ratio.travel))
    x = ratio.wheel_travel(s)
    return _table(spring, x, ratio.wheel_force(_force(spring, s), x), float(ratio.at(0.0)) ** 2, "wheel")


def damper_at_component(damper: Damper, ratio: MotionRatio, travel: float = 0.0) -> TableDamper:
    """The damper itself, from its characteristic at the wheel: ``v_comp = i v_wheel``, ``F_comp = F_wheel/i``.

    Friction of the rod becomes ``F_f/i``, the rate of the mount ``k1/i²``.

    Args:
        travel: wheel travel [m] at which i is taken; a single curve over speed belongs to one position of the wheel.
    """
    return _damper(damper, float(ratio.at(travel)))


def damper_at_wheel(damper: Damper, ratio: MotionRatio, travel: float = 0.0) -> TableDamper:
    """A damper's characteristic effective at the wheel: ``v_wheel = v_comp/i``, ``F_wheel = i F_comp`` at a wheel
    travel [m]."""
    return _damper(damper, 1.0 / float(ratio.at(travel)))


def _damper(damper: Damper, i: float) -> TableDamper:
    (v_c, f_c), (v_r, f_r) = damper.lines()
    if f_c[0] != 0.0:
        raise InputError(f"pushes with {f_c[0]:g} N at rest; only the spring may carry the body", key="damper")
    speed, force = np.concatenate([-v_r[:0:-1], v_c[1:]]), np.concatenate([-f_r[:0:-1], f_c[1:]])
    fields = {"speed": (speed * i).tolist(), "force": (force / i).tolist()}
    if isinstance(damper, HydraulicDamper):
        fields["friction"] = damper.friction / i
        if damper.mount is not None:
            fields["mount"] = {"rate": damper.mount.rate / i**2}
    return validate(TableDamper, fields, key="damper")


def _table(spring: Spring, deflection: FloatArray, force: FloatArray, factor: float, side: str) -> TableSpring:
    """Table on the other side of the ratio; `factor` takes the rate of the stops there."""
    falls = np.flatnonzero(np.diff(force) <= 0)
    if len(falls):
        raise InputError(
            f"the force at the {side} would fall from {force[falls[0]]:.0f} N as it is compressed beyond "
            f"{1000 * deflection[falls[0]]:.1f} mm; the ratio changes too fast for this spring",
            key="ratio",
        )
    ends = {"rebound": float(deflection[0]), "compression": float(deflection[-1]), "rate": spring.stops.rate * factor}
    return validate(
        TableSpring, {"deflection": deflection.tolist(), "force": force.tolist(), "stops": ends}, key="spring"
    )


def _force(spring: Spring, travel: FloatArray) -> FloatArray:
    try:
        return spring.force_at(travel)
    except ValueError as error:
        raise InputError(str(error), key="spring") from None


def _sampled(spring: Spring, others: ArrayLike) -> FloatArray:
    """Travels between the stops: both stops, a spring's own table, `others` (points of the ratio), a grid between
    them."""
    low, high = spring.stops.rebound, spring.stops.compression
    own = spring.deflection if isinstance(spring, TableSpring) else ()
    fixed = np.unique(np.concatenate([[low, 0.0, high], own, np.asarray(others, float)]))
    fixed = fixed[(fixed >= low) & (fixed <= high)]
    fixed = fixed[np.concatenate([[True], np.diff(fixed) > 1e-9 * (high - low)])]
    if len(fixed) > 500 - POINTS:
        return fixed
    grid = np.linspace(low, high, POINTS)
    distance = np.abs(grid[:, None] - fixed).min(axis=1)
    return np.sort(np.concatenate([fixed, grid[distance > 0.25 * (grid[1] - grid[0])]]))
