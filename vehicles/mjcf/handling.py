"""The car that drives freely (`handling`): a chassis with six freedoms, four wheels on look-up suspensions, tyres with
slip.

MuJoCo's tree is the free joint of the chassis, per wheel a vertical slide (the travel), for the front wheels a hinge
(the steering, elastic against the rack), and the spin. Springs, dampers, stops, friction and bars are the same user
actuators along the travel as in the oscillation models. Everything else (tyres, wheel paths, power train, brakes, air,
driver) is carried out by `susp_mj.compiled.handling` from the numbers that this module writes into the file's custom
numeric.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import mujoco

from susp_mj.elements import SpringDamper, Steering
from susp_mj.errors import InputError
from susp_mj.handling.block import (
    CAR_SIGNALS,
    RIG_CONTROLS,
    WHEEL_SIGNALS,
    WHEEL_STATES,
    names_of,
)
from susp_mj.meaning import Meaning
from susp_mj.names import CORNERS, QUANTITIES

from ..complete import CompleteAxle, CompleteCar
from ..models import HANDLING
from ..vehicle import Vehicle
from .axles import Corner, add_suspension, note_stiffness
from .handling_numbers import RIG_FORCES, Wheel, block
from .parts import POINT_MASS, Form, ModelBuilder

K_AND_C = "k_and_c"
_STEERING = {"steering_wheel": ("steering_wheel_angle", 0)}
_DRIVING = {
    "driver": ("", 1),
    "speed_target": ("speed_target", 1),
    "engine": ("accelerator", 1),
    "speed_control": ("speed_control", 0),
    "brake": ("brake_pedal", 0),
    "wind_x": ("wind_x", 0),
    "wind_y": ("wind_y", 0),
}
"""Actuators of the car's inputs: the quantity that drives each, if any, and how many inner states it has."""
_WHEEL_MASS_SHARE, _KNUCKLE_MASS = 0.5, 1e-3


def handling_specification(vehicle: Vehicle, load: str, rig: str | None) -> tuple[mujoco.MjSpec, Meaning]:
    """The MuJoCo specification of the car that drives freely, and the meaning of its numbers.

    Args:
        load: load case.
        rig: ``k_and_c`` holds the body on a servo and puts the wheels on free pads.

    Raises:
        InputError: something that the model needs is missing.
    """
    if rig not in (None, K_AND_C):
        raise InputError(f"no rig '{rig}' for model {HANDLING}; allowed is {K_AND_C}", key="rig")
    car = CompleteCar.of(vehicle, load)
    builder = ModelBuilder(f"{vehicle.name}_{HANDLING}", vehicle.source)
    builder.spec.option.disableflags |= (
        mujoco.mjtDisableBit.mjDSBL_SPRING | mujoco.mjtDisableBit.mjDSBL_DAMPER
    )  # no joint has any
    wheels = [_wheel(builder, car, station) for station in CORNERS]
    chassis = _add_chassis(builder, car)
    for wheel in wheels:
        _add_wheel(builder, car, chassis, wheel)
    for axle in car.axles:
        for wheel in (each for each in wheels if each.axle is axle):
            _add_forces(builder, car.steering, wheel)
        _note_time_constants(builder, car.steering, axle)
    controls = _add_controls(builder, wheels, rig)
    builder.car(lambda model: block(model, car, wheels, controls, rig))
    _outputs(builder, wheels, rig)
    return builder.finish(
        model=HANDLING,
        vehicle=vehicle.name,
        title=vehicle.title,
        load=load,
        driving=rig is None,
        facts={
            "sprung_mass": car.body.mass,
            "unsprung_mass": car.unsprung_mass,
            "cg_x": car.body.cg[0],
            "cg_y": car.body.cg[1],
            "cg_height": car.cg_height,
            "wheelbase": car.wheelbase,
            "steering_ratio": car.steering.ratio,
            "track_front": car.front.track,
            "wheel_radius_front": car.front.hub_height,
            "track_rear": car.rear.track,
            "wheel_radius_rear": car.rear.hub_height,
        },
    )


def _wheel(builder: ModelBuilder, car: CompleteCar, station: str) -> Wheel:
    axle, x = (car.front, 0.0) if station[0] == "f" else (car.rear, -car.wheelbase)
    side, partner, mounted = (1, "r", "LEFT") if station[1] == "l" else (-1, "l", "RIGHT")
    y = side * axle.track / 2
    road = builder.wheel_station(station, x, y, axle.name)
    corner = Corner(station, x - car.body.cg[0], y - car.body.cg[1], side, axle, road, station[0] + partner)
    return Wheel(corner, axle, axle.handling_tyre.mounted(mounted))


def _add_chassis(builder: ModelBuilder, car: CompleteCar) -> Any:
    """The sprung body, free to move, at its centre of gravity."""
    x, y, _ = car.body.cg
    chassis = builder.spec.worldbody.add_body(
        name="chassis",
        pos=[x, y, car.cg_height],
        mass=car.body.mass,
        **{**POINT_MASS, "inertia": list(car.body.inertia)},
    )
    chassis.add_freejoint(name="chassis")
    middle = [-x - car.wheelbase / 2, 0, 0.1]
    builder.draw(chassis, mujoco.mjtGeom.mjGEOM_BOX, [2.3, 0.85, 0.35], [0.16, 0.36, 0.6, 1], pos=middle)
    return chassis


