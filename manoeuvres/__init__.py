"""What is done to a car: one module a manoeuvre, each also a script (``python manoeuvres/bump.py --help``).

The modules have English names. Where the thesis names a manoeuvre in German, a file of that name is the same script
(``python manoeuvres/zuziehen.py``), and its German name can be written in a case file.
"""

from __future__ import annotations

from susp_mj.character import Character
from susp_mj.description import left_out
from susp_mj.errors import InputError, choices, short
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
from .recorded_motion import RecordedMotion
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
    each.name(): each
    for each in (
        Bump,
        RoadStep,
        VerticalSweep,
        UnevenRoad,
        RandomRoad,
        RecordedMotion,
        LateralForce,
        LongitudinalForce,
        RollAngle,
        RampSteer,
        StepSteer,
        SweptSteer,
        SineSteer,
        SteadyCircle,
        LaneChange,
        Acceleration,
        Braking,
        BrakingInTurn,
        SplitMu,
        Crosswind,
        CrossSlope,
        SuspensionRig,
    )
}
"""Every manoeuvre by its kind."""


def find_manoeuvre(name: str) -> str:
    """Registered kind of a manoeuvre given by its kind or its German name.

    Raises:
        InputError: no such manoeuvre.
    """
    if name in MANOEUVRES:
        return name
    found = next((kind for kind, each in MANOEUVRES.items() if each.german == name.lower() != ""), None)
    if found is None:
        raise InputError(f"'{name}' unknown; {choices(MANOEUVRES, name)}", key="kind")
    return found


def register(manoeuvre: type[Manoeuvre]) -> None:
    """Make a manoeuvre of your own known by its `kind`, in case files and on the command line.

    Raises:
        InputError: it has no kind, the kind is taken by another, or it does not say what it is, what it needs, what is
            done or when it begins.
    """
    kind = manoeuvre.name()
    if not isinstance(kind, str):
        raise InputError(f"{manoeuvre.__name__} needs a default for 'kind', like kind: Literal['mine'] = 'mine'")
    if left_out(manoeuvre):
        raise InputError(f"{manoeuvre.__name__} does not define {left_out(manoeuvre)}, which every manoeuvre has")
    for name, wanted in (("character", Character), ("needs", tuple)):
        given = getattr(manoeuvre, name)
        if not isinstance(given, wanted):
            raise InputError(f"{name} of {manoeuvre.__name__} is {short(given)}, not a {wanted.__name__}")
    if not hasattr(manoeuvre, manoeuvre.begins) and manoeuvre.begins not in ("start", *manoeuvre.model_fields):
        raise InputError(f"{manoeuvre.__name__} begins with '{manoeuvre.begins}', which is none of its parameters")
    manoeuvre.model_rebuild()  # a parameter that no file can give is refused here, by the line of a plugin
    taken = {each.german for each in MANOEUVRES.values()}
    if kind in taken or MANOEUVRES.get(kind, manoeuvre) is not manoeuvre:
        raise InputError(f"kind '{kind}' of {manoeuvre.__name__} is taken by another manoeuvre")
    MANOEUVRES[kind] = manoeuvre


__all__ = [
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
    "RecordedMotion",
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
