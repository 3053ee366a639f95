"""The car that drives freely, compiled: tyres, wheel paths, steering, power train, brakes, air and driver at every
stage.

Everything acts as generalised forces in mjData's `qfrc_applied`: ``Q = J' F`` with the exact Jacobian of the wheel's
path, so roll centres, anti-dive and anti-squat are the virtual work of the tyre's forces, and power is accounted for.
The chassis is body 1 with a free joint; names of the numbers are in `elements.car`. See docs/theory.md, "The car that
drives freely".
"""

from __future__ import annotations

import math

from numba import types

from ..elements.car import CAR_MARK, WHEEL_STATES
from ..elements.law import USERDATA_HEADER
from .driving import air, input_of, power, steering
from .memory import doubles, ints, plain
from .places import (
    AIR_X,
    CAR_SIGNALS_SIZE,
    CONTROL_RATE,
    DESIGN_X,
    DESIGN_Y,
    DESIGN_Z,
    DRIVE_SHARE,
    DRIVER,
    DRIVER_RATE,
    ENGINE,
    ENGINE_RATE,
    FINAL_DRIVE,
    GROUND_Z,
    HEAD_SIZE,
    HEAVE_TARGET,
    KAPPA_RATE,
    PEDAL,
    PITCH_TARGET,
    RADIUS,
    RIG,
    RIG_DAMPING,
    RIG_DAMPING_X,
    RIG_DAMPING_Y,
    RIG_DAMPING_Z,
    RIG_RATE_X,
    RIG_RATE_Y,
    RIG_RATE_Z,
    RIG_STIFFNESS,
    ROLL_TARGET,
    SIGNALS_SIZE,
    SPEED,
    SPEED_TARGET,
    SPIN_FREEDOM,
    TYRE,
    WHEEL_SIGNALS_SIZE,
    WHEEL_SIZE,
)
from .vectors import cross, turned, turned_back
from .wheel import wheel_forces

OVERTURNED = 0.35
"""Cosine of the body's tilt beyond which the car has fallen over."""


@plain
def is_car(model):
    """Whether a model's first custom numeric is the block of a car."""
    return model.nnumeric > 0 and doubles(model.numeric_data)[0] == CAR_MARK


@plain
def blown(head, data, r, velocity):
    """Air force and moment about the chassis' origin, in body axes."""
    force, moment = air(head, data, r, velocity)
    swept = cross((head[AIR_X], 0.0, head[GROUND_Z]), force)
    return force, (moment[0] + swept[0], moment[1] + swept[1], moment[2] + swept[2])


@plain
def held(head, data, r, origin, velocity, spin):
    """Force (inertial axes) and moment (body axes) of the rig's servo on the body."""
    ctrl = doubles(data.ctrl)
    k, d = head[RIG_STIFFNESS], head[RIG_DAMPING]
    height = head[DESIGN_Z] + input_of(head, HEAVE_TARGET, ctrl)
    roll, pitch, yaw = math.atan2(r[7], r[8]), -math.asin(min(max(r[6], -1.0), 1.0)), math.atan2(r[3], r[0])
    force = (
        -k * (origin[0] - head[DESIGN_X]) - d * velocity[0],
        -k * (origin[1] - head[DESIGN_Y]) - d * velocity[1],
        -k * (origin[2] - height) - d * velocity[2],
    )
    moment = (
        -head[RIG_RATE_X] * (roll - input_of(head, ROLL_TARGET, ctrl)) - head[RIG_DAMPING_X] * spin[0],
        -head[RIG_RATE_Y] * (pitch - input_of(head, PITCH_TARGET, ctrl)) - head[RIG_DAMPING_Y] * spin[1],
        -head[RIG_RATE_Z] * yaw - head[RIG_DAMPING_Z] * spin[2],
    )
    return force, moment


