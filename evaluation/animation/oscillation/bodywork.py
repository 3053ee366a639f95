"""Bodywork of a car with several wheels: an open hull with seats, or a platform with ballast above a single axle."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..picture import Picture
from ..shapes import tub
from ..shapes.parts import Surface, rounded_box
from .pose import Layout


def _outline(layout: Layout) -> np.ndarray:
    """Stations of the hull from the tail to the nose: x, half width, underside, top [m]."""
    rear, front = layout.rear, layout.front
    if layout.one_axle:
        half = layout.half_track - 0.13
        return np.array(
            [(rear - 0.60, 0.95 * half, 0.69, 0.87), (rear, half, 0.675, 0.88), (front + 0.60, 0.95 * half, 0.69, 0.87)]
        )
    slim, wide = layout.half_track - 0.36, layout.half_track + 0.03
    return np.array(
        [
            (rear - 0.66, 0.88 * slim, 0.42, 0.70),
            (rear - 0.40, slim, 0.28, 0.77),
            (rear, slim, 0.21, 0.79),
            (rear + 0.40, slim + 0.01, 0.18, 0.77),
            (rear + 0.74, wide, 0.17, 0.72),
            (0.5 * (rear + front), wide, 0.165, 0.67),
            (front - 0.95, wide - 0.03, 0.17, 0.67),
            (front - 0.43, slim + 0.01, 0.19, 0.68),
            (front, slim, 0.20, 0.65),
            (front + 0.45, 0.84 * slim, 0.24, 0.56),
            (front + 0.86, 0.55 * slim, 0.30, 0.44),
        ]
    )


def bodywork(picture: Picture, layout: Layout) -> None:
    """Hull with cockpit, seats, roll bar, lamps, and a bridge over each axle that carries the spring domes."""
    picture.material("glow", (0.98, 0.97, 0.9), 0.9, 0.9)
    picture.material("tail", (0.62, 0.05, 0.06), 0.6, 0.6)
    picture.material("leather", (0.24, 0.2, 0.18), 0.1, 0.2)
    body, half_only = picture.posed("body"), layout.one_sided

    def add(name: str, surface: Surface, material: str, pos: Sequence[float] = (0, 0, 0), behind: float = 0.0) -> None:
        moved = Surface(surface.vertices + np.array([pos[0], pos[1] + layout.middle, pos[2]]), surface.faces)
        picture.mesh(body, name, tub.cut(moved, y=layout.middle - behind) if half_only else moved, material)

    outline = _outline(layout)
    if layout.one_axle:
        add("hull", tub.hull(outline), "paint")
        for number in range(3):
            ballast = rounded_box(0.62 - 0.05 * number, 0.72 - 0.05 * number, 0.06, 0.012)
            add(
                f"ballast{number}",
                ballast,
                ("dark", "steel", "dark")[number],
                (layout.front, 0, outline[1, 3] + 0.03 + 0.062 * number),
            )
        return
    cockpit, floor = (layout.rear + 0.62, layout.front - 0.62), 0.34
    add("hull", tub.hull(outline, cockpit=cockpit, floor=floor), "paint")
    add("lining", tub.lining(outline, cockpit, floor), "liner", behind=0.008)
    if not half_only:
        add("bar", tub.roll_bar(0.40, 0.72, 1.10), "chrome", (cockpit[0] - 0.10, 0, 0))
    for side in (-1,) if half_only else (-1, 1):
        add(f"seat{side}", tub.seat(), "leather", (cockpit[0] + 0.52, 0.32 * side, floor + 0.07), behind=0.012)
    span, top, foot = layout.half_track - layout.strut.inset, layout.strut.head + 0.06, layout.half_track - 0.42
    for name, x in (("front", layout.front), ("rear", layout.rear)):
        bridge = tub.arch(span, 0.45, top, foot=foot, depth=0.15, thickness=0.06, right_only=half_only)
        add(f"{name}_bridge", bridge, "dark", (x, 0, 0))
    _lamps(picture, body, layout)


def _lamps(picture: Picture, body: Any, layout: Layout) -> None:
    """Head lamps and tail lamps, so that one sees where the front is."""
    slim = layout.half_track - 0.36
    for side in (-1.0,) if layout.one_sided else (-1.0, 1.0):
        picture.shape(
            body,
            "ellipsoid",
            (0.075, 0.035, 0.032),
            "glow",
            (layout.front + 0.64, layout.middle + side * 0.66 * slim, 0.43),
        )
        picture.shape(
            body,
            "ellipsoid",
            (0.03, 0.06, 0.03),
            "tail",
            (layout.rear - 0.645, layout.middle + side * 0.62 * slim, 0.6),
        )
