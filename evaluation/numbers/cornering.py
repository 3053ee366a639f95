"""Numbers of steady and slowly tightened turns: the largest lateral acceleration, self-steering, roll, load transfer.

Gradients are slopes of straight lines between 1 and 4 m/s²; values "at 4 m/s²" are those at which the lateral
acceleration first gets there. Angles count from the straight running at the beginning. The turn's side does not matter:
everything is positive in the direction of the turn.
"""

from __future__ import annotations

import numpy as np

from susp_mj.run import Run

from .number import Number
from .turns import FIT, SLOWLY_TIGHTENED, drives, fact, followed, load_transfer, missing, tightening

_LEAST = 0.5  # m/s²; less is no turn


def lateral_acceleration_max(run: Run) -> Number:
    """Largest lateral acceleration of the centre of gravity, to either side [m/s²], without sign."""
    if not drives(run):
        return missing("m/s²", "the car does not drive freely")
    acceleration = np.abs(run["lateral_acceleration"][: followed(run)])
    at = int(np.argmax(acceleration))
    if acceleration[at] < _LEAST:
        return missing("m/s²", "does not turn")
    return Number(float(acceleration[at]), "m/s²", f"at {run.time[at]:.2f} s, {run['speed'][at] * 3.6:.0f} km/h")


def understeer_gradient(run: Run) -> Number:
    """Understeer gradient, positive for understeer [rad/(m/s²)]: ``EG = d(delta_H/i - l a_y/v²)/d(a_y)``.

    delta_H steering wheel angle, i steering ratio, l wheelbase: the steering beyond that of slip-free geometry. On a
    circle of constant radius ``l a_y/v² = l/R`` does not change. The slope holds between 1 and 4 m/s².

    Source: ISO 4138:2012; ISO 8855:2011, 5.3.5.
    """
    unit = "rad/(m/s²)"
    turning = tightening(run)
    wheelbase, ratio = fact(run, "wheelbase"), fact(run, "steering_ratio")
    if turning is None or wheelbase is None or ratio is None:
        return missing(unit, "needs a slowly tightened turn")
    steering = turning.side * (run["steering_wheel_angle"] - run["steering_wheel_angle"][0])
    speed = np.maximum(turning.part(run["speed"]), 0.1)
    value = turning.gradient(turning.part(steering) / ratio - wheelbase * turning.acceleration / speed**2)
    return Number(value, unit, _fitted(value))


def characteristic_speed(run: Run) -> Number:
    """Characteristic speed of an understeering car [m/s]: ``sqrt(l/EG)``, at which the yaw gain is largest.

    An oversteering car has a critical speed instead, and no value here.

    Source: M. Mitschke, H. Wallentowitz, Dynamik der Kraftfahrzeuge.
    """
    gradient, wheelbase = understeer_gradient(run), fact(run, "wheelbase")
    if not gradient.applies or wheelbase is None:
        return missing("m/s", "needs a slowly tightened turn")
    if gradient.value is None:
        return Number(None, "m/s", gradient.note)
    if gradient.value <= 0:
        critical = (
            "" if gradient.value == 0 else f": critical speed {3.6 * (wheelbase / -gradient.value) ** 0.5:.0f} km/h"
        )
        return Number(None, "m/s", f"oversteers{critical}" if gradient.value < 0 else "neutral")
    value = (wheelbase / gradient.value) ** 0.5
    return Number(value, "m/s", f"{3.6 * value:.0f} km/h")


def steering_wheel_angle_at_4(run: Run) -> Number:
    """Steering wheel angle at a lateral acceleration of 4 m/s² [rad]."""
    return _at(run, "steering_wheel_angle", 4.0)


def steering_wheel_angle_at_7(run: Run) -> Number:
    """Steering wheel angle at a lateral acceleration of 7 m/s² [rad]."""
    return _at(run, "steering_wheel_angle", 7.0)


def roll_angle_at_4(run: Run) -> Number:
    """Roll out of the turn at a lateral acceleration of 4 m/s² [rad]."""
    return _at(run, "roll_angle", 4.0)


def roll_angle_at_7(run: Run) -> Number:
    """Roll out of the turn at a lateral acceleration of 7 m/s² [rad]."""
    return _at(run, "roll_angle", 7.0)


def side_slip_gradient(run: Run) -> Number:
    """Side slip angle per lateral acceleration at the centre of gravity [rad/(m/s²)]: ``SG = d(l_r a_y/v² -
    beta)/d(a_y)``.

    ``l_r a_y/v²`` is the angle of slip-free rolling, l_r the distance of the centre of gravity from the rear axle.
    Positive: the car points into the turn, ``SG`` being the slip angle of the rear axle. The slope holds between 1 and
    4 m/s².

    Source: ISO 4138:2012.
    """
    unit = "rad/(m/s²)"
    turning = tightening(run)
    wheelbase, cg = fact(run, "wheelbase"), fact(run, "cg_x")
    if turning is None or wheelbase is None or cg is None or "side_slip_angle" not in run:
        return missing(unit, "needs a slowly tightened turn")
    slip = turning.side * (run["side_slip_angle"] - run["side_slip_angle"][0])
    speed = np.maximum(turning.part(run["speed"]), 0.1)
    value = turning.gradient((wheelbase - abs(cg)) * turning.acceleration / speed**2 - turning.part(slip))
    return Number(value, unit, _fitted(value))


def rear_side_slip_max(run: Run) -> Number:
    """Largest side slip angle at the rear axle, to either side [rad], without sign."""
    if not drives(run) or "rear_side_slip_angle" not in run:
        return missing("rad", "the car does not drive freely")
    slip = np.where(run["speed"] > 2.0, np.abs(run["rear_side_slip_angle"]), 0.0)[: followed(run)]
    if np.abs(run["lateral_acceleration"]).max() < _LEAST:
        return missing("rad", "does not turn")
    at = int(np.argmax(slip))
    return Number(float(slip[at]), "rad", f"at {run.time[at]:.2f} s")


def load_transfer_share_at_4(run: Run) -> Number:
    """Front axle's share of the lateral load transfer at 4 m/s²."""
    return _share_at(run, 4.0)


def load_transfer_share_at_7(run: Run) -> Number:
    """Front axle's share of the lateral load transfer at 7 m/s²."""
    return _share_at(run, 7.0)


def _share_at(run: Run, acceleration: float) -> Number:
    turning = tightening(run)
    if turning is None or "fl_wheel_load" not in run:
        return missing("1", "needs a slowly tightened turn")
    front, rear = (turning.at(turning.part(load_transfer(run, axle)), acceleration) for axle in ("front", "rear"))
    if front is None or rear is None:
        return Number(None, "1", f"does not reach {acceleration:g} m/s²")
    return Number(front / (front + rear), "1", f"{front:.0f} N front, {rear:.0f} N rear")


def _at(run: Run, channel: str, acceleration: float) -> Number:
    turning = tightening(run)
    if turning is None or channel not in run:
        return missing("rad", f"needs a slowly tightened turn: {' or '.join(SLOWLY_TIGHTENED)}")
    value = turning.at(turning.part(turning.side * (run[channel] - run[channel][0])), acceleration)
    return Number(value, "rad", f"does not reach {acceleration:g} m/s²" if value is None else "")


def _fitted(value: float | None) -> str:
    return f"does not reach {FIT[1]:g} m/s²" if value is None else f"between {FIT[0]:g} and {FIT[1]:g} m/s²"
