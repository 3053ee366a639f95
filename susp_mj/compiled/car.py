"""The car that drives freely, compiled: tyres, wheel paths, steering, power train, brakes, air and driver at every stage.

Everything acts as generalised forces in mjData's `qfrc_applied`: ``Q = J' F`` with the exact Jacobian of the wheel's path, so
roll centres, anti-dive and anti-squat are the virtual work of the tyre's forces, and power is accounted for. The chassis is body 1
with a free joint; names of the numbers are in `elements.car`. See docs/theory.md, "The car that drives freely".
"""

from __future__ import annotations

import math

from numba import types

from ..elements.car import CAR_MARK, CAR_SIGNALS, CRUISE_ABOVE, CRUISE_DOWN, HEAD, SIGNALS, WHEEL, WHEEL_SIGNALS, WHEEL_STATES
from ..elements.law import LAW_TABLE_SIZE, USERDATA_HEADER
from .laws import contact_call
from .memory import doubles, ints, plain
from .surroundings import deviation, road_at, wanted_angle

# fmt: off
(
    MARK, LENGTH, FREEDOMS, RIG, STEERING_WHEEL, DRIVER, SPEED_TARGET, SPEED_CONTROL, ENGINE, BRAKE, WIND_X, WIND_Y, HEAVE_TARGET, ROLL_TARGET,
    PITCH_TARGET, STEERING_RATIO, STEERING_LIMIT, WHEELBASE, REAR_AXLE_X, GROUND_Z, CONTROL_GAIN, CONTROL_INTEGRAL, AIR_PRESSURE, DRAG,
    LIFT_FRONT, LIFT_REAR, SIDE_FORCE, YAW_MOMENT, AIR_X, DRIVEN_REAR, ENGINE_INERTIA, IDLE_SPEED, IDLE_GAIN, IDLE_TORQUE, COUPLING,
    CONVERTER, COUPLING_LIMIT, FINAL_DRIVE, EFFICIENCY, SHIFT_UP, SHIFT_DOWN, SHIFT_TIME, GEARS, GEAR_1,
) = range(44)
FULL_TORQUE, DRAG_TORQUE, DESIGN_X, DESIGN_Y, DESIGN_Z, RIG_STIFFNESS, RIG_DAMPING, RIG_RATE_X, RIG_RATE_Y, RIG_RATE_Z, RIG_DAMPING_X, RIG_DAMPING_Y, RIG_DAMPING_Z = (
    HEAD.index(name) for name in HEAD[HEAD.index("full_torque"):]
)
(
    SIDE, REAR, X, Y, Z, TRAVEL_FREEDOM, STEER_FREEDOM, SPIN_FREEDOM, TYRE, STEERING, ACKERMANN, TRAIL, SCRUB,
    DRIVE_SHARE, BRAKE_TORQUE, TYRE_LAW, TYRE_PARAMETERS, RADIUS, STIFFNESS, DAMPING, DESIGN_HEIGHT, LATERAL, LONGITUDINAL, TOE, CAMBER, SWING,
    TOE_LATERAL, CAMBER_LATERAL, TOE_LONGITUDINAL, TOE_ALIGNING, RIG_LONGITUDINAL, RIG_LATERAL, RIG_ALIGNING,
) = range(len(WHEEL))
(
    GEAR, SHIFT_BEGAN, TRIM_ANGLE, TRIMMING, DRIVER_RATE, CONTROL_RATE, ENGINE_RATE, WHEEL_ANGLE, ACCELERATOR, PEDAL, ENGINE_SPEED, ENGINE_TORQUE,
    PATH_DEVIATION, CONTROL_FORCE, SPEED,
) = range(len(CAR_SIGNALS))
(
    FX, FY, MX, MY, MZ, SIGMA_X, SIGMA_Y, ROLLING_RADIUS, LOAD, SLIP_RATIO, SLIP_ANGLE, ROAD_CAMBER, STEER_ANGLE, INCLINATION, WHEEL_SPEED,
    DRIVE_TORQUE, BRAKING_TORQUE, ROAD_HEIGHT, WHEEL_HEIGHT, CONTACT_X, CONTACT_Y, FRICTION, KAPPA_RATE, TAN_RATE, BRAKE_RATE, ELASTIC_X_RATE, ELASTIC_Y_RATE, ELASTIC_MOMENT_RATE,
) = range(len(WHEEL_SIGNALS))
# fmt: on
_HEAD_SIZE, _WHEEL_SIZE, _CAR_SIGNALS, _WHEEL_SIGNALS = len(HEAD), len(WHEEL), len(CAR_SIGNALS), len(WHEEL_SIGNALS)
_SIGNALS = len(SIGNALS)

