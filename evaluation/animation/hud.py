"""Texts and traces around the scenes: what all kinds of cars share."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import Any, ClassVar, Protocol

from susp_mj.run import Run

from ..colours import COLOURS, LIFTED, rgb
from .clip import Clip, at
from .layout import (
    BAND,
    HEADER,
    INK,
    LAYOUT_HEIGHT,
    PAPER,
    SOFT,
    STRIP,
    Box,
    columns,
    load_tone,
    panels,
    shortened,
    typeface,
)
from .style import Style
from .titles import describe, playback_text, signed
from .window import Window


class Diagram(Protocol):
    """Something that is drawn under the scenes."""

    def draw(self, frame: Any, time: float) -> None: ...


class Hud(ABC):
    """Everything in a frame that is not a scene: header, labels, numbers, load bars and traces.

    A kind of car gives its own `charts` and `gauges`. `boxes` are the places of the configurations' labels and gauges,
    `views` those of the scenes: the same, unless all configurations stand in one scene.
    """

    aside: ClassVar[float] = 146.0
    """Width beside a label that the gauges need [px at the layout's height]."""

    def __init__(self, clips: Sequence[Clip], window: Window, size: tuple[int, int], style: Style) -> None:
        self.clips, self.window, self.size = clips, window, size
        self.scale = size[1] / LAYOUT_HEIGHT
        self.boxes = columns(len(clips), size) if style.ghost else panels(len(clips), size)
        self.views = panels(1, size) if style.ghost else self.boxes
        loads = [load for clip in clips for load in clip.run.stations("wheel_load").values()]
        self.highest_load = max(1.0, *(float(load.max()) for load in loads))
        strip = round(STRIP * self.scale)
        half, top = size[0] // 2, size[1] - strip
        self.traces = self.charts(Box(0, top, half, strip), Box(half, top, size[0] - half, strip))
        self.background = self._background()

    @abstractmethod
    def charts(self, left: Box, right: Box) -> Sequence[Diagram]:
        """Traces under the scenes."""

    @abstractmethod
    def gauges(self, draw: Any, run: Run, box: Box, time: float) -> None:
        """Draw what was measured onto the scene of one configuration."""

    def headline(self, run: Run, time: float) -> tuple[str, str, str]:
        """Name, value and unit of the number that stands below the label."""
        return "body acceleration", signed(at(run, "body_acceleration", time)), "m/s²"

    def _background(self) -> Any:
        from PIL import Image, ImageDraw

        image = Image.new("RGB", self.size, PAPER)
        draw = ImageDraw.Draw(image)
        s, width = self.scale, self.size[0]
        middle = HEADER * s / 2
        draw.text((18 * s, middle), describe(self.clips[0].run), INK, typeface(17 * s, bold=True), anchor="lm")
        text = playback_text(self.window.playback)
        font = typeface(14 * s, bold=True)
        length = font.getlength(text)
        draw.rounded_rectangle([width - length - 38 * s, 11 * s, width - 14 * s, (HEADER - 11) * s], 13 * s, BAND)
        draw.text((width - 26 * s - length / 2, middle), text, SOFT, font, anchor="mm")
        self._clock_right = width - length - 56 * s
        return image

    def draw(self, frame: Any, time: float) -> None:
        """Draw onto a frame that already shows the scenes."""
        from PIL import ImageDraw

        draw = ImageDraw.Draw(frame)
        s = self.scale
        draw.text(
            (self._clock_right, HEADER * s / 2),
            f"t = {time:.3f} s".replace("-", "−"),
            INK,
            typeface(20 * s, bold=True),
            anchor="rm",
        )
        for number, (clip, box) in enumerate(zip(self.clips, self.boxes, strict=True)):
            self._label(draw, clip, rgb(COLOURS[number]), box, time)
            self.gauges(draw, clip.run, box, time)
        for chart in self.traces:
            chart.draw(frame, time)

    def _label(self, draw: Any, clip: Clip, colour: tuple[int, int, int], box: Box, time: float) -> None:
        s, run = self.scale, clip.run
        left, top = box.left + 16 * s, box.top + 14 * s
        font = typeface(16 * s, bold=True)
        label = shortened(clip.label, font, box.width - self.aside * s)
        draw.rounded_rectangle([left, top, left + font.getlength(label) + 24 * s, top + 29 * s], 8 * s, colour)
        draw.text((left + 12 * s, top + 14.5 * s), label, (255, 255, 255), font, anchor="lm")
        name, value, unit = self.headline(run, time)
        big = typeface(22 * s, bold=True)
        draw.text((left + 2 * s, top + 42 * s), name, SOFT, typeface(12.5 * s))
        draw.text((left + 2 * s, top + 80 * s), value, INK, big, anchor="ls")
        draw.text((left + 7 * s + big.getlength(value), top + 80 * s), unit, SOFT, typeface(13 * s), anchor="ls")

    def bar(
        self, draw: Any, place: tuple[float, float, float, float], load: float, static: float, lifted: bool
    ) -> float:
        """Wheel load as a bar, green to orange, its frame red while the wheel is off the road; returns where the static
        load stands."""
        s, full = self.scale, 1.05 * self.highest_load
        left, top, width, height = place
        right, base = left + width, top + height
        tone = rgb(LIFTED) if lifted else load_tone(load, static)
        draw.rounded_rectangle(
            [left, top, right, base], 4 * s, (255, 255, 255), rgb(LIFTED) if lifted else SOFT, max(round(s), 1)
        )
        filled = height * min(load / full, 1.0)
        if filled >= 2 * s + 1:
            draw.rectangle([left + 3 * s, base - filled, right - 3 * s, base - 2 * s], tone)
        mark = base - height * static / full
        draw.line([left - 5 * s, mark, right + 5 * s, mark], INK, max(round(1.5 * s), 1))
        return mark

    def alarm(self, draw: Any, box: Box, text: str) -> None:
        """Red sign at the foot of a scene."""
        s = self.scale
        x, y = box.left + box.width / 2, box.top + box.height - 26 * s
        font = typeface(19 * s, bold=True)
        half = font.getlength(text) / 2 + 16 * s
        draw.rounded_rectangle([x - half, y - 17 * s, x + half, y + 17 * s], 8 * s, rgb(LIFTED))
        draw.text((x, y), text, (255, 255, 255), font, anchor="mm")
