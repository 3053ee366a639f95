"""Numbers of the handling model that compiled code reads: head, wheels and tables of the file's custom numeric."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

from susp_mj.elements import ContactTyre, Kinematics
from susp_mj.elements.law import numbers_of
from susp_mj.errors import InputError
from susp_mj.handling.block import CONTROLS, MOST_GEARS, RIG_CONTROLS, car_block, table, table_of_tables, tables

from ..complete import CompleteAxle, CompleteCar
from ..vehicle import Body
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
    """A wheel of the car being built: its corner, its axle, its tyre as mounted on that side."""

    corner: Corner
    axle: CompleteAxle
    tyre: ContactTyre

    @property
    def front(self) -> bool:
        return self.axle.name == "front"


def block(
    model: mujoco.MjModel, car: CompleteCar, wheels: Sequence[Wheel], controls: Sequence[str], rig: str | None
) -> np.ndarray:
    """Everything that the compiled car reads, with the places of joints and actuators in the compiled model.

    Args:
        controls: names of the actuators that are inputs of the car.
        rig: as of `build`.

    Raises:
        InputError: more gears than the block has room for.
    """
    head = _head(car) | ({} if rig is None else _rig_servo(car.body))
    head |= {"freedoms": float(model.nv)}
    head |= {name: float(model.actuator(name).id) if name in controls else -1.0 for name in (*CONTROLS, *RIG_CONTROLS)}
    places = [_wheel_numbers(model, car, wheel, rig) for wheel in wheels]
    return car_block(head, places, [*_car_tables(car), *_wheel_tables(car, wheels)])


def _head(car: CompleteCar) -> dict[str, float | tuple[float, ...]]:
    """Numbers of the car as a whole."""
    steering, train = car.steering, car.powertrain
    if len(train.gears) > MOST_GEARS:
        raise InputError(
            f"{len(train.gears)} gears are not allowed; at most {MOST_GEARS}",
            key="powertrain.gears",
            source=car.vehicle.source,
        )
    mass, largest = car.body.mass + car.unsprung_mass, max(train.full_torque)
    return {
        "steering_ratio": steering.ratio,
        "steering_limit": steering.limit,
        "wheelbase": car.wheelbase,
        "ground_z": -car.cg_height,
        "control_gain": _CONTROL_GAIN * mass,
        "control_integral": _CONTROL_INTEGRAL * mass,
        "brake_law": float(car.brakes.law.number),
        "air_law": float(car.aerodynamics.law.number),
        "air_x": -car.wheelbase / 2 - car.body.cg[0],
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
        "ratios": train.gears,
        "design_x": car.body.cg[0],
        "design_y": car.body.cg[1],
        "design_z": car.cg_height,
    }


def _rig_servo(body: Body) -> dict[str, float]:
    """Servo that holds the body on the rig."""
    servo = {
        "rig": 1.0,
        "rig_stiffness": body.mass * _RIG_FREQUENCY**2,
        "rig_damping": 1.4 * body.mass * _RIG_FREQUENCY,
    }
    for axis, moment in zip("xyz", body.inertia, strict=True):
        servo |= {f"rig_rate_{axis}": moment * _RIG_FREQUENCY**2, f"rig_damping_{axis}": 1.4 * moment * _RIG_FREQUENCY}
    return servo


def _wheel_numbers(model: mujoco.MjModel, car: CompleteCar, wheel: Wheel, rig: str | None) -> dict[str, float]:
    corner, tyre, steering = wheel.corner, wheel.tyre, car.steering
    travel, spin = model.joint(corner.name("travel")), model.joint(corner.name("spin"))
    numbers = {
        "side": float(corner.side),
        "front": float(wheel.front),
        "x": corner.x,
        "y": corner.y,
        "z": -car.body.cg[2],
        "travel_freedom": float(travel.dofadr[0]),
        "steer_freedom": -1.0,
        "spin_freedom": float(spin.dofadr[0]),
        "tyre": float(model.actuator(corner.name("tyre")).id),
        "drive_share": float((car.powertrain.driven == "front") == wheel.front),
        "tyre_law": float(tyre.law.number),
        "radius": tyre.radius,
        "stiffness": tyre.vertical_stiffness,
        "damping": tyre.vertical_damping,
        "design_height": wheel.axle.hub_height,
    }
    if wheel.front:
        joint = model.joint(corner.name("steer"))
        numbers |= {
            "steer_freedom": float(joint.dofadr[0]),
            "steering": float(model.actuator(corner.name("steering")).id),
            "ackermann": steering.ackermann * wheel.axle.track / (2 * car.wheelbase),
            "trail": steering.trail,
            "scrub": steering.scrub,
        }
    for name in RIG_FORCES:
        numbers[name] = -1.0 if rig is None else float(model.actuator(corner.name(name)).id)
    return numbers


def _car_tables(car: CompleteCar) -> list[tuple[str, int, np.ndarray]]:
    """Torques over the engine's speed, parameters of brakes and air."""
    train = car.powertrain
    full, drag = tables(train.speed, [[train.full_torque], [train.drag_torque]], smooth=False, count=65)
    return [
        ("full_torque", -1, full),
        ("drag_torque", -1, drag),
        ("brake_parameters", -1, np.array(numbers_of(car.brakes))),
        ("air_parameters", -1, np.array(numbers_of(car.aerodynamics))),
    ]