MOST_KAPPA, MOST_TAN_ALPHA = 1.5, 3.0
"""Largest slips that sliding leads to, at standstill too."""
SLOW = 2.5
"""Below this rolling speed [m/s] the slips' rates add to the forces, a damping without which a standing car would sway for ever."""
SLOW_SLIP = 0.07
"""Slip per sliding speed [s/m] that is added at standstill: 0.02 s over a relaxation length of 0.3 m."""
HELD_SLIP, HELD_TIME = 0.08, 0.05
"""Coming to rest, a tyre that slid is wound up as far as its friction carries and no further: slips beyond the first fade within the second
[s]. As a spring of the relaxation length a slip of 1 would throw the car back by half a metre."""
SMALLEST_RELAXATION = 0.05
BUSHING_TIME = 0.005
"""Time constant [s] of the elastic suspension's answer to forces."""
BRISTLE, BRISTLE_TIME, BRISTLE_DAMPING = 0.02, 1e-3, 2e-3
"""Wind-up of a brake that holds [rad], its shortest time [s] when sliding fast, and its damping time when it holds [s]."""
HOLD_PEDAL = 0.3
"""Brake pedal with which the speed controller holds the car where its target is zero."""
PARKED = 0.01
WIND_UP = 1.2
"""The controller stops integrating where it asks for this share of what the engine gives."""


@plain
def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


@plain
def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@plain
def sine_cosine(angle):
    """Sine and cosine; the angles of wheels are small, where seven terms of the series are exact and quicker."""
    if abs(angle) > 0.35:
        return math.sin(angle), math.cos(angle)
    s = angle * angle
    sine = angle * (1.0 - s / 6.0 * (1.0 - s / 20.0 * (1.0 - s / 42.0 * (1.0 - s / 72.0 * (1.0 - s / 110.0 * (1.0 - s / 156.0))))))
    cosine = 1.0 - s / 2.0 * (1.0 - s / 12.0 * (1.0 - s / 30.0 * (1.0 - s / 56.0 * (1.0 - s / 90.0 * (1.0 - s / 132.0 * (1.0 - s / 182.0))))))
    return sine, cosine


@plain
def turned(r, v):
    """Body to inertial axes; r is a rotation matrix by rows."""
    return (
        r[0] * v[0] + r[1] * v[1] + r[2] * v[2],
        r[3] * v[0] + r[4] * v[1] + r[5] * v[2],
        r[6] * v[0] + r[7] * v[1] + r[8] * v[2],
    )


@plain
def turned_back(r, v):
    """Inertial to body axes."""
    return (
        r[0] * v[0] + r[3] * v[1] + r[6] * v[2],
        r[1] * v[0] + r[4] * v[1] + r[7] * v[2],
        r[2] * v[0] + r[5] * v[1] + r[8] * v[2],
    )


@plain
def looked_up(table, x):
    """Value and slope of a one-dimensional table."""
    spacing, last = table[1], int(table[2]) - 1
    place = (x - table[0]) / spacing
    if place <= 0.0:
        return table[3] + table[4] * (x - table[0]), table[4]
    if place >= last:
        return table[3 + 2 * last] + table[4 + 2 * last] * (place - last) * spacing, table[4 + 2 * last]
    i = int(place)
    u = place - i
    v0, m0, v1, m1 = table[3 + 2 * i], table[4 + 2 * i] * spacing, table[5 + 2 * i], table[6 + 2 * i] * spacing
    rise = v1 - v0
    c, d = 3.0 * rise - 2.0 * m0 - m1, m0 + m1 - 2.0 * rise
    return v0 + u * (m0 + u * (c + u * d)), (m0 + u * (2.0 * c + 3.0 * u * d)) / spacing


