"""Manoeuvre: what is done to a plant, as values and rates of its inputs over time."""

from __future__ import annotations

import dataclasses
from abc import ABC, abstractmethod
from collections.abc import Sequence
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from .character import Character
from .description import Description
from .errors import InputError
from .units import PositiveTime, readable, unit_of_field

if TYPE_CHECKING:
    from .elements.driver import Driver
    from .meaning import Input
    from .roads import Road

ValueAndRate = tuple[np.ndarray, np.ndarray]


class Manoeuvre(Description, ABC):
    """Base of every manoeuvre; a subclass adds its parameters, `needs` and `drive`.

    Attributes:
        kind: name in a case file.
        duration: length of the run [s].
    """

    needs: ClassVar[tuple[str, ...]] = ()
    """Quantities of inputs that the plant must offer."""

    rig: ClassVar[str | None] = None
    """Rig that the plant must be built on, if any."""

    character: ClassVar[Character] = Character()
    """What it is, for numbers, plots and titles of its runs; `declared` fills in when it begins."""

    begins: ClassVar[str] = "start"
    """Parameter that says when what it is about begins [s]; without it that is the beginning of the run."""

    german: ClassVar[str] = ""
    """German name, by which a case file may call it too."""

    default_model: ClassVar[str] = "quarter_2dof"
    """Model on which it runs as a script."""

    test_load: ClassVar[str] = ""
    """Load case in which a car that has it is tested; empty is the design position."""

    kind: str
    duration: PositiveTime

    @abstractmethod
    def drive(self, place: Input, time: np.ndarray) -> ValueAndRate | None:
        """Value and rate of one of the plant's inputs.

        Args:
            place: the input: its quantity, station and position on the car.
            time: (n,) [s].

        Returns:
            (n,) values and (n,) rates per second in the input's unit, or None for an input that stays zero.
        """

    def road(self) -> Road | None:
        """Road for a car that drives freely, its front axle at x = 0 when the run begins; None is level."""
        return None

    def surface(self, road: Road | None) -> Road | None:
        """A road with the friction that the manoeuvre's `grip` gives all of it; None is level."""
        from .roads import Road

        grip = float(getattr(self, "grip", 1.0))
        return road if grip == 1.0 else dataclasses.replace(road or Road(), friction=grip)

    def driver(self) -> Driver | None:
        """Driver who steers, instead of an open-loop steering input."""
        return None

    @classmethod
    def name(cls) -> str:
        """Its kind, as case files write it."""
        return cls.model_fields["kind"].default

    @classmethod
    def title(cls) -> str:
        """What a reader calls it: the title that it declares, else its kind in words."""
        return cls.character.title or cls.name().replace("_", " ").capitalize()

    def declared(self) -> Character:
        """Its character, with its title and its begin."""
        return dataclasses.replace(self.character, title=self.title(), begin=float(getattr(self, self.begins, 0.0)))

    def road_sweep(self) -> tuple[float, float] | None:
        """Frequencies [Hz] from and to which it sweeps the road under the wheels; None if it does not."""
        return None

    def weight(self, place: Input, frequency: float) -> complex:
        """Complex amplitude of a wheel's road in a sweep, relative to a wheel that is neither opposed nor delayed.

        Args:
            frequency: [Hz].
        """
        return 1.0

    def driving_speed(self) -> float:
        """Speed [m/s] at which a car that drives freely begins: the manoeuvre's `speed`, or standing still."""
        return float(getattr(self, "speed", 0.0))

    def readable(self) -> dict[str, str]:
        """Its parameters, those left to their defaults too, as a case file would have them: each with its unit.
        What is not given at all is left out."""
        texts = {
            name: readable(value, unit_of_field(field)) if isinstance(value, float) else _text(value)
            for name, field in type(self).model_fields.items()
            if name != "kind" and (value := getattr(self, name)) is not None
        }
        return {name: text for name, text in texts.items() if text}

    def record(self, time: np.ndarray) -> dict[str, np.ndarray]:
        """Signals of the manoeuvre itself to keep with the run, by quantity; by default none."""
        return {}

    def notes(self, places: Sequence[Input]) -> tuple[str, ...]:
        """What a reader of its runs should know beyond its parameters, in phrases; by default nothing.

        Args:
            places: inputs of the plant.
        """
        return ()

    def check(self, places: Sequence[Input], model: str) -> None:
        """Refuse a plant that lacks an input.

        Raises:
            InputError: naming the input.
        """
        offered = {place.quantity for place in places}
        for quantity in self.needs:
            if quantity not in offered:
                raise InputError(
                    f"model {model} has no input '{quantity}', which manoeuvre {self.kind} drives", key="model"
                )


def _text(value: object) -> str:
    """A value without unit as a reader wants it."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, dict):
        return ", ".join(f"{key} {each}" for key, each in value.items())
    return ", ".join(map(str, value)) if isinstance(value, tuple) else str(value)
