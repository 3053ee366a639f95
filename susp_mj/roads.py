"""Roads: height along the distance travelled, one function a shape, and as a surface with friction for a car that
drives freely."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .features import Feature, Patch

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


ROAD_CLASSES: dict[str, float] = {letter: 16e-6 * 4**i for i, letter in enumerate("ABCDEFGH")}
"""ISO 8608 class -> geometric mean of the roughness Gd(n0) [m³] at n0 = 0.1 cycles/m."""
_COHERENCE: dict[str, tuple[float, float]] = {
    "A": (8.5, 3.5),
    "B": (5.3, 2.2),
    "C": (3.0, 1.3),
    "D": (1.6, 0.8),
    "E": (0.8, 0.5),
}
_REFERENCE = 0.1  # cycles/m
_SPACING = 0.02  # m; the cubic spline through the samples follows a wavelength of 0.1 m within 0.3 % of its amplitude


class RandomTracks:
    """Tracks of a random road: ``Gd(n) = Gd(n0) (n/n0)^-2`` between two wavelengths, random phases.

    A track at lateral position y is ``common sqrt(c) + own sqrt(1 - c)``, so that the cross spectrum of left and right
    is c times their own: near 1 for waves much longer than their distance b = 2 |y|, near 0 for much shorter ones. c²
    is the coherence ``(1 + (Omega b / Omega_p)²)^-p``, Omega = 2 pi n; classes F to H use the values of E.

    Args:
        road_class: ISO 8608 class, A to H.
        length: of the road [m].
        longest, shortest: wavelengths [m].
        lead_in: the road fades in over this distance [m].
        seed: of the random numbers.

    Source: ISO 8608:2016; the coherence's form and values after D. Ammon, Veh. Syst. Dyn. 20 (1992), as Project Chrono
    has them for its random terrain; that they are a squared coherence is our reading.
    """

    def __init__(
        self, road_class: str, length: float, longest: float, shortest: float, lead_in: float, seed: int
    ) -> None:
        count = int(2 ** np.ceil(np.log2(length / _SPACING)))
        self._period = count * _SPACING
        number = np.fft.rfftfreq(count, _SPACING)
        inside = (number >= 1 / longest) & (number <= 1 / shortest)
        density = np.zeros_like(number)
        density[inside] = ROAD_CLASSES[road_class] * (number[inside] / _REFERENCE) ** -2.0
        amplitude = np.sqrt(2 * density / self._period) * count / 2
        phases = np.random.default_rng(seed).uniform(0, 2 * np.pi, (3, len(number)))
        self._number, self._waves = number, amplitude * np.exp(1j * phases)
        self._coherence = _COHERENCE.get(road_class, _COHERENCE["E"])
        self._lead_in, self._count = lead_in, count
        self._splines: dict[float, Any] = {}

    def at(self, distance: np.ndarray, y: float) -> HeightAndSlope:
        """Height [m] and slope at distances [m] of the track at lateral position y [m]; flat before 0."""
        spline = self._spline(y)
        inside = np.clip(distance, 0.0, self._period - _SPACING)
        height, slope = spline(inside), spline(inside, 1)
        if self._lead_in > 0:
            fade, rise = cosine_ramp(inside / self._lead_in, 1.0)
            height, slope = fade * height, fade * slope + rise / self._lead_in * height
        ahead = distance > 0
        return np.where(ahead, height, 0.0), np.where(ahead, slope, 0.0)

    def shared(self, number: np.ndarray, y: float) -> np.ndarray:
        """Share c of the cross spectrum of left and right at wave numbers [cycles/m]."""
        corner, exponent = self._coherence
        return (1 + (2 * np.pi * number * 2 * abs(y) / corner) ** 2) ** (-exponent / 2)

    def _spline(self, y: float) -> Any:
        from scipy.interpolate import CubicSpline

        if y not in self._splines:
            common, left, right = self._waves
            share = self.shared(self._number, y)
            waves = common * np.sqrt(share) + (left if y >= 0 else right) * np.sqrt(1 - share)
            self._splines[y] = CubicSpline(np.arange(self._count) * _SPACING, np.fft.irfft(waves, self._count))
        return self._splines[y]


_HEAD, _PATCH = 9, 5
"""Numbers of `Road.block` before the patches, and of each patch."""


def _row(block: Sequence[float], first: int, x_place: float, last: int, rows: int, row: int) -> tuple[float, float]:
    """Height and slope over x of one row of the height field; a cubic through the points, level beyond the ends."""
    if x_place <= 0.0:
        return block[first + row], 0.0
    if x_place >= last:
        return block[first + last * rows + row], 0.0
    i = int(x_place)
    u = x_place - i
    before, after = max(i - 1, 0), min(i + 2, last)
    v0, v1 = block[first + i * rows + row], block[first + (i + 1) * rows + row]
    m0 = 0.5 * (v1 - block[first + before * rows + row])
    m1 = 0.5 * (block[first + after * rows + row] - v0)
    rise = v1 - v0
    c, d = 3.0 * rise - 2.0 * m0 - m1, m0 + m1 - 2.0 * rise
    return v0 + u * (m0 + u * (c + u * d)), (m0 + u * (2.0 * c + 3.0 * u * d)) / block[1]


def surface_at(block: Sequence[float], x: float, y: float) -> tuple[float, float, float, float]:
    """Height [m], slopes over x and y, and friction of `Road.block` at a place [m]; plain, and compiled in the car."""
    columns, rows, patches = int(block[2]), int(block[5]), int(block[8])
    friction = 1.0
    for i in range(patches):
        patch = _HEAD + _PATCH * i
        if block[patch] <= x < block[patch + 1] and block[patch + 2] <= y < block[patch + 3]:
            friction = block[patch + 4]
    first = _HEAD + _PATCH * patches
    x_place = (x - block[0]) / block[1]
    y_place = min(max((y - block[3]) / block[4], 0.0), rows - 1.0)
    j = min(int(y_place), max(rows - 2, 0))
    height, slope_x = _row(block, first, x_place, columns - 1, rows, j)
    slope_y = 0.0
    if rows > 1:
        left, left_slope = _row(block, first, x_place, columns - 1, rows, j + 1)
        share = y_place - j
        if 0.0 < y_place < rows - 1.0:
            slope_y = (left - height) / block[4]
        height, slope_x = height + share * (left - height), slope_x + share * (left_slope - slope_x)
    return height + block[6] * y, slope_x, slope_y + block[6], friction * block[7]


def _flat() -> np.ndarray:
    return np.zeros((2, 1))


@dataclass(frozen=True)
class Road:
    """Surface over which a car drives freely: a height field on a regular grid, friction patches, a cross slope.

    Between the grid points the height is a cubic (Catmull-Rom) over x and linear over y; outside it stays as at the
    edge, level in x. Where patches overlap the last one counts.

    Attributes:
        x: (n,) evenly spaced places along the road [m], n >= 2.
        y: (m,) evenly spaced places across it [m], + to the left; one value makes all tracks equal.
        height: (n, m) [m].
        patches: where it has another friction.
        cross_slope: rise per metre to the left [1].
        friction: of the whole road, as a factor on what the tyre was measured with; the patches' factors come on top.
        features: what else lies or stands on it, for pictures, plots and numbers.
    """

    x: np.ndarray = field(default_factory=lambda: np.array([0.0, 1.0]))
    y: np.ndarray = field(default_factory=lambda: np.array([0.0]))
    height: np.ndarray = field(default_factory=_flat)
    patches: tuple[Patch, ...] = ()
    cross_slope: float = 0.0
    friction: float = 1.0
    features: tuple[Feature, ...] = ()

    @property
    def shown(self) -> tuple[Feature, ...]:
        """What a run tells of the road: patches and features."""
        return (*self.patches, *self.features)

    def block(self) -> np.ndarray:
        """The road as the compiled car reads it; see `surface_at`."""
        spacing_y = self.y[1] - self.y[0] if len(self.y) > 1 else 1.0
        head = [
            self.x[0],
            self.x[1] - self.x[0],
            len(self.x),
            self.y[0],
            spacing_y,
            len(self.y),
            self.cross_slope,
            self.friction,
        ]
        head.append(len(self.patches))
        patches = [value for p in self.patches for value in (*p.x, *p.y, p.friction)]
        return np.concatenate([np.array(head, float), np.array(patches, float), np.asarray(self.height, float).ravel()])
