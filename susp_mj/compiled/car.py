"""The car that drives freely, compiled: tyres, wheel paths, steering, power train, brakes, air and driver at every stage.

Everything acts as generalised forces in mjData's `qfrc_applied`: ``Q = J' F`` with the exact Jacobian of the wheel's path, so
roll centres, anti-dive and anti-squat are the virtual work of the tyre's forces, and power is accounted for. The chassis is body 1
with a free joint; names of the numbers are in `elements.car`. See docs/theory.md, "The car that drives freely".
"""

from __future__ import annotations

import math

from numba import types

from ..elements.car import CAR_MARK, CAR_SIGNALS, CRUISE_ABOVE, CRUISE_DOWN, HEAD, SIGNALS, WHEEL, WHEEL_SIGNALS, WHEEL_STATES
from ..elements.law import USERDATA_HEADER
from .laws import contact_call
from .memory import doubles, ints, plain
from .surroundings import deviation, road_at, wanted_angle

# fmt: off
(
    MARK, LENGTH, FREEDOMS, RIG, STEERING_WHEEL, DRIVER, SPEED_TARGET, SPEED_CONTROL, ENGINE, BRAKE, WIND_X, WIND_Y, HEAVE_TARGET,
    ROLL_TARGET, PITCH_TARGET, STEERING_RATIO, STEERING_LIMIT, WHEELBASE, REAR_AXLE_X, GROUND_Z, CONTROL_GAIN, CONTROL_INTEGRAL,
    AIR_PRESSURE, DRAG, LIFT_FRONT, LIFT_REAR, SIDE_FORCE, YAW_MOMENT, AIR_X, DRIVEN_REAR, ENGINE_INERTIA, IDLE_SPEED, IDLE_GAIN,
    IDLE_TORQUE, COUPLING, CONVERTER, COUPLING_LIMIT, FINAL_DRIVE, EFFICIENCY, SHIFT_UP, SHIFT_DOWN, SHIFT_TIME, ENGINE_LIMIT,
    GEARS, GEAR_1,
) = range(HEAD.index("gear_1") + 1)
(
    FULL_TORQUE, DRAG_TORQUE, DESIGN_X, DESIGN_Y, DESIGN_Z, RIG_STIFFNESS, RIG_DAMPING, RIG_RATE_X, RIG_RATE_Y, RIG_RATE_Z,
    RIG_DAMPING_X, RIG_DAMPING_Y, RIG_DAMPING_Z,
) = (HEAD.index(name) for name in HEAD[HEAD.index("full_torque") :])
(
    SIDE, REAR, X, Y, Z, TRAVEL_FREEDOM, STEER_FREEDOM, SPIN_FREEDOM, TYRE, STEERING, ACKERMANN, TRAIL, SCRUB, DRIVE_SHARE,
    BRAKE_TORQUE, TYRE_LAW, TYRE_PARAMETERS, RADIUS, STIFFNESS, DAMPING, DESIGN_HEIGHT, PATH, ANGLES, SWING, ELASTIC_LATERAL,
    ELASTIC_LONGITUDINAL, ELASTIC_ALIGNING, RIG_LONGITUDINAL, RIG_LATERAL, RIG_ALIGNING,
) = range(len(WHEEL))
(
    GEAR, SHIFT_BEGAN, TRIM_ANGLE, TRIMMING, DRIVER_RATE, CONTROL_RATE, ENGINE_RATE, WHEEL_ANGLE, ACCELERATOR, PEDAL, ENGINE_SPEED,
    ENGINE_TORQUE, PATH_DEVIATION, CONTROL_FORCE, SPEED,
) = range(len(CAR_SIGNALS))
(
    FX, FY, MX, MY, MZ, SIGMA_X, SIGMA_Y, ROLLING_RADIUS, LOAD, SLIP_RATIO, SLIP_ANGLE, ROAD_CAMBER, STEER_ANGLE, INCLINATION,
    WHEEL_SPEED, DRIVE_TORQUE, BRAKING_TORQUE, ROAD_HEIGHT, WHEEL_HEIGHT, CONTACT_X, CONTACT_Y, FRICTION, KAPPA_RATE, TAN_RATE,
    BRAKE_RATE, ELASTIC_X_RATE, ELASTIC_Y_RATE, ELASTIC_MOMENT_RATE,
) = range(len(WHEEL_SIGNALS))
# fmt: on
STATE_KAPPA, STATE_TAN, STATE_BRAKE, STATE_FX, STATE_FY, STATE_MZ = range(WHEEL_STATES)
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
SMALLEST_RELAXATION, SMALLEST_TIME = 0.05, 7e-4
"""Relaxation length [m] and time [s] of a tyre that hardly touches the road, however fast it slips: what steps of 1 ms integrate."""
BUSHING_TIME = 0.005
"""Time constant [s] of the elastic suspension's answer to forces."""
BRISTLE, BRISTLE_TIME, BRISTLE_DAMPING = 0.02, 1e-3, 2e-3
"""Wind-up of a brake that holds [rad], its shortest time [s] when sliding fast, and its damping time when it holds [s]."""
HOLD_PEDAL = 0.3
"""Brake pedal with which the speed controller holds the car where its target is zero."""
PARKED = 0.01
LIMITER_WIDTH = 0.03
"""The limiter takes the torque away while the engine's speed exceeds the map's last by this share."""
OVERTURNED = 0.35
"""Cosine of the body's tilt beyond which the car has fallen over."""
WIND_UP = 1.2
"""The controller stops integrating where it asks for this share of what the engine gives."""


