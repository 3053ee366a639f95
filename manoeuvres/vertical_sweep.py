"""Vertical sine sweep of the road under the wheels (Gleitsinus)."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np
from pydantic import model_validator

from manoeuvres.sweeping import Sweep
from susp_mj.character import Character
from susp_mj.description import wrong
from susp_mj.manoeuvre import Manoeuvre, ValueAndRate
from susp_mj.meaning import Input
from susp_mj.units import Frequency, PositiveLength, PositiveSpeed, PositiveTime


class VerticalSweep(Manoeuvre):
    """Sine of the road height whose frequency rises exponentially, ``f(t) = f0 (f1/f0)^(t/T)``.

    Phase ``phi = 2 pi f0 T / ln(f1/f0) ((f1/f0)^(t/T) - 1)``; the amplitude is constant, or falls as ``f0/f`` where
    `constant_speed` keeps the road's speed amplitude instead. It fades in over the first period. Phase and frequency
    are kept with the run, so that amplifications can be read off by demodulation.

    Attributes:
        amplitude: of the road height at the start frequency [m].
        start_frequency, end_frequency: f0 and f1 [Hz].
        constant_speed: whether the amplitude falls with frequency.
        mode: ``in_phase``; ``anti_phase`` (right wheels opposite to left); ``pitch`` (rear wheels opposite to front).
        speed: if given, the rear wheels follow the front ones later by wheelbase/speed [m/s].

    Source: thesis, table 7.1; the exponential sweep after A. Farina, AES Convention 108 (2000), 5093.
    """

    character: ClassVar[Character] = Character("Vertical sine sweep")
    german: ClassVar[str] = "gleitsinus"
    needs: ClassVar[tuple[str, ...]] = ("road_height",)

    kind: Literal["vertical_sweep"] = "vertical_sweep"
    duration: PositiveTime = 60.0
    amplitude: PositiveLength = 0.05
    start_frequency: Frequency = 0.3
    end_frequency: Frequency = 20.0
    constant_speed: bool = True
    mode: Literal["in_phase", "anti_phase", "pitch"] = "in_phase"
    speed: PositiveSpeed | None = None

    @model_validator(mode="after")
    def _rising(self) -> VerticalSweep:
        if self.end_frequency <= self.start_frequency:
            raise wrong(
                f"{self.end_frequency} Hz is not allowed; it must lie above start_frequency {self.start_frequency} Hz",
                "end_frequency",
            )
        return self

    def drive(self, place: Input, time: np.ndarray) -> ValueAndRate | None:
        if place.quantity != "road_height":
            return None
        delay = 0.0 if self.speed is None else -place.x / self.speed
        height, rate = self._sine(np.maximum(time - delay, 0.0))
        sign = -1.0 if self._opposed(place) else 1.0
        return sign * height, np.where(time >= delay, sign * rate, 0.0)

    def weight(self, place: Input, frequency: float) -> complex:
        delay = 0.0 if self.speed is None else -place.x / self.speed
        return (-1.0 if self._opposed(place) else 1.0) * complex(np.exp(-2j * np.pi * frequency * delay))

    def road_sweep(self) -> tuple[float, float]:
        return self.start_frequency, self.end_frequency

    def _opposed(self, place: Input) -> bool:
        """Whether a wheel's road is opposite to the first one's."""
        return (self.mode == "anti_phase" and place.y < 0) or (self.mode == "pitch" and place.x < 0)

    def _sine(self, time: np.ndarray) -> ValueAndRate:
        """Height and rate of the sweep under the first wheel."""
        value, rate = self._sweep.sine(time)
        if not self.constant_speed:
            return self.amplitude * value, self.amplitude * rate
        growth = np.log(self.end_frequency / self.start_frequency) / self.duration
        amplitude = self.amplitude * self.start_frequency / self._sweep.frequency(time)
        return amplitude * value, amplitude * (rate - growth * value)

    def record(self, time: np.ndarray) -> dict[str, np.ndarray]:
        return self._sweep.record(time)

    def driving_speed(self) -> float:
        """Zero: a car stands on a test rig that delays the rear wheels' road, whatever the speed."""
        return 0.0

    @property
    def _sweep(self) -> Sweep:
        return Sweep(self.start_frequency, self.end_frequency, self.duration)


if __name__ == "__main__":
    from design.cli import manoeuvre_script

    manoeuvre_script("vertical_sweep")
