"""What drives and steers the compiled car: steering wheel, controller, engine, gearbox, brakes, air."""

from __future__ import annotations

import math

from numba import types

from ..elements.car import CRUISE_ABOVE, CRUISE_DOWN
from ..elements.law import USERDATA_HEADER
from .lookup import looked_up, place_of
from .memory import doubles, ints, plain
from .places import (
    ACCELERATOR,
    AIR_PRESSURE,
    BRAKE,
    CONTROL_FORCE,
    CONTROL_GAIN,
    CONTROL_INTEGRAL,
    CONTROL_RATE,
    CONVERTER,
    COUPLING,
    COUPLING_LIMIT,
    DRAG,
    DRAG_TORQUE,
    DRIVER,
    DRIVER_RATE,
    EFFICIENCY,
    ENGINE,
    ENGINE_INERTIA,
    ENGINE_LIMIT,
    ENGINE_RATE,
    ENGINE_SPEED,
    ENGINE_TORQUE,
    FINAL_DRIVE,
    FULL_TORQUE,
    GEAR,
    GEAR_1,
    GEARS,
    IDLE_GAIN,
    IDLE_SPEED,
    IDLE_TORQUE,
    LIFT_FRONT,
    LIFT_REAR,
    PATH_DEVIATION,
    PEDAL,
    SHIFT_BEGAN,
    SHIFT_DOWN,
    SHIFT_TIME,
    SHIFT_UP,
    SIDE_FORCE,
    SPEED_CONTROL,
    SPEED_TARGET,
    STEERING_LIMIT,
    STEERING_RATIO,
    STEERING_WHEEL,
    TRIM_ANGLE,
    TRIMMING,
    WHEEL_ANGLE,
    WHEELBASE,
    WIND_X,
    WIND_Y,
    YAW_MOMENT,
)
from .surroundings import deviation, wanted_angle
from .vectors import turned_back

BRISTLE, BRISTLE_TIME, BRISTLE_DAMPING = 0.02, 1e-3, 2e-3
"""Wind-up of a brake that holds [rad], its shortest time [s] when sliding fast, and its damping time when it holds
[s]."""
HOLD_PEDAL = 0.3
"""Brake pedal with which the speed controller holds the car where its target is zero."""
PARKED = 0.01
LIMITER_WIDTH = 0.03
"""The limiter takes the torque away while the engine's speed exceeds the map's last by this share."""
SHIFT_OPEN, MATCHING_TIME = 0.6, 0.05
"""Share of a shift for which the drive is open, and the time [s] in which the engine is brought to the speed of the new
gear."""
WIND_UP = 1.2


@plain
def input_of(head, name, ctrl):
    """Value of an input; 0 where the car has none."""
    actuator = int(head[name])
    return ctrl[actuator] if actuator >= 0 else 0.0


@plain
def steering(head, model, data, signals, path, position, heading, speed):
    """Angle of the steering wheel and its rate: trim, what the manoeuvre asks for, what the driver steers."""
    ctrl, userdata, act = doubles(data.ctrl), doubles(data.userdata), doubles(data.act)
    wheel, driver = int(head[STEERING_WHEEL]), int(head[DRIVER])
    angle, rate = ctrl[wheel] + signals[TRIM_ANGLE], userdata[USERDATA_HEADER + wheel]
    signals[DRIVER_RATE] = 0.0
    signals[PATH_DEVIATION] = 0.0
    if driver >= 0 and path != types.uint64(0):
        state = act[ints(model.actuator_actadr)[driver]]
        wanted = wanted_angle(
            doubles(path), position[0], position[1], heading, speed, head[STEERING_RATIO], head[WHEELBASE]
        )
        wanted = min(max(wanted, -head[STEERING_LIMIT]), head[STEERING_LIMIT])
        own_rate = (wanted - state) / max(doubles(path)[1], 1e-3)
        signals[DRIVER_RATE] = own_rate
        signals[PATH_DEVIATION] = deviation(doubles(path), position[0], position[1])
        angle, rate = angle + state, rate + own_rate
    if abs(angle) > head[STEERING_LIMIT]:
        angle, rate = math.copysign(head[STEERING_LIMIT], angle), 0.0
    signals[WHEEL_ANGLE] = angle
    return angle, rate


@plain
def shifted_gear(head, signals, time, shaft_speed, accelerator):
    """Gear at a speed of the propeller shaft; remembers gear and the beginning of a shift. The first call chooses a
    gear to cruise in.

    The speed is that of wheels which roll: neither a locked wheel nor a spinning one shifts the box. The accelerator is
    that of the manoeuvre: released, as under braking or with the speed controller in charge, the gear is held as long
    as the engine can turn in it; floored, `shift_down` holds; between, the threshold lies between.
    """
    count = int(head[GEARS])
    gear = int(signals[GEAR])
    lowest = CRUISE_ABOVE * head[IDLE_SPEED]
    if gear < 1 or gear > count:
        gear = count
        while gear > 1 and shaft_speed * head[GEAR_1 + gear - 1] < lowest:
            gear -= 1
        signals[SHIFT_BEGAN] = -1e3
    elif signals[TRIMMING] == 0.0 and time - signals[SHIFT_BEGAN] > max(head[SHIFT_TIME], 1e-3):
        engine_side = shaft_speed * head[GEAR_1 + gear - 1]
        least = CRUISE_DOWN * head[IDLE_SPEED]
        below = least + min(max(accelerator, 0.0), 1.0) * max(head[SHIFT_DOWN] - least, 0.0)
        if engine_side > head[SHIFT_UP] and gear < count:
            gear += 1
            signals[SHIFT_BEGAN] = time
        elif engine_side < below and gear > 1:
            gear -= 1
            signals[SHIFT_BEGAN] = time
    signals[GEAR] = gear
    return gear


