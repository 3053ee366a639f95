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
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np

from susp_mj.elements import GRAVITY, Rig
from susp_mj.elements.car import (
    CAR_NUMERIC,
    CAR_SIGNALS,
    CONTROLS,
    MOST_GEARS,
    RIG_CONTROLS,
    WHEEL_SIGNALS,
    WHEEL_STATES,
    car_block,
    table,
    table_of_tables,
)
from susp_mj.errors import InputError
from susp_mj.meaning import Meaning
from susp_mj.names import CORNERS, QUANTITIES

from ..vehicle import DESIGN_LOAD, Axle, Vehicle
from .axles import Corner, add_suspension, note_stiffness
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
_RIG_FORCES = {
    "rig_longitudinal": "longitudinal_force",
    "rig_lateral": "lateral_force",
    "rig_aligning": "aligning_moment",
}
_RIG_FREQUENCY = 300.0  # rad/s of the body on its servo: far above every suspension, resolved by a step of 1 ms
_CONTROL_GAIN, _CONTROL_INTEGRAL = 1.5, 0.5  # 1/s, 1/s²: force of the speed controller per car mass and speed error
_STALL_SPEED = 220.0  # rad/s at which the converter holds the engine's largest torque with the car at rest
_IDLE_GAIN = 10.0  # N m s/rad of the idle governor
_STEER_ROWS = 33
_WHEEL_MASS_SHARE, _KNUCKLE_MASS = 0.5, 1e-3
_SOFTEST = 0.5  # largest static deflection of a tyre, as a share of its radius


@dataclass(frozen=True)
class _Wheel:
    """A wheel of the car being built: its corner, its tyre on the road, and where things stand in the design
    position."""

    corner: Corner
    tyre: Any
    design_height: float

    @property
    def front(self) -> bool:
        return self.corner.axle_name == "front"


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
        **_head(vehicle, total, (case.cg[0], case.cg[1], height)),
        **_rig_servo(case.sprung_mass, case.inertia, rig),
    }
    builder.car(lambda model: _block(model, vehicle, wheels, head, controls, rig))
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


def _wheel(builder: ModelBuilder, vehicle: Vehicle, station: str, cg: tuple[float, float, float]) -> _Wheel:
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
    return _Wheel(corner, tyre, tyre.radius - carried / tyre.vertical_stiffness)


def _add_wheel(builder: ModelBuilder, vehicle: Vehicle, chassis: Any, wheel: _Wheel, z: float) -> None:
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


def _add_forces(builder: ModelBuilder, vehicle: Vehicle, wheel: _Wheel) -> None:
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


def _add_controls(builder: ModelBuilder, wheels: Sequence[_Wheel], rig: str | None) -> list[str]:
    """Actuators whose `ctrl` are the car's inputs; returns their names, which are those of the block's head."""
    joint = wheels[0].corner.name("spin")
    controls = _STEERING | (_DRIVING if rig is None else {name: (name, 0) for name in RIG_CONTROLS})
    for name, (quantity, states) in controls.items():
        builder.control(name, joint, states)
        if quantity:
            builder.drive(quantity, name, 1.0)
    if rig is not None:
        for wheel in wheels:
            for name, quantity in _RIG_FORCES.items():
                builder.control(wheel.corner.name(name), joint)
                builder.drive(quantity, wheel.corner.name(name), 1.0, wheel.corner.station)
    return list(controls)


def _outputs(builder: ModelBuilder, wheels: Sequence[_Wheel], rig: str | None) -> None:
    """Channels that the compiled car writes."""
    for signal in CAR_SIGNALS:
        drives = rig is None or signal == "steering_wheel_angle"
        if signal in QUANTITIES and signal != "speed" and drives:
            builder.output(signal, "", ("signal", signal, 1.0))
    for wheel in wheels:
        for signal in WHEEL_SIGNALS:
            if signal in QUANTITIES:
                builder.output(signal, wheel.corner.station, ("signal", wheel.corner.name(signal), 1.0))


