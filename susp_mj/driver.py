"""Driver who follows a path: what he knows of the path and how he steers; the compiled car carries him out."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True)
class Path:
    """Path over the ground, from the origin along the x axis.

    Attributes:
        x, y: (n,) evenly spaced x [m] and the path's y there [m]; straight on beyond the ends.
        radius: of a circle [m] that begins at x = 0, tangent to the x axis, positive to the left; then x and y are not
            used.
    """

    x: np.ndarray = field(default_factory=lambda: np.array([0.0, 1.0]))
    y: np.ndarray = field(default_factory=lambda: np.zeros(2))
    radius: float | None = None


@dataclass(frozen=True)
class Driver:
    """Preview driver: he looks `preview_time` ahead and steers the arc that leads from where he is to the path there.

    With e the lateral deviation of the path from the point that the car will reach if it goes on straight, L = v T the
    distance to it, and l + K v² the angle per curvature of the car (wheelbase and understeer),

        wanted = ratio (l + K v²) (2 e/L²),    lag d(angle)/dt = wanted - angle

    Attributes:
        path: what he follows.
        preview_time: T [s].
        lag: of his arms [s].
        understeer: K [rad s²/m] that he has learned of the car.

    Source: preview tracking as in [macadam1981], reduced to one point and one arc.
    """

    path: Path
    preview_time: float = 0.6
    lag: float = 0.08
    understeer: float = 0.0

    def block(self) -> np.ndarray:
        """The driver as the compiled car reads him; see `compiled.surroundings`."""
        path = self.path
        radius = 0.0 if path.radius is None else path.radius
        head = [self.preview_time, self.lag, self.understeer, radius, path.x[0], path.x[1] - path.x[0], len(path.x)]
        return np.concatenate([np.array(head, float), np.asarray(path.y, float)])
