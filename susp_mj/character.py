"""Character: what a manoeuvre is, for everything that judges or shows its runs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

from .errors import InputError, choices
from .names import QUANTITIES

Car = Literal["oscillation", "handling", "rig"]
"""What a run is of: an oscillation model, a car that drives freely, the same car held on the kinematics rig."""

TRAITS: dict[str, str] = {
    "steering": "the steering wheel is what the driver moves: its amplitude is an angle",
    "steering_step": "it is turned to an angle that is held",
    "turn": "the car drives through a bend to one side",
    "tightened": "so slowly that every instant is close to a steady turn",
    "braking": "the brakes are applied as it begins",
    "acceleration": "the accelerator is pressed as it begins",
    "disturbance": "from then on a car that shall go straight on is pushed aside",
    "course": "what it is about is where the car goes on the ground",
    "required_roll": "a rig rolls the body to the angle that a lateral acceleration may cause",
}
"""What may hold of a manoeuvre, by its trait."""


def register_trait(trait: str, meaning: str) -> None:
    """Add a trait of your own, for manoeuvres that have it and numbers that are for their runs.

    Args:
        meaning: what holds of a manoeuvre that has it, one phrase.

    Raises:
        InputError: the trait is taken; the same trait with the same meaning is not.
    """
    if TRAITS.get(trait, meaning) != meaning:
        raise InputError(f"trait '{trait}' is taken: {TRAITS[trait]}")
    TRAITS[trait] = meaning


def check_traits(*traits: str) -> None:
    """Refuse traits that nobody knows.

    Raises:
        InputError: naming the trait.
    """
    for trait in traits:
        if trait not in TRAITS:
            raise InputError(f"trait '{trait}' unknown; {choices(TRAITS, trait)}; or bring it by register_trait")


@dataclass(frozen=True)
class Character:
    """What a manoeuvre is; kept with each of its runs.

    Attributes:
        title: what a reader calls it; empty takes its kind.
        traits: what holds of it, of `TRAITS`.
        average: length of the average [s] that takes quick events, a shift of gears say, out of a ``tightened`` turn.
        together: quantities that are drawn over time in one figure.
        begin: when what it is about begins [s].

    Raises:
        InputError: an unknown trait, or an unknown quantity.
    """

    title: str = ""
    traits: tuple[str, ...] = ()
    average: float = 0.0
    together: tuple[str, ...] = ()
    begin: float = 0.0

    def __post_init__(self) -> None:
        for key, names in (("traits", self.traits), ("together", self.together)):
            if isinstance(names, str):
                raise InputError(f"{key}: '{names}' is not allowed; write ('{names}',)")
        check_traits(*self.traits)
        for quantity in self.together:
            if quantity not in QUANTITIES:
                raise InputError(f"together: quantity '{quantity}' unknown; {choices(QUANTITIES, quantity)}")

    def plain(self) -> dict[str, Any]:
        """As plain JSON values."""
        return {name: list(value) if isinstance(value, tuple) else value for name, value in vars(self).items()}

    @classmethod
    def read(cls, plain: Mapping[str, Any]) -> Character:
        """Inverse of `plain`; a trait whose plugin is not loaded is left out, for nobody can ask about it."""
        values: dict[str, Any] = {
            name: tuple(value) if isinstance(value, list) else value for name, value in plain.items()
        }
        traits = (trait for trait in values.pop("traits", ()) if trait in TRAITS)
        return cls(**values, traits=tuple(traits))
