"""Oscillation models: vertical dynamics of a body on its wheels (thesis section 4.3.1 and appendix 4).

One builder for all topologies: a body with some of heave, pitch and roll, on wheels that either follow the road without
mass or have mass and stand on tyre springs, guided independently or by a rigid axle.
"""

from __future__ import annotations

from typing import Any

import mujoco

from susp_mj.errors import InputError
from susp_mj.meaning import Meaning
from susp_mj.names import AXLES

from ..complete import LoadedCar
from ..models import OSCILLATION, Topology
from ..vehicle import DESIGN_LOAD, Vehicle
from .axles import BODY_HEIGHT, Corner, add_axle, note_stiffness
from .body_forces import add_lateral, add_longitudinal, add_rig, add_seat
from .mass import Mass
from .parts import POINT_MASS, Form, ModelBuilder

_FREEDOMS = {
    "heave": ("slide", [0.0, 0.0, 1.0]),
    "pitch": ("hinge", [0.0, 1.0, 0.0]),
    "roll": ("hinge", [1.0, 0.0, 0.0]),
}


def oscillation_specification(
    vehicle: Vehicle, model: str, load: str = DESIGN_LOAD, axle: str | None = None, rig: str | None = None
) -> tuple[mujoco.MjSpec, Meaning]:
    """The MuJoCo specification of an oscillation model and the meaning of its numbers; arguments as for `build`."""
    topology = OSCILLATION[model]
    if topology.axles == 2 and axle is not None:
        raise InputError(f"'{axle}' is not allowed; model {model} has both axles", key="axle")
    only = axle or ("rear" if vehicle.rear is not None else "front")
    car = LoadedCar.of(vehicle, load, AXLES if topology.axles == 2 else (only,))
    mass = Mass.of(car, topology, model)
    builder = ModelBuilder(f"{vehicle.name}_{model}", vehicle.source)
    body, position = _body(builder, topology, mass)
    corners = _corners(builder, car, topology, mass)
    for group in (corners[i : i + topology.sides] for i in range(0, len(corners), topology.sides)):
        add_axle(builder, topology, body, position, group)
    for each in car.axles:
        felt = each.unsprung_mass if topology.sprung_wheels else each.corner_mass
        note_stiffness(builder, each, felt, tyre=topology.sprung_wheels)
    roll_lever = add_lateral(builder, topology, car.cg_height, corners, position)
    add_longitudinal(builder, topology, car.cg_height, mass, position)
    add_seat(builder, vehicle.driver, mass, position)
    if rig is not None:
        add_rig(builder, rig, position, mass)
    return builder.finish(
        model=model,
        vehicle=vehicle.name,
        title=vehicle.title,
        load=load,
        facts={
            "sprung_mass": mass.mass,
            "unsprung_mass": sum(corner.axle.unsprung_mass for corner in corners) if topology.sprung_wheels else 0.0,
            "cg_x": mass.x,
            "cg_y": mass.y,
            **({"roll_lever": roll_lever} if roll_lever is not None else {}),
            **{f"track_{each.name}": each.track for each in car.axles if topology.sides == 2},
        },
    )


def _body(builder: ModelBuilder, topology: Topology, mass: Mass) -> tuple[Any, dict[str, Form]]:
    """The sprung body at its centre of gravity, with its freedoms as forms.

    Its mass heaves; its moments of inertia sit on a child that pitches and rolls. Wheels are children of the part that
    only heaves, so they move vertically and every height stays the linear form that defines these models, at any angle.
    With Jzz = Jyy pitch and roll do not couple either.
    """
    place = {**POINT_MASS, "mass": mass.mass}
    body = builder.spec.worldbody.add_body(name="body", pos=[mass.x, mass.y, BODY_HEIGHT], **place)
    position = {"heave": builder.joint(body, "heave", *_FREEDOMS["heave"])}
    shell = body
    if len(topology.freedoms) > 1:
        inertia = [mass.roll_inertia, mass.pitch_inertia, mass.pitch_inertia]
        if "pitch" not in topology.freedoms:
            inertia = [mass.roll_inertia] * 3
        shell = body.add_body(name="attitude", **{**POINT_MASS, "inertia": inertia, "mass": 1e-9 * mass.mass})
        position |= {
            name: builder.joint(shell, name, *_FREEDOMS[name]) for name in topology.freedoms if name != "heave"
        }
    length = 2.4 if topology.axles == 2 else 0.35
    width = 0.6 if topology.sides == 2 else 0.25
    builder.draw(shell, mujoco.mjtGeom.mjGEOM_BOX, [length / 2 + 0.3, width, 0.1], [0.16, 0.36, 0.6, 1])
    for name, quantity in (("heave", "body"), ("pitch", "pitch"), ("roll", "roll")):
        if name in position:
            words = (
                ("displacement", "velocity", "acceleration") if name == "heave" else ("angle", "rate", "acceleration")
            )
            for source, word in zip(("qpos", "qvel", "qacc"), words, strict=True):
                builder.output(f"{quantity}_{word}", "", (source, name, 1.0))
    return body, position


def _corners(builder: ModelBuilder, car: LoadedCar, topology: Topology, mass: Mass) -> list[Corner]:
    """The model's wheels, axle by axle, left before right."""
    corners = []
    for axle in car.axles:
        x = 0.0 if axle is car.axles[0] else -car.wheelbase
        if topology.sides == 1:
            sides: dict[str, int] = {axle.name if topology.axles == 2 else "": 0}
        else:
            sides = {f"{axle.name[0]}l": 1, f"{axle.name[0]}r": -1}
        half_track = axle.required("track", "models with two sides") / 2 if topology.sides == 2 else 0.0
        for station, side in sides.items():
            y = side * half_track
            road = builder.wheel_station(station, x, y, axle.name)
            partner = next((other for other in sides if other != station), None)
            corners.append(Corner(station, x - mass.x, y - mass.y, side, axle, road, partner))
    return corners
