"""Roads of manoeuvres as sampled surfaces, for a car that drives freely."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from susp_mj.errors import InputError
from susp_mj.features import Feature
from susp_mj.roads import Road

SPACING = 0.02
"""Distance of samples along the road [m]; the cubic through them follows a wavelength of 0.2 m within 0.4 %."""


SHORTEST, LONGEST = 0.2, 20e3
"""Lengths [m] of what lies on a road that samples can describe."""


def check_length(length: float, key: str) -> None:
    """Refuse a length [m] between samples, or one that would take too many; `key` is its parameter.

    Raises:
        InputError: with the lengths that are allowed.
    """
    if not SHORTEST <= length <= LONGEST:
        text = (
            f"{length:g} m is not allowed for a car that drives freely; it must be from {SHORTEST:g} m to "
            f"{LONGEST / 1e3:g} km"
        )
        raise InputError(text, key=key, source="manoeuvre")


def sampled(
    height: Callable[[np.ndarray, float], np.ndarray],
    begin: float,
    end: float,
    across: tuple[float, ...] = (0.0,),
    features: tuple[Feature, ...] = (),
) -> Road:
    """Road from a height over place and lateral position; it goes on as at its ends.

    Args:
        height: height [m] at places x (n,) [m] and one lateral position y [m].
        begin, end: what to sample along the road [m]; a few samples more are taken on both sides.
        across: lateral positions [m], one, or two for a left and a right track.
        features: what lies on it.
    """
    x = begin + SPACING * np.arange(-4, int(np.ceil((end - begin) / SPACING)) + 5)
    return Road(x, np.array(across), np.column_stack([height(x, y) for y in across]), features=features)
