"""One wheel of the compiled car: where it is and how it stands, what its tyre does, and what that does to every
freedom."""

from __future__ import annotations

import math
from typing import NamedTuple

from numba import types

from ... import roads
from ...elements import steering as steering_laws
from ...elements.law import USERDATA_HEADER
from ...elements.tyres import slip as slip_laws
from ...elements.tyres.slip import MOST_KAPPA, MOST_TAN_ALPHA, SLOW
from ..laws import brake_of, contact_of
from ..memory import doubles, ints, plain, usable
from .lookup import both_between, both_looked_up, looked_up
from .records import input_of, place_of, wheel_state_at
from .vectors import arc_sine, combined, cross, dot, sine_cosine, turned, turned_back

BUSHING_TIME = 0.005
"""Time constant [s] of the elastic suspension's answer to forces."""
RIG_FADING = 100.0
"""Rate [1/s] at which slips and brakes fade on the rig, where no tyre slips."""
RIG_DRAG = 5.0
"""Moment per speed [N m s/rad] that holds a wheel on the rig."""

usable(roads._row)
surface_at = usable(roads.surface_at)
rack_angle = usable(steering_laws.rack_angle)
usable(slip_laws._slowness)
slip_rate, damped_slip, fading = (usable(law) for law in (slip_laws.slip_rate, slip_laws.damped_slip, slip_laws.fading))


class Guidance(NamedTuple):
    """How a wheel is guided at its travel, as for the left one: place of the contact patch, angles, each with its slope
    over the travel; the swing is the carrier's about the lateral axis."""

    out: float
    out_slope: float
    ahead: float
    ahead_slope: float
    toe: float
    toe_slope: float
    camber: float
    camber_slope: float
    swing: float
    swing_slope: float


class Patch(NamedTuple):
    """Contact patch in body axes: place below which the wheel stands, lever about the steering axis, way from the
    design position, velocity against the body, and slope of the wheel centre's path."""

    place: tuple[float, float, float]
    lever: tuple[float, float]
    moved: tuple[float, float]
    velocity: tuple[float, float, float]
    centre_slope: float


class Standing(NamedTuple):
    """How a wheel stands on the road: normal, distance of the hub along the body's z axis, height and friction."""

    normal: tuple[float, float, float]
    loaded: float
    height: float
    friction: float


@plain
def steered(head, wheel, data, command):
    """Angle and rate of a wheel about its steering axis; what the rack gives it becomes the target of its spring."""
    if wheel.steer_freedom < 0.0:
        return 0.0, 0.0
    actuator = int(wheel.steering)
    target, rate = rack_angle(command.angle, command.rate, head.steering_ratio, wheel.side * wheel.ackermann)
    doubles(data.ctrl)[actuator] = -target
    doubles(data.userdata)[USERDATA_HEADER + actuator] = -rate
    return doubles(data.actuator_length)[actuator], doubles(data.qvel)[int(wheel.steer_freedom)]


@plain
def guided(wheel, base, state, travel, steer):
    """Kinematics at a travel and steer angle, and what the forces add to toe and camber."""
    side = wheel.side
    out, out_slope, ahead, ahead_slope = both_looked_up(place_of(base, wheel.path), travel)
    angles = base + types.uint64(8 * int(wheel.angles))
    toe, toe_slope, camber, camber_slope = both_between(angles, travel, side * steer)
    swing, swing_slope = 0.0, 0.0
    if wheel.swing != 0.0:
        swing, swing_slope = looked_up(place_of(base, wheel.swing), travel)
    if wheel.elastic_lateral != 0.0:
        more, _, lean, _ = both_looked_up(place_of(base, wheel.elastic_lateral), -side * state.elastic_y)
        toe, camber = toe + more, camber + lean
    if wheel.elastic_longitudinal != 0.0:
        more, _ = looked_up(place_of(base, wheel.elastic_longitudinal), state.elastic_x)
        toe += more
    if wheel.elastic_aligning != 0.0:
        more, _ = looked_up(place_of(base, wheel.elastic_aligning), -side * state.elastic_moment)
        toe += more
    return Guidance(out, out_slope, ahead, ahead_slope, toe, toe_slope, camber, camber_slope, swing, swing_slope)


