"""One wheel of the compiled car: where it is and how it stands, what its tyre does, and what that does to every
freedom."""

from __future__ import annotations

import math

from numba import types

from ..elements.law import USERDATA_HEADER
from .driving import brake_torque, input_of
from .laws import contact_call
from .lookup import both_between, both_looked_up, looked_up, place_of
from .memory import doubles, ints, plain
from .places import (
    ACKERMANN,
    ANGLES,
    BRAKE_RATE,
    BRAKE_TORQUE,
    BRAKING_TORQUE,
    CONTACT_X,
    CONTACT_Y,
    DAMPING,
    DESIGN_HEIGHT,
    DRIVE_SHARE,
    DRIVE_TORQUE,
    ELASTIC_ALIGNING,
    ELASTIC_LATERAL,
    ELASTIC_LONGITUDINAL,
    ELASTIC_MOMENT_RATE,
    ELASTIC_X_RATE,
    ELASTIC_Y_RATE,
    FRICTION,
    FX,
    FY,
    INCLINATION,
    KAPPA_RATE,
    LOAD,
    MX,
    MY,
    MZ,
    PATH,
    RADIUS,
    RIG,
    RIG_ALIGNING,
    RIG_LATERAL,
    RIG_LONGITUDINAL,
    ROAD_CAMBER,
    ROAD_HEIGHT,
    ROLLING_RADIUS,
    SCRUB,
    SIDE,
    SIGMA_X,
    SIGMA_Y,
    SLIP_ANGLE,
    SLIP_RATIO,
    SPIN_FREEDOM,
    STATE_BRAKE,
    STATE_FX,
    STATE_FY,
    STATE_KAPPA,
    STATE_MZ,
    STATE_TAN,
    STEER_ANGLE,
    STEER_FREEDOM,
    STEERING,
    STEERING_RATIO,
    STIFFNESS,
    SWING,
    TAN_RATE,
    TRAIL,
    TRAVEL_FREEDOM,
    TYRE,
    TYRE_LAW,
    TYRE_PARAMETERS,
    WHEEL_HEIGHT,
    WHEEL_SPEED,
    X,
    Y,
    Z,
)
from .surroundings import road_at
from .vectors import arc_sine, combined, cross, dot, sine_cosine, turned, turned_back

MOST_KAPPA, MOST_TAN_ALPHA = 1.5, 3.0
"""Largest slips that sliding leads to, at standstill too."""
SLOW = 2.5
"""Below this rolling speed [m/s] the slips' rates add to the forces, a damping without which a standing car would sway
for ever."""
SLOW_SLIP = 0.07
"""Slip per sliding speed [s/m] that is added at standstill: 0.02 s over a relaxation length of 0.3 m."""
HELD_SLIP, HELD_TIME = 0.08, 0.05
"""Coming to rest, a tyre that slid is wound up as far as its friction carries and no further: slips beyond the first
fade within the second [s]. As a spring of the relaxation length a slip of 1 would throw the car back by half a
metre."""
SMALLEST_RELAXATION, SMALLEST_TIME = 0.05, 7e-4
"""Relaxation length [m] and time [s] of a tyre that hardly touches the road, however fast it slips: what steps of 1 ms
integrate."""
SLIDING_SLIP = 0.15
"""Slip s_c at which the relaxation length has halved, about that of the largest force."""
BUSHING_TIME = 0.005
"""Time constant [s] of the elastic suspension's answer to forces."""


@plain
def slip_rate(slip, sliding, rolling, relaxation, largest):
    """As `elements.tyres.slip.slip_rate`, for large slips and for a wheel that spins in the air too.

    The relaxation length falls as ``sigma/(1 + (s/s_c)²)``, with the slope of the force over the slip: a tyre that
    slides is wound up no further than its friction carries, and a locked wheel that grips again does not spring back.
    """
    speed = max(abs(rolling), abs(sliding) / largest)
    length = relaxation / (1.0 + slip * slip / (SLIDING_SLIP * SLIDING_SLIP))
    return (sliding - speed * slip) / max(length, SMALLEST_RELAXATION, speed * SMALLEST_TIME)


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
    """Path of the contact patch and slopes, toe and camber with compliance and their slopes, swing and slope, as for
    the left wheel."""
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
    """Normal of the road below a hub, distance from hub to road along the body's z axis, height and friction of the
    road.

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
    """Forces of the tyre from its lagged slips, rates of its states, and the brake; returns brake torque and rolling
    radius.

    The wheel turns with `spin` against the body; the brake rubs on the carrier, which turns with `swinging`.
    """
    kappa, tangent = state[STATE_KAPPA], state[STATE_TAN]
    slip, tangent_slip = kappa, tangent
    if abs(rolling) < SLOW:
        fade = 0.5 * (1.0 + math.cos(math.pi * rolling / SLOW)) * SLOW_SLIP
        slip -= fade * (rolling - spin * (wheel[RADIUS] - pressed / 3.0))
        tangent_slip += fade * lateral
    parameters = doubles(place_of(base, wheel[TYRE_PARAMETERS]))
    contact_call(
        int(wheel[TYRE_LAW]), slip, tangent_slip, camber, load, rolling, lateral, friction, parameters, signals
    )
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
    """Forces of the rig in place of the tyre's; the slips fade, and the wheel is held. Returns torque and rolling
    radius."""
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
def wheel_forces(  # noqa: PLR0915
    head, wheel, base, model, data, signals, road, r, origin, velocity, spin_world, angle, angle_rate, drive, pedal
):
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

    # the contact patch in body axes: it turns about the steering axis and lies below the wheel's centre, which moves
    # along its path; the path of the patch itself is that of a wheel held by its carrier, which swings about the
    # lateral axis
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
    own = (
        centre_slope * travel_rate - lever_y * steer_rate,
        side * out_slope * travel_rate + lever_x * steer_rate,
        travel_rate,
    )
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
            wheel, base, state, signals, road_camber, load, rolling, lateral, spin, swing_slope * travel_rate,
            friction, pressed, pedal
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
        - side
        * ((heading_cosine * twist_body[0] + heading_sine * twist_body[1]) * camber_slope + twist_body[2] * toe_slope)
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
