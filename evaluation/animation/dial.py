"""A small steering wheel that turns with the driver's, and panes behind texts."""

from __future__ import annotations

from functools import cache
from typing import Any

import numpy as np

from .layout import INK, PAPER

_FINE = 4
_MARK = (224, 168, 0)


@cache
def steering_wheel(side: int) -> Any:
    """Steering wheel in its straight position as a picture of `side` pixels, with a mark at the top of its rim."""
    from PIL import Image, ImageDraw

    full = side * _FINE
    image = Image.new("RGBA", (full, full), (*INK, 0))
    draw = ImageDraw.Draw(image)
    rim, middle = 0.10 * full, full / 2
    draw.ellipse([1, 1, full - 2, full - 2], (*INK, 255))
    draw.ellipse([rim, rim, full - rim, full - rim], (*INK, 0))
    for angle in np.radians([180.0, 0.0, 90.0]):
        tip = middle + (middle - rim / 2) * np.array([np.cos(angle), np.sin(angle)])
        draw.line([middle, middle, *tip.tolist()], (*INK, 255), round(0.11 * full))
    hub = 0.16 * full
    draw.ellipse([middle - hub, middle - hub, middle + hub, middle + hub], (*INK, 255))
    draw.arc([1, 1, full - 2, full - 2], 258, 282, (*_MARK, 255), round(rim))
    return image.resize((2 * side, 2 * side), Image.Resampling.LANCZOS)


def draw_steering_wheel(frame: Any, centre: tuple[float, float], side: int, angle: float) -> None:
    """Paste the steering wheel turned by an angle, positive to the left [rad], into a frame."""
    from PIL import Image

    turned = steering_wheel(side).rotate(float(np.degrees(angle)), Image.Resampling.BICUBIC).reduce(2)
    frame.paste(turned, (round(centre[0] - side / 2), round(centre[1] - side / 2)), turned)


@cache
def _pane_mask(width: int, height: int, rounding: int, strength: int) -> Any:
    from PIL import Image, ImageDraw

    mask = Image.new("L", (width * 2, height * 2), 0)
    ImageDraw.Draw(mask).rounded_rectangle([0, 0, width * 2 - 1, height * 2 - 1], rounding * 2, strength)
    return mask.reduce(2)


def draw_pane(frame: Any, box: tuple[float, float, float, float], rounding: float, strength: float = 0.80) -> None:
    """A light translucent pane (left, top, right, bottom) in a frame, on which texts can be read."""
    left, top, right, bottom = (round(edge) for edge in box)
    frame.paste(
        PAPER,
        (left, top, right, bottom),
        _pane_mask(right - left, bottom - top, round(rounding), round(255 * strength)),
    )
