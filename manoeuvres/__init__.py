"""What is done to a car: one module a manoeuvre, each also a script (``python manoeuvres/bump.py --help``)."""

from __future__ import annotations

from susp_mj.errors import InputError, choices
from susp_mj.manoeuvre import Manoeuvre

from .bump import Bump
from .lateral_force import LateralForce
from .longitudinal_force import LongitudinalForce
from .random_road import RandomRoad
from .road_step import RoadStep
from .roll_angle import RollAngle
from .uneven_road import UnevenRoad
from .vertical_sweep import VerticalSweep

MANOEUVRES: dict[str, type[Manoeuvre]] = {
    "bump": Bump,
    "step": RoadStep,
    "vertical_sweep": VerticalSweep,
    "uneven_road": UnevenRoad,
    "random_road": RandomRoad,
    "lateral_force": LateralForce,
    "longitudinal_force": LongitudinalForce,
    "roll_angle": RollAngle,
}
ALIASES = {
    "bodenwelle": "bump",
    "schwelle": "step",
    "gleitsinus": "vertical_sweep",
    "einseitige_bodenwelle": "uneven_road",
    "zufallsstrasse": "random_road",
    "seitenkraft": "lateral_force",
    "laengskraft": "longitudinal_force",
    "wankwinkel": "roll_angle",
}
"""German names that a practitioner knows."""


def find_manoeuvre(name: str) -> str:
    """Registered name of a manoeuvre given by its name or German alias.

    Raises:
        InputError: no such manoeuvre.
    """
    found = ALIASES.get(name.lower(), name)
    if found not in MANOEUVRES:
        raise InputError(f"'{name}' unknown; {choices(MANOEUVRES, name)}", key="kind")
    return found


__all__ = [
    "ALIASES",
    "MANOEUVRES",
    "Bump",
    "LateralForce",
    "LongitudinalForce",
    "RandomRoad",
    "RoadStep",
    "RollAngle",
    "UnevenRoad",
    "VerticalSweep",
    "find_manoeuvre",
]
