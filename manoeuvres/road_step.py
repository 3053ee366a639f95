"""Step of the road height, up or down, with a finite rise time (Schwelle)."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np
from pydantic import model_validator

from manoeuvres.wheels import checked, is_chosen
from susp_mj.character import Character
from susp_mj.manoeuvre import Manoeuvre, ValueAndRate
from susp_mj.meaning import Input
from susp_mj.roads import cosine_ramp
from susp_mj.units import Length, PositiveTime, Time


class RoadStep(Manoeuvre):
    """Step of the road under all chosen wheels at once: half a cosine from 0 to `height` within `rise_time`.

    A rise time of 0 is allowed: the height jumps, and so does the load of a rigid wheel through its damper's mount; the
    peak acceleration is then ``k1 h / m`` whatever the damper. The default of 20 ms is reconstructed.

    Attributes:
        height: [m]; positive lifts the wheel (inbound), negative drops it.
        start: beginning of the rise [s].
        rise_time: [s].
        wheels: stations (``fl``) or words (``left``, ``front``); None is all.

    Source: thesis, table 7.1 and appendix 9, model-manoeuvre 1.
    """

    character: ClassVar[Character] = Character("Road step")
    german: ClassVar[str] = "schwelle"
    needs: ClassVar[tuple[str, ...]] = ("road_height",)

    kind: Literal["step"] = "step"
    duration: PositiveTime = 3.0
    height: Length = 0.03
    start: Time = 0.2
    rise_time: Time = 0.02
    wheels: tuple[str, ...] | None = None

    @model_validator(mode="after")
    def _known_wheels(self) -> RoadStep:
        checked(self.wheels)
        return self

    def drive(self, place: Input, time: np.ndarray) -> ValueAndRate | None:
        if place.quantity != "road_height" or not is_chosen(place, self.wheels):
            return None
        if self.rise_time == 0.0:
            return np.where(time >= self.start, self.height, 0.0), np.zeros_like(time)
        height, slope = cosine_ramp((time - self.start) / self.rise_time, self.height)
        return height, slope / self.rise_time


if __name__ == "__main__":
    from design.cli import manoeuvre_script

    manoeuvre_script("step")
