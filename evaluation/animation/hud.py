"""Texts, load bars and traces around the scenes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from susp_mj.run import Run

from ..colours import COLOURS, LIFTED, rgb
from ..ride import CONTACT_LOST
from .chart import Chart
from .clip import Clip, at
from .layout import BAND, HEADER, INK, LAYOUT_HEIGHT, PAPER, SOFT, STRIP, Box, mixed, panels, shortened, typeface
from .titles import describe, playback_text
from .window import Window


class Hud:
    """Everything in a frame that is not a scene: header, labels, numbers, load bars and traces."""

    def __init__(self, clips: Sequence[Clip], window: Window, size: tuple[int, int]) -> None:
        self.clips, self.window, self.size = clips, window, size
        self.scale = size[1] / LAYOUT_HEIGHT
        self.boxes = panels(len(clips), size)
        self.highest_load = max(float(clip.run["wheel_load"].max()) for clip in clips)
        strip = round(STRIP * self.scale)
        half, top = size[0] // 2, size[1] - strip
        left, right = Box(0, top, half, strip), Box(half, top, size[0] - half, strip)
        self.charts = [
            Chart(clips, "body_acceleration", "Body acceleration in m/s²", 1.0, window, left, self.scale),
            Chart(clips, "wheel_load", "Wheel load in kN", 1e-3, window, right, self.scale),
        ]
        self.background = self._background()

    def _background(self) -> Any:
        from PIL import Image, ImageDraw

        image = Image.new("RGB", self.size, PAPER)
        draw = ImageDraw.Draw(image)
        s, width = self.scale, self.size[0]
        meta = self.clips[0].run.meta
        middle = HEADER * s / 2
        draw.text((18 * s, middle), describe(meta.get("manoeuvre", {})), INK, typeface(17 * s, bold=True), anchor="lm")
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
        draw.text((self._clock_right, HEADER * s / 2), f"t = {time:.3f} s".replace("-", "−"), INK, typeface(20 * s, bold=True), anchor="rm")
        for number, (clip, box) in enumerate(zip(self.clips, self.boxes, strict=True)):
            self._panel(draw, clip, rgb(COLOURS[number]), box, time)
        for chart in self.charts:
            chart.draw(frame, time)

    def _panel(self, draw: Any, clip: Clip, colour: tuple[int, int, int], box: Box, time: float) -> None:
        s, run = self.scale, clip.run
        left, top = box.left + 16 * s, box.top + 14 * s
        font = typeface(16 * s, bold=True)
        label = shortened(clip.label, font, box.width - 146 * s)
        draw.rounded_rectangle([left, top, left + font.getlength(label) + 24 * s, top + 29 * s], 8 * s, colour)
        draw.text((left + 12 * s, top + 14.5 * s), label, (255, 255, 255), font, anchor="lm")
        draw.text((left + 2 * s, top + 42 * s), "body acceleration", SOFT, typeface(12.5 * s))
        value, big = f"{at(run, 'body_acceleration', time):+.1f}".replace("-", "−"), typeface(22 * s, bold=True)
        draw.text((left + 2 * s, top + 80 * s), value, INK, big, anchor="ls")
        draw.text((left + 7 * s + big.getlength(value), top + 80 * s), "m/s²", SOFT, typeface(13 * s), anchor="ls")
        self._load_bar(draw, run, box, time)

    def _load_bar(self, draw: Any, run: Run, box: Box, time: float) -> None:
        """Wheel load as a bar with the static load as a mark; red while the wheel is off the road."""
        s = self.scale
        right, top = box.left + box.width - 18 * s, box.top + 40 * s
        width, height = 20 * s, min(210 * s, box.height - 120 * s)
        lifted, total = lift(run, self.window, time)
        load, static = 0.0 if lifted else at(run, "wheel_load", time), float(run["wheel_load"][0])
        tone = rgb(LIFTED) if lifted else mixed((38, 140, 88), (235, 150, 20), float(np.clip(2 - load / max(static, 1.0), 0.0, 1.0)))
        draw.rounded_rectangle(
            [right - width, top, right, top + height], 4 * s, (255, 255, 255), rgb(LIFTED) if lifted else SOFT, max(round(s), 1)
        )
        filled = height * min(load / (1.05 * self.highest_load), 1.0)
        if filled >= 1:
            draw.rectangle([right - width + 3 * s, top + height - filled, right - 3 * s, top + height - 2 * s], tone)
        mark = top + height - height * static / (1.05 * self.highest_load)
        draw.line([right - width - 5 * s, mark, right + 5 * s, mark], INK, max(round(1.5 * s), 1))
        draw.text((right - width - 8 * s, mark), "static", SOFT, typeface(11 * s), anchor="rm")
        draw.text((right, top - 8 * s), "wheel load", SOFT, typeface(12.5 * s), anchor="rb")
        number = typeface(18 * s, bold=True)
        outlined: dict[str, Any] = {"anchor": "rt", "stroke_width": 2.2 * s, "stroke_fill": PAPER}
        draw.text((right, top + height + 8 * s), f"{load / 1000:.1f} kN", rgb(LIFTED) if lifted else INK, number, **outlined)
        if total > 0:
            note = f"lifted for {1000 * total:.0f} ms"
            draw.text((right, top + height + 32 * s), note, rgb(LIFTED), typeface(12.5 * s, bold=True), **outlined)
        if lifted:
            self._alarm(draw, box)

    def _alarm(self, draw: Any, box: Box) -> None:
        s = self.scale
        x, y = box.left + box.width / 2, box.top + box.height - 26 * s
        font = typeface(19 * s, bold=True)
        half = font.getlength("NO CONTACT") / 2 + 16 * s
        draw.rounded_rectangle([x - half, y - 17 * s, x + half, y + 17 * s], 8 * s, rgb(LIFTED))
        draw.text((x, y), "NO CONTACT", (255, 255, 255), font, anchor="mm")


def lift(run: Run, window: Window, time: float) -> tuple[bool, float]:
    """Whether the wheel is off the road at any record since the last frame, and how long it has been in the window so far [s]."""
    off = run["wheel_load"] <= CONTACT_LOST
    latest = (run.time > time - max(window.frame_step, run.step)) & (run.time <= time + 1e-9)
    past = (run.time >= window.start) & (run.time <= time + 1e-9)
    return bool(off[latest].any()), float(off[past].sum()) * run.step
