"""Oscillation models: vertical dynamics of a body on its wheels (thesis section 4.3.1)."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import mujoco

from susp_mj.errors import InputError, choices
from susp_mj.plant import Meaning, Plant, write_mjcf

from ..vehicle import DESIGN_LOAD, Vehicle
from .parts import POINT_MASS, Corner, ModelBuilder

_BODY_HEIGHT = 0.75
_WHEEL_DROP = -0.42


@dataclass(frozen=True)
class Topology:
    """What an oscillation model is made of.

    Attributes:
        title: one line.
        sprung_wheels: whether the wheels have mass and stand on tyre springs; else they follow the road, massless.
    """

    title: str
    sprung_wheels: bool


MODELS: dict[str, Topology] = {
    "quarter_1dof": Topology("OM1: body heave; the massless wheel follows the road", sprung_wheels=False),
    "quarter_2dof": Topology("OM5: body heave, wheel mass on a tyre spring", sprung_wheels=True),
}


def build(vehicle: Vehicle, model: str, load: str = DESIGN_LOAD, axle: str | None = None) -> Plant:
    """Build an oscillation model of a car.

    Args:
        model: a key of `MODELS`.
        load: load case of the vehicle.
        axle: ``front`` or ``rear`` for models of one axle; None takes the rear, or the only one there is.

    Raises:
        InputError: unknown model, load case or axle, or a value that the model needs is missing.
    """
    return Plant.from_spec(*specification(vehicle, model, load, axle))


def write(vehicle: Vehicle, model: str, path: str | Path, load: str = DESIGN_LOAD, axle: str | None = None) -> Path:
    """Write the MJCF file of the model that `build` makes, complete and with every digit."""
    return write_mjcf(*specification(vehicle, model, load, axle), path)


def specification(vehicle: Vehicle, model: str, load: str = DESIGN_LOAD, axle: str | None = None) -> tuple[mujoco.MjSpec, Meaning]:
    """The MuJoCo specification of a model and the meaning of its numbers; arguments as for `build`."""
    if model not in MODELS:
        raise InputError(f"no model '{model}'; {choices(MODELS, model)}", key="model")
    axle_name = axle or ("rear" if vehicle.rear is not None else "front")
    corner = Corner("", axle_name, 0.0, 0.0, vehicle.axle(axle_name), {"heave": 1.0})
    mass = vehicle.corner_mass(axle_name, load)

    builder = ModelBuilder(f"{vehicle.name}_{model}", vehicle.source)
    body = builder.spec.worldbody.add_body(name="body", pos=[0, 0, _BODY_HEIGHT], mass=mass, **POINT_MASS)
    builder.slide(body, "heave")
    builder.draw(body, mujoco.mjtGeom.mjGEOM_BOX, [0.35, 0.3, 0.12], [0.16, 0.36, 0.6, 1])
    builder.output("body_displacement", "", ("qpos", "heave", 1.0))
    builder.output("body_velocity", "", ("qvel", "heave", 1.0))
    builder.output("body_acceleration", "", ("qacc", "heave", 1.0))
    if MODELS[model].sprung_wheels:
        builder.sprung_wheel(body, corner, [0, 0, _WHEEL_DROP])
    else:
        builder.rigid_wheel(corner)
    return builder.finish(
        model=model,
        vehicle=vehicle.name,
        title=vehicle.title,
        load=load,
        facts={"sprung_mass": mass, "unsprung_mass": (corner.axle.unsprung_mass or 0.0) if MODELS[model].sprung_wheels else 0.0},
    )