@plain
def car_forces(model, data, road, path):
    """Write `qfrc_applied`, the targets of the steering springs and the signals; called at every stage after the
    inputs.

    Args:
        model, data: records of mjModel and mjData.
        road, path: addresses of `Road.block` and `Driver.block`, 0 where there is none.
    """
    if model.nuserdata < SIGNALS_SIZE + USERDATA_HEADER:
        return
    base = model.numeric_data
    head, wheels = doubles(base), base + types.uint64(8 * HEAD_SIZE)
    signals_address = data.userdata + types.uint64(8 * (model.nuserdata - SIGNALS_SIZE))
    signals, wheel_signals = doubles(signals_address), signals_address + types.uint64(8 * CAR_SIGNALS_SIZE)
    v, applied = doubles(data.qvel), doubles(data.qfrc_applied)
    rows, places = doubles(data.xmat + types.uint64(72)), doubles(data.xpos + types.uint64(24))
    r = (rows[0], rows[1], rows[2], rows[3], rows[4], rows[5], rows[6], rows[7], rows[8])
    origin, velocity, spin = (places[0], places[1], places[2]), (v[0], v[1], v[2]), (v[3], v[4], v[5])
    spin_world = turned(r, spin)
    speed = math.copysign(
        math.sqrt(velocity[0] * velocity[0] + velocity[1] * velocity[1]), velocity[0] * r[0] + velocity[1] * r[3]
    )
    signals[SPEED] = speed
    angle, angle_rate = steering(head, model, data, signals, path, origin, math.atan2(r[3], r[0]), speed)
    drive = 0.0
    if head[RIG] == 0.0:
        shaft, radius = 0.0, 0.0
        for i in range(4):
            wheel = doubles(wheels + types.uint64(8 * WHEEL_SIZE * i))
            if wheel[DRIVE_SHARE] > 0.0:
                shaft += 0.5 * v[int(wheel[SPIN_FREEDOM])]
                radius = wheel[RADIUS]
        drive = power(head, base, model, data, signals, shaft * head[FINAL_DRIVE], radius, speed)

    force, moment = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    for i in range(4):
        wheel = doubles(wheels + types.uint64(8 * WHEEL_SIZE * i))
        own = doubles(wheel_signals + types.uint64(8 * WHEEL_SIGNALS_SIZE * i))
        push, twist = wheel_forces(
            head, wheel, base, model, data, own, road, r, origin, velocity, spin_world, angle, angle_rate, drive,
            signals[PEDAL]
        )  # fmt: skip
        force = (force[0] + push[0], force[1] + push[1], force[2] + push[2])
        moment = (moment[0] + twist[0], moment[1] + twist[1], moment[2] + twist[2])
    moment = turned_back(r, moment)
    if head[RIG] == 0.0:
        more, twist = blown(head, data, r, velocity)
        more = turned(r, more)
    else:
        more, twist = held(head, data, r, origin, velocity, spin)
    if r[8] < OVERTURNED:
        force = (math.inf, math.inf, math.inf)  # the run ends here
    for i in range(3):
        applied[i] = force[i] + more[i]
        applied[3 + i] = moment[i] + twist[i]


@plain
def car_state_rates(model, data, actuator):
    """Write `act_dot` of an actuator of the car that has inner states, from the signals; returns the first."""
    base = model.numeric_data
    head = doubles(base)
    first = ints(model.actuator_actadr)[actuator]
    if model.nuserdata < SIGNALS_SIZE + USERDATA_HEADER or first < 0:
        return 0.0
    signals_address = data.userdata + types.uint64(8 * (model.nuserdata - SIGNALS_SIZE))
    signals, rates = doubles(signals_address), doubles(data.act_dot)
    if actuator == int(head[DRIVER]):
        return signals[DRIVER_RATE]
    if actuator == int(head[SPEED_TARGET]):
        return signals[CONTROL_RATE]
    if actuator == int(head[ENGINE]):
        return signals[ENGINE_RATE]
    for i in range(4):
        wheel = doubles(base + types.uint64(8 * (HEAD_SIZE + WHEEL_SIZE * i)))
        if actuator == int(wheel[TYRE]):
            own = CAR_SIGNALS_SIZE + WHEEL_SIGNALS_SIZE * i + KAPPA_RATE
            for state in range(WHEEL_STATES):
                rates[first + state] = signals[own + state]
            return rates[first]
    return 0.0
