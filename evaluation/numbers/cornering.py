"""Numbers of steady and slowly tightened turns: the largest lateral acceleration, self-steering, roll, load transfer.

Gradients are slopes of straight lines between 1 and 4 m/s²; values "at 4 m/s²" are those at which the lateral
acceleration first gets there. Angles count from the straight running at the beginning. The turn's side does not matter:
everything is positive in the direction of the turn.
"""

from __future__ import annotations

import math

import numpy as np

from susp_mj.names import AXLES
from susp_mj.run import Run

from .number import Answer, Measure, no_question
from .runs import DRIVES, facts, known, recorded
from .turns import FIT, TIGHTENED, followed, load_transfer, stations_of, tightening

_LEAST = 0.5  # m/s²; less is no turn


def lateral_acceleration_max(run: Run) -> Answer:
    """Largest lateral acceleration of the centre of gravity, to either side [m/s²], without sign."""
    acceleration = np.abs(run["lateral_acceleration"][: followed(run)])
    at = int(np.argmax(acceleration))
    if acceleration[at] < _LEAST:
        return no_question("does not turn")
    return Answer(float(acceleration[at]), f"at {run.time[at]:.2f} s, {run['speed'][at] * 3.6:.0f} km/h")


def understeer_gradient(run: Run) -> Answer:
    """Understeer gradient, positive for understeer [rad/(m/s²)]: ``EG = d(delta_H/i - l a_y/v²)/d(a_y)``.

    delta_H steering wheel angle, i steering ratio, l wheelbase: the steering beyond that of slip-free geometry. On a
    circle of constant radius ``l a_y/v² = l/R`` does not change. The slope holds between 1 and 4 m/s².

    Source: ISO 4138:2012; ISO 8855:2011, 5.3.5.
    """
    turning, wheelbase, ratio = tightening(run), facts(run)["wheelbase"], facts(run)["steering_ratio"]
    steering = turning.side * (run["steering_wheel_angle"] - run["steering_wheel_angle"][0])
    speed = np.maximum(turning.part(run["speed"]), 0.1)
    value = turning.gradient(turning.part(steering) / ratio - wheelbase * turning.acceleration / speed**2)
    return Answer(value, _fitted(value))


def characteristic_speed(run: Run) -> Answer:
    """Characteristic speed of an understeering car [m/s]: ``sqrt(l/EG)``, at which the yaw gain is largest.

    An oversteering car has a critical speed instead, and no value here.

    Source: M. Mitschke, H. Wallentowitz, Dynamik der Kraftfahrzeuge.
    """
    gradient, wheelbase = understeer_gradient(run), facts(run)["wheelbase"]
    if gradient.value is None:
        return gradient
    if gradient.value <= 0:
        critical = (
            "" if gradient.value == 0 else f": critical speed {3.6 * (wheelbase / -gradient.value) ** 0.5:.0f} km/h"
        )
        return Answer(None, f"oversteers{critical}" if gradient.value < 0 else "neutral")
    value = (wheelbase / gradient.value) ** 0.5
    return Answer(value, f"{3.6 * value:.0f} km/h")


def steering_wheel_angle_at_4(run: Run) -> Answer:
    """Steering wheel angle at a lateral acceleration of 4 m/s² [rad]."""
    return _at(run, "steering_wheel_angle", 4.0)


def steering_wheel_angle_at_7(run: Run) -> Answer:
    """Steering wheel angle at a lateral acceleration of 7 m/s² [rad]."""
    return _at(run, "steering_wheel_angle", 7.0)


def roll_angle_at_4(run: Run) -> Answer:
    """Roll out of the turn at a lateral acceleration of 4 m/s² [rad]."""
    return _at(run, "roll_angle", 4.0)


def roll_angle_at_7(run: Run) -> Answer:
    """Roll out of the turn at a lateral acceleration of 7 m/s² [rad]."""
    return _at(run, "roll_angle", 7.0)


def suspension_roll_at_4(run: Run) -> Answer:
    """Roll of the body against its wheels at a lateral acceleration of 4 m/s² [rad]: mean over the axles of ``(z_o -
    z_i)/t``.

    z_o and z_i are the deflections of the outer and the inner suspension, t is the track.
    """
    return _suspension_roll_at(run, 4.0)


def suspension_roll_at_7(run: Run) -> Answer:
    """Roll of the body against its wheels at a lateral acceleration of 7 m/s² [rad]: mean over the axles of ``(z_o -
    z_i)/t``.

    z_o and z_i are the deflections of the outer and the inner suspension, t is the track.
    """
    return _suspension_roll_at(run, 7.0)


