"""Checks of a car's numbers in an MJCF file that may have been edited by hand: compiled code reads where they point."""

from __future__ import annotations

import mujoco
import numpy as np

from .elements.car import CAR_MARK, CAR_NUMERIC, CONTROLS, CURVES, HEAD, MOST_GEARS, OPTIONAL, RIG_CONTROLS, WHEEL
from .errors import InputError
from .names import CORNERS


def check_block(spec: mujoco.MjSpec, source: str) -> None:
    """Refuse a car's block that is not whole, or that addresses something outside the model or itself."""
    if CAR_NUMERIC not in _names(spec):
        return
    block, wheels = _numbers(spec)
    whole = (
        len(block) > len(HEAD) + 4 * len(WHEEL) and block[0] == CAR_MARK and block[HEAD.index("length")] == len(block)
    )
    if _names(spec)[0] != CAR_NUMERIC or not whole:
        raise InputError("must be the first custom numeric, and whole", key=CAR_NUMERIC, source=source)
    sizes = {mujoco.mjtJoint.mjJNT_FREE: 6, mujoco.mjtJoint.mjJNT_BALL: 3}
    freedoms = sum(sizes.get(joint.type, 1) for joint in spec.joints)
    if block[HEAD.index("freedoms")] != freedoms:
        text = (
            f"is written for {block[HEAD.index('freedoms')]:g} freedoms, the model has {freedoms}; add no joints, "
            "build the car anew"
        )
        raise InputError(text, key=CAR_NUMERIC, source=source)
    for name in ("travel_freedom", "steer_freedom", "spin_freedom", "tyre", "steering"):
        number = wheels[:, WHEEL.index(name)]
        if not ((number >= -1) & (number < (freedoms if name.endswith("freedom") else len(spec.actuators)))).all():
            raise InputError(
                f"'{name}' of a wheel lies outside the model; keep the order", key=CAR_NUMERIC, source=source
            )
    _check_numbers(block, wheels, len(spec.actuators), source)


def check_places(spec: mujoco.MjSpec, model: mujoco.MjModel, source: str) -> None:
    """Refuse a file in which the car's numbers address joints or actuators that are no longer where they say."""
    if CAR_NUMERIC not in _names(spec):
        return
    _, wheels = _numbers(spec)
    for corner, wheel in zip(CORNERS, wheels, strict=True):
        expected = {"tyre": ("actuator", f"{corner}_tyre"), "travel_freedom": ("joint", f"{corner}_travel")}
        expected |= {"spin_freedom": ("joint", f"{corner}_spin")}
        if corner.startswith("f"):
            expected |= {"steer_freedom": ("joint", f"{corner}_steer"), "steering": ("actuator", f"{corner}_steering")}
        for number, (kind, name) in expected.items():
            named = mujoco.mjtObj.mjOBJ_ACTUATOR if kind == "actuator" else mujoco.mjtObj.mjOBJ_JOINT
            index = mujoco.mj_name2id(model, named, name)
            if index >= 0 and kind == "joint":
                index = int(model.jnt_dofadr[index])
            if index < 0 or wheel[WHEEL.index(number)] != index:
                raise InputError(
                    f"{kind} '{name}' is not where the car's numbers say; keep the order",
                    key=CAR_NUMERIC,
                    source=source,
                )


def _names(spec: mujoco.MjSpec) -> list[str]:
    return [numeric.name for numeric in spec.numerics]


def _numbers(spec: mujoco.MjSpec) -> tuple[np.ndarray, np.ndarray]:
    """The car's block, and of it the (4, n) numbers of the wheels; zeros where it is too short."""
    block = np.array(spec.numerics[_names(spec).index(CAR_NUMERIC)].data)
    wheels = block[len(HEAD) : len(HEAD) + 4 * len(WHEEL)]
    return block, np.pad(wheels, (0, 4 * len(WHEEL) - len(wheels))).reshape(4, len(WHEEL))


def _check_numbers(block: np.ndarray, wheels: np.ndarray, actuators: int, source: str) -> None:
    """Refuse numbers with which the compiled car would read outside its block, which lies in memory that others use."""
    head = dict(zip(HEAD, block[: len(HEAD)], strict=True))
    controls = [
        name
        for name in (*CONTROLS, *RIG_CONTROLS)
        if not (-1 <= head[name] < actuators and head[name] == int(head[name]))
    ]
    if controls:
        text = (
            f"{head[controls[0]]:g} is not allowed for '{controls[0]}'; the model has {actuators} actuators, 0 to "
            f"{actuators - 1}"
        )
        raise InputError(text, key=CAR_NUMERIC, source=source)
    if not 1 <= head["gears"] <= MOST_GEARS:
        raise InputError(
            f"{head['gears']:g} gears are not allowed; 1 to {MOST_GEARS} are", key=CAR_NUMERIC, source=source
        )
    if (
        not (wheels[:, WHEEL.index("radius")] > 0).all()
        or not head["engine_inertia"] > 0
        or not head["steering_ratio"] > 0
    ):
        raise InputError(
            "radius of a wheel, engine_inertia and steering_ratio must be greater than 0",
            key=CAR_NUMERIC,
            source=source,
        )
    places = [(name, head[name]) for name in CURVES if name in HEAD]
    places += [
        (name, wheel[WHEEL.index(name)])
        for wheel in wheels
        for name in (*CURVES, "angles", "tyre_parameters")
        if name in WHEEL
    ]
    begins = sorted({place for _, place in places if place != 0} | {float(len(block))})
    parameters: set[float] = set()
    for name, place in places:
        if place == 0 and name in OPTIONAL:
            continue
        room = (
            begins[begins.index(place) + 1] - place
            if len(HEAD) + wheels.size <= place < len(block) and place == int(place)
            else 0
        )
        at = int(place)
        if name == "tyre_parameters":
            parameters.add(room)
            fits = room > 0 and len(parameters) <= len(set(wheels[:, WHEEL.index("tyre_law")]))
        elif name == "angles":
            fits = room > 4 and room == 4 + block[at + 2] * block[at + 3] and block[at + 3] == 3 + 4 * block[at + 6]
        else:
            fits = room > 3 and room == 3 + 2 * CURVES[name] * block[at + 2]
        if not fits:
            raise InputError(
                f"'{name}' is not where the car's numbers say; leave places and lengths as they are",
                key=CAR_NUMERIC,
                source=source,
            )
