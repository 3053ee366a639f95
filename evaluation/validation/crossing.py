"""A channel over another one: where both are compared, and the value of a noisy curve at such a point."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from susp_mj.errors import InputError

from .alignment import Trace

_FEWEST = 3
_POINTS = 6


def points_for(given: Sequence[float], abscissas: Sequence[Trace]) -> np.ndarray:
    """Abscissas at which curves are compared: those given, or round ones that all of them reach.

    Raises:
        InputError: there is none that all of them reach.
    """
    if given:
        return np.array(sorted(given))
    low = max(float(_rising(each).min()) for each in abscissas)
    high = min(float(_rising(each).max()) for each in abscissas)
    if high <= low:
        raise InputError("run and measurements share no values of it", key="over", source="validation")
    rough = (high - low) / _POINTS
    size = 10.0 ** np.floor(np.log10(rough))
    step = size * next(each for each in (1, 2, 5, 10) if each * size >= 0.7 * rough)
    points = step * np.arange(np.ceil(low / step), np.floor(high / step) + 1)
    room = step / 4
    return points[(points >= low + room) & (points <= high - room) & (np.abs(points) > room)]


def width_for(points: np.ndarray, given: float | None) -> float:
    """How far from a point values belong to it: as given, or a quarter of the points' distance.

    Raises:
        InputError: none is given and there is one point only.
    """
    if given is not None:
        return given
    if len(points) < 2:
        raise InputError("is needed where there is one point only", key="within", source="validation")
    return float(np.diff(points).min()) / 4


def values_at(points: np.ndarray, width: float, across: Trace, along: Trace, source: str) -> np.ndarray:
    """Values of a curve at some abscissas: of the straight line through what lies within `width` of each.

    What comes after the largest abscissa is another course back, and left out.

    Args:
        across, along: abscissa and ordinate over time.

    Raises:
        InputError: the curve has too little at a point.
    """
    x = _rising(across)
    y = np.interp(across.time[: len(x)], along.time, along.values)
    found = []
    for point in points:
        near = np.abs(x - point) <= width
        off = x[near] - point
        if len(off) < _FEWEST or off.min() > 0 or off.max() < 0:
            text = f"{source} has too few values within {width:.3g} of {point:g}"
            raise InputError(text, key="at", source="validation")
        found.append(np.polynomial.polynomial.polyfit(off, y[near], 1 if np.ptp(off) > 0 else 0)[0])
    return np.array(found)


def _rising(across: Trace) -> np.ndarray:
    """An abscissa up to where it is largest, to either side."""
    return across.values[: int(np.abs(across.values).argmax()) + 1]
