"""Prescribed roll angle on a rig (Wankwinkel)."""

from __future__ import annotations

from typing import Annotated, ClassVar, Literal

import numpy as np

from manoeuvres.rise import Rise
from susp_mj.character import Character
from susp_mj.units import PositiveTime, Quantity


class RollAngle(Rise):
    """Roll angle input: a rig rolls the body slowly to `angle` and holds it there, heave and pitch free.

    Attributes:
        angle: [rad], positive left side up.
        lateral_acceleration: a_y [m/s²] at which this angle is required; with the angle it is the roll flexibility from
            which anti-roll bars are estimated.
        front_share: required share of the front axle in the roll moment, 0 to 1.
        start, rise_time: [s]; slow, so that damping plays no part at the end.

    Source: thesis, table 7.1, "estimation of anti-roll bar stiffness".
    """

    character: ClassVar[Character] = Character("Roll angle", ("required_roll",))
    german: ClassVar[str] = "wankwinkel"
    default_model: ClassVar[str] = "full_3dof"
    needs: ClassVar[tuple[str, ...]] = ("roll_target",)
    rig: ClassVar[str | None] = "roll"

    kind: Literal["roll_angle"] = "roll_angle"
    duration: PositiveTime = 6.0
    rise_time: PositiveTime = 4.0
    angle: Annotated[float, Quantity("rad", gt=0)] = np.radians(5.0)
    lateral_acceleration: Annotated[float, Quantity("m/s²", gt=0)] = 7.0
    front_share: Annotated[float, Quantity("", ge=0, le=1)] = 0.6

    def level(self) -> float:
        return self.angle


if __name__ == "__main__":
    from design.cli import manoeuvre_script

    manoeuvre_script("roll_angle")
