"""Names that models, manoeuvres and evaluation share: corners, axles, and the quantities of channels.

Corner order is front left, front right, rear left, rear right. A channel's full name is its station and its quantity,
e.g. ``fl_wheel_load``; a model with one wheel drops the station: ``wheel_load``.
"""

from __future__ import annotations

from collections.abc import Collection

CORNERS = ("fl", "fr", "rl", "rr")
AXLES = ("front", "rear")

# quantity -> (unit, frame, what it is)
QUANTITIES: dict[str, tuple[str, str, str]] = {
    "body_displacement": ("m", "inertial, z up", "height of the body's centre of gravity above its design position"),
    "body_velocity": ("m/s", "inertial, z up", "vertical velocity of the body's centre of gravity"),
    "body_acceleration": ("m/s²", "inertial, z up", "vertical acceleration of the body's centre of gravity"),
    "pitch_angle": ("rad", "ISO 8855", "pitch of the body from its design position, positive nose down"),
    "pitch_rate": ("rad/s", "ISO 8855", "rate of the pitch angle"),
    "pitch_acceleration": ("rad/s²", "ISO 8855", "second rate of the pitch angle"),
    "roll_angle": ("rad", "ISO 8855", "roll of the body from its design position, positive left side up"),
    "roll_rate": ("rad/s", "ISO 8855", "rate of the roll angle"),
    "roll_acceleration": ("rad/s²", "ISO 8855", "second rate of the roll angle"),
    "seat_acceleration": ("m/s²", "inertial, z up", "vertical acceleration at the driver's seat"),
    "rig_moment": ("N m", "ISO 8855", "moment by which the rig holds the body at its roll angle"),
    "lateral_acceleration": (
        "m/s²",
        "ISO 8855, y left",
        "lateral acceleration of the body's centre of gravity, positive in a left turn",
    ),
    "longitudinal_acceleration": (
        "m/s²",
        "ISO 8855, x forward",
        "longitudinal acceleration of the body's centre of gravity",
    ),
    "roll_target": ("rad", "ISO 8855", "roll angle that the rig prescribes"),
    "wheel_displacement": ("m", "inertial, z up", "height of the wheel centre above its design position"),
    "wheel_acceleration": ("m/s²", "inertial, z up", "vertical acceleration of the wheel centre"),
    "suspension_deflection": ("m", "wheel to body", "wheel travel from the design position, positive in compression"),
    "suspension_speed": ("m/s", "wheel to body", "rate of the suspension deflection, positive in compression"),
    "spring_force": ("N", "wheel to body", "spring, positive when it pushes wheel and body apart"),
    "stop_force": ("N", "wheel to body", "hard stop, positive at the compression stop, negative at the rebound stop"),
    "damper_force": ("N", "wheel to body", "damper with its mount and friction, positive in compression"),
    "friction_force": ("N", "wheel to body", "linkage friction, positive in compression"),
    "bar_force": ("N", "wheel to body", "anti-roll bar, positive when it pushes wheel and body apart"),
    "wheel_load": ("N", "inertial, z up", "vertical force of the road on the tyre"),
    "road_height": ("m", "inertial, z up", "height of the road under the wheel"),
    "excitation_phase": ("rad", "", "phase of the sine sweep"),
    "excitation_frequency": ("Hz", "", "momentary frequency of the sine sweep"),
    "road_speed": ("m/s", "inertial, z up", "rate of the road height under the wheel"),
    # what a handling car is driven with
    "steering_wheel_angle": ("rad", "driver's view", "angle of the steering wheel, positive for a left turn"),
    "speed_target": ("m/s", "", "speed that the speed controller holds"),
    "speed_control": ("1", "", "share with which the speed controller acts, 1 on and 0 off"),
    "accelerator": ("1", "", "accelerator pedal, 0 released to 1 floored"),
    "brake_pedal": ("1", "", "brake pedal, 0 released to 1 full"),
    "wind_x": ("m/s", "inertial, x", "wind velocity along the inertial x axis"),
    "wind_y": ("m/s", "inertial, y", "wind velocity along the inertial y axis"),
    "heave_target": ("m", "inertial, z up", "height above the design position that the rig prescribes for the body"),
    "pitch_target": ("rad", "ISO 8855", "pitch angle that the rig prescribes, positive nose down"),
    # motion of a handling car
    "position_x": ("m", "inertial", "x of the body's centre of gravity"),
    "position_y": ("m", "inertial", "y of the body's centre of gravity"),
    "yaw_angle": ("rad", "ISO 8855", "heading of the body, positive to the left, counted on beyond a full turn"),
    "yaw_rate": ("rad/s", "ISO 8855", "rate of the yaw angle, positive to the left"),
    "speed": ("m/s", "horizontal", "horizontal speed of the body's centre of gravity"),
    "longitudinal_velocity": (
        "m/s",
        "horizontal, heading",
        "velocity of the body's centre of gravity along its heading",
    ),
    "lateral_velocity": (
        "m/s",
        "horizontal, heading, y left",
        "velocity of the body's centre of gravity across its heading",
    ),
    "side_slip_angle": ("rad", "ISO 8855", "side slip angle of the body's centre of gravity, atan2(v_y, v_x)"),
    "rear_side_slip_angle": ("rad", "ISO 8855", "side slip angle at the middle of the rear axle, on the ground"),
    "engine_speed": ("rad/s", "", "speed of the engine"),
    "engine_torque": ("N m", "", "torque of the engine, positive when it drives"),
    "gear": ("1", "", "gear engaged"),
    "path_deviation": (
        "m",
        "y left",
        "deviation of the centre of gravity from the driver's path, positive to the left",
    ),
    # wheels of a handling car
    "longitudinal_force": ("N", "wheel axes, x forward", "longitudinal force of the road, or of the rig, on the tyre"),
    "lateral_force": ("N", "wheel axes, y left", "lateral force of the road, or of the rig, on the tyre"),
    "aligning_moment": ("N m", "wheel axes, z up", "aligning moment of the road, or of the rig, on the tyre"),
    "overturning_moment": ("N m", "wheel axes, x forward", "overturning moment of the road on the tyre"),
    "slip_ratio": ("1", "wheel axes", "longitudinal slip, positive when the wheel drives, after the tyre's lag"),
    "slip_angle": (
        "rad",
        "wheel axes, ISO-W",
        "slip angle, positive when the wheel drifts to the left, after the tyre's lag",
    ),
    "camber_angle": ("rad", "wheel to road, ISO-W", "camber, positive when the wheel leans to the right"),
    "steer_angle": ("rad", "wheel to body", "angle of the wheel plane from the body's x axis, positive to the left"),
    "inclination_angle": ("rad", "wheel to body", "lean of the wheel against the body, positive with its top outwards"),
    "wheel_speed": ("rad/s", "", "speed of the wheel about its axis"),
    "drive_torque": ("N m", "", "torque that drives the wheel"),
    "brake_torque": ("N m", "", "torque of the wheel's brake"),
    "contact_x": ("m", "body, x forward", "movement of the contact patch along the body from the design position"),
    "contact_y": ("m", "body, y left", "movement of the contact patch across the body from the design position"),
}