@plain
def placed(wheel, path, travel, travel_rate, steer, steer_rate):
    """The contact patch: it turns about the steering axis and lies below the wheel's centre, which moves along its
    path; the path of the patch itself is that of a wheel held by its carrier, which swings about the lateral axis."""
    side, height = wheel.side, wheel.design_height
    sine, cosine = sine_cosine(steer)
    arm_x, arm_y = -wheel.trail, side * wheel.scrub
    lever_x, lever_y = cosine * arm_x - sine * arm_y, sine * arm_x + cosine * arm_y
    moved_x, moved_y = lever_x - arm_x + path.ahead, lever_y - arm_y + side * path.out
    place = (wheel.x + moved_x + height * path.swing, wheel.y + moved_y, wheel.z + travel)
    centre_slope = path.ahead_slope + height * path.swing_slope
    velocity = (
        centre_slope * travel_rate - lever_y * steer_rate,
        side * path.out_slope * travel_rate + lever_x * steer_rate,
        travel_rate,
    )
    return Patch(place, (lever_x, lever_y), (moved_x, moved_y), velocity, centre_slope)


@plain
def standing_on(wheel, road, r, hub, lift):
    """How a wheel stands below a hub; the road is the plane that touches it where an unloaded wheel would."""
    reach = wheel.radius
    if road == types.uint64(0):
        return Standing((0.0, 0.0, 1.0), (hub[2] - lift) / r[8], lift, 1.0)
    x, y = -reach * r[2], -reach * r[5]
    height, slope_x, slope_y, friction = surface_at(doubles(road), hub[0] + x, hub[1] + y)
    size = 1.0 / math.sqrt(1.0 + slope_x * slope_x + slope_y * slope_y)
    normal = (-slope_x * size, -slope_y * size, size)
    distance = (hub[2] - height - lift + slope_x * x + slope_y * y) * size
    return Standing(normal, distance / dot((r[2], r[5], r[8]), normal), height + lift, friction)


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
def gripping(wheel, base, state, own, camber, rolling, lateral, spin, pressed):
    """Forces of the tyre from its lagged slips, and the slips' rates.

    Args:
        own: signals of the wheel, with load and friction; the rest is written.
        spin: of the wheel against the body.
    """
    slipping = -(rolling - spin * (wheel.radius - pressed / 3.0))
    fx, fy, mx, my, mz, sigma_x, sigma_y, rolling_radius = contact_of(
        int(wheel.tyre_law),
        damped_slip(state.kappa, slipping, rolling),
        damped_slip(state.tan_alpha, lateral, rolling),
        camber,
        own.wheel_load,
        rolling,
        lateral,
        own.friction,
        place_of(base, wheel.tyre_parameters),
    )
    own.longitudinal_force, own.lateral_force, own.relaxation_x, own.relaxation_y = fx, fy, sigma_x, sigma_y
    own.overturning_moment, own.rolling_moment, own.aligning_moment = mx, my, mz
    own.rolling_radius = rolling_radius
    sliding = rolling - spin * rolling_radius
    kappa_rate = slip_rate(state.kappa, -sliding, rolling, sigma_x, MOST_KAPPA)
    tangent_rate = slip_rate(state.tan_alpha, lateral, rolling, sigma_y, MOST_TAN_ALPHA)
    if abs(sliding) < SLOW:
        kappa_rate += fading(state.kappa, rolling)
        tangent_rate += fading(state.tan_alpha, rolling)
    own.slip_ratio_rate, own.slip_rate = kappa_rate, tangent_rate


@plain
def pushed_by_rig(wheel, data, state, own):
    """Forces of the rig in place of the tyre's; the slips fade."""
    ctrl = doubles(data.ctrl)
    own.longitudinal_force = input_of(wheel.rig_longitudinal, ctrl)
    own.lateral_force = input_of(wheel.rig_lateral, ctrl)
    own.aligning_moment = input_of(wheel.rig_aligning, ctrl)
    own.overturning_moment, own.rolling_moment = 0.0, 0.0
    own.relaxation_x, own.relaxation_y, own.rolling_radius = 0.0, 0.0, 0.0
    own.slip_ratio_rate, own.slip_rate = -RIG_FADING * state.kappa, -RIG_FADING * state.tan_alpha
    own.brake_rate = -RIG_FADING * state.bristle


@plain
def elastic_rates(state, own):
    """Forces as the elastic suspension feels them, a little later."""
    own.elastic_x_rate = (own.longitudinal_force - state.elastic_x) / BUSHING_TIME
    own.elastic_y_rate = (own.lateral_force - state.elastic_y) / BUSHING_TIME
    own.elastic_moment_rate = (own.aligning_moment - state.elastic_moment) / BUSHING_TIME


