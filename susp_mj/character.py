"""Character: what a manoeuvre is, for everything that judges or shows its runs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

Car = Literal["oscillation", "handling", "rig"]
"""What a run is of: an oscillation model, a car that drives freely, the same car held on the kinematics rig."""

Trait = Literal[
    "steering",  # the steering wheel is what the driver moves: its amplitude is an angle
    "steering_step",  # it is turned to an angle that is held
    "turn",  # the car drives through a bend to one side
    "tightened",  # so slowly that every instant is close to a steady turn
    "braking",  # the brakes are applied as it begins
    "acceleration",  # the accelerator is pressed as it begins
    "disturbance",  # from then on a car that shall go straight on is pushed aside
    "course",  # what it is about is where the car goes on the ground
    "required_roll",  # a rig rolls the body to the angle that a lateral acceleration may cause
]


@dataclass(frozen=True)
class Character:
    """What a manoeuvre is; kept with each of its runs.

    Attributes:
        title: what a reader calls it; empty takes its kind.
        traits: what holds of it.
        average: length of the average [s] that takes quick events, a shift of gears say, out of a ``tightened`` turn.
        together: quantities that are drawn over time in one figure.
        begin: when what it is about begins [s].
    """

    title: str = ""
    traits: tuple[Trait, ...] = ()
    average: float = 0.0
    together: tuple[str, ...] = ()
    begin: float = 0.0

    def plain(self) -> dict[str, Any]:
        """As plain JSON values."""
        return {name: list(value) if isinstance(value, tuple) else value for name, value in vars(self).items()}

    @classmethod
    def read(cls, plain: Mapping[str, Any]) -> Character:
        """Inverse of `plain`."""
        values: dict[str, Any] = {
            name: tuple(value) if isinstance(value, list) else value for name, value in plain.items()
        }
        return cls(**values)
