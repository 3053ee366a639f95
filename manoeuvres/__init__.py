"""What is done to a car: one module a manoeuvre, each also a script (``python manoeuvres/bump.py --help``).

The modules have English names. Where the thesis names a manoeuvre in German, a file of that name is the same script
(``python manoeuvres/zuziehen.py``), and every German name in `ALIASES` can be written in a case file.
"""

from __future__ import annotations

from susp_mj.errors import InputError, choices
from susp_mj.manoeuvre import Manoeuvre

from .acceleration import Acceleration
from .braking import Braking
from .braking_in_turn import BrakingInTurn
from .bump import Bump
from .cross_slope import CrossSlope
from .crosswind import Crosswind
from .lane_change import LaneChange
from .lateral_force import LateralForce
from .longitudinal_force import LongitudinalForce
from .ramp_steer import RampSteer
from .random_road import RandomRoad
from .road_step import RoadStep
from .roll_angle import RollAngle
from .sine_steer import SineSteer
from .split_mu import SplitMu
from .steady_circle import SteadyCircle
from .step_steer import StepSteer
from .suspension_rig import SuspensionRig
from .swept_steer import SweptSteer
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
    "ramp_steer": RampSteer,
    "step_steer": StepSteer,
    "swept_steer": SweptSteer,
    "sine_steer": SineSteer,
    "steady_circle": SteadyCircle,
    "lane_change": LaneChange,
    "acceleration": Acceleration,
    "braking": Braking,
    "braking_in_turn": BrakingInTurn,
    "split_mu": SplitMu,
    "crosswind": Crosswind,
    "cross_slope": CrossSlope,
    "suspension_rig": SuspensionRig,
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
    "zuziehen": "ramp_steer",
    "lenkwinkelsprung": "step_steer",
    "lenksweep": "swept_steer",
    "lenkeinsinus": "sine_steer",
    "kreisfahrt": "steady_circle",
    "doppelter_fahrspurwechsel": "lane_change",
    "beschleunigung": "acceleration",
    "bremsen": "braking",
    "bremsen_in_der_kurve": "braking_in_turn",
    "mu_split": "split_mu",
    "seitenwind": "crosswind",
    "querneigung": "cross_slope",
    "kennwerte": "suspension_rig",
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


def register(manoeuvre: type[Manoeuvre]) -> None:
    """Make a manoeuvre of your own known by its `kind`, in case files and on the command line.

    Raises:
        InputError: it has no kind, or the kind is taken by another.
    """
    kind = manoeuvre.model_fields["kind"].default
    if not isinstance(kind, str):
        raise InputError(f"{manoeuvre.__name__} needs a default for 'kind', like kind: Literal['mine'] = 'mine'")
    if kind in ALIASES or MANOEUVRES.get(kind, manoeuvre) is not manoeuvre:
        raise InputError(f"kind '{kind}' of {manoeuvre.__name__} is taken by another manoeuvre")
    MANOEUVRES[kind] = manoeuvre


__all__ = [
    "ALIASES",
    "MANOEUVRES",
    "Acceleration",
    "Braking",
    "BrakingInTurn",
    "Bump",
    "CrossSlope",
    "Crosswind",
    "LaneChange",
    "LateralForce",
    "LongitudinalForce",
    "RampSteer",
    "RandomRoad",
    "RoadStep",
    "RollAngle",
    "SineSteer",
    "SplitMu",
    "SteadyCircle",
    "StepSteer",
    "SuspensionRig",
    "SweptSteer",
    "UnevenRoad",
    "VerticalSweep",
    "find_manoeuvre",
    "register",
]