@plain
def power(head, base, model, data, signals, shaft_speed, rolling_radius, speed):
    """Drive torque of each driven wheel: controller, engine, coupling, gearbox, open differential."""
    ctrl, act = doubles(data.ctrl), doubles(data.act)
    target = input_of(head, SPEED_TARGET, ctrl)
    weight = input_of(head, SPEED_CONTROL, ctrl)
    demanded = input_of(head, ENGINE, ctrl)
    signals[PEDAL] = input_of(head, BRAKE, ctrl)
    signals[CONTROL_RATE], signals[ENGINE_RATE] = 0.0, 0.0
    engine = int(head[ENGINE])
    engine_speed = act[ints(model.actuator_actadr)[engine]]
    time = data.time
    trimming = signals[TRIMMING] != 0.0
    gear = shifted_gear(head, signals, time, abs(speed) / rolling_radius * head[FINAL_DRIVE], demanded)
    ratio = head[GEAR_1 + gear - 1] * head[FINAL_DRIVE]
    input_speed = shaft_speed * head[GEAR_1 + gear - 1]
    full, _ = looked_up(doubles(place_of(base, head[FULL_TORQUE])), engine_speed)
    drag, _ = looked_up(doubles(place_of(base, head[DRAG_TORQUE])), engine_speed)
    pedal = demanded
    if trimming:
        target, weight, pedal = speed, 1.0, 0.0
    if weight > 0.0:
        error = target - speed
        force = head[CONTROL_GAIN] * error + act[ints(model.actuator_actadr)[int(head[SPEED_TARGET])]]
        torque = force * rolling_radius / (ratio * head[EFFICIENCY])
        wanted = (torque - drag) / (full - drag)
        pedal += weight * (min(max(wanted, 0.0), 1.0) if not trimming else wanted)
        winding = (wanted > WIND_UP and error > 0.0) or (wanted < 1.0 - WIND_UP and error < 0.0)
        signals[CONTROL_FORCE] = force
        if not winding:
            signals[CONTROL_RATE] = weight * head[CONTROL_INTEGRAL] * error
        if target < PARKED and abs(speed) < 0.5:
            signals[PEDAL] = max(signals[PEDAL], weight * HOLD_PEDAL)
            signals[CONTROL_RATE] = 0.0
            pedal = 0.0 if trimming else demanded
    if not trimming:
        pedal = min(max(pedal, 0.0), 1.0)
    limiter = 1.0 - min(max((engine_speed / head[ENGINE_LIMIT] - 1.0) / LIMITER_WIDTH, 0.0), 1.0)
    idle = min(max(head[IDLE_GAIN] * (head[IDLE_SPEED] - engine_speed), 0.0), head[IDLE_TORQUE])
    torque = drag + limiter * pedal * (full - drag) + idle
    # a converter at standstill, locked up by a viscous clutch once the shaft turns faster than idling; a shift opens
    # both, and until they close again the engine is brought to the shaft's speed
    lock = min(max(2.0 * input_speed / head[IDLE_SPEED] - 1.6, 0.0), 1.0)
    since = (time - signals[SHIFT_BEGAN]) / max(head[SHIFT_TIME], 1e-3)
    closed = min(max((since - SHIFT_OPEN) / (1.0 - SHIFT_OPEN), 0.0), 1.0)
    slip = engine_speed - input_speed
    passed = closed * (head[CONVERTER] * max(engine_speed, 0.0) + lock * head[COUPLING]) * slip
    passed = min(max(passed, -head[COUPLING_LIMIT]), head[COUPLING_LIMIT])
    matched = (max(input_speed, head[IDLE_SPEED]) - engine_speed) / MATCHING_TIME
    signals[ENGINE_RATE] = closed * (torque - passed) / head[ENGINE_INERTIA] + (1.0 - closed) * matched
    signals[ACCELERATOR], signals[ENGINE_SPEED], signals[ENGINE_TORQUE] = pedal, engine_speed, torque
    efficiency = head[EFFICIENCY] if passed > 0.0 else 1.0 / head[EFFICIENCY]
    return passed * ratio * efficiency / 2.0


@plain
def brake_torque(largest, pedal, bristle, spin):
    """Torque against the turning and the rate of the bristle: a friction that holds at standstill and slides beyond its
    limit."""
    rate = (spin - abs(spin) * bristle) / max(BRISTLE, abs(spin) * BRISTLE_TIME)
    return largest * max(pedal, 0.0) * min(max(bristle + BRISTLE_DAMPING * rate, -1.0), 1.0), rate


@plain
def air(head, data, r, velocity):
    """Air forces and moments about the ground point amid the wheels, in body axes."""
    ctrl = doubles(data.ctrl)
    wind = (input_of(head, WIND_X, ctrl) - velocity[0], input_of(head, WIND_Y, ctrl) - velocity[1], 0.0)
    u = turned_back(r, wind)
    square = u[0] * u[0] + u[1] * u[1]
    if square < 1e-12:
        return (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    beta = math.atan2(u[1], -u[0])
    q = head[AIR_PRESSURE] * square
    half = head[WHEELBASE] / 2.0
    front, rear = q * head[LIFT_FRONT], q * head[LIFT_REAR]
    force = (head[AIR_PRESSURE] * head[DRAG] * math.sqrt(square) * u[0], q * head[SIDE_FORCE] * beta, front + rear)
    return force, (0.0, (rear - front) * half, q * head[WHEELBASE] * head[YAW_MOMENT] * beta)
