"""One quantity over another under the scenes: the way so far in full colour, what is to come faint."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..colours import COLOURS, rgb
from .chart import Signal
from .layout import INK, PAPER, RULE, SOFT, Box, mixed, ticks, typeface
from .window import Window

_FINE = 2
_LEAST = 0.05


class Locus:
    """Diagram of two quantities of all runs, without time.

    Args:
        pairs: (horizontal, vertical) signals over the same times, one pair for each configuration.
        title: of the diagram.
        across: name of the horizontal axis, with its unit; the title names the vertical one.
        window: stretch of the runs.
        box: where it stands in the frame.
        scale: of all lengths.
    """

    def __init__(
        self,
        pairs: Sequence[tuple[Signal, Signal]],
        title: str,
        across: str,
        window: Window,
        box: Box,
        scale: float,
    ) -> None:
        self.box, self.window, self.scale, self.title, self.across = box, window, scale, title, across
        self.plot = Box(
            round(40 * scale), round(27 * scale), box.width - round(52 * scale), box.height - round(66 * scale)
        )
        self.times = np.linspace(window.start, window.times[-1], 600)
        self.lines = [np.column_stack([np.interp(self.times, *signal) for signal in pair]) for pair in pairs]
        every = np.concatenate(self.lines)
        low, high = np.minimum(every.min(axis=0), 0.0), np.maximum(every.max(axis=0), 0.0)
        margin = np.maximum(0.06 * (high - low), _LEAST)
        low, high = low - margin, high + margin
        self.low, self.high = low, high
        self.faint = self._layer()

    def at(self, points: np.ndarray) -> np.ndarray:
        """(n, 2) places in the diagram [px] of (n, 2) values."""
        share = (points - self.low) / (self.high - self.low)
        return np.column_stack(
            [self.plot.left + share[:, 0] * self.plot.width, self.plot.top + (1 - share[:, 1]) * self.plot.height]
        )

    def _layer(self) -> Any:
        """Axes and what is to come, drawn large."""
        from PIL import Image, ImageDraw

        image = Image.new("RGB", (self.box.width * _FINE, self.box.height * _FINE), PAPER)
        draw = ImageDraw.Draw(image)
        plot, s, hair = self.plot, self.scale * _FINE, max(round(self.scale * _FINE), 1)
        right, base = (plot.left + plot.width) * _FINE, (plot.top + plot.height) * _FINE
        font = typeface(11.5 * s)
        for value in ticks(float(self.low[0]), float(self.high[0]), 4):
            x = float(self.at(np.array([[value, 0.0]]))[0, 0]) * _FINE
            draw.line([x, plot.top * _FINE, x, base], SOFT if value == 0 else RULE, hair)
            draw.text((x, base + 4 * s), f"{value:g}".replace("-", "−"), SOFT, font, anchor="mt")
        for value in ticks(float(self.low[1]), float(self.high[1]), 4):
            y = float(self.at(np.array([[0.0, value]]))[0, 1]) * _FINE
            draw.line([plot.left * _FINE, y, right, y], SOFT if value == 0 else RULE, hair)
            draw.text((plot.left * _FINE - 5 * s, y), f"{value:g}".replace("-", "−"), SOFT, font, anchor="rm")
        draw.text((plot.left * _FINE, 5 * s), self.title, INK, typeface(13 * s, bold=True))
        draw.text(((plot.left * _FINE + right) / 2, base + 19 * s), self.across, SOFT, font, anchor="mt")
        for number, line in enumerate(self.lines):
            self._line(draw, line, mixed(rgb(COLOURS[number]), PAPER, 0.25), 1.6)
        return image

    def _line(self, draw: Any, line: np.ndarray, tone: tuple[int, int, int], width: float) -> None:
        if len(line) > 1:
            places = [tuple(place) for place in (self.at(line) * _FINE).tolist()]
            draw.line(places, tone, max(round(width * self.scale * _FINE), 1), joint="curve")

    def draw(self, frame: Any, time: float) -> None:
        """Paste the diagram as it is at a time [s] into a frame."""
        from PIL import ImageDraw

        image = self.faint.copy()
        draw = ImageDraw.Draw(image)
        past = self.times < time
        for number, line in enumerate(self.lines):
            now = np.array([[np.interp(time, self.times, line[:, k]) for k in range(2)]])
            self._line(draw, np.concatenate([line[past], now]), rgb(COLOURS[number]), 2.3)
        for number, line in enumerate(self.lines):
            now = np.array([[np.interp(time, self.times, line[:, k]) for k in range(2)]])
            (x, y), radius = (self.at(now) * _FINE)[0].tolist(), 4.5 * self.scale * _FINE
            draw.ellipse(
                [x - radius, y - radius, x + radius, y + radius],
                rgb(COLOURS[number]),
                (255, 255, 255),
                max(round(self.scale * _FINE), 1),
            )
        frame.paste(image.reduce(_FINE), (self.box.left, self.box.top))