def _wheel_tables(car: CompleteCar, wheels: Sequence[Wheel]) -> list[tuple[str, int, np.ndarray]]:
    """Tables of every wheel; the two of an axle share all but their tyres' parameters."""
    of_axle = {axle.name: (_motion_tables(axle.kinematics), _optional_tables(axle)) for axle in car.axles}
    placed = []
    for i, wheel in enumerate(wheels):
        motion, optional = of_axle[wheel.axle.name]
        own = motion | {"tyre_parameters": np.array(numbers_of(wheel.tyre))} | optional
        placed += [(name, i, numbers) for name, numbers in own.items()]
    return placed


def _motion_tables(kinematics: Kinematics) -> dict[str, np.ndarray]:
    """Path of the contact patch, toe and camber over travel and steering."""
    path = table(kinematics.travel, kinematics.path("lateral"), kinematics.path("longitudinal"), smooth=True)
    return {"path": path, "angles": _angle_tables(kinematics)}


def _angle_tables(kinematics: Kinematics) -> np.ndarray:
    """Toe and camber over travel for evenly spaced steer angles; between the given ones they follow cubic splines."""
    steer, angles = kinematics.steer, np.stack([kinematics.angles("toe"), kinematics.angles("camber")])
    if not steer:
        return table_of_tables(0.0, 1.0, tables(kinematics.travel, angles.transpose(2, 0, 1), smooth=True))
    from scipy.interpolate import CubicSpline

    even, spacing = np.linspace(steer[0], steer[-1], _STEER_ROWS, retstep=True)
    ends = "not-a-knot" if len(steer) > 2 else "natural"
    rows = CubicSpline(steer, angles, axis=2, bc_type=ends)(even).transpose(2, 0, 1)
    return table_of_tables(even[0], spacing, tables(kinematics.travel, rows, smooth=True))


def _optional_tables(axle: CompleteAxle) -> dict[str, np.ndarray]:
    """Turning of the carrier over travel, elastic angles over forces; those that the car has."""
    kinematics, compliance, found = axle.kinematics, axle.compliance, {}
    if kinematics.longitudinal_centre:
        turn = (kinematics.path("longitudinal_centre") - kinematics.path("longitudinal")) / axle.hub_height
        found["swing"] = table(kinematics.travel, turn, smooth=True)
    if compliance.lateral_force:
        nothing = [0.0] * len(compliance.lateral_force)
        curves = [compliance.toe or nothing, compliance.camber or nothing]
        found["elastic_lateral"] = table(compliance.lateral_force, *curves, smooth=False)
    if compliance.longitudinal_force:
        found["elastic_longitudinal"] = table(compliance.longitudinal_force, compliance.toe_longitudinal, smooth=False)
    if compliance.aligning_moment:
        found["elastic_aligning"] = table(compliance.aligning_moment, compliance.toe_aligning, smooth=False)
    return found
