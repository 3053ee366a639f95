"""Texts and traces around cars that drive freely: speed, steering wheel, lateral acceleration, roll, gear, wheel
loads."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from susp_mj.features import Bump, Roughness
from susp_mj.run import Run

from ..chart import Chart, Signal
from ..clip import at, features_of
from ..dial import draw_pane, draw_steering_wheel
from ..hud import Diagram
from ..layout import INK, SOFT, Box, typeface
from ..locus import Locus
from ..titles import signed
from ..wheels_hud import WheelsHud

_LOCUS = 250.0
_MOVES = 0.5
_NARROW = 440.0


@dataclass(frozen=True)
class Subject:
    """What a manoeuvre is about.

    Attributes:
        quantity: channel that is shown over time.
        title: quantity and unit.
        factor: to that unit.
        follows: channel that is shown over it, title and factor.
    """

    quantity: str
    title: str
    factor: float
    follows: tuple[str, str, float]


_DEGREES = 180 / np.pi
_PITCH = ("pitch_angle", "Pitch in °", _DEGREES)
_TRAVEL = ("fl_suspension_deflection", "Front left travel in mm", 1000.0)
_STEER = ("fl_steer_angle", "Front left steer in °", _DEGREES)
SUBJECTS = {
    each.quantity: each
    for each in (
        Subject(
            "lateral_acceleration", "Lateral acceleration in m/s² (left +)", 1.0, ("roll_angle", "Roll in °", _DEGREES)
        ),
        Subject("longitudinal_acceleration", "Longitudinal acceleration in m/s²", 1.0, _PITCH),
        Subject("body_displacement", "Body displacement in mm", 1000.0, _PITCH),
        Subject("roll_angle", "Roll angle in ° (left side up +)", _DEGREES, _TRAVEL),
        Subject("steering_wheel_angle", "Steering wheel angle in ° (left +)", _DEGREES, _STEER),
    )
}
_LEAST = {"roll_angle": np.radians(0.5), "steering_wheel_angle": np.radians(10.0)}
_STANDS = 0.1


class HandlingHud(WheelsHud):
    """Everything in a frame that is not a scene, for cars that drive freely."""

    aside: ClassVar[float] = 150.0

    def charts(self, left: Box, right: Box) -> Sequence[Diagram]:
        s, width = self.scale, left.width + right.width
        square = min(round(_LOCUS * s), width // 3)
        half = (width - square) // 2
        one, other = Box(0, left.top, half, left.height), Box(half, left.top, half, left.height)
        last = Box(2 * half, left.top, width - 2 * half, left.height)
        subject = self._subject()
        signals = self._signals(subject.quantity, subject.factor)
        return [
            Chart(signals, subject.title, self.window, one, s),
            self.load_chart(other),
            self._locus(last),
        ]

    def _locus(self, box: Box) -> Locus:
        """What follows over what the manoeuvre is about: roll over lateral acceleration, for one."""
        subject = self._subject()
        name, title, factor = subject.follows
        both = list(zip(self._signals(subject.quantity, subject.factor), self._signals(name, factor), strict=True))
        across = subject.title.split(" (")[0]
        return Locus(both, title, across[0].lower() + across[1:], self.window, box, self.scale)

    def _subject(self) -> Subject:
        """What the manoeuvre is about."""
        if self._bends():
            return SUBJECTS["lateral_acceleration"]
        uneven = any(isinstance(feature, Bump | Roughness) for clip in self.clips for feature in features_of(clip.run))
        if not uneven and max(_largest(clip.run, "longitudinal_acceleration") for clip in self.clips) > _MOVES:
            return SUBJECTS["longitudinal_acceleration"]
        standing = max(_largest(clip.run, "speed") for clip in self.clips) < _STANDS
        for name, least in _LEAST.items() if standing else ():
            if max(float(np.ptp(clip.run[name])) for clip in self.clips) > least:
                return SUBJECTS[name]
        return SUBJECTS["body_displacement"]

    def _signals(self, quantity: str, factor: float = 1.0) -> list[Signal]:
        runs = [clip.run for clip in self.clips]
        return [(run.time, factor * (run[quantity] if quantity in run else np.zeros_like(run.time))) for run in runs]

    def _bends(self) -> bool:
        """Whether any car corners, and more than half as much as it brakes or accelerates."""
        runs = [clip.run for clip in self.clips]
        lateral = max(_largest(run, "lateral_acceleration") for run in runs)
        return lateral > _MOVES and lateral > 0.5 * max(_largest(run, "longitudinal_acceleration") for run in runs)

    def draw(self, frame: Any, time: float) -> None:
        for clip, box in zip(self.clips, self.boxes, strict=True):
            self._panes(frame, clip.run, box, time)
        super().draw(frame, time)

    def _panes(self, frame: Any, run: Run, box: Box, time: float) -> None:
        """Light panes behind the numbers and the load bars, and the steering wheel."""
        from PIL import ImageDraw

        s, small = self.scale, self.small(box)
        left, top = box.left + 10 * s, box.top + 8 * s
        draw_pane(frame, (left, top, left + 190 * s, top + (122 if small else 194) * s), 10 * s)
        right = box.left + box.width - 8 * s
        draw_pane(frame, (right - (104 if small else 122) * s, top, right, top + (206 if small else 246) * s), 10 * s)
        if not small:
            bottom = box.top + box.height - 8 * s
            draw_pane(frame, (left, bottom - 118 * s, left + 100 * s, bottom), 10 * s)
            angle = at(run, "steering_wheel_angle", time)
            draw_steering_wheel(frame, (left + 50 * s, bottom - 72 * s), round(74 * s), angle)
            text = f"{round(float(np.degrees(angle))) + 0:+d}°".replace("-", "−")
            font = typeface(15 * s, bold=True)
            ImageDraw.Draw(frame).text((left + 50 * s, bottom - 10 * s), text, INK, font, anchor="ms")

    def alarm(self, draw: Any, box: Box, text: str) -> None:
        """Red sign at the foot of a scene, beside the steering wheel where there is no room above it."""
        narrow = round(110 * self.scale) if box.width < _NARROW * self.scale else 0
        super().alarm(draw, Box(box.left + narrow, box.top, box.width - narrow, box.height), text)

    def headline(self, run: Run, time: float) -> tuple[str, str, str]:
        return "speed", f"{3.6 * at(run, 'speed', time):.1f}", "km/h"

    def gauges(self, draw: Any, run: Run, box: Box, time: float) -> None:
        """Lateral acceleration, roll and gear; the steering wheel; wheel loads in the order of the wheels seen from
        above."""
        s, small = self.scale, self.small(box)
        rows = self._rows(run, time)
        if small:
            text = "   ".join(
                f"{name} {value}{unit if unit == '°' else ''}"
                for name, value, unit in rows
                if name in ("lateral", "roll")
            )
            draw.text((box.left + 18 * s, box.top + 114 * s), text, INK, typeface(12.5 * s), anchor="ls")
        else:
            for number, (name, value, unit) in enumerate(rows):
                base = box.top + (118 + 21 * number) * s
                draw.text((box.left + 18 * s, base), name, SOFT, typeface(12.5 * s), anchor="ls")
                draw.text((box.left + 150 * s, base), value, INK, typeface(15 * s, bold=True), anchor="rs")
                draw.text((box.left + 154 * s, base), unit, SOFT, typeface(12 * s), anchor="ls")
        self.loads(draw, run, box, time)

    def _rows(self, run: Run, time: float) -> list[tuple[str, str, str]]:
        """Name, value and unit of the numbers below the speed."""
        rows = [
            ("lateral", signed(at(run, "lateral_acceleration", time)), "m/s²"),
            ("roll", signed(float(np.degrees(at(run, "roll_angle", time)))), "°"),
        ]
        if "longitudinal_acceleration" in run:
            rows.insert(1, ("longitudinal", signed(at(run, "longitudinal_acceleration", time)), "m/s²"))
        if "gear" in run:
            number = int(run["gear"][min(int(np.searchsorted(run.time, time)), len(run.time) - 1)])
            rows.append(("gear", str(number) if number > 0 else "N", ""))
        return rows


def _largest(run: Run, quantity: str) -> float:
    """Largest magnitude of a channel, 0 if there is none."""
    return float(np.abs(run[quantity]).max()) if quantity in run else 0.0