def _head(vehicle: Vehicle, mass: float, place: tuple[float, float, float]) -> dict[str, float]:
    """Numbers of the car as a whole; `place` is the centre of gravity's in the design position."""
    steering, train, air = vehicle.steering, vehicle.powertrain, vehicle.aerodynamics
    assert steering is not None and train is not None and air is not None and vehicle.wheelbase is not None
    if len(train.gears) > MOST_GEARS:
        raise InputError(
            f"{len(train.gears)} gears are not allowed; at most {MOST_GEARS}",
            key="powertrain.gears",
            source=vehicle.source,
        )
    largest = max(train.full_torque)
    return {
        "steering_ratio": steering.ratio,
        "steering_limit": steering.limit,
        "wheelbase": vehicle.wheelbase,
        "ground_z": -place[2],
        "control_gain": _CONTROL_GAIN * mass,
        "control_integral": _CONTROL_INTEGRAL * mass,
        "air_pressure": air.density * air.area / 2,
        "drag": air.drag,
        "lift_front": air.lift_front,
        "lift_rear": air.lift_rear,
        "side_force": air.side,
        "yaw_moment": air.yaw,
        "air_x": -vehicle.wheelbase / 2 - place[0],
        "engine_inertia": train.inertia,
        "idle_speed": train.idle_speed,
        "idle_gain": _IDLE_GAIN,
        "idle_torque": float(np.interp(train.idle_speed, train.speed, train.full_torque)),
        "coupling": train.coupling,
        "converter": largest / _STALL_SPEED**2,
        "coupling_limit": 2 * largest,
        "final_drive": train.final_drive,
        "efficiency": train.efficiency,
        "shift_up": train.shift_up,
        "shift_down": train.shift_down,
        "shift_time": train.shift_time,
        "engine_limit": train.speed[-1],
        "gears": float(len(train.gears)),
        **{f"gear_{i}": ratio for i, ratio in enumerate(train.gears, 1)},
        "design_x": place[0],
        "design_y": place[1],
        "design_z": place[2],
    }


def _rig_servo(mass: float, inertia: Sequence[float], rig: str | None) -> dict[str, float]:
    """Servo that holds the body on the rig."""
    if rig is None:
        return {}
    servo = {"rig": 1.0, "rig_stiffness": mass * _RIG_FREQUENCY**2, "rig_damping": 1.4 * mass * _RIG_FREQUENCY}
    for axis, moment in zip("xyz", inertia, strict=True):
        servo |= {f"rig_rate_{axis}": moment * _RIG_FREQUENCY**2, f"rig_damping_{axis}": 1.4 * moment * _RIG_FREQUENCY}
    return servo


def _block(
    model: mujoco.MjModel,
    vehicle: Vehicle,
    wheels: Sequence[_Wheel],
    head: Mapping[str, float],
    controls: Sequence[str],
    rig: str | None,
) -> np.ndarray:
    """Everything that the compiled car reads, with the places of joints and actuators in the compiled model."""
    train = vehicle.powertrain
    assert train is not None
    values = {**head, "freedoms": float(model.nv)}
    values |= {
        name: float(model.actuator(name).id) if name in controls else -1.0 for name in (*CONTROLS, *RIG_CONTROLS)
    }
    places: list[dict[str, float]] = []
    tables = [
        ("full_torque", -1, table(train.speed, train.full_torque, smooth=False, count=65)),
        ("drag_torque", -1, table(train.speed, train.drag_torque, smooth=False, count=65)),
    ]
    for i, wheel in enumerate(wheels):
        places.append(_wheel_numbers(model, vehicle, wheel, rig))
        tables += [(name, i, numbers) for name, numbers in _wheel_tables(wheel).items()]
    return car_block(values, places, tables)


