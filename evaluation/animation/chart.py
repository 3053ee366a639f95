"""Time traces under the scenes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..colours import COLOURS, LIFTED, rgb
from ..numbers.ride import CONTACT_LOST
from .layout import INK, PAPER, RULE, SOFT, Box, mixed, spans, ticks, typeface
from .window import Window

Signal = tuple[np.ndarray, np.ndarray]
"""(n,) times [s] and (n,) values."""


class Chart:
    """Time traces of one quantity of all runs; what is past is drawn in full colour, what is to come faint.

    Args:
        signals: one for each configuration.
        title: quantity and unit.
        window: stretch of the runs.
        box: where it stands in the frame.
        scale: of all lengths.
        loads: the values are wheel loads; stretches without contact are marked red.
    """

    def __init__(
        self, signals: Sequence[Signal], title: str, window: Window, box: Box, scale: float, *, loads: bool = False
    ) -> None:
        self.box, self.window, self.scale = box, window, scale
        self.plot = Box(
            round(46 * scale), round(27 * scale), box.width - round(60 * scale), box.height - round(50 * scale)
        )
        grid = np.linspace(window.start, window.times[-1], max(self.plot.width * 2, 2))
        self.traces = [np.interp(grid, time, values) for time, values in signals]
        self.grid, self.title = grid, title
        low, high = min(0.0, *(float(t.min()) for t in self.traces)), max(0.0, *(float(t.max()) for t in self.traces))
        margin = 0.06 * max(high - low, 1e-3)
        self.low, self.high = low - (margin if low < 0 else 0.35 * margin), high + margin
        self.lifts = [t <= CONTACT_LOST for t in self.traces] if loads else []
        self.faint, self.full = self._layer(0.33), self._layer(1.0)

    def x(self, time: float | np.ndarray) -> Any:
        """Horizontal place in the chart [px]."""
        return (
            self.plot.left
            + (time - self.window.start) / max(self.window.times[-1] - self.window.start, 1e-9) * self.plot.width
        )

    def y(self, value: float | np.ndarray) -> Any:
        """Vertical place in the chart [px]."""
        return self.plot.top + (self.high - value) / (self.high - self.low) * self.plot.height

    def _layer(self, strength: float) -> Any:
        """The chart with its traces in a strength from 0 to 1, drawn large and reduced."""
        from PIL import Image, ImageDraw

        fine = 3
        image = Image.new("RGB", (self.box.width * fine, self.box.height * fine), PAPER)
        draw = ImageDraw.Draw(image)
        right, base = self.plot.left + self.plot.width, self.plot.top + self.plot.height
        hair = max(round(self.scale * fine), 1)
        for value in ticks(self.low, self.high, 4):
            y = self.y(value)
            draw.line([self.plot.left * fine, y * fine, right * fine, y * fine], SOFT if value == 0 else RULE, hair)
        for time in ticks(self.window.start, self.window.times[-1], 8):
            x = self.x(time)
            draw.line([x * fine, base * fine, x * fine, (base + 4 * self.scale) * fine], SOFT, hair)
        for number, trace in enumerate(self.traces):
            tone = mixed(rgb(COLOURS[number]), PAPER, strength)
            points = np.column_stack([self.x(self.grid), self.y(trace)]) * fine
            draw.line(
                [tuple(point) for point in points.tolist()], tone, max(round(2.3 * self.scale * fine), 1), joint="curve"
            )
        for lifted in self.lifts:
            for one, other in spans(lifted):
                edge = [
                    self.x(self.grid[one]) * fine,
                    (self.y(0.0) - 3 * self.scale) * fine,
                    self.x(self.grid[other]) * fine,
                ]
                draw.rectangle([*edge, (self.y(0.0) + 3 * self.scale) * fine], mixed(rgb(LIFTED), PAPER, strength))
        image = image.resize((self.box.width, self.box.height), Image.Resampling.LANCZOS)
        self._label(ImageDraw.Draw(image))
        return image

    def _label(self, draw: Any) -> None:
        font = typeface(11.5 * self.scale)
        draw.text((self.plot.left, 5 * self.scale), self.title, INK, typeface(13 * self.scale, bold=True))
        for value in ticks(self.low, self.high, 4):
            draw.text(
                (self.plot.left - 6 * self.scale, self.y(value)),
                f"{value:g}".replace("-", "−"),
                SOFT,
                font,
                anchor="rm",
            )
        base = self.plot.top + self.plot.height
        for time in ticks(self.window.start, self.window.times[-1], 8):
            draw.text((self.x(time), base + 5 * self.scale), f"{time:.3g}", SOFT, font, anchor="mt")
        draw.text((self.plot.left + self.plot.width, 6 * self.scale), "time in s", SOFT, font, anchor="rt")

    def draw(self, frame: Any, time: float) -> None:
        """Paste the chart with its cursor at a time [s] into a frame."""
        from PIL import ImageDraw

        cursor = round(self.x(time))
        frame.paste(self.faint, (self.box.left, self.box.top))
        frame.paste(self.full.crop((0, 0, cursor, self.box.height)), (self.box.left, self.box.top))
        draw = ImageDraw.Draw(frame)
        x, top = self.box.left + cursor, self.box.top + self.plot.top
        draw.line([x, top - 3 * self.scale, x, top + self.plot.height + 3 * self.scale], INK, max(round(self.scale), 1))
        for number, trace in enumerate(self.traces):
            y, radius = self.box.top + self.y(float(np.interp(time, self.grid, trace))), 4.5 * self.scale
            draw.ellipse(
                [x - radius, y - radius, x + radius, y + radius],
                rgb(COLOURS[number]),
                (255, 255, 255),
                max(round(self.scale), 1),
            )