@plain
def looked_up_twice(address, x, s):
    """Value and slope over x of a table whose rows belong to even values of s; linear between the rows, held outside."""
    head = doubles(address)
    rows, stride = int(head[2]), int(head[3])
    first = address + types.uint64(32)
    if rows == 1:
        return looked_up(doubles(first), x)
    place = min(max((s - head[0]) / head[1], 0.0), rows - 1.0)
    j = min(int(place), rows - 2)
    share = place - j
    v0, m0 = looked_up(doubles(first + types.uint64(8 * stride * j)), x)
    v1, m1 = looked_up(doubles(first + types.uint64(8 * stride * (j + 1))), x)
    return v0 + share * (v1 - v0), m0 + share * (m1 - m0)


@plain
def looked_up_if_any(base, place, x):
    """Value of a table; 0 where there is none."""
    if place == 0.0:
        return 0.0
    value, _ = looked_up(doubles(base + types.uint64(8 * int(place))), x)
    return value


@plain
def slip_rate(slip, sliding, rolling, relaxation, largest):
    """As `elements.tyres.slip.slip_rate`."""
    speed = max(abs(rolling), abs(sliding) / largest)
    return (sliding - speed * slip) / max(relaxation, SMALLEST_RELAXATION)


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
        wanted = wanted_angle(doubles(path), position[0], position[1], heading, speed, head[STEERING_RATIO], head[WHEELBASE])
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
def shifted_gear(head, signals, time, shaft_speed, cruising):
    """Gear at a speed of the propeller shaft; remembers gear and the beginning of a shift. The first call chooses a gear to cruise in.

    With the speed controller in charge it is held as long as the engine can turn in it, so that no shift disturbs a manoeuvre.
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
        below = CRUISE_DOWN * head[IDLE_SPEED] if cruising else head[SHIFT_DOWN]
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
    gear = shifted_gear(head, signals, time, shaft_speed, weight > 0.0)
    ratio = head[GEAR_1 + gear - 1] * head[FINAL_DRIVE]
    input_speed = shaft_speed * head[GEAR_1 + gear - 1]
    full, _ = looked_up(doubles(base + types.uint64(8 * int(head[FULL_TORQUE]))), engine_speed)
    drag, _ = looked_up(doubles(base + types.uint64(8 * int(head[DRAG_TORQUE]))), engine_speed)
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
    idle = min(max(head[IDLE_GAIN] * (head[IDLE_SPEED] - engine_speed), 0.0), head[IDLE_TORQUE])
    torque = drag + pedal * (full - drag) + idle
    # a converter at standstill, locked up by a viscous clutch once the shaft turns faster than idling; a shift closes it anew
    lock = min(max(2.0 * input_speed / head[IDLE_SPEED] - 1.6, 0.0), 1.0)
    since = (time - signals[SHIFT_BEGAN]) / max(head[SHIFT_TIME], 1e-3)
    closed = min(max(since, 0.0), 1.0)
    slip = engine_speed - input_speed
    passed = (head[CONVERTER] * max(engine_speed, 0.0) + lock * closed * head[COUPLING]) * slip
    passed = min(max(passed, -head[COUPLING_LIMIT]), head[COUPLING_LIMIT])
    signals[ENGINE_RATE] = (torque - passed) / head[ENGINE_INERTIA]
    signals[ACCELERATOR], signals[ENGINE_SPEED], signals[ENGINE_TORQUE] = pedal, engine_speed, torque
    efficiency = head[EFFICIENCY] if passed > 0.0 else 1.0 / head[EFFICIENCY]
    return passed * ratio * efficiency / 2.0


@plain
def brake_torque(largest, pedal, bristle, spin):
    """Torque against the turning and the rate of the bristle: a friction that holds at standstill and slides beyond its limit."""
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


@plain
def contact(head, wheel, base, model, data, signals, road, r, origin, velocity, spin_world, angle, angle_rate, drive, pedal):
    """One wheel: its place and orientation, its slips, its forces and what they do to every freedom. Returns force and moment on the chassis."""
    length, v, ctrl, userdata = doubles(data.actuator_length), doubles(data.qvel), doubles(data.ctrl), doubles(data.userdata)
    side, tyre = wheel[SIDE], int(wheel[TYRE])
    travel, travel_rate = length[tyre], v[int(wheel[TRAVEL_FREEDOM])]
    state = doubles(data.act + types.uint64(8 * ints(model.actuator_actadr)[tyre]))
    kappa, tangent, bristle, pulled, pushed, twisted = state[0], state[1], state[2], state[3], state[4], state[5]

    # steering: the rack's angle for this wheel becomes the target of its spring
    steer, steer_rate = 0.0, 0.0
    if wheel[STEER_FREEDOM] >= 0.0:
        rack, rack_rate = angle / head[STEERING_RATIO], angle_rate / head[STEERING_RATIO]
        target = rack + side * wheel[ACKERMANN] * rack * rack
        actuator = int(wheel[STEERING])
        ctrl[actuator] = -target
        userdata[USERDATA_HEADER + actuator] = -rack_rate * (1.0 + 2.0 * side * wheel[ACKERMANN] * rack)
        steer, steer_rate = length[actuator], v[int(wheel[STEER_FREEDOM])]

    # look-up kinematics and compliance, as the left wheel sees them
    out, out_slope = looked_up(doubles(base + types.uint64(8 * int(wheel[LATERAL]))), travel)
    ahead, ahead_slope = looked_up(doubles(base + types.uint64(8 * int(wheel[LONGITUDINAL]))), travel)
    toe, toe_slope = looked_up_twice(base + types.uint64(8 * int(wheel[TOE])), travel, side * steer)
    camber, camber_slope = looked_up_twice(base + types.uint64(8 * int(wheel[CAMBER])), travel, side * steer)
    swing_slope = 0.0
    if wheel[SWING] != 0.0:
        _, swing_slope = looked_up(doubles(base + types.uint64(8 * int(wheel[SWING]))), travel)
    inwards = -side * pushed
    toe_elastic = (
        looked_up_if_any(base, wheel[TOE_LATERAL], inwards)
        + looked_up_if_any(base, wheel[TOE_LONGITUDINAL], pulled)
        + looked_up_if_any(base, wheel[TOE_ALIGNING], -side * twisted)
    )
    camber_elastic = looked_up_if_any(base, wheel[CAMBER_LATERAL], inwards)

    # contact point in body axes: the patch turns about the steering axis and moves along the tables
    sine, cosine = sine_cosine(steer)
    arm_x, arm_y = -wheel[TRAIL], side * wheel[SCRUB]
    lever_x, lever_y = cosine * arm_x - sine * arm_y, sine * arm_x + cosine * arm_y
    place_x = wheel[X] - arm_x + lever_x + ahead
    place_y = wheel[Y] - arm_y + lever_y + side * out
    hub = turned(r, (place_x, place_y, wheel[Z] + travel))
    hub = (hub[0] + origin[0], hub[1] + origin[1], hub[2] + origin[2])
    up = (r[2], r[5], r[8])
    lift, reach = ctrl[tyre], wheel[RADIUS]
    height, slope_x, slope_y, friction = 0.0, 0.0, 0.0, 1.0
    if road != types.uint64(0):
        height, slope_x, slope_y, friction = road_at(doubles(road), hub[0] - reach * up[0], hub[1] - reach * up[1])
    normal_size = 1.0 / math.sqrt(1.0 + slope_x * slope_x + slope_y * slope_y)
    normal = (-slope_x * normal_size, -slope_y * normal_size, normal_size)
    # distance from hub to road along the body's z: the road is the plane through the point looked at
    below = (hub[2] - height - lift - slope_x * reach * up[0] - slope_y * reach * up[1]) * normal_size
    loaded = below / dot(up, normal)
    arm = (place_x, place_y, wheel[Z] + travel - loaded)
    lever = turned(r, arm)
    point_velocity = cross(spin_world, lever)
    moving = turned(
        r,
        (
            ahead_slope * travel_rate - lever_y * steer_rate,
            side * out_slope * travel_rate + lever_x * steer_rate,
            travel_rate,
        ),
    )
    point_velocity = (
        velocity[0] + point_velocity[0] + moving[0],
        velocity[1] + point_velocity[1] + moving[1],
        velocity[2] + point_velocity[2] + moving[2],
    )

    # orientation of the wheel
    heading = steer - side * (toe + toe_elastic)
    lean = -side * (camber + camber_elastic)
    sine, cosine = sine_cosine(heading)
    lean_sine, lean_cosine = sine_cosine(lean)
    axis = (-sine * lean_cosine, cosine * lean_cosine, lean_sine)
    axis_world = turned(r, axis)
    forward = cross(axis_world, normal)
    size = 1.0 / math.sqrt(dot(forward, forward))
    forward = (forward[0] * size, forward[1] * size, forward[2] * size)
    leftward = cross(normal, forward)
    road_camber = math.asin(min(max(dot(axis_world, normal), -1.0), 1.0))

    # load, slips, forces
    pressed = wheel[RADIUS] - loaded
    press_rate = userdata[USERDATA_HEADER + tyre] * normal[2] - dot(point_velocity, normal)
    load = 0.0
    if pressed > 0.0:
        load = max(0.0, wheel[STIFFNESS] * pressed + wheel[DAMPING] * press_rate)
    rolling, lateral = dot(point_velocity, forward), dot(point_velocity, leftward)
    spin = v[int(wheel[SPIN_FREEDOM])]
    if head[RIG] == 0.0:
        slip, tangent_slip = kappa, tangent
        if abs(rolling) < SLOW:
            fade = 0.5 * (1.0 + math.cos(math.pi * rolling / SLOW)) * SLOW_SLIP
            slip -= fade * (rolling - spin * (wheel[RADIUS] - pressed / 3.0))
            tangent_slip += fade * lateral
        parameters = doubles(base + types.uint64(8 * int(wheel[TYRE_PARAMETERS])))
        contact_call(int(wheel[TYRE_LAW]), slip, tangent_slip, road_camber, load, rolling, lateral, friction, parameters, signals)
        rolling_radius = signals[ROLLING_RADIUS]
        sliding = rolling - spin * rolling_radius
        signals[KAPPA_RATE] = slip_rate(kappa, -sliding, rolling, signals[SIGMA_X], MOST_KAPPA)
        signals[TAN_RATE] = slip_rate(tangent, lateral, rolling, signals[SIGMA_Y], MOST_TAN_ALPHA)
        if abs(rolling) < SLOW and abs(sliding) < SLOW:
            settling = 0.5 * (1.0 + math.cos(math.pi * rolling / SLOW)) / HELD_TIME
            signals[KAPPA_RATE] -= settling * (kappa - min(max(kappa, -HELD_SLIP), HELD_SLIP))
            signals[TAN_RATE] -= settling * (tangent - min(max(tangent, -HELD_SLIP), HELD_SLIP))
        torque, signals[BRAKE_RATE] = brake_torque(wheel[BRAKE_TORQUE], pedal, bristle, spin)
    else:
        for i in range(8):
            signals[i] = 0.0
        signals[FX], signals[FY], signals[MZ] = (
            input_of(wheel, RIG_LONGITUDINAL, ctrl),
            input_of(wheel, RIG_LATERAL, ctrl),
            input_of(wheel, RIG_ALIGNING, ctrl),
        )
        rolling_radius, torque = 0.0, 5.0 * spin
        signals[KAPPA_RATE], signals[TAN_RATE], signals[BRAKE_RATE] = -100.0 * kappa, -100.0 * tangent, -100.0 * bristle
    signals[ELASTIC_X_RATE] = (signals[FX] - pulled) / BUSHING_TIME
    signals[ELASTIC_Y_RATE] = (signals[FY] - pushed) / BUSHING_TIME
    signals[ELASTIC_MOMENT_RATE] = (signals[MZ] - twisted) / BUSHING_TIME

    # generalised forces
    along, across = signals[FX], signals[FY]
    push = (
        along * forward[0] + across * leftward[0] + load * normal[0],
        along * forward[1] + across * leftward[1] + load * normal[1],
        along * forward[2] + across * leftward[2] + load * normal[2],
    )
    about_axis = signals[MY] - along * (rolling_radius - loaded)
    twist = (
        signals[MX] * forward[0] + about_axis * axis_world[0] + signals[MZ] * normal[0],
        signals[MX] * forward[1] + about_axis * axis_world[1] + signals[MZ] * normal[1],
        signals[MX] * forward[2] + about_axis * axis_world[2] + signals[MZ] * normal[2],
    )
    if head[RIG] != 0.0:
        twist = (signals[MZ] * normal[0], signals[MZ] * normal[1], signals[MZ] * normal[2])
    push_body, twist_body = turned_back(r, push), turned_back(r, twist)
    applied = doubles(data.qfrc_applied)
    driving = drive * wheel[DRIVE_SHARE]
    applied[int(wheel[TRAVEL_FREEDOM])] = (
        push_body[2]
        + push_body[0] * ahead_slope
        + push_body[1] * side * out_slope
        - side * (twist_body[0] * camber_slope + twist_body[2] * toe_slope)
        + driving * swing_slope
    )
    if wheel[STEER_FREEDOM] >= 0.0:
        applied[int(wheel[STEER_FREEDOM])] = lever_x * push_body[1] - lever_y * push_body[0] + twist_body[2]
    applied[int(wheel[SPIN_FREEDOM])] = driving - torque + signals[MY] - along * rolling_radius
    moment = cross(lever, push)

    signals[LOAD], signals[SLIP_RATIO], signals[SLIP_ANGLE] = load, kappa, math.atan(tangent)
    signals[ROAD_CAMBER], signals[STEER_ANGLE], signals[INCLINATION] = road_camber, heading, -side * lean
    signals[WHEEL_SPEED], signals[DRIVE_TORQUE], signals[BRAKING_TORQUE] = spin, driving, torque
    signals[ROAD_HEIGHT], signals[WHEEL_HEIGHT] = height + lift, hub[2] - wheel[DESIGN_HEIGHT]
    signals[CONTACT_X], signals[CONTACT_Y], signals[FRICTION] = place_x - wheel[X], place_y - wheel[Y], friction
    return push, (moment[0] + twist[0], moment[1] + twist[1], moment[2] + twist[2])


@plain
def is_car(model):
    """Whether a model's first custom numeric is the block of a car."""
    return model.nnumeric > 0 and doubles(model.numeric_data)[0] == CAR_MARK


