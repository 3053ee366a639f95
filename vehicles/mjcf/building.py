"""Vehicle to MuJoCo: every model by its name."""

from __future__ import annotations

from pathlib import Path

import mujoco

from susp_mj.errors import InputError, choices
from susp_mj.meaning import Meaning
from susp_mj.plant import Plant, write_mjcf

from ..models import HANDLING, MODELS
from ..vehicle import DESIGN_LOAD, Vehicle
from .handling import handling_specification
from .oscillation import oscillation_specification


def build(
    vehicle: Vehicle, model: str, load: str = DESIGN_LOAD, axle: str | None = None, rig: str | None = None
) -> Plant:
    """Build a model of a car.

    Args:
        model: a key of `MODELS`.
        load: load case of the vehicle.
        axle: ``front`` or ``rear`` for models of one axle; None takes the rear, or the only one there is.
        rig: ``roll`` puts an oscillation model on a rig that prescribes its roll angle, ``k_and_c`` the handling car on
            one that holds its body and pushes its wheels.

    Raises:
        InputError: unknown model, load case, axle or rig, or a value that the model needs is missing.
    """
    return Plant.from_spec(*specification(vehicle, model, load, axle, rig))


def write(
    vehicle: Vehicle,
    model: str,
    path: str | Path,
    load: str = DESIGN_LOAD,
    axle: str | None = None,
    rig: str | None = None,
) -> Path:
    """Write the MJCF file of the model that `build` makes, complete and with every digit."""
    return write_mjcf(*specification(vehicle, model, load, axle, rig), path)


def specification(
    vehicle: Vehicle, model: str, load: str = DESIGN_LOAD, axle: str | None = None, rig: str | None = None
) -> tuple[mujoco.MjSpec, Meaning]:
    """The MuJoCo specification of a model and the meaning of its numbers; arguments as for `build`."""
    if model not in MODELS:
        raise InputError(f"no model '{model}'; {choices(MODELS, model)}", key="model")
    if model != HANDLING:
        return oscillation_specification(vehicle, model, load, axle, rig)
    if axle is not None:
        raise InputError(f"'{axle}' is not allowed; model {model} has both axles", key="axle")
    return handling_specification(vehicle, load, rig)