def _suspension_roll_at(run: Run, acceleration: float) -> Answer:
    turning, rolls = tightening(run), []
    for axle in AXLES:
        left, right = (run[f"{station}_suspension_deflection"] for station in stations_of(axle))
        roll = turning.side * (right - left) / facts(run)[f"track_{axle}"]
        rolls.append(turning.at(turning.part(roll - roll[0]), acceleration))
    front, rear = rolls
    if front is None or rear is None:
        return Answer(None, f"does not reach {acceleration:g} m/s²")
    return Answer((front + rear) / 2, f"{math.degrees(front):.2f}° front, {math.degrees(rear):.2f}° rear")


def side_slip_gradient(run: Run) -> Answer:
    """Side slip angle per lateral acceleration at the centre of gravity [rad/(m/s²)]: ``SG = d(l_r a_y/v² -
    beta)/d(a_y)``.

    ``l_r a_y/v²`` is the angle of slip-free rolling, l_r the distance of the centre of gravity from the rear axle.
    Positive: the car points into the turn, ``SG`` being the slip angle of the rear axle. The slope holds between 1 and
    4 m/s².

    Source: ISO 4138:2012.
    """
    turning, behind = tightening(run), facts(run)["wheelbase"] - abs(facts(run)["cg_x"])
    slip = turning.side * (run["side_slip_angle"] - run["side_slip_angle"][0])
    speed = np.maximum(turning.part(run["speed"]), 0.1)
    value = turning.gradient(behind * turning.acceleration / speed**2 - turning.part(slip))
    return Answer(value, _fitted(value))


def rear_side_slip_max(run: Run) -> Answer:
    """Largest side slip angle at the rear axle, to either side [rad], without sign."""
    slip = np.where(run["speed"] > 2.0, np.abs(run["rear_side_slip_angle"]), 0.0)[: followed(run)]
    if np.abs(run["lateral_acceleration"]).max() < _LEAST:
        return no_question("does not turn")
    at = int(np.argmax(slip))
    return Answer(float(slip[at]), f"at {run.time[at]:.2f} s")


def load_transfer_share_at_4(run: Run) -> Answer:
    """Front axle's share of the lateral load transfer at 4 m/s²."""
    return _share_at(run, 4.0)


def load_transfer_share_at_7(run: Run) -> Answer:
    """Front axle's share of the lateral load transfer at 7 m/s²."""
    return _share_at(run, 7.0)


def _share_at(run: Run, acceleration: float) -> Answer:
    turning = tightening(run)
    front, rear = (turning.at(turning.part(load_transfer(run, axle)), acceleration) for axle in ("front", "rear"))
    if front is None or rear is None:
        return Answer(None, f"does not reach {acceleration:g} m/s²")
    return Answer(front / (front + rear), f"{front:.0f} N front, {rear:.0f} N rear")


def _at(run: Run, channel: str, acceleration: float) -> Answer:
    turning = tightening(run)
    value = turning.at(turning.part(turning.side * (run[channel] - run[channel][0])), acceleration)
    return Answer(value, f"does not reach {acceleration:g} m/s²" if value is None else "")


def _fitted(value: float | None) -> str:
    return f"does not reach {FIT[1]:g} m/s²" if value is None else f"between {FIT[0]:g} and {FIT[1]:g} m/s²"


DEFLECTIONS = known("track_front", "track_rear") & recorded("suspension_deflection")
NUMBERS = (
    Measure(lateral_acceleration_max, "m/s²", DRIVES),
    Measure(understeer_gradient, "rad/(m/s²)", TIGHTENED & known("wheelbase", "steering_ratio")),
    Measure(characteristic_speed, "m/s", TIGHTENED & known("wheelbase", "steering_ratio")),
    Measure(steering_wheel_angle_at_4, "rad", TIGHTENED),
    Measure(steering_wheel_angle_at_7, "rad", TIGHTENED),
    Measure(roll_angle_at_4, "rad", TIGHTENED),
    Measure(roll_angle_at_7, "rad", TIGHTENED),
    Measure(suspension_roll_at_4, "rad", TIGHTENED & DEFLECTIONS),
    Measure(suspension_roll_at_7, "rad", TIGHTENED & DEFLECTIONS),
    Measure(side_slip_gradient, "rad/(m/s²)", TIGHTENED & known("wheelbase", "cg_x")),
    Measure(rear_side_slip_max, "rad", DRIVES),
    Measure(load_transfer_share_at_4, "1", TIGHTENED),
    Measure(load_transfer_share_at_7, "1", TIGHTENED),
)
