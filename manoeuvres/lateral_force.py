"""Lateral force at the body's centre of gravity (Seitenkraft)."""

from __future__ import annotations

from typing import ClassVar, Literal

from manoeuvres.rise import Rise
from susp_mj.character import Character
from susp_mj.units import Acceleration, PositiveTime


class LateralForce(Rise):
    """Lateral force at the centre of gravity: the inertial force ``-m a_y`` of a steady turn, rising and staying.

    Attributes:
        acceleration: a_y [m/s²] of the sprung mass, positive in a left turn, which rolls the body to the right.
        start, rise_time: [s].

    Source: thesis, table 7.1, oscillation model 4.
    """

    character: ClassVar[Character] = Character("Lateral force")
    german: ClassVar[str] = "seitenkraft"
    default_model: ClassVar[str] = "full_3dof"
    needs: ClassVar[tuple[str, ...]] = ("lateral_acceleration",)

    kind: Literal["lateral_force"] = "lateral_force"
    duration: PositiveTime = 3.0
    acceleration: Acceleration = 4.0

    def level(self) -> float:
        return self.acceleration


if __name__ == "__main__":
    from design.cli import manoeuvre_script

    manoeuvre_script("lateral_force")
