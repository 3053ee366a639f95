"""Manoeuvres registered nowhere, as a user would write them: inputs as given, roads smooth enough to show an order."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np
from pydantic import Field

from susp_mj import Manoeuvre
from susp_mj.manoeuvre import ValueAndRate
from susp_mj.meaning import Input
from susp_mj.units import PositiveTime

from ..verification.reference import Road


class Driven(Manoeuvre):
    """Inputs as given: (time, value) pairs, linear between, with the controller holding the speed; on a road, with a
    driver."""

    kind: str = "driven"
    speed: float = 20.0
    control: float = 1.0
    inputs: dict[str, list[tuple[float, float]]] = {}  # noqa: RUF012 - pydantic copies it
    ground: object = Field(default=None, exclude=True)
    steerer: object = Field(default=None, exclude=True)

    def road(self):
        return self.ground

    def driver(self):
        return self.steerer

    def drive(self, place: Input, time: np.ndarray) -> ValueAndRate | None:
        inputs = {"speed_target": [(0.0, self.speed)], "speed_control": [(0.0, self.control)], **self.inputs}
        points = inputs.get(f"{place.station}_{place.quantity}" if place.station else place.quantity)
        if points is None:
            return None
        moments, values = (np.array(each) for each in zip(*points, strict=True))
        slopes = np.concatenate([[0.0], np.diff(values) / np.diff(moments), [0.0]])
        return np.interp(time, moments, values), slopes[np.searchsorted(moments, time, side="right")]


class SmoothBump(Manoeuvre):
    """``z = h exp(-((t - t0)/w)²)``, smooth to every order."""

    needs: ClassVar[tuple[str, ...]] = ("road_height",)

    kind: Literal["smooth_bump"] = "smooth_bump"
    duration: PositiveTime = 1.5
    height: float = 0.02
    centre: float = 0.5
    width: float = 0.06

    def drive(self, place, time):
        share = (time - self.centre) / self.width
        height = self.height * np.exp(-(share**2))
        return height, -2 * share / self.width * height

    def reference(self) -> Road:
        """The same road for the reference."""

        def z(t: float) -> float:
            return self.height * np.exp(-(((t - self.centre) / self.width) ** 2))

        def dz(t: float) -> float:
            return -2 * (t - self.centre) / self.width**2 * z(t)

        return Road(z, dz)


class SteadySine(Manoeuvre):
    """``z = a sin(2 pi f t)``, faded in over the first half of the run."""

    needs: ClassVar[tuple[str, ...]] = ("road_height",)

    kind: Literal["steady_sine"] = "steady_sine"
    duration: PositiveTime = 10.0
    amplitude: float = 0.002
    frequency: float = 1.0

    def drive(self, place, time):
        w, ramp = 2 * np.pi * self.frequency, self.duration / 2
        share = np.clip(time / ramp, 0, 1)
        fade, fade_rate = np.sin(np.pi / 2 * share) ** 2, np.pi / 2 / ramp * np.sin(np.pi * share)
        sine, cosine = self.amplitude * np.sin(w * time), self.amplitude * np.cos(w * time)
        return fade * sine, fade * w * cosine + fade_rate * sine


def under_another_kind(manoeuvre: type[Manoeuvre]) -> type[Manoeuvre]:
    """A subclass that differs in its kind alone."""
    own = {"__module__": __name__, "__annotations__": {"kind": Literal["own"]}, "kind": "own"}
    return type("Own", (manoeuvre,), own)