@plain
def car_forces(model, data, road, path):
    """Write `qfrc_applied`, the targets of the steering springs and the signals; called at every stage after the inputs.

    Args:
        model, data: records of mjModel and mjData.
        road, path: addresses of `Road.block` and `Driver.block`, 0 where there is none.
    """
    if model.nuserdata < _SIGNALS + USERDATA_HEADER:
        return
    base = model.numeric_data
    head = doubles(base)
    signals_address = data.userdata + types.uint64(8 * (model.nuserdata - _SIGNALS))
    signals = doubles(signals_address)
    v, applied = doubles(data.qvel), doubles(data.qfrc_applied)
    rotation, places = doubles(data.xmat + types.uint64(72)), doubles(data.xpos + types.uint64(24))
    r = (
        rotation[0], rotation[1], rotation[2], rotation[3], rotation[4], rotation[5], rotation[6], rotation[7], rotation[8],
    )  # fmt: skip
    origin = (places[0], places[1], places[2])
    velocity, spin_body = (v[0], v[1], v[2]), (v[3], v[4], v[5])
    spin_world = turned(r, spin_body)
    level = math.sqrt(r[0] * r[0] + r[3] * r[3])
    speed = (velocity[0] * r[0] + velocity[1] * r[3]) / level
    signals[SPEED] = speed
    heading = math.atan2(r[3], r[0])
    angle, angle_rate = steering(head, model, data, signals, path, origin, heading, speed)

    wheels = base + types.uint64(8 * _HEAD_SIZE)
    wheel_signals = signals_address + types.uint64(8 * _CAR_SIGNALS)
    drive = 0.0
    if head[RIG] == 0.0:
        shaft, radius = 0.0, 0.0
        for i in range(4):
            wheel = doubles(wheels + types.uint64(8 * _WHEEL_SIZE * i))
            if wheel[DRIVE_SHARE] > 0.0:
                shaft += 0.5 * v[int(wheel[SPIN_FREEDOM])]
                radius = wheel[RADIUS]
        drive = power(head, base, model, data, signals, shaft * head[FINAL_DRIVE], radius, speed)

    total_x, total_y, total_z, moment_x, moment_y, moment_z = 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    for i in range(4):
        wheel = doubles(wheels + types.uint64(8 * _WHEEL_SIZE * i))
        own = doubles(wheel_signals + types.uint64(8 * _WHEEL_SIGNALS * i))
        push, twist = contact(
            head, wheel, base, model, data, own, road, r, origin, velocity, spin_world, angle, angle_rate, drive, signals[PEDAL]
        )  # fmt: skip
        total_x, total_y, total_z = total_x + push[0], total_y + push[1], total_z + push[2]
        moment_x, moment_y, moment_z = moment_x + twist[0], moment_y + twist[1], moment_z + twist[2]

    if head[RIG] == 0.0:
        force, moment = air(head, data, r, velocity)
        moment = (
            moment[0] - head[GROUND_Z] * force[1],
            moment[1] + head[GROUND_Z] * force[0] - head[AIR_X] * force[2],
            moment[2] + head[AIR_X] * force[1],
        )
        force = turned(r, force)
        total_x, total_y, total_z = total_x + force[0], total_y + force[1], total_z + force[2]
        turning = turned_back(r, (moment_x, moment_y, moment_z))
        turning = (turning[0] + moment[0], turning[1] + moment[1], turning[2] + moment[2])
    else:
        ctrl = doubles(data.ctrl)
        k, d = head[RIG_STIFFNESS], head[RIG_DAMPING]
        total_x += -k * (origin[0] - head[DESIGN_X]) - d * velocity[0]
        total_y += -k * (origin[1] - head[DESIGN_Y]) - d * velocity[1]
        total_z += -k * (origin[2] - head[DESIGN_Z] - input_of(head, HEAVE_TARGET, ctrl)) - d * velocity[2]
        roll, pitch = math.atan2(r[7], r[8]), -math.asin(min(max(r[6], -1.0), 1.0))
        turning = turned_back(r, (moment_x, moment_y, moment_z))
        turning = (
            turning[0] - head[RIG_RATE_X] * (roll - input_of(head, ROLL_TARGET, ctrl)) - head[RIG_DAMPING_X] * spin_body[0],
            turning[1] - head[RIG_RATE_Y] * (pitch - input_of(head, PITCH_TARGET, ctrl)) - head[RIG_DAMPING_Y] * spin_body[1],
            turning[2] - head[RIG_RATE_Z] * heading - head[RIG_DAMPING_Z] * spin_body[2],
        )
    applied[0], applied[1], applied[2] = total_x, total_y, total_z
    applied[3], applied[4], applied[5] = turning


@plain
def car_state_rates(model, data, actuator):
    """Write `act_dot` of an actuator of the car that has inner states, from the signals; returns the first."""
    base = model.numeric_data
    head = doubles(base)
    first = ints(model.actuator_actadr)[actuator]
    if model.nuserdata < _SIGNALS + USERDATA_HEADER or first < 0:
        return 0.0
    signals_address = data.userdata + types.uint64(8 * (model.nuserdata - _SIGNALS))
    signals, rates = doubles(signals_address), doubles(data.act_dot)
    if actuator == int(head[DRIVER]):
        return signals[DRIVER_RATE]
    if actuator == int(head[SPEED_TARGET]):
        return signals[CONTROL_RATE]
    if actuator == int(head[ENGINE]):
        return signals[ENGINE_RATE]
    for i in range(4):
        wheel = doubles(base + types.uint64(8 * (_HEAD_SIZE + _WHEEL_SIZE * i)))
        if actuator == int(wheel[TYRE]):
            own = _CAR_SIGNALS + _WHEEL_SIGNALS * i + KAPPA_RATE
            for state in range(WHEEL_STATES):
                rates[first + state] = signals[own + state]
            return rates[first]
    return 0.0
