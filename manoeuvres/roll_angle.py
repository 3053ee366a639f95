"""Prescribed roll angle on a rig (Wankwinkel)."""

from __future__ import annotations

from typing import ClassVar, Literal

import numpy as np

from susp_mj.units import Angle, PositiveTime

from .rise import Rise


class RollAngle(Rise):
    """Roll angle input: a rig rolls the body slowly to `angle` and holds it there, heave and pitch free.

    Attributes:
        angle: [rad], positive left side up.
        start, rise_time: [s]; slow, so that damping plays no part at the end.

    Source: thesis, table 7.1, "estimation of anti-roll bar stiffness".
    """

    needs: ClassVar[tuple[str, ...]] = ("roll_target",)
    rig: ClassVar[str | None] = "roll"

    kind: Literal["roll_angle"] = "roll_angle"
    duration: PositiveTime = 6.0
    rise_time: PositiveTime = 4.0
    angle: Angle = np.radians(5.0)

    def level(self) -> float:
        return self.angle


if __name__ == "__main__":
    from design.cli import manoeuvre_script

    manoeuvre_script("roll_angle")