@plain
def combined(a, u, b, v, c, w):
    """Sum of three vectors times numbers."""
    return (a * u[0] + b * v[0] + c * w[0], a * u[1] + b * v[1] + c * w[1], a * u[2] + b * v[2] + c * w[2])


@plain
def cross(a, b):
    """Vector product."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


@plain
def dot(a, b):
    """Scalar product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@plain
def sine_cosine(angle):
    """Sine and cosine; the angles of wheels are small, where seven terms of the series are exact and quicker."""
    if abs(angle) > 0.35:
        return math.sin(angle), math.cos(angle)
    s = angle * angle
    sine = 1.0 - s / 42.0 * (1.0 - s / 72.0 * (1.0 - s / 110.0 * (1.0 - s / 156.0)))
    cosine = 1.0 - s / 56.0 * (1.0 - s / 90.0 * (1.0 - s / 132.0 * (1.0 - s / 182.0)))
    sine = angle * (1.0 - s / 6.0 * (1.0 - s / 20.0 * sine))
    cosine = 1.0 - s / 2.0 * (1.0 - s / 12.0 * (1.0 - s / 30.0 * cosine))
    return sine, cosine


@plain
def arc_sine(x):
    """Arc sine; for the small leans of wheels by its series."""
    if abs(x) > 0.15:
        return math.asin(min(max(x, -1.0), 1.0))
    s = x * x
    high = 35.0 / 1152.0 + s * (63.0 / 2816.0 + s * (231.0 / 13312.0))
    return x * (1.0 + s * (1.0 / 6.0 + s * (3.0 / 40.0 + s * (5.0 / 112.0 + s * high))))


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
def cubic(v0, m0, v1, m1, u):
    """Value and slope of the cubic from v0 to v1 with slopes m0 and m1 at a share u of the way; straight on beyond it."""
    if u < 0.0:
        return v0 + m0 * u, m0
    if u > 1.0:
        return v1 + m1 * (u - 1.0), m1
    rise = v1 - v0
    c, d = 3.0 * rise - 2.0 * m0 - m1, m0 + m1 - 2.0 * rise
    return v0 + u * (m0 + u * (c + u * d)), m0 + u * (2.0 * c + 3.0 * u * d)


@plain
def looked_up(table, x):
    """Value and slope of a table with one curve."""
    place = (x - table[0]) * table[1]
    i = min(max(int(place), 0), int(table[2]) - 2)
    at = 3 + 2 * i
    value, slope = cubic(table[at], table[at + 1], table[at + 2], table[at + 3], place - i)
    return value, slope * table[1]


@plain
def both_looked_up(table, x):
    """Values and slopes of a table with two curves."""
    place = (x - table[0]) * table[1]
    i = min(max(int(place), 0), int(table[2]) - 2)
    at, u = 3 + 4 * i, place - i
    first, first_slope = cubic(table[at], table[at + 1], table[at + 4], table[at + 5], u)
    second, second_slope = cubic(table[at + 2], table[at + 3], table[at + 6], table[at + 7], u)
    return first, first_slope * table[1], second, second_slope * table[1]