def _add_wheel(builder: ModelBuilder, car: CompleteCar, chassis: Any, wheel: Wheel) -> None:
    """Carrier on its slide, knuckle on the steering hinge, wheel on its spin."""
    corner, mass, spin = wheel.corner, wheel.axle.unsprung_mass, wheel.axle.wheel_inertia
    place = [corner.x, corner.y, -car.body.cg[2]]
    left = (1 - _WHEEL_MASS_SHARE) * mass - (_KNUCKLE_MASS if wheel.front else 0.0)
    carrier = chassis.add_body(name=corner.name("carrier"), pos=place, mass=left, **POINT_MASS)
    builder.joint(carrier, corner.name("travel"), "slide", [0, 0, 1])
    holder = carrier
    if wheel.front:
        knuckle = car.steering.knuckle_inertia
        upright = max(knuckle - 0.55 * spin, 0.05 * knuckle)
        inertia = {**POINT_MASS, "inertia": [upright] * 3}
        holder = carrier.add_body(name=corner.name("knuckle"), mass=_KNUCKLE_MASS, **inertia)
        builder.joint(holder, corner.name("steer"), "hinge", [0, 0, 1])
    inertia = {**POINT_MASS, "inertia": [0.55 * spin, spin, 0.55 * spin]}
    rolling = holder.add_body(name=corner.name("wheel"), mass=_WHEEL_MASS_SHARE * mass, **inertia)
    builder.joint(rolling, corner.name("spin"), "hinge", [0, 1, 0])
    upright_quat = [math.sqrt(0.5), math.sqrt(0.5), 0, 0]
    builder.draw(
        rolling, mujoco.mjtGeom.mjGEOM_CYLINDER, [wheel.tyre.radius, 0.11, 0], [0.1, 0.1, 0.1, 1], quat=upright_quat
    )


def _add_forces(builder: ModelBuilder, steering: Steering, wheel: Wheel) -> None:
    """Suspension elements along the travel, the steering's elasticity, and the tyre with its inner states."""
    corner = wheel.corner
    add_suspension(builder, corner, Form({corner.name("travel"): 1.0}))
    if wheel.front:
        spring = SpringDamper(stiffness=steering.stiffness, damping=steering.damping)
        builder.force(corner.name("steering"), spring, Form({corner.name("steer"): 1.0}))
    builder.control(corner.name("tyre"), corner.name("travel"), WHEEL_STATES)
    builder.drive("road_height", corner.name("tyre"), 1.0, corner.station)


def _note_time_constants(builder: ModelBuilder, steering: Steering, axle: CompleteAxle) -> None:
    """What the step must resolve: suspension, tyre and, in front, the steering's elasticity."""
    mass, tyre, key = axle.unsprung_mass, axle.handling_tyre, f"{axle.name}.handling_tyre"
    note_stiffness(builder, axle, mass, tyre=False)
    seconds = math.sqrt(mass / tyre.vertical_stiffness)
    builder.resolve(f"{key}.vertical_stiffness", tyre.vertical_stiffness, "N/m", seconds, power=2.0)
    if tyre.vertical_damping > 0:
        builder.resolve(f"{key}.vertical_damping", tyre.vertical_damping, "N s/m", mass / tyre.vertical_damping)
    if axle.name == "front":
        inertia = steering.knuckle_inertia
        seconds = math.sqrt(inertia / steering.stiffness)
        builder.resolve("steering.stiffness", steering.stiffness, "N m/rad", seconds, power=2.0)
        builder.resolve("steering.damping", steering.damping, "N m s/rad", inertia / steering.damping)


def _add_controls(builder: ModelBuilder, wheels: Sequence[Wheel], rig: str | None) -> list[str]:
    """Actuators whose `ctrl` are the car's inputs; returns their names, which are those of the block's head."""
    joint = wheels[0].corner.name("spin")
    controls = _STEERING | (_DRIVING if rig is None else {name: (name, 0) for name in RIG_CONTROLS})
    for name, (quantity, states) in controls.items():
        builder.control(name, joint, states)
        if quantity:
            builder.drive(quantity, name, 1.0)
    if rig is not None:
        for wheel in wheels:
            for name, quantity in RIG_FORCES.items():
                builder.control(wheel.corner.name(name), joint)
                builder.drive(quantity, wheel.corner.name(name), 1.0, wheel.corner.station)
    return list(controls)


def _outputs(builder: ModelBuilder, wheels: Sequence[Wheel], rig: str | None) -> None:
    """Channels that the compiled car writes."""
    for signal in names_of(CAR_SIGNALS):
        drives = rig is None or signal == "steering_wheel_angle"
        if signal in QUANTITIES and signal != "speed" and drives:
            builder.output(signal, "", ("signal", signal, 1.0))
    for wheel in wheels:
        for signal in names_of(WHEEL_SIGNALS):
            if signal in QUANTITIES:
                builder.output(signal, wheel.corner.station, ("signal", wheel.corner.name(signal), 1.0))
