"""The car that drives freely (`handling`): a chassis with six freedoms, four wheels on look-up suspensions, tyres with
slip.

MuJoCo's tree is the free joint of the chassis, per wheel a vertical slide (the travel), for the front wheels a hinge
(the steering, elastic against the rack), and the spin. Springs, dampers, stops, friction and bars are the same user
actuators along the travel as in the oscillation models. Everything else (tyres, wheel paths, power train, brakes, air,
driver) is carried out by `susp_mj.compiled.car` from the numbers that this module writes into the file's custom
numeric.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import mujoco

from susp_mj.elements import GRAVITY, Rig
from susp_mj.elements.car import (
    CAR_SIGNALS,
    RIG_CONTROLS,
    WHEEL_SIGNALS,
    WHEEL_STATES,
)
from susp_mj.errors import InputError
from susp_mj.meaning import Meaning
from susp_mj.names import CORNERS, QUANTITIES

from ..vehicle import DESIGN_LOAD, Axle, Vehicle
from .axles import Corner, add_suspension, note_stiffness
from .handling_numbers import RIG_FORCES, Wheel, block, head_numbers, rig_servo
from .parts import POINT_MASS, Form, ModelBuilder

HANDLING = "handling"
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
_SOFTEST = 0.5  # largest static deflection of a tyre, as a share of its radius


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
    vehicle.check_handling()
    builder = ModelBuilder(f"{vehicle.name}_{HANDLING}", vehicle.source)
    builder.spec.option.disableflags |= (
        mujoco.mjtDisableBit.mjDSBL_SPRING | mujoco.mjtDisableBit.mjDSBL_DAMPER
    )  # no joint has any
    case = vehicle.load(load)
    assert (
        case.cg is not None
        and case.sprung_mass is not None
        and case.inertia is not None
        and vehicle.wheelbase is not None
    )
    wheels = [_wheel(builder, vehicle, station, case.cg) for station in CORNERS]
    share = -case.cg[0] / vehicle.wheelbase
    hubs = [(wheels[i].design_height + wheels[i + 1].design_height) / 2 for i in (0, 2)]
    height = hubs[0] + share * (hubs[1] - hubs[0]) + case.cg[2]
    if height <= 0:
        text = f"{case.cg[2]:g} m is not allowed; the centre of gravity would lie {-height:.2f} m below the ground"
        raise InputError(text, key=f"loads.{load}.cg.2", source=vehicle.source)
    chassis = builder.spec.worldbody.add_body(
        name="chassis",
        pos=[case.cg[0], case.cg[1], height],
        mass=case.sprung_mass,
        **{**POINT_MASS, "inertia": list(case.inertia)},
    )
    chassis.add_freejoint(name="chassis")
    middle = [-case.cg[0] - vehicle.wheelbase / 2, 0, 0.1]
    builder.draw(chassis, mujoco.mjtGeom.mjGEOM_BOX, [2.3, 0.85, 0.35], [0.16, 0.36, 0.6, 1], pos=middle)
    for wheel in wheels:
        _add_wheel(builder, vehicle, chassis, wheel, -case.cg[2])
    for wheel in wheels:
        _add_forces(builder, vehicle, wheel)
    controls = _add_controls(builder, wheels, rig)
    unsprung = sum(2 * (_axle(vehicle, name).unsprung_mass or 0.0) for name in ("front", "rear"))
    total = case.sprung_mass + unsprung
    head = {
        **head_numbers(vehicle, total, (case.cg[0], case.cg[1], height)),
        **rig_servo(case.sprung_mass, case.inertia, rig),
    }
    builder.car(lambda model: block(model, vehicle, wheels, head, controls, rig))
    _outputs(builder, wheels, rig)
    steering, mass_share = vehicle.steering, {}
    assert steering is not None
    for name in ("front", "rear"):
        mass_share[f"track_{name}"] = _axle(vehicle, name).track or 0.0
        mass_share[f"wheel_radius_{name}"] = wheels[0 if name == "front" else 2].design_height
    return builder.finish(
        model=HANDLING,
        vehicle=vehicle.name,
        title=vehicle.title,
        load=load,
        driving=rig is None,
        facts={
            "sprung_mass": case.sprung_mass,
            "unsprung_mass": unsprung,
            "cg_x": case.cg[0],
            "cg_y": case.cg[1],
            "cg_height": height,
            "wheelbase": vehicle.wheelbase,
            "steering_ratio": steering.ratio,
            **mass_share,
        },
    )


def _axle(vehicle: Vehicle, name: str) -> Axle:
    axle = vehicle.front if name == "front" else vehicle.rear
    assert axle is not None
    return axle


def _wheel(builder: ModelBuilder, vehicle: Vehicle, station: str, cg: tuple[float, float, float]) -> Wheel:
    axle_name, side = ("front" if station[0] == "f" else "rear"), (1 if station[1] == "l" else -1)
    axle = vehicle.axle(axle_name)
    assert axle.handling_tyre is not None and vehicle.wheelbase is not None
    x, y = (0.0 if axle_name == "front" else -vehicle.wheelbase), side * (axle.track or 0.0) / 2
    road = builder.wheel_station(station, x, y)
    partner = station[0] + ("r" if station[1] == "l" else "l")
    corner = Corner(station, axle_name, x - cg[0], y - cg[1], side, axle, road, partner)
    tyre = axle.handling_tyre.mounted("LEFT" if side > 0 else "RIGHT")
    carried = (vehicle.corner_mass(axle_name, DESIGN_LOAD) + (axle.unsprung_mass or 0.0)) * GRAVITY
    if carried / tyre.vertical_stiffness > _SOFTEST * tyre.radius:
        raise InputError(
            f"{tyre.vertical_stiffness:g} N/m is not allowed; {carried:.0f} N would press the tyre in by "
            f"{1000 * carried / tyre.vertical_stiffness:.0f} mm, more than half its radius of "
            f"{1000 * tyre.radius:.0f} mm",
            key=f"{axle_name}.handling_tyre.vertical_stiffness",
            source=vehicle.source,
        )
    return Wheel(corner, tyre, tyre.radius - carried / tyre.vertical_stiffness)


def _add_wheel(builder: ModelBuilder, vehicle: Vehicle, chassis: Any, wheel: Wheel, z: float) -> None:
    """Carrier on its slide, knuckle on the steering hinge, wheel on its spin."""
    corner, mass = wheel.corner, wheel.corner.axle.unsprung_mass or 0.0
    spin = corner.axle.wheel_inertia or 0.0
    left = (1 - _WHEEL_MASS_SHARE) * mass - (_KNUCKLE_MASS if wheel.front else 0.0)
    carrier = chassis.add_body(name=corner.name("carrier"), pos=[corner.x, corner.y, z], mass=left, **POINT_MASS)
    builder.joint(carrier, corner.name("travel"), "slide", [0, 0, 1])
    holder = carrier
    if wheel.front:
        assert vehicle.steering is not None
        upright = max(vehicle.steering.knuckle_inertia - 0.55 * spin, 0.05 * vehicle.steering.knuckle_inertia)
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


def _add_forces(builder: ModelBuilder, vehicle: Vehicle, wheel: Wheel) -> None:
    """Suspension elements along the travel, the steering's elasticity, and the tyre with its inner states."""
    corner = wheel.corner
    add_suspension(builder, corner, Form({corner.name("travel"): 1.0}))
    mass = corner.axle.unsprung_mass or 0.0
    note_stiffness(builder, corner, mass, tyre=False)
    key, stiffness, damping = (
        f"{corner.axle_name}.handling_tyre",
        wheel.tyre.vertical_stiffness,
        wheel.tyre.vertical_damping,
    )
    builder.resolve(f"{key}.vertical_stiffness", stiffness, "N/m", math.sqrt(mass / stiffness), power=2.0)
    if damping > 0:
        builder.resolve(f"{key}.vertical_damping", damping, "N s/m", mass / damping)
    if wheel.front:
        steering = vehicle.steering
        assert steering is not None
        spring = Rig(stiffness=steering.stiffness, damping=steering.damping)
        builder.force(corner.name("steering"), spring, Form({corner.name("steer"): 1.0}))
        seconds = math.sqrt(steering.knuckle_inertia / steering.stiffness)
        builder.resolve("steering.stiffness", steering.stiffness, "N m/rad", seconds, power=2.0)
        builder.resolve("steering.damping", steering.damping, "N m s/rad", steering.knuckle_inertia / steering.damping)
    builder.control(corner.name("tyre"), corner.name("travel"), WHEEL_STATES)
    builder.drive("road_height", corner.name("tyre"), 1.0, corner.station)


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
    for signal in CAR_SIGNALS:
        drives = rig is None or signal == "steering_wheel_angle"
        if signal in QUANTITIES and signal != "speed" and drives:
            builder.output(signal, "", ("signal", signal, 1.0))
    for wheel in wheels:
        for signal in WHEEL_SIGNALS:
            if signal in QUANTITIES:
                builder.output(signal, wheel.corner.station, ("signal", wheel.corner.name(signal), 1.0))