@plain
def both_between(address, x, s):
    """As `both_looked_up`, of tables for even values of s; linear between them, held outside."""
    head = doubles(address)
    rows, stride = int(head[2]), int(head[3])
    first = address + types.uint64(32)
    if rows == 1:
        return both_looked_up(doubles(first), x)
    place = min(max((s - head[0]) * head[1], 0.0), rows - 1.0)
    j = min(int(place), rows - 2)
    share = place - j
    v, m, w, n = both_looked_up(doubles(first + types.uint64(8 * stride * j)), x)
    v1, m1, w1, n1 = both_looked_up(doubles(first + types.uint64(8 * stride * (j + 1))), x)
    return v + share * (v1 - v), m + share * (m1 - m), w + share * (w1 - w), n + share * (n1 - n)


@plain
def place_of(base, number):
    """Address of what lies at a place in the block."""
    return base + types.uint64(8 * int(number))


@plain
def slip_rate(slip, sliding, rolling, relaxation, largest):
    """As `elements.tyres.slip.slip_rate`, for a wheel that spins in the air too."""
    speed = max(abs(rolling), abs(sliding) / largest)
    return (sliding - speed * slip) / max(relaxation, SMALLEST_RELAXATION, speed * SMALLEST_TIME)


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

    The speed is that of wheels which roll: neither a locked wheel nor a spinning one shifts the box. With the speed controller
    in charge the gear is held as long as the engine can turn in it, so that no shift disturbs a manoeuvre.
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
    gear = shifted_gear(head, signals, time, abs(speed) / rolling_radius * head[FINAL_DRIVE], weight > 0.0)
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
def steered(head, wheel, data, angle, angle_rate):
    """Angle and rate of a wheel about its steering axis; what the rack gives it becomes the target of its spring."""
    if wheel[STEER_FREEDOM] < 0.0:
        return 0.0, 0.0
    actuator = int(wheel[STEERING])
    rack, rack_rate = angle / head[STEERING_RATIO], angle_rate / head[STEERING_RATIO]
    bend = wheel[SIDE] * wheel[ACKERMANN]
    doubles(data.ctrl)[actuator] = -rack - bend * rack * rack
    doubles(data.userdata)[USERDATA_HEADER + actuator] = -rack_rate * (1.0 + 2.0 * bend * rack)
    return doubles(data.actuator_length)[actuator], doubles(data.qvel)[int(wheel[STEER_FREEDOM])]


@plain
def guided(wheel, base, state, travel, steer):
    """Path of the contact patch and slopes, toe and camber with compliance and their slopes, swing and slope, as for the left wheel."""
    side = wheel[SIDE]
    out, out_slope, ahead, ahead_slope = both_looked_up(doubles(place_of(base, wheel[PATH])), travel)
    toe, toe_slope, camber, camber_slope = both_between(place_of(base, wheel[ANGLES]), travel, side * steer)
    swing, swing_slope = 0.0, 0.0
    if wheel[SWING] != 0.0:
        swing, swing_slope = looked_up(doubles(place_of(base, wheel[SWING])), travel)
    if wheel[ELASTIC_LATERAL] != 0.0:
        more, _, lean, _ = both_looked_up(doubles(place_of(base, wheel[ELASTIC_LATERAL])), -side * state[STATE_FY])
        toe, camber = toe + more, camber + lean
    if wheel[ELASTIC_LONGITUDINAL] != 0.0:
        more, _ = looked_up(doubles(place_of(base, wheel[ELASTIC_LONGITUDINAL])), state[STATE_FX])
        toe += more
    if wheel[ELASTIC_ALIGNING] != 0.0:
        more, _ = looked_up(doubles(place_of(base, wheel[ELASTIC_ALIGNING])), -side * state[STATE_MZ])
        toe += more
    return out, out_slope, ahead, ahead_slope, toe, toe_slope, camber, camber_slope, swing, swing_slope


