"""The car that drives freely, compiled: tyres, wheel paths, steering, power train, brakes, air and driver at every
stage.

Everything acts as generalised forces in mjData's `qfrc_applied`: ``Q = J' F`` with the exact Jacobian of the wheel's
path, so roll centres, anti-dive and anti-squat are the virtual work of the tyre's forces, and power is accounted for.
The chassis is body 1 with a free joint; names of the numbers are in `handling.block`. See docs/theory.md, "The car that
drives freely".
"""

from __future__ import annotations

import math

from numba import types

from ...elements.law import USERDATA_HEADER
from ...handling.block import CAR_MARK, WHEEL_STATES
from ..memory import doubles, ints, plain
from .driving import blown, power, steering
from .records import (
    SIGNALS_SIZE,
    Command,
    Pose,
    car_signals_at,
    head_at,
    input_of,
    signals_address,
    wheel_at,
    wheel_signals_at,
)
from .vectors import turned, turned_back
from .wheel import wheel_forces, wheel_state_rates

OVERTURNED = 0.35
"""Cosine of the body's tilt beyond which the car has fallen over."""


@plain
def is_car(model):
    """Whether a model's first custom numeric is the block of a car."""
    return model.nnumeric > 0 and doubles(model.numeric_data)[0] == CAR_MARK


@plain
def held(head, data, pose, spin):
    """Force (inertial axes) and moment (body axes) of the rig's servo on the body, which turns with `spin` in its
    axes."""
    ctrl, r, origin, velocity = doubles(data.ctrl), pose.rotation, pose.origin, pose.velocity
    k, d = head.rig_stiffness, head.rig_damping
    height = head.design_z + input_of(head.heave_target, ctrl)
    roll, pitch, yaw = math.atan2(r[7], r[8]), -math.asin(min(max(r[6], -1.0), 1.0)), math.atan2(r[3], r[0])
    force = (
        -k * (origin[0] - head.design_x) - d * velocity[0],
        -k * (origin[1] - head.design_y) - d * velocity[1],
        -k * (origin[2] - height) - d * velocity[2],
    )
    moment = (
        -head.rig_rate_x * (roll - input_of(head.roll_target, ctrl)) - head.rig_damping_x * spin[0],
        -head.rig_rate_y * (pitch - input_of(head.pitch_target, ctrl)) - head.rig_damping_y * spin[1],
        -head.rig_rate_z * yaw - head.rig_damping_z * spin[2],
    )
    return force, moment


@plain
def driven_torque(head, model, data, signals, speed):
    """Torque [N m] of each driven wheel."""
    v, shaft, radius = doubles(data.qvel), 0.0, 0.0
    for i in range(4):
        wheel = wheel_at(model.numeric_data, i)
        if wheel.drive_share > 0.0:
            shaft += 0.5 * v[int(wheel.spin_freedom)]
            radius = wheel.radius
    return power(head, model, data, signals, shaft * head.final_drive, radius, speed)


@plain
def car_forces(model, data, road, driver):
    """Write `qfrc_applied`, the targets of the steering springs and the signals; called at every stage after the
    inputs.

    Args:
        model, data: records of mjModel and mjData.
        road, driver: addresses of `Road.block` and `Driver.block`, 0 where there is none.
    """
    if 8 * model.nuserdata < SIGNALS_SIZE + 8 * USERDATA_HEADER:
        return
    head, address = head_at(model.numeric_data), signals_address(model, data)
    signals = car_signals_at(address)
    v, applied = doubles(data.qvel), doubles(data.qfrc_applied)
    rows, places = doubles(data.xmat + types.uint64(72)), doubles(data.xpos + types.uint64(24))
    r = (rows[0], rows[1], rows[2], rows[3], rows[4], rows[5], rows[6], rows[7], rows[8])
    origin, velocity, spin = (places[0], places[1], places[2]), (v[0], v[1], v[2]), (v[3], v[4], v[5])
    pose = Pose(r, origin, velocity, turned(r, spin))
    ahead = velocity[0] * r[0] + velocity[1] * r[3]
    speed = math.copysign(math.sqrt(velocity[0] * velocity[0] + velocity[1] * velocity[1]), ahead)
    signals.speed = speed
    angle, rate = steering(head, model, data, signals, driver, origin, math.atan2(r[3], r[0]), speed)
    drive = driven_torque(head, model, data, signals, speed) if head.rig == 0.0 else 0.0
    command = Command(angle, rate, drive, signals.brake_pedal)

    force, moment = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    for i in range(4):
        own = wheel_signals_at(address, i)
        push, twist = wheel_forces(head, wheel_at(model.numeric_data, i), own, model, data, road, pose, command)
        force = (force[0] + push[0], force[1] + push[1], force[2] + push[2])
        moment = (moment[0] + twist[0], moment[1] + twist[1], moment[2] + twist[2])
    moment = turned_back(r, moment)
    if head.rig == 0.0:
        more, twist = blown(head, model, data, r, velocity)
        more = turned(r, more)
    else:
        more, twist = held(head, data, pose, spin)
    if r[8] < OVERTURNED:
        force = (math.inf, math.inf, math.inf)  # the run ends here
    for i in range(3):
        applied[i] = force[i] + more[i]
        applied[3 + i] = moment[i] + twist[i]


@plain
def car_state_rates(model, data, actuator):
    """Write `act_dot` of an actuator of the car that has inner states, from the signals; returns the first."""
    head, first = head_at(model.numeric_data), ints(model.actuator_actadr)[actuator]
    if 8 * model.nuserdata < SIGNALS_SIZE + 8 * USERDATA_HEADER or first < 0:
        return 0.0
    address = signals_address(model, data)
    signals = car_signals_at(address)
    if actuator == int(head.driver):
        return signals.driver_rate
    if actuator == int(head.speed_target):
        return signals.control_rate
    if actuator == int(head.engine):
        return signals.engine_rate
    for i in range(4):
        if actuator == int(wheel_at(model.numeric_data, i).tyre):
            rates = wheel_state_rates(wheel_signals_at(address, i))
            for state in range(WHEEL_STATES):
                doubles(data.act_dot)[first + state] = rates[state]
            return rates[0]
    return 0.0
