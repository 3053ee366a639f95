"""Shapes for pictures of whole cars: open hull with cockpit, roll bar, subframe; no physics uses them.

Lengths are in m; x points forward from the front axle, y to the left, z up from the road in the design position.
"""

from __future__ import annotations

import numpy as np

from .parts import Surface, loft, rounded_box, surface_of, tube

_END = 0.16
_RIM = 0.07


def hull(outline: np.ndarray, *, cockpit: tuple[float, float] | None = None, floor: float = 0.3) -> Surface:
    """Car body along x with rounded edges, its top open over the cockpit.

    Args:
        outline: (n, 4) stations from the tail to the nose: x, half width, underside, top [m].
        cockpit: where the opening begins and ends in x [m], or None for a closed body.
        floor: height of the cockpit's floor [m].
    """
    x, half, low, high = _smooth(outline)
    rings = []
    for station, width, bottom, top in zip(x, half, low, high, strict=True):
        open_by = _opening(station, cockpit)
        ring = _section(width, bottom, top, (top - floor) * open_by)
        near_end = min(station - x[0], x[-1] - station) / _END
        shrink = float(np.sqrt(max(1 - (1 - min(near_end, 1.0)) ** 2, 0.09)))
        middle = np.array([0.0, (bottom + top) / 2])
        rings.append(
            np.column_stack([np.full(len(ring), station), middle + (ring - middle) * [0.55 + 0.45 * shrink, shrink]])
        )
    return surface_of(loft(np.array(rings)))


def lining(outline: np.ndarray, cockpit: tuple[float, float], floor: float = 0.3) -> Surface:
    """Dark inside of the cockpit of `hull`, a few millimetres off its walls."""
    x, half, _, high = _smooth(outline)
    rings = []
    for station, width, top in zip(x, half, high, strict=True):
        if not cockpit[0] + 0.1 < station < cockpit[1] - 0.1:
            continue
        wall, edge = width - _RIM - 0.006, top - 0.03
        right = [
            (0.0, floor + 0.012),
            (wall - 0.012, floor + 0.012),
            (wall, edge),
            (wall + 0.004, edge),
            (wall - 0.004, floor + 0.004),
        ]
        ring = [*right, (0.0, floor + 0.004), *[(-y, z) for y, z in right[:0:-1]]]
        rings.append([(station, y, z) for y, z in ring])
    return surface_of(loft(np.array(rings)))


def roll_bar(half: float, foot: float, top: float) -> Surface:
    """Bent tube across the car, from `foot` up to `top` [m]."""
    turn = np.linspace(0.0, np.pi, 33)
    bend = np.column_stack(
        [np.zeros(33), half * np.sign(np.cos(turn)) * np.abs(np.cos(turn)) ** 0.6, np.sin(turn) ** 0.6]
    )
    bend[:, 2] = foot + (top - foot) * bend[:, 2]
    return surface_of(tube(bend, 0.022, 12))


def seat() -> Surface:
    """Seat with a leaning back, its cushion's middle at the origin."""
    back = rounded_box(0.12, 0.40, 0.52, 0.05)
    lean = np.array([[np.cos(0.3), 0, -np.sin(0.3)], [0, 1, 0], [np.sin(0.3), 0, np.cos(0.3)]])
    back = Surface(back.vertices @ lean.T + [-0.30, 0, 0.25], back.faces)
    return both(rounded_box(0.48, 0.40, 0.12, 0.05), back)


def arch(
    half: float, low: float, high: float, *, foot: float, depth: float, thickness: float, right_only: bool = False
) -> Surface:
    """Bridge across the car that carries the spring domes: two legs leaning outwards and a flat top, centred in x.

    Args:
        half: half of its span at the top [m].
        low, high: heights of its feet and of its upper side [m].
        foot: half of the span at the feet [m].
        depth: extent in x [m].
        thickness: of the legs and the top [m].
        right_only: leave the left half away.
    """
    outer = [(foot, low), (half - 0.02, high - 0.10), (half + 0.07, high - 0.045), (half + 0.07, high), (0.0, high)]
    inner = [(0.0, high - thickness), (half - thickness - 0.05, high - thickness), (foot - thickness, low)]
    left, right = np.array([*outer, *inner]), np.array([*outer, *inner])[::-1] * [-1, 1]
    parts = [right] if right_only else [left, right]
    return both(
        *(surface_of(loft(np.array([[(x, y, z) for y, z in part] for x in (-depth / 2, depth / 2)]))) for part in parts)
    )


def both(*parts: Surface) -> Surface:
    """Several surfaces as one."""
    starts = np.cumsum([0, *(len(part.vertices) for part in parts)])
    faces = [part.faces + start for part, start in zip(parts, starts, strict=False)]
    return Surface(np.concatenate([part.vertices for part in parts]), np.concatenate(faces).astype(np.int32))


def cut(surface: Surface, *, y: float) -> Surface:
    """What lies right of a plane y = const; the rest is pressed flat onto it [m]."""
    vertices = surface.vertices.copy()
    vertices[:, 1] = np.minimum(vertices[:, 1], y)
    return Surface(vertices, surface.faces)


def _smooth(outline: np.ndarray) -> tuple[np.ndarray, ...]:
    """Stations every 5 cm, denser at the ends, through the outline's points without overshoot."""
    from scipy.interpolate import PchipInterpolator

    start, end = float(outline[0, 0]), float(outline[-1, 0])
    rounded = _END * (1 - np.cos(np.linspace(0.0, np.pi / 2, 8)))
    middle = np.arange(start + _END + 0.05, end - _END - 0.02, 0.05)
    x = np.concatenate([start + rounded, middle, end - rounded[::-1]])
    return (x, *PchipInterpolator(outline[:, 0], outline[:, 1:])(x).T)


def _opening(x: float, cockpit: tuple[float, float] | None) -> float:
    """How far the top is sunk at x, from 0 to 1, with short slopes at both ends."""
    if cockpit is None:
        return 0.0
    share = float(np.clip(min((x - cockpit[0]) / 0.10, (cockpit[1] - x) / 0.16), 0.0, 1.0))
    return share**2 * (3 - 2 * share)


def _section(half: float, low: float, high: float, sunk: float) -> np.ndarray:
    """(k, 2) closed outline in (y, z): rounded edges, a crowned top, sunk inside the rim."""
    upper = min(_RIM - 0.01, 0.45 * (high - low))
    crown, rim = 0.05 * half, half - _RIM
    turn = np.linspace(0.0, np.pi / 2, 7)
    belt = low + 0.62 * (high - low)
    share = np.sin(np.linspace(0.0, np.pi / 2, 9))
    bulge = np.sqrt(1 - (1 - share) ** 2.4)
    flank = np.column_stack([half * (0.80 + 0.20 * bulge), low + (belt - low) * share**1.3])
    side = np.column_stack([half - upper * (1 - np.cos(turn)), high - crown - upper * (1 - np.sin(turn))])
    top = [
        (rim, high - 0.8 * crown),
        (rim - 0.008, high - 0.78 * crown - sunk),
        (0.5 * rim, high - 0.2 * crown - sunk),
        (0.0, high - sunk),
    ]
    right = np.vstack([[(0.0, low), (0.5 * half, low)], flank, side, top])
    return np.vstack([right, right[-2:0:-1] * [-1, 1]])