@plain
def standing_on(wheel, road, r, hub, lift):
    """Normal of the road below a hub, distance from hub to road along the body's z axis, height and friction of the road.

    The road is the plane that touches it where an unloaded wheel would.
    """
    reach = wheel[RADIUS]
    if road == types.uint64(0):
        return (0.0, 0.0, 1.0), (hub[2] - lift) / r[8], lift, 1.0
    x, y = -reach * r[2], -reach * r[5]
    height, slope_x, slope_y, friction = road_at(doubles(road), hub[0] + x, hub[1] + y)
    size = 1.0 / math.sqrt(1.0 + slope_x * slope_x + slope_y * slope_y)
    normal = (-slope_x * size, -slope_y * size, size)
    distance = (hub[2] - height - lift + slope_x * x + slope_y * y) * size
    return normal, distance / dot((r[2], r[5], r[8]), normal), height + lift, friction


@plain
def oriented(r, sine, cosine, lean, normal):
    """Axis of a wheel, its forward and leftward directions in the road's plane, and its camber to the road.

    Args:
        sine, cosine: of the wheel's heading in the body.
    """
    lean_sine, lean_cosine = sine_cosine(lean)
    axis = turned(r, (-sine * lean_cosine, cosine * lean_cosine, lean_sine))
    forward = cross(axis, normal)
    size = 1.0 / math.sqrt(dot(forward, forward))
    forward = (forward[0] * size, forward[1] * size, forward[2] * size)
    return axis, forward, cross(normal, forward), arc_sine(dot(axis, normal))


@plain
def gripping(wheel, base, state, signals, camber, load, rolling, lateral, spin, swinging, friction, pressed, pedal):
    """Forces of the tyre from its lagged slips, rates of its states, and the brake; returns brake torque and rolling radius.

    The wheel turns with `spin` against the body; the brake rubs on the carrier, which turns with `swinging`.
    """
    kappa, tangent = state[STATE_KAPPA], state[STATE_TAN]
    slip, tangent_slip = kappa, tangent
    if abs(rolling) < SLOW:
        fade = 0.5 * (1.0 + math.cos(math.pi * rolling / SLOW)) * SLOW_SLIP
        slip -= fade * (rolling - spin * (wheel[RADIUS] - pressed / 3.0))
        tangent_slip += fade * lateral
    parameters = doubles(place_of(base, wheel[TYRE_PARAMETERS]))
    contact_call(int(wheel[TYRE_LAW]), slip, tangent_slip, camber, load, rolling, lateral, friction, parameters, signals)
    sliding = rolling - spin * signals[ROLLING_RADIUS]
    kappa_rate = slip_rate(kappa, -sliding, rolling, signals[SIGMA_X], MOST_KAPPA)
    tangent_rate = slip_rate(tangent, lateral, rolling, signals[SIGMA_Y], MOST_TAN_ALPHA)
    if abs(rolling) < SLOW and abs(sliding) < SLOW:
        settling = 0.5 * (1.0 + math.cos(math.pi * rolling / SLOW)) / HELD_TIME
        kappa_rate -= settling * (kappa - min(max(kappa, -HELD_SLIP), HELD_SLIP))
        tangent_rate -= settling * (tangent - min(max(tangent, -HELD_SLIP), HELD_SLIP))
    torque, signals[BRAKE_RATE] = brake_torque(wheel[BRAKE_TORQUE], pedal, state[STATE_BRAKE], spin - swinging)
    signals[KAPPA_RATE], signals[TAN_RATE] = kappa_rate, tangent_rate
    return torque, signals[ROLLING_RADIUS]


@plain
def pushed_by_rig(wheel, data, state, signals, spin):
    """Forces of the rig in place of the tyre's; the slips fade, and the wheel is held. Returns torque and rolling radius."""
    ctrl = doubles(data.ctrl)
    for i in range(FX, ROLLING_RADIUS + 1):
        signals[i] = 0.0
    signals[FX], signals[FY], signals[MZ] = (
        input_of(wheel, RIG_LONGITUDINAL, ctrl),
        input_of(wheel, RIG_LATERAL, ctrl),
        input_of(wheel, RIG_ALIGNING, ctrl),
    )
    signals[KAPPA_RATE], signals[TAN_RATE] = -100.0 * state[STATE_KAPPA], -100.0 * state[STATE_TAN]
    signals[BRAKE_RATE] = -100.0 * state[STATE_BRAKE]
    return 5.0 * spin, 0.0


