"""Progressive springs of steel and rubber: auxiliary springs, springs in series, coils of varying pitch (thesis
appendix 3).

Each function returns the component's force over its own travel from the design position, compression positive; the
force there is `preload`. `spring_at_wheel` takes it to the wheel. Every value is SI or a text with its unit. The curves
are straight between their kinks; a kink is rounded over a thousandth of the travel.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ..description import validate
from ..elements import Stops, TableSpring
from ..elements.element import FloatArray
from ..errors import InputError
from ..units import to_si
from .given import positive, positives

SHEAR_MODULUS = 78.5e9
"""Hot-rolled spring steel [Pa] (EN 13906-1)."""
ROUNDING = 1e-3


def auxiliary_springs(rate: Any, engagements: Any, rates: Any, *, preload: Any, stops: Stops) -> TableSpring:
    """A main spring and auxiliary springs beside it, each from its own deflection on (figure A3.1).

    ``F = F0 + k s + sum k_j (max(0, s - s_j) - max(0, -s_j))``: the forces superimpose, and F(0) = F0.

    Args:
        rate: k [N/m] of the main spring.
        engagements: travel s_j [m] from which each auxiliary spring acts; below 0 it acts in the design position
            already.
        rates: k_j [N/m] of the auxiliary springs.
        preload: F0 [N], all springs together.
        stops: of the component [m].

    Raises:
        InputError: a value out of range, or the spring is unloaded before the rebound stop.
    """
    main, force = positive(rate, "N/m", "rate"), positive(preload, "N", "preload")
    begins = _travels(engagements)
    stiffness = positives(rates, "N/m", "rates", len(begins))

    def characteristic(s: FloatArray) -> FloatArray:
        parts = [
            k * (np.maximum(0.0, s - begin) - max(0.0, -begin)) for begin, k in zip(begins, stiffness, strict=True)
        ]
        return force + main * s + np.sum(parts, axis=0)

    return _straight_pieces(characteristic, begins, stops)


def series_springs(rates: Any, travels: Any, *, preload: Any, stops: Stops) -> TableSpring:
    """Springs in series, each of which may become solid (figure A3.3).

    Two soft ones give ``c = c1 c2/(c1 + c2)``; once the first is coil-bound, at the force ``c1 b1``, the rate is that
    of the other. Any number works alike: ``1/c`` is the sum over those not solid.

    Args:
        rates: c_j [N/m].
        travels: b_j [m] from free to solid; None for a spring that never becomes solid.
        preload: force [N] in the design position, carried by each of them.
        stops: of the component [m].

    Raises:
        InputError: a value out of range, the springs are unloaded before the rebound stop, or all solid before the
            compression stop.
    """
    stiffness = positives(rates, "N/m", "rates")
    if isinstance(travels, str) or not hasattr(travels, "__len__") or len(travels) != len(stiffness):
        raise InputError(
            f"give one for each of {len(stiffness)} rates, None where a spring never becomes solid", key="travels"
        )
    free = [np.inf if each is None else positive(each, "m", f"travels.{i}") for i, each in enumerate(travels)]
    return _in_series(np.array(stiffness), np.array(free), positive(preload, "N", "preload"), stops)


def helical_spring(
    wire_diameter: Any,
    coil_diameter: Any,
    turns: Any,
    pitch: Any,
    *,
    preload: Any,
    stops: Stops,
    shear_modulus: Any = SHEAR_MODULUS,
) -> TableSpring:
    """A helical spring of segments with different pitch; the coils of small pitch become solid first (figures A3.2,
    A3.4).

    A segment of n turns has the rate ``c = G d⁴/(8 D³ n)`` and becomes solid after ``n (p - d)``; the segments are in
    series. Different coil diameters make a barrel; its coils are taken to become solid as those of a cylinder, not to
    sink into each other. Ends that lie flat are not active and do not count as turns.

    Args:
        wire_diameter: d [m], one value or one for each segment.
        coil_diameter: D [m], mean diameter of a coil, one value or one for each segment.
        turns: active turns n of the segments.
        pitch: p [m], distance of neighbouring coils, centre to centre, of the free spring, one for each segment.
        preload: force [N] in the design position.
        stops: of the component [m].
        shear_modulus: G [Pa].

    Raises:
        InputError: a value out of range, the spring is unloaded before the rebound stop or solid before the compression
            stop.
    """
    n = np.array(positives(turns, "", "turns"))
    count = len(n)
    d = np.array(positives(wire_diameter, "m", "wire_diameter", count))
    coil = np.array(positives(coil_diameter, "m", "coil_diameter", count))
    gap = np.array(positives(pitch, "m", "pitch", count)) - d
    if gap.min() <= 0:
        i = int(np.argmin(gap))
        raise InputError(f"{gap[i] + d[i]:g} m is not allowed; it must exceed the wire of {d[i]:g} m", key=f"pitch.{i}")
    if np.any(coil <= d):
        i = int(np.argmax(coil <= d))
        raise InputError(f"{coil[i]:g} m is not allowed; it must exceed the wire of {d[i]:g} m", key="coil_diameter")
    rate = positive(shear_modulus, "Pa", "shear_modulus") * d**4 / (8 * coil**3 * n)
    return _in_series(rate, n * gap, positive(preload, "N", "preload"), stops)


def _in_series(rate: FloatArray, travel: FloatArray, preload: float, stops: Stops) -> TableSpring:
    """Springs of given rates [N/m] and travels to solid [m], one behind the other."""
    solid = np.sort(np.unique(rate * travel))
    forces = np.concatenate([[0.0], solid[np.isfinite(solid)]])
    compressions = np.array([np.sum(np.minimum(force / rate, travel)) for force in forces])
    last = float(np.sum(1 / rate[np.isinf(travel)]))  # compliance when all that can be solid are
    if last > 0:
        forces = np.append(forces, forces[-1] + 1.0 / last)  # one metre further
        compressions = np.append(compressions, compressions[-1] + 1.0)
    if last == 0 and preload >= forces[-1]:
        raise InputError(f"{preload:.0f} N is not allowed; all coils are solid at {forces[-1]:.0f} N", key="preload")
    design = float(np.interp(preload, forces, compressions))
    if last == 0 and compressions[-1] - design < stops.compression:
        raise InputError(
            f"{stops.compression} m is not allowed; all coils are solid at {compressions[-1] - design:.4f} m",
            key="stops.compression",
        )
    if design + stops.rebound < 0:
        raise InputError(
            f"{stops.rebound} m is not allowed; the spring is unloaded at {-design:.4f} m", key="stops.rebound"
        )
    return _straight_pieces(
        lambda s: np.interp(design + s, compressions, forces), (compressions - design).tolist(), stops
    )


def _straight_pieces(
    characteristic: Callable[[FloatArray], FloatArray], kinks: list[float], stops: Stops
) -> TableSpring:
    """Table of a curve that is straight between its kinks [m]: each kink, a point on either side, and the stops."""
    low, high = stops.rebound, stops.compression
    least = 1e-6 * (high - low)
    inside = np.unique([each for each in kinks if low + least < each < high - least])
    corners = np.concatenate([[low], inside[np.diff(inside, prepend=low) > least], [high]])
    near = min(ROUNDING * (high - low), float(np.diff(corners).min()) / 3)
    nodes = np.unique(np.concatenate([corners, corners[1:-1] - near, corners[1:-1] + near]))
    force = characteristic(nodes)
    if force[0] < 0:
        unloaded = float(np.interp(0.0, force, nodes))
        raise InputError(f"{low} m is not allowed; the spring is unloaded at {unloaded:.4f} m", key="stops.rebound")
    return validate(TableSpring, {"deflection": nodes.tolist(), "force": force.tolist(), "stops": stops}, key="spring")


def _travels(values: Any) -> list[float]:
    if isinstance(values, str) or not hasattr(values, "__len__"):
        values = [values]
    try:
        return [to_si(each, "m") for each in values]
    except ValueError as error:
        raise InputError(str(error), key="engagements") from None
