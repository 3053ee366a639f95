"""Names that models, manoeuvres and evaluation share: corners, axles, and the quantities of channels.

Corner order is front left, front right, rear left, rear right. A channel's full name is its station and its quantity,
e.g. ``fl_wheel_load``; a model with one wheel drops the station: ``wheel_load``.
"""

from __future__ import annotations

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
    "lateral_acceleration": ("m/s²", "ISO 8855, y left", "lateral acceleration of the sprung mass, positive in a left turn"),
    "longitudinal_acceleration": ("m/s²", "ISO 8855, x forward", "longitudinal acceleration of the sprung mass"),
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
}


def channel_name(station: str, quantity: str) -> str:
    """Full name of a channel: ``fl_wheel_load``, or ``wheel_load`` where there is one station only."""
    return f"{station}_{quantity}" if station else quantity
