"""Checks of a car's numbers in an MJCF file that may have been edited by hand: compiled code reads where they point."""

from __future__ import annotations

from collections.abc import Iterator

import mujoco
import numpy as np

from ..errors import InputError
from ..names import CORNERS
from .block import CAR_NUMERIC, CONTROLS, CURVES, MOST_GEARS, OPTIONAL, PARAMETERS, RIG_CONTROLS, CarNumbers, names_of


def check_block(spec: mujoco.MjSpec, source: str) -> None:
    """Refuse a car's block that is not whole, or that addresses something outside the model or itself."""
    if CAR_NUMERIC not in _names(spec):
        return
    car = _car(spec)
    if car is None or _names(spec)[0] != CAR_NUMERIC or car.head.length != len(car.block):
        raise InputError("must be the first custom numeric, and whole", key=CAR_NUMERIC, source=source)
    sizes = {mujoco.mjtJoint.mjJNT_FREE: 6, mujoco.mjtJoint.mjJNT_BALL: 3}
    freedoms = sum(sizes.get(joint.type, 1) for joint in spec.joints)
    if car.head.freedoms != freedoms:
        raise InputError(
            f"is written for {car.head.freedoms:g} freedoms, the model has {freedoms}; add no joints, build the car "
            "anew",
            key=CAR_NUMERIC,
            source=source,
        )
    for name in ("travel_freedom", "steer_freedom", "spin_freedom", "tyre", "steering"):
        number = car.wheels[name]
        if not ((number >= -1) & (number < (freedoms if name.endswith("freedom") else len(spec.actuators)))).all():
            text = f"'{name}' of a wheel lies outside the model; keep the order"
            raise InputError(text, key=CAR_NUMERIC, source=source)
    _check_numbers(car, len(spec.actuators), source)
    _check_rooms(car, source)


def check_places(spec: mujoco.MjSpec, model: mujoco.MjModel, source: str) -> None:
    """Refuse a file in which the car's numbers address joints or actuators that are no longer where they say."""
    car = _car(spec) if CAR_NUMERIC in _names(spec) else None
    if car is None:
        return
    for corner, wheel in zip(CORNERS, car.wheels, strict=True):
        expected = {"tyre": ("actuator", f"{corner}_tyre"), "travel_freedom": ("joint", f"{corner}_travel")}
        expected |= {"spin_freedom": ("joint", f"{corner}_spin")}
        if corner.startswith("f"):
            expected |= {
                "steer_freedom": ("joint", f"{corner}_steer"),
                "steering": ("actuator", f"{corner}_steering"),
            }
        for number, (kind, name) in expected.items():
            named = mujoco.mjtObj.mjOBJ_ACTUATOR if kind == "actuator" else mujoco.mjtObj.mjOBJ_JOINT
            index = mujoco.mj_name2id(model, named, name)
            if index >= 0 and kind == "joint":
                index = int(model.jnt_dofadr[index])
            if index < 0 or wheel[number] != index:
                text = f"{kind} '{name}' is not where the car's numbers say; keep the order"
                raise InputError(text, key=CAR_NUMERIC, source=source)


def _names(spec: mujoco.MjSpec) -> list[str]:
    return [numeric.name for numeric in spec.numerics]


def _car(spec: mujoco.MjSpec) -> CarNumbers | None:
    """The car's numbers; None where they are not whole."""
    return CarNumbers.of(np.array(spec.numerics[_names(spec).index(CAR_NUMERIC)].data))


def _check_numbers(car: CarNumbers, actuators: int, source: str) -> None:
    """Refuse numbers with which the compiled car would divide by zero, or read an actuator or a gear that is none."""
    head = car.head
    for name in (*CONTROLS, *RIG_CONTROLS):
        if not (-1 <= head[name] < actuators and head[name] == int(head[name])):
            raise InputError(
                f"{head[name]:g} is not allowed for '{name}'; the model has {actuators} actuators, 0 to "
                f"{actuators - 1}",
                key=CAR_NUMERIC,
                source=source,
            )
    if not 1 <= head.gears <= MOST_GEARS:
        text = f"{head.gears:g} gears are not allowed; 1 to {MOST_GEARS} are"
        raise InputError(text, key=CAR_NUMERIC, source=source)
    if not (car.wheels.radius > 0).all() or not head.engine_inertia > 0 or not head.steering_ratio > 0:
        text = "radius of a wheel, engine_inertia and steering_ratio must be greater than 0"
        raise InputError(text, key=CAR_NUMERIC, source=source)


def _check_rooms(car: CarNumbers, source: str) -> None:
    """Refuse places of tables and parameters behind which there is not what compiled code reads there."""
    places = list(_places(car))
    begins = sorted({place for _, place, _ in places if place != 0} | {float(len(car.block))})
    rooms: dict[tuple[str, float], float] = {}
    for name, place, law in places:
        if place == 0 and name in OPTIONAL:
            continue
        inside = car.size() <= place < len(car.block) and place == int(place)
        room = begins[begins.index(place) + 1] - place if inside else 0
        at = car.block[int(place) :] if inside else np.zeros(7)
        if name in PARAMETERS:
            fits = room > 0 and rooms.setdefault((name, law), room) == room
        elif name == "angles":
            fits = room > 4 and room == 4 + at[2] * at[3] and at[3] == 3 + 4 * at[6]
        else:
            fits = room > 3 and room == 3 + 2 * CURVES[name] * at[2]
        if not fits:
            text = f"'{name}' is not where the car's numbers say; leave places and lengths as they are"
            raise InputError(text, key=CAR_NUMERIC, source=source)


def _places(car: CarNumbers) -> Iterator[tuple[str, float, float]]:
    """Name, place and law (0 for a table) of everything behind head and wheels."""
    for record in (car.head, *car.wheels):
        for name in names_of(record.dtype):
            if name in CURVES or name == "angles" or name in PARAMETERS:
                yield name, float(record[name]), float(record[PARAMETERS[name]]) if name in PARAMETERS else 0.0
