"""Kinematics and compliance rig: one slow input after the other on a held body (Kennwerte der Achse)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import model_validator

from manoeuvres.driving import PositiveAngle
from susp_mj.character import Character
from susp_mj.description import wrong
from susp_mj.errors import InputError
from susp_mj.manoeuvre import Manoeuvre, ValueAndRate
from susp_mj.meaning import Input
from susp_mj.roads import cosine_ramp
from susp_mj.units import PositiveForce, PositiveLength, PositiveTime, Quantity, Time

TESTS: dict[str, tuple[str, str]] = {
    "bump": ("heave_target", "heave"),
    "roll": ("roll_target", "roll"),
    "steer": ("steering_wheel_angle", "steering_wheel_angle"),
    "lateral_force": ("lateral_force", "lateral_force"),
    "longitudinal_force": ("longitudinal_force", "longitudinal_force"),
    "aligning_moment": ("aligning_moment", "aligning_moment"),
}
"""Test -> (input that it moves, parameter that is its amplitude)."""


class SuspensionRig(Manoeuvre):
    """The body is held and one input swept slowly to both sides and back: ``A sin(2 pi s)``, s rising softly from 0 to
    1.

    ``bump`` moves the body down and up over standing wheels, ``roll`` rolls it; ``steer`` turns the steering wheel;
    ``lateral_force``, ``longitudinal_force`` and ``aligning_moment`` act on all contact patches in wheel axes, to the
    left, forwards and about the upward vertical, on a ground without friction.

    Attributes:
        test: which input is swept.
        heave: amplitude of ``bump`` [m].
        roll: of ``roll`` [rad].
        steering_wheel_angle: of ``steer`` [rad].
        lateral_force, longitudinal_force: of those tests, per wheel [N].
        aligning_moment: of that test, per wheel [N m].
        opposed: whether the forces or moments on the right are opposite to those on the left.
        start: [s].

    Source: thesis, table 7.1, "investigation of suspension property"; the values are ours.
    """

    character: ClassVar[Character] = Character("Suspension rig")
    german: ClassVar[str] = "kennwerte"
    default_model: ClassVar[str] = "handling"
    test_load: ClassVar[str] = "empty"
    needs: ClassVar[tuple[str, ...]] = ("heave_target",)
    rig: ClassVar[str | None] = "k_and_c"

    kind: Literal["suspension_rig"] = "suspension_rig"
    duration: PositiveTime = 20.0
    test: Literal["bump", "roll", "steer", "lateral_force", "longitudinal_force", "aligning_moment"] = "bump"
    heave: PositiveLength = 0.06
    roll: PositiveAngle = np.radians(4.0)
    steering_wheel_angle: PositiveAngle = np.radians(360.0)
    lateral_force: PositiveForce = 2000.0
    longitudinal_force: PositiveForce = 2000.0
    aligning_moment: Annotated[float, Quantity("N m", gt=0)] = 100.0
    opposed: bool = False
    start: Time = 0.5

    @model_validator(mode="after")
    def _can_be_opposed(self) -> SuspensionRig:
        if self.opposed and self.test in ("bump", "roll", "steer"):
            raise wrong(
                f"true is not allowed for test '{self.test}'; only forces and moments can be opposed", "opposed"
            )
        return self

    @property
    def swept(self) -> str:
        """Quantity of the input that the test moves."""
        return TESTS[self.test][0]

    def drive(self, place: Input, time: np.ndarray) -> ValueAndRate | None:
        if place.quantity != self.swept:
            return None
        amplitude = getattr(self, TESTS[self.test][1]) * (-1.0 if self.opposed and place.y < 0 else 1.0)
        length = self.duration - self.start
        progress, slope = cosine_ramp((time - self.start) / length, 1.0)
        angle = 2 * np.pi * progress
        return amplitude * np.sin(angle), amplitude * 2 * np.pi * slope / length * np.cos(angle)

    def check(self, places: Sequence[Input], model: str) -> None:
        super().check(places, model)
        if self.swept not in {place.quantity for place in places}:
            raise InputError(
                f"model {model} has no input '{self.swept}', which test '{self.test}' drives", key="manoeuvre.test"
            )


if __name__ == "__main__":
    from design.cli import manoeuvre_script

    manoeuvre_script("suspension_rig")
