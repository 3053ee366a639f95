"""Wheels or road follow a recorded or measured motion (Nachfahrversuch)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar, Literal

import numpy as np
from pydantic import PrivateAttr, ValidationInfo, model_validator

from manoeuvres.driving import held_speed
from susp_mj.character import Character
from susp_mj.description import beside, wrong
from susp_mj.errors import InputError, choices
from susp_mj.manoeuvre import Manoeuvre, ValueAndRate
from susp_mj.meaning import Input
from susp_mj.names import AXLES, CORNERS, channel_name, stand_ins
from susp_mj.roads import cosine_ramp
from susp_mj.signals import Signals, read_signals
from susp_mj.units import PositiveSpeed, PositiveTime, Time

RECORDINGS = Path(__file__).parent / "recordings"
"""Where the recordings that ship lie."""
WORDS = {**{station: station for station in (*CORNERS, *AXLES)}, "all": ""}
"""What a recording may call its signals, and the station that each is of."""
_AT_REST = 0.05
_VISIBLE = 1e-6  # m


@dataclass(frozen=True)
class _Track:
    """What a wheel follows: the mean of some signals of the file, between times of the file that all wheels share."""

    names: tuple[str, ...]
    time: np.ndarray
    height: np.ndarray
    begin: float
    end: float


class RecordedMotion(Manoeuvre):
    """The wheels of a model without tyres, or the road under those with, follow the signals of a file.

    The signals are called ``fl``, ``fr``, ``rl``, ``rr``, or ``front``, ``rear``, or ``all``, in any unit of length,
    positive upwards, whatever the model: a wheel takes its own, else that of its axle, else the one for all; a model of
    one side takes the mean of left and right. A saved run is read as it is: wheels without tyres follow its wheel
    centres, a road its road. Each motion begins at zero: its height at the beginning is taken off, and said.

    Attributes:
        file: CSV, NetCDF or MDF4, see `susp_mj.signals.read_signals`; beside the case file, or one that ships.
        signals: station -> name of the signal, where the file does not call them so.
        method: between samples: ``pchip`` does not overshoot, ``cubic`` is smoother.
        skip: how much of the recording is left out at its beginning [s].
        start: when it begins in the run [s].
        fade_in: over which half a cosine brings it in [s]; asked for where it does not begin at rest.
        at_end: what a run that is longer than the recording does: ``refuse``, or ``hold`` the last height.
        speed: of a car that drives freely meanwhile [m/s].

    Source: thesis, chapter 6: its models are driven by what another model's wheels did.
    """

    character: ClassVar[Character] = Character("Recorded motion")
    german: ClassVar[str] = "nachfahrversuch"
    needs: ClassVar[tuple[str, ...]] = ("road_height",)

    kind: Literal["recorded_motion"] = "recorded_motion"
    duration: PositiveTime = 2.5
    file: str = "bump_50_mm.csv"
    signals: dict[str, str] = {}  # noqa: RUF012 - pydantic copies it
    method: Literal["pchip", "cubic"] = "pchip"
    skip: Time = 0.0
    start: Time = 0.0
    fade_in: Time = 0.0
    at_end: Literal["refuse", "hold"] = "refuse"
    speed: PositiveSpeed = 80 / 3.6

    _signals: Signals = PrivateAttr()

    @model_validator(mode="after")
    def _read(self, info: ValidationInfo) -> RecordedMotion:
        for word in self.signals:
            if word not in WORDS:
                raise wrong(f"unknown; {choices(WORDS, word)}", f"signals.{word}")
        path = next((each for each in (beside(self.file, info), RECORDINGS / self.file) if each.is_file()), None)
        if path is None:
            shipped = choices(sorted(each.name for each in RECORDINGS.glob("*.csv")), self.file)
            raise wrong(f"no file '{self.file}' beside the case file; {shipped}, or give a path", "file")
        try:
            self._signals = read_signals(path)
            for name in self.signals.values():
                self._signals.si(name, "m")
        except InputError as error:
            raise wrong(str(error), "file") from None
        return self

    def drive(self, place: Input, time: np.ndarray) -> ValueAndRate | None:
        if place.quantity != "road_height":
            return held_speed(place.quantity, self.speed, time)
        track = self._track(place)
        curve, slope = self._curves(track)
        self._check_rest(float(slope(track.begin)), slope(track.time))
        moment = track.begin + time - self.start
        inside = np.clip(moment, track.begin, track.end)
        height = curve(inside) - curve(track.begin)
        rate = np.where(moment == inside, slope(inside), 0.0)
        if self.fade_in == 0.0:
            return height, rate
        share, growth = cosine_ramp((time - self.start) / self.fade_in, 1.0)
        return share * height, share * rate + growth / self.fade_in * height

    def notes(self, places: Sequence[Input]) -> tuple[str, ...]:
        found: dict[str, None] = {}
        for place in places:
            if place.quantity == "road_height":
                found |= dict.fromkeys(self._said(place))
        return tuple(found)

    def _said(self, place: Input) -> list[str]:
        """What is done to a recording before a wheel follows it."""
        track = self._track(place)
        wheel = place.station or place.axle or "wheel"
        said = []
        if track.names != (wheel,):
            said.append(f"{wheel} follows {'the mean of ' if len(track.names) > 1 else ''}{' and '.join(track.names)}")
        offset = float(self._curves(track)[0](track.begin))
        if abs(offset) > _VISIBLE:
            said.append(f"{1e3 * offset:.4g} mm taken off the motion of {wheel}, which begins there")
        left = track.end - track.begin
        if self.duration - self.start > left + 1e-9:
            said.append(f"the recording ends at {self.start + left:.4g} s of the run and is held")
        elif self.skip + self.duration - self.start < left - 1e-9 or self.skip:
            said.append(f"{self.skip:.4g} to {self.skip + self.duration - self.start:.4g} s of the recording")
        return said

    def _curves(self, track: _Track):  # noqa: ANN202 - scipy's interpolants
        """The height over the file's time as a curve through the samples, and its rate."""
        from scipy.interpolate import CubicSpline, PchipInterpolator

        curve = (PchipInterpolator if self.method == "pchip" else CubicSpline)(track.time, track.height)
        return curve, curve.derivative()

    def _check_rest(self, rate: float, rates: np.ndarray) -> None:
        largest = float(np.abs(rates).max())
        if self.fade_in == 0.0 and abs(rate) > _AT_REST * largest:
            raise InputError(
                f"the motion begins with {rate:.3g} m/s, {100 * abs(rate) / largest:.0f} % of its largest; it must "
                "begin at rest: skip more of it, or bring it in, like fade_in = '0.5 s'",
                key="fade_in",
                source="manoeuvre",
            )

    def _track(self, place: Input) -> _Track:
        """What the wheel at a place follows.

        Raises:
            InputError: the file has no signal for it, or ends too early.
        """
        wheel = place.station or place.axle or ("front" if place.x == 0.0 else "rear")
        offered = self._offered("road_height" if place.on_tyre else "wheel_displacement")
        names = tuple(offered[station] for station in stand_ins(wheel, offered))
        if not names:
            text = f"no signal for {wheel}; call one {', '.join(WORDS)} (there are {', '.join(self._signals)})"
            raise InputError(f"{self._signals.source}: {text}", key="signals", source="manoeuvre")
        times = [self._signals[name].time for name in offered.values()]
        first, end = max(float(each[0]) for each in times), min(float(each[-1]) for each in times)
        left = end - first - self.skip
        if left <= 0.0:
            raise InputError(
                f"{self.skip:g} s is not allowed; the recording lasts {max(end - first, 0.0):.6g} s",
                key="skip",
                source="manoeuvre",
            )
        if self.at_end == "refuse" and self.duration - self.start > left + 1e-9:
            raise InputError(
                f"{self.duration:g} s is too long; the recording ends at {self.start + left:.6g} s of the run: "
                "at_end = 'hold' holds its last height",
                key="duration",
                source="manoeuvre",
            )
        time = self._signals[names[0]].time
        heights = [np.interp(time, self._signals[name].time, self._signals.si(name, "m")) for name in names]
        return _Track(names, time, np.mean(heights, axis=0), first + self.skip, end)

    def _offered(self, quantity: str) -> dict[str, str]:
        """Names of the file's signals by station; of a saved run those of a quantity, else those of the other one."""
        if self.signals:
            return {WORDS[word]: name for word, name in self.signals.items()}
        for spelling in ("", quantity, "wheel_displacement", "road_height"):
            names = {station: channel_name(station, spelling) if spelling else word for word, station in WORDS.items()}
            found = {station: name for station, name in names.items() if name in self._signals}
            if found:
                return found
        only = tuple(self._signals)
        return {"": only[0]} if len(only) == 1 else {}


if __name__ == "__main__":
    from design.cli import manoeuvre_script

    manoeuvre_script("recorded_motion")
