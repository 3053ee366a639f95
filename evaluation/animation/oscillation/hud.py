"""Texts and traces around cars with several wheels: load bars laid out as the wheels are, roll and pitch, smallest
load."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, ClassVar

import numpy as np

from susp_mj.run import Run

from ..chart import Chart
from ..clip import Clip, at
from ..hud import Diagram
from ..layout import INK, PAPER, SOFT, Box, typeface
from ..titles import signed
from ..wheels_hud import WheelsHud
from ..window import Window

ANGLES = {"roll_angle": "roll", "pitch_angle": "pitch"}
SIGNS = {"roll_angle": "left side up +", "pitch_angle": "nose down +"}
_RESTING = np.radians(0.01)


class OscillationHud(WheelsHud):
    """Everything in a frame that is not a scene, for cars with several wheels."""

    aside: ClassVar[float] = 170.0

    def charts(self, left: Box, right: Box) -> Sequence[Diagram]:
        quantity = liveliest_angle(self.clips, self.window)
        if quantity is None:
            signals, title = (
                [(clip.run.time, clip.run["body_acceleration"]) for clip in self.clips],
                "Body acceleration in m/s²",
            )
        else:
            signals = [(clip.run.time, np.degrees(angle_of(clip.run, quantity))) for clip in self.clips]
            title = f"{ANGLES[quantity].capitalize()} angle in ° ({SIGNS[quantity]})"
        return [Chart(signals, title, self.window, left, self.scale), self.load_chart(right)]

    def gauges(self, draw: Any, run: Run, box: Box, time: float) -> None:
        """Roll and pitch in degrees, and the wheel loads in the order of the wheels seen from above."""
        self._angles(draw, run, box, time)
        self.loads(draw, run, box, time)

    def _angles(self, draw: Any, run: Run, box: Box, time: float) -> None:
        s, outlined = self.scale, {"stroke_width": 2 * self.scale, "stroke_fill": PAPER}
        shown = [
            (ANGLES[quantity], signed(float(np.degrees(at(run, quantity, time))), "°"))
            for quantity in ANGLES
            if quantity in run
        ]
        if self.small(box):
            text = "   ".join(f"{name} {value}" for name, value in shown)
            draw.text(
                (box.left + 18 * s, box.top + 114 * s),
                text,
                INK,
                typeface(12.5 * s),
                anchor="ls",
                stroke_width=2 * s,
                stroke_fill=PAPER,
            )
            return
        for row, (name, value) in enumerate(shown):
            base = box.top + (122 + 24 * row) * s
            draw.text((box.left + 18 * s, base), name, SOFT, typeface(12.5 * s), anchor="ls", **outlined)
            draw.text(
                (box.left + 112 * s, base),
                value,
                INK,
                typeface(16 * s, bold=True),
                anchor="rs",
                stroke_width=2 * s,
                stroke_fill=PAPER,
            )


def liveliest_angle(clips: Sequence[Clip], window: Window) -> str | None:
    """Roll or pitch angle, whichever moves more within the window in any run; None if neither moves."""
    moves = {quantity: max(_range(clip.run, quantity, window) for clip in clips) for quantity in ANGLES}
    quantity = max(moves, key=lambda each: moves[each])
    return quantity if moves[quantity] > _RESTING else None


def angle_of(run: Run, quantity: str) -> np.ndarray:
    """(n,) angle of the body [rad]; 0 where the model has no such freedom."""
    return run[quantity] if quantity in run else np.zeros_like(run.time)


def _range(run: Run, quantity: str, window: Window) -> float:
    inside = (run.time >= window.start - 1e-9) & (run.time <= window.end + 1e-9)
    return float(np.ptp(angle_of(run, quantity)[inside]))