@plain
def wheel_forces(head, wheel, base, model, data, signals, road, r, origin, velocity, spin_world, angle, angle_rate, drive, pedal):  # noqa: PLR0915
    """One wheel: where it is and how it stands, what the tyre does, and what that does to every freedom of the car.

    Returns force [N] and moment [N m] about the chassis' origin, in inertial axes.
    """
    v, applied = doubles(data.qvel), doubles(data.qfrc_applied)
    side, tyre = wheel[SIDE], int(wheel[TYRE])
    state = doubles(data.act + types.uint64(8 * ints(model.actuator_actadr)[tyre]))
    travel, travel_rate = doubles(data.actuator_length)[tyre], v[int(wheel[TRAVEL_FREEDOM])]
    spin = v[int(wheel[SPIN_FREEDOM])]
    steer, steer_rate = steered(head, wheel, data, angle, angle_rate)
    out, out_slope, ahead, ahead_slope, toe, toe_slope, camber, camber_slope, swing, swing_slope = guided(
        wheel, base, state, travel, steer
    )  # fmt: skip

    # the contact patch in body axes: it turns about the steering axis and lies below the wheel's centre, which moves along its path;
    # the path of the patch itself is that of a wheel held by its carrier, which swings about the lateral axis
    sine, cosine = sine_cosine(steer)
    arm_x, arm_y = -wheel[TRAIL], side * wheel[SCRUB]
    lever_x, lever_y = cosine * arm_x - sine * arm_y, sine * arm_x + cosine * arm_y
    patch_x, patch_y = lever_x - arm_x + ahead, lever_y - arm_y + side * out
    place = (wheel[X] + patch_x + wheel[DESIGN_HEIGHT] * swing, wheel[Y] + patch_y, wheel[Z] + travel)
    centre_slope = ahead_slope + wheel[DESIGN_HEIGHT] * swing_slope
    hub = turned(r, place)
    hub = (hub[0] + origin[0], hub[1] + origin[1], hub[2] + origin[2])
    normal, loaded, height, friction = standing_on(wheel, road, r, hub, doubles(data.ctrl)[tyre])
    lever = turned(r, (place[0], place[1], place[2] - loaded))
    own = (centre_slope * travel_rate - lever_y * steer_rate, side * out_slope * travel_rate + lever_x * steer_rate, travel_rate)
    own, swept = turned(r, own), cross(spin_world, lever)
    moving = (velocity[0] + swept[0] + own[0], velocity[1] + swept[1] + own[1], velocity[2] + swept[2] + own[2])

    heading, lean = steer - side * toe, -side * camber
    heading_sine, heading_cosine = sine_cosine(heading)
    axis, forward, leftward, road_camber = oriented(r, heading_sine, heading_cosine, lean, normal)
    pressed = wheel[RADIUS] - loaded
    press_rate = doubles(data.userdata)[USERDATA_HEADER + tyre] * normal[2] - dot(moving, normal)
    load = 0.0
    if pressed > 0.0:
        load = max(0.0, wheel[STIFFNESS] * pressed + wheel[DAMPING] * press_rate)
    rolling, lateral = dot(moving, forward), dot(moving, leftward)
    if head[RIG] == 0.0:
        torque, rolling_radius = gripping(
            wheel, base, state, signals, road_camber, load, rolling, lateral, spin, swing_slope * travel_rate, friction, pressed, pedal
        )  # fmt: skip
        on_carrier = torque
        about_axis = signals[MY] - signals[FX] * (rolling_radius - loaded)
    else:
        torque, rolling_radius = pushed_by_rig(wheel, data, state, signals, spin)
        on_carrier = -signals[FX] * wheel[DESIGN_HEIGHT]  # the wheel is held by its brake
        about_axis = 0.0
    signals[ELASTIC_X_RATE] = (signals[FX] - state[STATE_FX]) / BUSHING_TIME
    signals[ELASTIC_Y_RATE] = (signals[FY] - state[STATE_FY]) / BUSHING_TIME
    signals[ELASTIC_MOMENT_RATE] = (signals[MZ] - state[STATE_MZ]) / BUSHING_TIME

    # generalised forces
    push = combined(signals[FX], forward, signals[FY], leftward, load, normal)
    twist = combined(signals[MX], forward, about_axis, axis, signals[MZ], normal)
    push_body, twist_body = turned_back(r, push), turned_back(r, twist)
    driving = drive * wheel[DRIVE_SHARE]
    applied[int(wheel[TRAVEL_FREEDOM])] = (
        push_body[2]
        + push_body[0] * centre_slope
        + push_body[1] * side * out_slope
        - side * ((heading_cosine * twist_body[0] + heading_sine * twist_body[1]) * camber_slope + twist_body[2] * toe_slope)
        + on_carrier * swing_slope
    )
    if wheel[STEER_FREEDOM] >= 0.0:
        applied[int(wheel[STEER_FREEDOM])] = lever_x * push_body[1] - lever_y * push_body[0] + twist_body[2]
    applied[int(wheel[SPIN_FREEDOM])] = driving - torque + signals[MY] - signals[FX] * rolling_radius
    moment = cross(lever, push)

    signals[LOAD], signals[SLIP_RATIO], signals[SLIP_ANGLE] = load, state[STATE_KAPPA], state[STATE_TAN]
    signals[ROAD_CAMBER], signals[STEER_ANGLE], signals[INCLINATION] = road_camber, heading, camber
    signals[WHEEL_SPEED], signals[DRIVE_TORQUE], signals[BRAKING_TORQUE] = spin, driving, torque
    signals[ROAD_HEIGHT], signals[WHEEL_HEIGHT] = height, hub[2] - wheel[DESIGN_HEIGHT]
    signals[CONTACT_X], signals[CONTACT_Y], signals[FRICTION] = patch_x, patch_y, friction
    return push, (moment[0] + twist[0], moment[1] + twist[1], moment[2] + twist[2])


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
    """Write `qfrc_applied`, the targets of the steering springs and the signals; called at every stage after the inputs.

    Args:
        model, data: records of mjModel and mjData.
        road, path: addresses of `Road.block` and `Driver.block`, 0 where there is none.
    """
    if model.nuserdata < _SIGNALS + USERDATA_HEADER:
        return
    base = model.numeric_data
    head, wheels = doubles(base), base + types.uint64(8 * _HEAD_SIZE)
    signals_address = data.userdata + types.uint64(8 * (model.nuserdata - _SIGNALS))
    signals, wheel_signals = doubles(signals_address), signals_address + types.uint64(8 * _CAR_SIGNALS)
    v, applied = doubles(data.qvel), doubles(data.qfrc_applied)
    rows, places = doubles(data.xmat + types.uint64(72)), doubles(data.xpos + types.uint64(24))
    r = (rows[0], rows[1], rows[2], rows[3], rows[4], rows[5], rows[6], rows[7], rows[8])
    origin, velocity, spin = (places[0], places[1], places[2]), (v[0], v[1], v[2]), (v[3], v[4], v[5])
    spin_world = turned(r, spin)
    speed = math.copysign(math.sqrt(velocity[0] * velocity[0] + velocity[1] * velocity[1]), velocity[0] * r[0] + velocity[1] * r[3])
    signals[SPEED] = speed
    angle, angle_rate = steering(head, model, data, signals, path, origin, math.atan2(r[3], r[0]), speed)
    drive = 0.0
    if head[RIG] == 0.0:
        shaft, radius = 0.0, 0.0
        for i in range(4):
            wheel = doubles(wheels + types.uint64(8 * _WHEEL_SIZE * i))
            if wheel[DRIVE_SHARE] > 0.0:
                shaft += 0.5 * v[int(wheel[SPIN_FREEDOM])]
                radius = wheel[RADIUS]
        drive = power(head, base, model, data, signals, shaft * head[FINAL_DRIVE], radius, speed)

    force, moment = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    for i in range(4):
        wheel = doubles(wheels + types.uint64(8 * _WHEEL_SIZE * i))
        own = doubles(wheel_signals + types.uint64(8 * _WHEEL_SIGNALS * i))
        push, twist = wheel_forces(
            head, wheel, base, model, data, own, road, r, origin, velocity, spin_world, angle, angle_rate, drive, signals[PEDAL]
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
