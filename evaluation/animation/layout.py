"""Boxes, tones, letters and round numbers of a frame."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

LAYOUT_HEIGHT = 720
"""Frame height [px] that the layout's numbers are meant for; other sizes scale."""

INK, SOFT, RULE, PAPER, BAND = (28, 33, 40), (98, 107, 118), (205, 211, 218), (250, 251, 252), (236, 240, 244)
HEADER, STRIP, COLUMN = 50, 196, 336


@dataclass(frozen=True)
class Box:
    """Rectangle in a frame [px]."""

    left: int
    top: int
    width: int
    height: int


def panels(count: int, size: tuple[int, int]) -> list[Box]:
    """Where the scenes go: side by side, from four on in two rows."""
    width, height = size
    scale = height / LAYOUT_HEIGHT
    top, bottom = round(HEADER * scale), height - round(STRIP * scale)
    rows = 1 if count <= 3 else 2
    columns = -(-count // rows)
    xs, ys = (
        np.linspace(0, width, columns + 1).round().astype(int),
        np.linspace(top, bottom, rows + 1).round().astype(int),
    )
    gap = max(round(3 * scale), 1)
    boxes = []
    for number in range(count):
        row, column = divmod(number, columns)
        left, right = int(xs[column]) + (gap if column else 0), int(xs[column + 1])
        upper, lower = int(ys[row]) + (gap if row else 0), int(ys[row + 1])
        boxes.append(Box(left, upper, right - left, lower - upper))
    return boxes


def columns(count: int, size: tuple[int, int]) -> list[Box]:
    """Where labels and gauges go if all configurations stand in one scene: one at its left edge and one at its
    right."""
    whole = panels(1, size)[0]
    width = min(round(COLUMN * size[1] / LAYOUT_HEIGHT), whole.width // count)
    return [
        Box(whole.left + (whole.width - width) * number // max(count - 1, 1), whole.top, width, whole.height)
        for number in range(count)
    ]


@cache
def typeface(height: float, bold: bool = False) -> Any:
    """DejaVu Sans, which matplotlib brings, in a height [px]."""
    import matplotlib
    from PIL import ImageFont

    name = "DejaVuSans-Bold.ttf" if bold else "DejaVuSans.ttf"
    return ImageFont.truetype(str(Path(matplotlib.get_data_path(), "fonts", "ttf", name)), max(round(height), 6))


def shortened(text: str, font: Any, width: float) -> str:
    """The text, or as much of it as fits [px], with an ellipsis."""
    while len(text) > 1 and font.getlength(text) > width:
        text = text[:-2].rstrip() + "…"
    return text


def mixed(colour: Sequence[int], ground: Sequence[int], share: float) -> tuple[int, int, int]:
    """A colour laid over a ground with a share from 0 to 1."""
    red, green, blue = (round(share * a + (1 - share) * b) for a, b in zip(colour, ground, strict=True))
    return red, green, blue


def load_tone(load: float, static: float) -> tuple[int, int, int]:
    """Colour of a wheel load: green up to the static load, orange from twice that on."""
    return mixed((38, 140, 88), (235, 150, 20), float(np.clip(2 - load / max(static, 1.0), 0.0, 1.0)))


def spans(flags: np.ndarray) -> list[tuple[int, int]]:
    """First and last index of every stretch that is true."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], flags, [False]])))
    return [(int(one), int(other) - 1) for one, other in edges.reshape(-1, 2)]


def ticks(low: float, high: float, count: int) -> list[float]:
    """About `count` round numbers from `low` to `high`."""
    raw = (high - low) / count
    power = 10.0 ** np.floor(np.log10(raw))
    step = power * next(factor for factor in (1, 2, 2.5, 5, 10) if factor * power >= raw * 0.999)
    return [
        round(float(k * step), 9) + 0.0
        for k in range(int(np.ceil(low / step - 1e-9)), int(np.floor(high / step + 1e-9)) + 1)
    ]
