"""Numbers of a run: ride, comfort, attitude, handling, kinematics, frequency response."""

from __future__ import annotations

from collections.abc import Sequence

from susp_mj.errors import InputError, choices
from susp_mj.run import Run

from . import (
    attitude,
    braking,
    comfort,
    cornering,
    course,
    frequency,
    kinematics,
    ride,
    steering_frequency,
    transient,
    wheel_lift,
)
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
HANDLING: tuple[Evaluate, ...] = (
    cornering.lateral_acceleration_max,
    cornering.understeer_gradient,
    cornering.characteristic_speed,
    cornering.steering_wheel_angle_at_4,
    cornering.steering_wheel_angle_at_7,
    cornering.roll_angle_at_4,
    cornering.roll_angle_at_7,
    cornering.side_slip_gradient,
    cornering.rear_side_slip_max,
    cornering.load_transfer_share_at_4,
    cornering.load_transfer_share_at_7,
    wheel_lift.wheel_lift_time,
    wheel_lift.wheel_lift_instant,
    wheel_lift.wheel_lift_acceleration,
    wheel_lift.inner_wheel_load_front,
    wheel_lift.inner_wheel_load_rear,
    transient.yaw_rate_response_time,
    transient.lateral_acceleration_response_time,
    transient.roll_angle_response_time,
    transient.yaw_rate_peak_response_time,
    transient.yaw_rate_overshoot,
    transient.lateral_acceleration_overshoot,
    transient.roll_angle_overshoot,
    transient.tb_factor,
    transient.yaw_rate_gain,
    transient.lateral_acceleration_gain,
    transient.roll_angle_gain,
    transient.side_slip_angle_steady,
    steering_frequency.yaw_rate_gain_peak,
    steering_frequency.yaw_rate_peak_frequency,
    steering_frequency.yaw_rate_phase,
    steering_frequency.yaw_rate_delay,
    steering_frequency.lateral_acceleration_gain_peak,
    steering_frequency.lateral_acceleration_phase,
    steering_frequency.lateral_acceleration_delay,
    steering_frequency.roll_angle_gain_peak,
    steering_frequency.roll_angle_peak_frequency,
    steering_frequency.side_slip_gain_peak,
    steering_frequency.side_slip_peak_frequency,
    steering_frequency.rear_side_slip_gain_peak,
    braking.braking_deceleration,
    braking.stopping_distance,
    braking.braking_load_share_front,
    braking.wheel_lock_time,
    braking.braking_yaw_deviation,
    braking.braking_lateral_deviation,
    braking.braking_yaw_ratio,
    braking.acceleration_time_100,
    braking.acceleration_distance_100,
    braking.longitudinal_acceleration_max,
    course.lateral_drift_1s,
    course.lateral_drift_2s,
    course.disturbance_yaw_rate_max,
    course.disturbance_steering_max,
    course.path_deviation_max,
    course.cones_hit,
    course.lane_departure,
    course.lane_entry_speed,
    course.lane_exit_speed,
    ride.travel_left_compression_front,
    ride.travel_left_compression_rear,
    ride.travel_left_rebound_front,
    ride.travel_left_rebound_rear,
)
KINEMATICS: tuple[Evaluate, ...] = (
    kinematics.bump_steer_front,
    kinematics.bump_steer_rear,
    kinematics.bump_camber_front,
    kinematics.bump_camber_rear,
    kinematics.wheel_rate_front,
    kinematics.wheel_rate_rear,
    kinematics.roll_centre_height_front,
    kinematics.roll_centre_height_rear,
    kinematics.path_angle_front,
    kinematics.path_angle_rear,
    kinematics.roll_steer_front,
    kinematics.roll_steer_rear,
    kinematics.roll_camber_front,
    kinematics.roll_camber_rear,
    kinematics.roll_stiffness_front,
    kinematics.roll_stiffness_rear,
    kinematics.steering_ratio,
    kinematics.lateral_force_steer_front,
    kinematics.lateral_force_steer_rear,
    kinematics.lateral_force_camber_front,
    kinematics.lateral_force_camber_rear,
    kinematics.longitudinal_force_steer_front,
    kinematics.longitudinal_force_steer_rear,
    kinematics.aligning_moment_steer_front,
    kinematics.aligning_moment_steer_rear,
)
NUMBERS: dict[str, Evaluate] = {
    function.__name__: function for function in (*HANDLING, *KINEMATICS, *RIDE, *COMFORT, *ATTITUDE, *FREQUENCY)
}


def evaluate(run: Run, names: Sequence[str]) -> dict[str, Number]:
    """Evaluation numbers of a run, by name.

    Raises:
        InputError: an unknown number.
    """
    for name in names:
        if name not in NUMBERS:
            raise InputError(f"no evaluation number '{name}'; {choices(NUMBERS, name)}", key="numbers")
    return {name: NUMBERS[name](run) for name in names}


__all__ = [
    "ATTITUDE",
    "COMFORT",
    "FREQUENCY",
    "HANDLING",
    "KINEMATICS",
    "NUMBERS",
    "RIDE",
    "Criterion",
    "Number",
    "evaluate",
]
