"""Driver who follows a path: what he knows of the path, and how he steers."""

from __future__ import annotations

import math
from abc import ABC, abstractmethod
from collections.abc import MutableSequence
from dataclasses import dataclass, field
from typing import ClassVar

import numpy as np

from .law import Law, Parameters, Role, numbers_of

DRIVER = Role(
    "driver",
    ("x", "y", "heading", "speed", "angle", "ratio", "wheelbase", "limit"),
    ("angle_rate", "deviation"),
)
"""Of a driver: ``driver(x, y, heading, speed, angle, ratio, wheelbase, limit, p, out)`` with place [m], heading [rad]
and speed [m/s] of the car, the angle at which he holds the steering wheel [rad], and the car's steering ratio,
wheelbase [m] and largest angle of the steering wheel [rad]. It writes the rate at which he turns the steering wheel
[rad/s] and how far the car is to the left of his path [m]."""
PREVIEW, LAG, UNDERSTEER, RADIUS, BEGIN, SPACING, COUNT, PATH = range(8)
SHORTEST_LAG = 1e-3
"""Time [s] in which arms follow at best: what steps of 1 ms integrate."""
SLOWEST = 2.0
"""Speed [m/s] below which the driver looks no nearer ahead."""


def _path_at(p: Parameters, x: float) -> float:
    """The path's y at x [m]; straight on beyond the ends."""
    last = int(p[COUNT]) - 1
    place = (x - p[BEGIN]) / p[SPACING]
    if place <= 0.0:
        return p[PATH]
    if place >= last:
        return p[PATH + last]
    i = int(place)
    return p[PATH + i] + (place - i) * (p[PATH + 1 + i] - p[PATH + i])


def _deviation(p: Parameters, x: float, y: float) -> float:
    """How far a place is to the left of the path [m]."""
    radius = p[RADIUS]
    if radius != 0.0:
        inside = abs(radius) - math.hypot(x, y - radius)
        return inside if radius > 0.0 else -inside
    return y - _path_at(p, x)


def preview_driver(
    x: float,
    y: float,
    heading: float,
    speed: float,
    angle: float,
    ratio: float,
    wheelbase: float,
    limit: float,
    p: Parameters,
    out: MutableSequence[float],
) -> None:
    """The formulas of `PreviewDriver`; p = T, lag, K, radius; begin, spacing, number and y of the path's points."""
    ahead = max(speed, SLOWEST) * p[PREVIEW]
    error = -_deviation(p, x + ahead * math.cos(heading), y + ahead * math.sin(heading))
    if p[RADIUS] == 0.0:
        error *= math.cos(heading)
    wanted = ratio * (wheelbase + p[UNDERSTEER] * speed * speed) * 2.0 * error / (ahead * ahead)
    wanted = min(max(wanted, -limit), limit)
    out[0] = (wanted - angle) / max(p[LAG], SHORTEST_LAG)
    out[1] = _deviation(p, x, y)


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


class Driver(ABC):
    """Driver of a manoeuvre. A subclass provides the class attribute `law` and `parameters`; see `DRIVER`."""

    role: ClassVar[Role] = DRIVER
    law: ClassVar[Law]

    @abstractmethod
    def parameters(self) -> tuple[float, ...]:
        """Numbers handed to the law, SI, in the law's own order."""

    def block(self) -> np.ndarray:
        """The driver as the compiled car reads him: the number of his law, then its parameters."""
        return np.array([float(self.law.number), *numbers_of(self)])


@dataclass(frozen=True)
class PreviewDriver(Driver):
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

    law: ClassVar[Law] = Law("preview_driver", preview_driver, role=DRIVER)

    path: Path
    preview_time: float = 0.6
    lag: float = 0.08
    understeer: float = 0.0

    def parameters(self) -> tuple[float, ...]:
        path = self.path
        radius = 0.0 if path.radius is None else path.radius
        begin, spacing = float(path.x[0]), float(path.x[1] - path.x[0])
        points = np.asarray(path.y, float).tolist()
        return (self.preview_time, self.lag, self.understeer, radius, begin, spacing, float(len(path.x)), *points)
