"""Texts and traces that all cars with several wheels share: load bars laid out as the wheels are, smallest load."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from susp_mj.names import channel_name
from susp_mj.run import Run

from ..colours import LIFTED, rgb
from .chart import Chart
from .clip import stations_of
from .hud import Hud
from .layout import INK, PAPER, SOFT, Box, typeface
from .window import lift

_SMALL = 300.0


class WheelsHud(Hud):
    """Everything in a frame that is not a scene, for cars with several wheels."""

    def small(self, box: Box) -> bool:
        """Whether a scene is too low for gauges in their full size."""
        return box.height < _SMALL * self.scale

    def load_chart(self, box: Box) -> Chart:
        """Smallest of all wheel loads over time."""
        loads = [(clip.run.time, smallest_load(clip.run) / 1000) for clip in self.clips]
        return Chart(loads, "Smallest wheel load in kN", self.window, box, self.scale, loads=True)

    def loads(self, draw: Any, run: Run, box: Box, time: float) -> None:
        """Wheel loads as bars in the order of the wheels seen from above, and an alarm while any is off the road."""
        s, places, small = self.scale, plan(stations_of(run)), self.small(box)
        rows, columns = 1 + max(row for row, _ in places.values()), 1 + max(column for _, column in places.values())
        width, gap, height = (11 * s, 38 * s, 32 * s) if small else (17 * s, 50 * s, (110 if rows == 1 else 62) * s)
        right = box.left + box.width - (20 if small else 26) * s
        draw.text((right + 8 * s, box.top + 14 * s), "wheel loads in kN", SOFT, typeface(12.5 * s), anchor="rt")
        off: list[str] = []
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
        if off:
            self.alarm(draw, box, f"LIFT  {' '.join(off)}")


def plan(stations: Sequence[str]) -> dict[str, tuple[int, int]]:
    """Row from the front and column from the left of each wheel, seen from above."""
    front = [station for station in stations if station[0] == "f"]
    rows = [row for row in (front, [station for station in stations if station not in front]) if row]
    return {station: (number, column) for number, row in enumerate(rows) for column, station in enumerate(row)}


def smallest_load(run: Run) -> np.ndarray:
    """(n,) smallest of all wheel loads [N]."""
    return np.min(list(run.stations("wheel_load").values()), axis=0)
