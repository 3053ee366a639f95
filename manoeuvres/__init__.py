"""What is done to a car: one module a manoeuvre, each also a script (``python manoeuvres/bump.py --help``)."""

from __future__ import annotations

from susp_mj.manoeuvre import Manoeuvre

from .bump import Bump
from .road_step import RoadStep
from .vertical_sweep import VerticalSweep

MANOEUVRES: dict[str, type[Manoeuvre]] = {
    "bump": Bump,
    "step": RoadStep,
    "vertical_sweep": VerticalSweep,
}

__all__ = ["MANOEUVRES", "Bump", "RoadStep", "VerticalSweep"]