def _wheel_numbers(model: mujoco.MjModel, vehicle: Vehicle, wheel: _Wheel, rig: str | None) -> dict[str, float]:
    corner, tyre, steering, train, brakes = (
        wheel.corner,
        wheel.tyre,
        vehicle.steering,
        vehicle.powertrain,
        vehicle.brakes,
    )
    assert steering is not None and train is not None and brakes is not None and vehicle.wheelbase is not None
    case_z = -float(model.body(corner.name("carrier")).pos[2])
    travel, spin = model.joint(corner.name("travel")), model.joint(corner.name("spin"))
    share = brakes.front_share if wheel.front else 1 - brakes.front_share
    numbers = {
        "side": float(corner.side),
        "x": corner.x,
        "y": corner.y,
        "z": -case_z,
        "travel_freedom": float(travel.dofadr[0]),
        "steer_freedom": -1.0,
        "spin_freedom": float(spin.dofadr[0]),
        "tyre": float(model.actuator(corner.name("tyre")).id),
        "drive_share": float((train.driven == "front") == wheel.front),
        "brake_torque": brakes.torque * share / 2,
        "tyre_law": float(tyre.law.number),
        "radius": tyre.radius,
        "stiffness": tyre.vertical_stiffness,
        "damping": tyre.vertical_damping,
        "design_height": wheel.design_height,
    }
    if wheel.front:
        joint = model.joint(corner.name("steer"))
        numbers |= {
            "steer_freedom": float(joint.dofadr[0]),
            "steering": float(model.actuator(corner.name("steering")).id),
            "ackermann": steering.ackermann * (corner.axle.track or 0.0) / (2 * vehicle.wheelbase),
            "trail": steering.trail,
            "scrub": steering.scrub,
        }
    for name in _RIG_FORCES:
        numbers[name] = -1.0 if rig is None else float(model.actuator(corner.name(name)).id)
    return numbers


def _wheel_tables(wheel: _Wheel) -> dict[str, np.ndarray]:
    """Kinematics over travel and steering, compliance over force, the tyre's parameters."""
    kinematics, compliance = wheel.corner.axle.kinematics, wheel.corner.axle.compliance
    assert kinematics is not None and compliance is not None
    tables = {
        "path": table(kinematics.travel, kinematics.path("lateral"), kinematics.path("longitudinal"), smooth=True),
        "angles": _angle_tables(
            kinematics.travel, kinematics.steer, kinematics.angles("toe"), kinematics.angles("camber")
        ),
        "tyre_parameters": np.array(wheel.tyre.parameters()),
    }
    if kinematics.longitudinal_centre:
        turn = (kinematics.path("longitudinal_centre") - kinematics.path("longitudinal")) / wheel.design_height
        tables["swing"] = table(kinematics.travel, turn, smooth=True)
    if compliance.lateral_force:
        nothing = [0.0] * len(compliance.lateral_force)
        curves = [compliance.toe or nothing, compliance.camber or nothing]
        tables["elastic_lateral"] = table(compliance.lateral_force, *curves, smooth=False)
    if compliance.longitudinal_force:
        tables["elastic_longitudinal"] = table(compliance.longitudinal_force, compliance.toe_longitudinal, smooth=False)
    if compliance.aligning_moment:
        tables["elastic_aligning"] = table(compliance.aligning_moment, compliance.toe_aligning, smooth=False)
    return tables


def _angle_tables(travel: Sequence[float], steer: Sequence[float], toe: np.ndarray, camber: np.ndarray) -> np.ndarray:
    """Toe and camber over travel for evenly spaced steer angles; between the given ones they follow cubic splines."""
    if len(steer) == 0:
        return table_of_tables(0.0, 1.0, [table(travel, toe[:, 0], camber[:, 0], smooth=True)])
    from scipy.interpolate import CubicSpline

    even, spacing = np.linspace(steer[0], steer[-1], _STEER_ROWS, retstep=True)
    ends = "not-a-knot" if len(steer) > 2 else "natural"
    toes, cambers = (CubicSpline(steer, angles, axis=1, bc_type=ends)(even) for angles in (toe, camber))
    return table_of_tables(
        even[0], spacing, [table(travel, toes[:, j], cambers[:, j], smooth=True) for j in range(_STEER_ROWS)]
    )


__all__ = ["CAR_NUMERIC", "HANDLING", "K_AND_C", "handling_specification"]
