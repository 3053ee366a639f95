"""Longitudinal force at the body's centre of gravity: acceleration and braking (Längskraft)."""

from __future__ import annotations

from typing import ClassVar, Literal

from manoeuvres.rise import Rise
from susp_mj.character import Character
from susp_mj.units import Acceleration, PositiveTime


class LongitudinalForce(Rise):
    """Longitudinal force at the centre of gravity: the inertial force ``-m a_x`` of acceleration or braking.

    Attributes:
        acceleration: a_x [m/s²], positive forward; negative is braking, which puts the nose down.
        start, rise_time: [s].

    Source: thesis, table 7.1, oscillation model 3; without anti-dive, which needs wheel paths.
    """

    character: ClassVar[Character] = Character("Longitudinal force")
    german: ClassVar[str] = "laengskraft"
    default_model: ClassVar[str] = "full_3dof"
    needs: ClassVar[tuple[str, ...]] = ("longitudinal_acceleration",)

    kind: Literal["longitudinal_force"] = "longitudinal_force"
    duration: PositiveTime = 3.0
    acceleration: Acceleration = -5.0

    def level(self) -> float:
        return self.acceleration


if __name__ == "__main__":
    from design.cli import manoeuvre_script

    manoeuvre_script("longitudinal_force")
