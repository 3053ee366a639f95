"""Numbers of the handling model that compiled code reads: head, wheels and tables of the file's custom numeric."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np

from susp_mj.elements.car import CONTROLS, MOST_GEARS, RIG_CONTROLS, car_block, table, table_of_tables
from susp_mj.errors import InputError

from ..vehicle import Vehicle
from .axles import Corner

RIG_FORCES = {
    "rig_longitudinal": "longitudinal_force",
    "rig_lateral": "lateral_force",
    "rig_aligning": "aligning_moment",
}
"""Actuators of a wheel on the rig, and the quantity that drives each."""
_RIG_FREQUENCY = 300.0  # rad/s of the body on its servo: far above every suspension, resolved by a step of 1 ms
_CONTROL_GAIN, _CONTROL_INTEGRAL = 1.5, 0.5  # 1/s, 1/s²: force of the speed controller per car mass and speed error
_STALL_SPEED = 220.0  # rad/s at which the converter holds the engine's largest torque with the car at rest
_IDLE_GAIN = 10.0  # N m s/rad of the idle governor
_STEER_ROWS = 33


@dataclass(frozen=True)
class Wheel:
    """A wheel of the car being built: its corner, its tyre on the road, and where things stand in the design
    position."""

    corner: Corner
    tyre: Any
    design_height: float

    @property
    def front(self) -> bool:
        return self.corner.axle_name == "front"


def head_numbers(vehicle: Vehicle, mass: float, place: tuple[float, float, float]) -> dict[str, float]:
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


def rig_servo(mass: float, inertia: Sequence[float], rig: str | None) -> dict[str, float]:
    """Servo that holds the body on the rig."""
    if rig is None:
        return {}
    servo = {"rig": 1.0, "rig_stiffness": mass * _RIG_FREQUENCY**2, "rig_damping": 1.4 * mass * _RIG_FREQUENCY}
    for axis, moment in zip("xyz", inertia, strict=True):
        servo |= {f"rig_rate_{axis}": moment * _RIG_FREQUENCY**2, f"rig_damping_{axis}": 1.4 * moment * _RIG_FREQUENCY}
    return servo


def block(
    model: mujoco.MjModel,
    vehicle: Vehicle,
    wheels: Sequence[Wheel],
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


def _wheel_numbers(model: mujoco.MjModel, vehicle: Vehicle, wheel: Wheel, rig: str | None) -> dict[str, float]:
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
    for name in RIG_FORCES:
        numbers[name] = -1.0 if rig is None else float(model.actuator(corner.name(name)).id)
    return numbers


def _wheel_tables(wheel: Wheel) -> dict[str, np.ndarray]:
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
