"""Flat shapes that lie on the proving ground: strips, plates, cones, and the hills around it; triangles from plain
numpy."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Sheet:
    """Triangles: (n, 3) vertices [m], (m, 3) vertex numbers, (n, 3) normals."""

    vertices: np.ndarray
    faces: np.ndarray
    normals: np.ndarray


_DEPTH = 0.02


def strip(
    points: np.ndarray, width: float, height: float | np.ndarray = 0.0, offset: float = 0.0, bottom: float | None = None
) -> Sheet:
    """A strip of a width along (n, 2) points, its top at a height and its sides down to a `bottom`, moved left by an
    `offset` [m]."""
    along = np.gradient(points, axis=0)
    along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-9)
    left = np.column_stack([-along[:, 1], along[:, 0]])
    high = np.broadcast_to(height, (len(points),))
    edges = [points + (offset + side * width / 2) * left for side in (-1.0, 1.0)]
    low = high - _DEPTH if bottom is None else np.full(len(points), bottom)
    rings = np.stack(
        [np.column_stack([edges[k], z]) for z, k in ((low, 0), (high, 0), (high, 0), (high, 1), (high, 1), (low, 1))],
        axis=1,
    )
    distance = np.concatenate([[0.0], np.cumsum(np.maximum(np.linalg.norm(np.diff(points, axis=0), axis=1), 1e-9))])
    up = np.column_stack([-np.gradient(high, distance)[:, None] * along, np.ones(len(points))])
    up /= np.linalg.norm(up, axis=1, keepdims=True)
    out = np.column_stack([left, np.zeros(len(points))])
    return _extruded(rings, np.stack([-out, -out, up, up, out, out], axis=1))


def dashes(
    points: np.ndarray, width: float, height: float, length: float, gap: float, offset: float = 0.0
) -> list[Sheet]:
    """Dashes of a length with a gap [m] along (n, 2) points."""
    distance = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    sheets = []
    for start in np.arange(0.0, distance[-1] - length, length + gap):
        places = np.linspace(start, start + length, 4)
        sheets.append(
            strip(np.column_stack([np.interp(places, distance, points[:, k]) for k in range(2)]), width, height, offset)
        )
    return sheets


def circle(x: float, y: float, radius: float, count: int = 181) -> np.ndarray:
    """(n, 2) points of a circle [m]."""
    turn = np.linspace(0.0, 2 * np.pi, count)
    return np.column_stack([x + radius * np.cos(turn), y + radius * np.sin(turn)])


def plate(x: tuple[float, float], y: tuple[float, float], height: float) -> Sheet:
    """A rectangle whose upper side lies at a height [m]."""
    middle = (y[0] + y[1]) / 2
    return strip(np.array([[x[0], middle], [x[1], middle]]), abs(y[1] - y[0]), height)


def frame(x: tuple[float, float], y: tuple[float, float], width: float, height: float) -> list[Sheet]:
    """The border of a rectangle [m]."""
    (left, right), (low, high) = sorted(x), sorted(y)
    across = [plate((a, a + width), (low, high), height) for a in (left, right - width)]
    return [*across, *(plate((left, right), (b, b + width), height + 0.001) for b in (low, high - width))]


def cone(height: float = 0.50, foot: float = 0.15) -> Sheet:
    """A traffic cone standing at the origin, without its band [m]."""
    return _turned([(foot, 0.03), (0.028, height), (0.0, height)])


def cone_band(height: float = 0.50, foot: float = 0.15) -> Sheet:
    """The white band around a `cone` [m]."""

    def radius(share: float) -> float:
        return foot + (0.028 - foot) * share + 0.004

    return _turned([(radius(0.42), 0.03 + 0.42 * (height - 0.03)), (radius(0.72), 0.03 + 0.72 * (height - 0.03))])


def hills(radius: float, low: float, high: float, waves: Sequence[tuple[int, float, float]]) -> Sheet:
    """A ring of hills around the origin, seen from within: `waves` are number around, share and phase."""
    turn = np.linspace(0.0, 2 * np.pi, 361)
    shape = sum((share * np.sin(number * turn + phase) for number, share, phase in waves), np.zeros_like(turn))
    top = low + (high - low) * np.clip(0.5 + 0.5 * shape, 0.0, 1.0)
    foot = np.column_stack([radius * np.cos(turn), radius * np.sin(turn), np.full_like(turn, -1.0)])
    vertices = np.concatenate([foot, foot * [0.985, 0.985, 0.0] + np.column_stack([0 * turn, 0 * turn, top])])
    one = np.arange(360)
    faces = np.concatenate(
        [np.column_stack([one, one + 361, one + 1]), np.column_stack([one + 1, one + 361, one + 362])]
    )
    normals = np.tile(np.column_stack([-0.7 * np.cos(turn), -0.7 * np.sin(turn), np.full_like(turn, 0.71)]), (2, 1))
    return Sheet(vertices, faces.astype(np.int32), normals)


def disc(half_length: float, half_width: float, exponent: float = 3.0, height: float = 0.0) -> Sheet:
    """A flat superellipse around the origin [m]."""
    turn = np.linspace(0.0, 2 * np.pi, 49)[:-1]
    x, y = (np.sign(part) * np.abs(part) ** (2 / exponent) for part in (np.cos(turn), np.sin(turn)))
    rim = np.column_stack([half_length * x, half_width * y, np.full(48, height)])
    vertices = np.concatenate([rim, [[0.0, 0.0, height], [0.0, 0.0, height - _DEPTH]]])
    one, other = np.arange(48), np.roll(np.arange(48), -1)
    faces = np.concatenate(
        [np.column_stack([one, other, np.full(48, 48)]), np.column_stack([other, one, np.full(48, 49)])]
    )
    return Sheet(vertices, faces.astype(np.int32), np.tile([0.0, 0.0, 1.0], (50, 1)))


def together(sheets: Sequence[Sheet]) -> Sheet:
    """Several sheets as one."""
    starts = np.cumsum([0, *(len(each.vertices) for each in sheets)])
    faces = [each.faces + start for each, start in zip(sheets, starts, strict=False)]
    return Sheet(
        np.concatenate([each.vertices for each in sheets]),
        np.concatenate(faces).astype(np.int32),
        np.concatenate([e.normals for e in sheets]),
    )


def _extruded(rings: np.ndarray, normals: np.ndarray) -> Sheet:
    """Right wall, top and left wall between (n, 6, 3) rings of points, two for each of them, with their normals."""
    count = len(rings)
    one, other = np.meshgrid(np.arange(count - 1), np.array([0, 2, 4]), indexing="ij")
    a = one * 6 + other
    faces = np.concatenate(
        [np.stack([a, a + 6, a + 7], axis=-1).reshape(-1, 3), np.stack([a, a + 7, a + 1], axis=-1).reshape(-1, 3)]
    )
    return Sheet(rings.reshape(-1, 3), faces.astype(np.int32), normals.reshape(-1, 3))


def _turned(outline: Sequence[tuple[float, float]], sections: int = 20) -> Sheet:
    """Body of revolution about z from its outline: (radius, height) [m], from below upwards."""
    turn = np.linspace(0.0, 2 * np.pi, sections + 1)
    radii, heights = np.array(outline).T
    grid = np.stack(
        [
            radii[:, None] * np.cos(turn),
            radii[:, None] * np.sin(turn),
            np.repeat(heights[:, None], sections + 1, axis=1),
        ],
        axis=-1,
    )
    slope = np.gradient(radii, np.maximum.accumulate(heights + 1e-6 * np.arange(len(heights))))
    normals = np.stack(
        [
            np.repeat(np.cos(turn)[None], len(radii), 0),
            np.repeat(np.sin(turn)[None], len(radii), 0),
            -np.repeat(slope[:, None], sections + 1, 1),
        ],
        axis=-1,
    )
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    one, other = np.meshgrid(np.arange(len(radii) - 1), np.arange(sections), indexing="ij")
    a = one * (sections + 1) + other
    below = np.stack([a, a + 1, a + sections + 2], axis=-1).reshape(-1, 3)
    above = np.stack([a, a + sections + 2, a + sections + 1], axis=-1).reshape(-1, 3)
    return Sheet(grid.reshape(-1, 3), np.concatenate([below, above]).astype(np.int32), normals.reshape(-1, 3))
