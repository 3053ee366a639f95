"""Texts and traces around cars with several wheels: load bars laid out as the wheels are, roll and pitch, smallest
load."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, ClassVar

import numpy as np

from susp_mj.names import channel_name
from susp_mj.run import Run

from ...colours import LIFTED, rgb
from ..chart import Chart
from ..clip import Clip, at, stations_of
from ..hud import Diagram, Hud
from ..layout import INK, PAPER, SOFT, Box, typeface
from ..titles import signed
from ..window import Window, lift

ANGLES = {"roll_angle": "roll", "pitch_angle": "pitch"}
SIGNS = {"roll_angle": "left side up +", "pitch_angle": "nose down +"}
_RESTING = np.radians(0.01)
_SMALL = 300.0


class OscillationHud(Hud):
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
        loads = [(clip.run.time, smallest_load(clip.run) / 1000) for clip in self.clips]
        return [
            Chart(signals, title, self.window, left, self.scale),
            Chart(loads, "Smallest wheel load in kN", self.window, right, self.scale, loads=True),
        ]

    def gauges(self, draw: Any, run: Run, box: Box, time: float) -> None:
        """Roll and pitch in degrees, and the wheel loads in the order of the wheels seen from above."""
        self._angles(draw, run, box, time)
        lifted = self._loads(draw, run, box, time)
        if lifted:
            self.alarm(draw, box, f"LIFT  {' '.join(lifted)}")

    def _angles(self, draw: Any, run: Run, box: Box, time: float) -> None:
        s, outlined = self.scale, {"stroke_width": 2 * self.scale, "stroke_fill": PAPER}
        shown = [
            (ANGLES[quantity], signed(float(np.degrees(at(run, quantity, time))), "°"))
            for quantity in ANGLES
            if quantity in run
        ]
        if box.height < _SMALL * s:
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

    def _loads(self, draw: Any, run: Run, box: Box, time: float) -> list[str]:
        """Draw the load bars; returns the stations that are off the road."""
        s, places, small = self.scale, plan(stations_of(run)), box.height < _SMALL * self.scale
        rows, columns = 1 + max(row for row, _ in places.values()), 1 + max(column for _, column in places.values())
        width, gap, height = (11 * s, 38 * s, 32 * s) if small else (17 * s, 50 * s, (110 if rows == 1 else 62) * s)
        right = box.left + box.width - (20 if small else 26) * s
        draw.text((right + 8 * s, box.top + 14 * s), "wheel loads in kN", SOFT, typeface(12.5 * s), anchor="rt")
        off = []
        for station, (row, column) in places.items():
            left, top = right - width - (columns - 1 - column) * gap, box.top + 52 * s + row * (height + 46 * s)
            lifted, _ = lift(run, self.window, time, station)
            values = run[channel_name(station, "wheel_load")]
            load = 0.0 if lifted else float(np.interp(time, run.time, values))
            self.bar(draw, (left, top, width, height), load, float(values[0]), lifted)
            tone, outlined = rgb(LIFTED) if lifted else INK, {"stroke_width": 2.2 * s, "stroke_fill": PAPER}
            middle = left + width / 2
            draw.text((middle, top - 4 * s), station, SOFT, typeface(12 * s), anchor="ms", **outlined)
            text = "LIFT" if lifted else f"{load / 1000:.1f}"
            draw.text(
                (middle, top + height + 5 * s),
                text,
                tone,
                typeface((12 if small else 14) * s, bold=True),
                anchor="mt",
                **outlined,
            )
            off += [station] if lifted else []
        return off


def plan(stations: Sequence[str]) -> dict[str, tuple[int, int]]:
    """Row from the front and column from the left of each wheel, seen from above."""
    front = [station for station in stations if station[0] == "f"]
    rows = [row for row in (front, [station for station in stations if station not in front]) if row]
    return {station: (number, column) for number, row in enumerate(rows) for column, station in enumerate(row)}


def liveliest_angle(clips: Sequence[Clip], window: Window) -> str | None:
    """Roll or pitch angle, whichever moves more within the window in any run; None if neither moves."""
    moves = {quantity: max(_range(clip.run, quantity, window) for clip in clips) for quantity in ANGLES}
    quantity = max(moves, key=lambda each: moves[each])
    return quantity if moves[quantity] > _RESTING else None


def angle_of(run: Run, quantity: str) -> np.ndarray:
    """(n,) angle of the body [rad]; 0 where the model has no such freedom."""
    return run[quantity] if quantity in run else np.zeros_like(run.time)


def smallest_load(run: Run) -> np.ndarray:
    """(n,) smallest of all wheel loads [N]."""
    return np.min(list(run.stations("wheel_load").values()), axis=0)


def _range(run: Run, quantity: str, window: Window) -> float:
    inside = (run.time >= window.start - 1e-9) & (run.time <= window.end + 1e-9)
    return float(np.ptp(angle_of(run, quantity)[inside]))
