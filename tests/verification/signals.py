"""Roads of the user's own: what a manoeuvre registered nowhere looks like, and smooth enough to show an order."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np

from susp_mj import Manoeuvre
from susp_mj.units import PositiveTime

from .reference import Road


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

    def road(self) -> Road:
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


def first_harmonic(time: np.ndarray, values: np.ndarray, frequency: float, periods: int) -> complex:
    """Complex amplitude over the last whole `periods`, by least squares with the higher harmonics beside it."""
    last = time >= time[-1] - periods / frequency
    t = time[last]
    columns = [np.ones_like(t)]
    for harmonic in range(1, 6):
        columns += [np.cos(2 * np.pi * harmonic * frequency * t), np.sin(2 * np.pi * harmonic * frequency * t)]
    found = np.linalg.lstsq(np.column_stack(columns), values[last], rcond=None)[0]
    return complex(found[1], -found[2])
