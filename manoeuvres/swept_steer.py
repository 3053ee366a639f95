"""Sine sweep of the steering wheel at constant speed (Lenksweep)."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np
from pydantic import model_validator

from manoeuvres.driving import Driving, PositiveAngle, SteeringFrequency, fallen
from manoeuvres.sweeping import Sweep
from susp_mj.character import Character
from susp_mj.description import wrong
from susp_mj.manoeuvre import ValueAndRate
from susp_mj.meaning import Input
from susp_mj.units import PositiveTime, Time


class SweptSteer(Driving):
    """Sine of the steering wheel of constant amplitude and rising frequency, faded in over its first period and out
    over its last.

    For gain and phase of yaw velocity, lateral acceleration, roll and side slip over frequency. Phase and frequency are
    kept with the run. Only the exponential sweep keeps the harmonics of a non-linear car apart.

    Attributes:
        amplitude: of the steering wheel [rad].
        start_frequency, end_frequency: [Hz].
        scale: ``exponential`` or ``linear`` rise of the frequency over the run.
        settle: how long the steering wheel is straight at the end, so that the car's response dies away within the run
            [s].
        speed: [m/s].
        start: [s].

    Source: thesis appendix 9, model-manoeuvre 5: 72 km/h, 30°, 0.2 to 2.8 Hz; ISO 7401:2011. How the frequency rises,
    and the length, are reconstructed.
    """

    character: ClassVar[Character] = Character(
        "Swept steer",
        ("steering",),
        together=("steering_wheel_angle", "yaw_rate", "lateral_acceleration", "roll_angle"),
    )
    german: ClassVar[str] = "lenksweep"

    kind: Literal["swept_steer"] = "swept_steer"
    duration: PositiveTime = 60.0
    amplitude: PositiveAngle = np.radians(30.0)
    start_frequency: SteeringFrequency = 0.2
    end_frequency: SteeringFrequency = 2.8
    scale: Literal["exponential", "linear"] = "exponential"
    start: Time = 0.0
    settle: Time = 2.0

    @model_validator(mode="after")
    def _rising(self) -> SweptSteer:
        if self.end_frequency <= self.start_frequency:
            text = (
                f"{self.end_frequency} Hz is not allowed; it must lie above start_frequency {self.start_frequency} Hz"
            )
            raise wrong(text, "end_frequency")
        if self.start + self.settle > self.duration / 2:
            text = (
                f"{self.settle:g} s is not allowed; with the start it must leave half of the run, "
                f"{self.duration / 2:g} s, to the sweep"
            )
            raise wrong(text, "settle")
        return self

    def drive(self, place: Input, time: np.ndarray) -> ValueAndRate | None:
        if place.quantity != "steering_wheel_angle":
            return super().drive(place, time)
        sweep, since = self._sweep, self._since(time)
        value, rate = sweep.sine(since)
        last = 1 / self.end_frequency
        fade, fade_rate = fallen(since, sweep.duration - last, last, 1.0)
        inside = (time >= self.start) & (time < self.start + sweep.duration)
        return self.amplitude * fade * value, np.where(inside, self.amplitude * (fade * rate + fade_rate * value), 0.0)

    def record(self, time: np.ndarray) -> dict[str, np.ndarray]:
        return self._sweep.record(self._since(time))

    def _since(self, time: np.ndarray) -> np.ndarray:
        """Time within the sweep, held before and after it."""
        return np.clip(time - self.start, 0.0, self._sweep.duration)

    @property
    def _sweep(self) -> Sweep:
        return Sweep(
            self.start_frequency, self.end_frequency, self.duration - self.start - self.settle, self.scale == "linear"
        )


if __name__ == "__main__":
    from design.cli import manoeuvre_script

    manoeuvre_script("swept_steer")
