"""Texts and traces around quarter cars: one load bar each, body acceleration and wheel load over time."""

from __future__ import annotations

from typing import Any

from susp_mj.run import Run

from ...colours import LIFTED, rgb
from ..chart import Chart
from ..clip import at
from ..hud import Hud
from ..layout import INK, PAPER, SOFT, Box, typeface
from ..window import lift


class QuarterHud(Hud):
    """Everything in a frame that is not a scene, for quarter cars."""

    def charts(self, left: Box, right: Box) -> list[Chart]:
        accelerations = [(clip.run.time, clip.run["body_acceleration"]) for clip in self.clips]
        loads = [(clip.run.time, clip.run["wheel_load"] / 1000) for clip in self.clips]
        return [
            Chart(accelerations, "Body acceleration in m/s²", self.window, left, self.scale),
            Chart(loads, "Wheel load in kN", self.window, right, self.scale, loads=True),
        ]

    def gauges(self, draw: Any, run: Run, box: Box, time: float) -> None:
        """Wheel load as a bar with the static load as a mark; red while the wheel is off the road."""
        s = self.scale
        right, top = box.left + box.width - 18 * s, box.top + 40 * s
        width, height = 20 * s, min(210 * s, box.height - 120 * s)
        lifted, total = lift(run, self.window, time)
        load, static = 0.0 if lifted else at(run, "wheel_load", time), float(run["wheel_load"][0])
        mark = self.bar(draw, (right - width, top, width, height), load, static, lifted)
        draw.text((right - width - 8 * s, mark), "static", SOFT, typeface(11 * s), anchor="rm")
        draw.text((right, top - 8 * s), "wheel load", SOFT, typeface(12.5 * s), anchor="rb")
        outlined: dict[str, Any] = {"anchor": "rt", "stroke_width": 2.2 * s, "stroke_fill": PAPER}
        tone = rgb(LIFTED) if lifted else INK
        draw.text((right, top + height + 8 * s), f"{load / 1000:.1f} kN", tone, typeface(18 * s, bold=True), **outlined)
        if total > 0:
            note = f"lifted for {1000 * total:.0f} ms"
            draw.text((right, top + height + 32 * s), note, rgb(LIFTED), typeface(12.5 * s, bold=True), **outlined)
        if lifted:
            self.alarm(draw, box, "NO CONTACT")
