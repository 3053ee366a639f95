"""Kinds of runs that questions are for, and what is known of a run: its car and its manoeuvre."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from susp_mj.character import Car, Character, check_traits
from susp_mj.run import Run

from .number import Runs


def car(run: Run) -> Car:
    """What the run is of: an oscillation model, a car that drives freely, a car on the kinematics rig."""
    return run.meta.get("car", "oscillation")


def character(run: Run) -> Character:
    """What its manoeuvre is."""
    return Character.read(run.meta.get("character", {}))


def is_a(run: Run, *traits: str) -> bool:
    """Whether any of these holds of its manoeuvre.

    Raises:
        InputError: an unknown trait.
    """
    check_traits(*traits)
    return not set(traits).isdisjoint(character(run).traits)


def beginning(run: Run) -> int:
    """Index of the record at which what the manoeuvre is about begins."""
    return int(np.argmax(run.time >= character(run).begin - 1e-9))


def parameter(run: Run, name: str, default: Any = None) -> Any:
    """A parameter of the run's manoeuvre."""
    return run.meta.get("manoeuvre", {}).get(name, default)


def facts(run: Run) -> Mapping[str, float]:
    """Facts of the car: lengths, masses, ratios in SI."""
    return run.meta.get("facts", {})


def drives(run: Run) -> bool:
    """Whether the car of this run drives freely; an oscillation model or a car on a rig does not."""
    return car(run) == "handling"


def on_rig(run: Run) -> bool:
    """Whether the car stands on the kinematics rig, which holds its body."""
    return car(run) == "rig"


def on_tyres(run: Run) -> bool:
    """Whether the car stands or rolls on tyres with slip."""
    return car(run) != "oscillation"


def driving(trait: str, otherwise: str) -> Runs:
    """Runs of a freely driving car of whose manoeuvre something holds, and that last until it begins.

    Raises:
        InputError: an unknown trait.
    """
    check_traits(trait)
    return Runs(lambda run: drives(run) and is_a(run, trait) and character(run).begin <= run.time[-1], otherwise)


DRIVES = Runs(drives, "the car does not drive freely")
NOT_ON_RIG = Runs(lambda run: not on_rig(run), "the rig holds the body")


def recorded(*names: str) -> Runs:
    """Runs that have channels of these names, or of these quantities at any station."""
    return Runs(
        lambda run: all(name in run or run.stations(name) for name in names), f"the run has no {' or '.join(names)}"
    )


def known(*names: str) -> Runs:
    """Runs of cars of which these facts are known."""
    return Runs(lambda run: all(name in facts(run) for name in names), f"{' or '.join(names)} of the car is unknown")
