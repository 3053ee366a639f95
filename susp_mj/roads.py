"""Road height as a function of the distance travelled, with its slope; plain numpy, one function a shape."""

from __future__ import annotations

import numpy as np

HeightAndSlope = tuple[np.ndarray, np.ndarray]


def cosine_bump(distance: np.ndarray, height: float, length: float) -> HeightAndSlope:
    """Cosine bump from 0 to `length`: ``z = h/2 (1 - cos(2 pi s/L))``, 0 elsewhere (thesis appendix 1).

    Args:
        distance: s [m] of any shape.
        height: h [m], negative for a dip.
        length: L [m].

    Returns:
        Height [m] and slope dz/ds.
    """
    angle = 2 * np.pi * np.clip(distance / length, 0.0, 1.0)
    return height / 2 * (1 - np.cos(angle)), np.pi * height / length * np.sin(angle)


def cosine_ramp(progress: np.ndarray, height: float) -> HeightAndSlope:
    """Half a cosine from 0 at progress 0 to `height` at progress 1, constant outside; slope per unit of progress."""
    angle = np.pi * np.clip(progress, 0.0, 1.0)
    return height / 2 * (1 - np.cos(angle)), np.pi * height / 2 * np.sin(angle)
