"""What a run means: numbers, criteria, plots, animation, report."""

from __future__ import annotations

from . import attitude, comfort, frequency, ride
from .number import Criterion, Evaluate, Number

RIDE: tuple[Evaluate, ...] = (
    ride.body_acceleration_max,
    ride.body_acceleration_min,
    ride.body_acceleration_rms,
    ride.body_displacement_max,
    ride.overshoot,
    ride.settling_time,
    ride.wheel_load_min,
    ride.wheel_load_max,
    ride.wheel_load_rms,
    ride.contact_loss_time,
    ride.contact_loss_instant,
    ride.travel_compression,
    ride.travel_rebound,
    ride.travel_left_compression,
    ride.travel_left_rebound,
    ride.stop_hits,
)
FREQUENCY: tuple[Evaluate, ...] = (
    frequency.body_resonance,
    frequency.body_amplification,
    frequency.body_acceleration_amplification,
    frequency.suspension_amplification,
    frequency.wheel_resonance,
    frequency.wheel_load_amplification,
    frequency.pitch_amplification,
    frequency.roll_amplification,
)
COMFORT: tuple[Evaluate, ...] = (
    comfort.weighted_acceleration,
    comfort.weighted_seat_acceleration,
    comfort.vibration_dose_value,
    comfort.maximum_transient_vibration,
)
ATTITUDE: tuple[Evaluate, ...] = (
    attitude.pitch_angle_max,
    attitude.pitch_angle_min,
    attitude.roll_angle_max,
    attitude.roll_angle_final,
    attitude.roll_gradient,
    attitude.load_share_front,
    attitude.load_transfer_front,
    attitude.load_transfer_rear,
    attitude.load_transfer_share,
    attitude.anti_roll_bar_front,
    attitude.anti_roll_bar_rear,
)
NUMBERS: dict[str, Evaluate] = {function.__name__: function for function in (*RIDE, *COMFORT, *ATTITUDE, *FREQUENCY)}

__all__ = ["ATTITUDE", "COMFORT", "FREQUENCY", "NUMBERS", "RIDE", "Criterion", "Number"]