@plain
def wheel_forces(head, wheel, own, model, data, road, pose, command):
    """One wheel: where it is and how it stands, what the tyre does, and what that does to every freedom of the car.

    Args:
        own: signals of the wheel, written here.
        road: address of `Road.block`, or 0.

    Returns force [N] and moment [N m] about the chassis' origin, in inertial axes.
    """
    v, base, r, side, tyre = doubles(data.qvel), model.numeric_data, pose.rotation, wheel.side, int(wheel.tyre)
    state = wheel_state_at(data.act + types.uint64(8 * ints(model.actuator_actadr)[tyre]))
    travel, travel_rate = doubles(data.actuator_length)[tyre], v[int(wheel.travel_freedom)]
    spin = v[int(wheel.spin_freedom)]
    steer, steer_rate = steered(head, wheel, data, command)
    path = guided(wheel, base, state, travel, steer)
    patch = placed(wheel, path, travel, travel_rate, steer, steer_rate)
    place, hub = patch.place, turned(r, patch.place)
    hub = (hub[0] + pose.origin[0], hub[1] + pose.origin[1], hub[2] + pose.origin[2])
    normal, loaded, own.road_height, own.friction = standing_on(wheel, road, r, hub, doubles(data.ctrl)[tyre])
    lever = turned(r, (place[0], place[1], place[2] - loaded))
    moving, swept, against = pose.velocity, cross(pose.turning, lever), turned(r, patch.velocity)
    moving = (
        moving[0] + swept[0] + against[0],
        moving[1] + swept[1] + against[1],
        moving[2] + swept[2] + against[2],
    )

    heading, lean = steer - side * path.toe, -side * path.camber
    sine, cosine = sine_cosine(heading)
    axis, forward, leftward, own.camber_angle = oriented(r, sine, cosine, lean, normal)
    pressed = wheel.radius - loaded
    press_rate = doubles(data.userdata)[USERDATA_HEADER + tyre] * normal[2] - dot(moving, normal)
    own.wheel_load = max(0.0, wheel.stiffness * pressed + wheel.damping * press_rate) if pressed > 0.0 else 0.0
    if head.rig == 0.0:
        rolling, lateral = dot(moving, forward), dot(moving, leftward)
        gripping(wheel, base, state, own, own.camber_angle, rolling, lateral, spin, pressed)
        rubbing, brake = spin - path.swing_slope * travel_rate, place_of(base, head.brake_parameters)
        torque, own.brake_rate = brake_of(
            int(head.brake_law), command.pedal, state.bristle, rubbing, wheel.front, brake
        )
        on_carrier = torque
        about_axis = own.rolling_moment - own.longitudinal_force * (own.rolling_radius - loaded)
    else:
        pushed_by_rig(wheel, data, state, own)
        torque, about_axis = RIG_DRAG * spin, 0.0
        on_carrier = -own.longitudinal_force * wheel.design_height  # the wheel is held by its brake
    elastic_rates(state, own)
    own.slip_ratio, own.slip_angle, own.wheel_speed = state.kappa, state.tan_alpha, spin
    own.steer_angle, own.inclination_angle = heading, path.camber
    own.drive_torque, own.brake_torque = command.drive * wheel.drive_share, torque
    own.wheel_displacement = hub[2] - wheel.design_height
    own.contact_x, own.contact_y = patch.moved

    # generalised forces
    push = combined(own.longitudinal_force, forward, own.lateral_force, leftward, own.wheel_load, normal)
    twist = combined(own.overturning_moment, forward, about_axis, axis, own.aligning_moment, normal)
    push_body, twist_body = turned_back(r, push), turned_back(r, twist)
    applied = doubles(data.qfrc_applied)
    applied[int(wheel.travel_freedom)] = (
        push_body[2]
        + push_body[0] * patch.centre_slope
        + push_body[1] * side * path.out_slope
        - side * ((cosine * twist_body[0] + sine * twist_body[1]) * path.camber_slope + twist_body[2] * path.toe_slope)
        + on_carrier * path.swing_slope
    )
    if wheel.steer_freedom >= 0.0:
        lever_x, lever_y = patch.lever
        applied[int(wheel.steer_freedom)] = lever_x * push_body[1] - lever_y * push_body[0] + twist_body[2]
    turned_by = own.drive_torque - torque + own.rolling_moment
    applied[int(wheel.spin_freedom)] = turned_by - own.longitudinal_force * own.rolling_radius
    moment = cross(lever, push)
    return push, (moment[0] + twist[0], moment[1] + twist[1], moment[2] + twist[2])


@plain
def wheel_state_rates(own):
    """Rates of a wheel's inner states, in the order of `WHEEL_STATE`."""
    return (
        own.slip_ratio_rate,
        own.slip_rate,
        own.brake_rate,
        own.elastic_x_rate,
        own.elastic_y_rate,
        own.elastic_moment_rate,
    )