def axle_of(station: str) -> str:
    """Axle of a wheel or an axle by its name; empty if the station does not say.

    >>> axle_of("fl"), axle_of("rear"), axle_of("")
    ('front', 'rear', '')
    """
    return station if station in AXLES else next((axle for axle in AXLES if station in wheels_of(axle)), "")


def wheels_of(axle: str) -> tuple[str, ...]:
    """Left and right wheel of an axle."""
    return tuple(corner for corner in CORNERS if corner[0] == axle[0])


def stand_ins(station: str, offered: Collection[str]) -> tuple[str, ...]:
    """The stations whose mean stands for one: itself, its axle, both its wheels, or the one for all (``""``).

    >>> stand_ins("fl", ("front", "rear")), stand_ins("rear", ("rl", "rr")), stand_ins("fl", ("rl", "rr"))
    (('front',), ('rl', 'rr'), ())
    """
    axle = axle_of(station)
    pair = wheels_of(axle) if station in AXLES else ()
    for group in ((station,), (axle,) if axle else (), pair, ("",)):
        if group and all(each in offered for each in group):
            return group
    return ()


def channel_name(station: str, quantity: str) -> str:
    """Full name of a channel: ``fl_wheel_load``, or ``wheel_load`` where there is one station only."""
    return f"{station}_{quantity}" if station else quantity
