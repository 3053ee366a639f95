"""Numbers of the response to a step of the steering wheel: response times, overshoot, steady-state gains, TB factor.

Time counts from the instant at which the steering wheel has made half its way. The steady state is the mean over the
last fifth of the time for which the angle is held. Gains are per steering wheel angle.

Source: ISO 7401:2011, step input; M. Mitschke, H. Wallentowitz, Dynamik der Kraftfahrzeuge.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from susp_mj.run import Run

from .number import Number
from .turns import drives, first, kind, missing, parameter

REACHED = 0.9
"""Share of the steady state at which a response counts as there."""
STEADY = 0.05
"""Change within the averaged part, as a share of the steady state, above which the note says that it is not steady."""


@dataclass(frozen=True)
class Step:
    """Response of a channel to the step.

    Attributes:
        time: (n,) from half the steering on [s], up to where the angle is given up.
        values: (n,) of the channel, against its value before the step.
        steady: its steady state.
        note: empty, or that the state is not steady.
        angle: of the steering wheel in the end [rad].
    """

    time: np.ndarray
    values: np.ndarray
    steady: float
    note: str
    angle: float


def step_response(run: Run, channel: str) -> Step | None:
    """Response of a channel to the step of the steering wheel; None if the run has no step."""
    if not drives(run) or kind(run) != "step_steer" or channel not in run:
        return None
    steering = run["steering_wheel_angle"] - run["steering_wheel_angle"][0]
    largest = steering[int(np.argmax(np.abs(steering)))]
    if largest == 0.0:
        return None
    turned = steering / largest
    half, held = first(turned >= 0.5), first(turned >= 0.999)
    if half is None or held is None:
        return None
    given_up = first(turned[held:] < 0.999)
    end = len(turned) if given_up is None else held + given_up
    begin = (
        run.time[half - 1] + (0.5 - turned[half - 1]) / (turned[half] - turned[half - 1]) * run.step
        if half
        else run.time[half]
    )
    start = min(float(parameter(run, "start", 0.0)), float(begin))
    before = float(np.interp(start, run.time, run[channel]))
    values = run[channel] - before
    averaged = values[end - max((end - held) // 5, 1) : end]
    steady = float(averaged.mean())
    drift = abs(float(averaged[-1] - averaged[0]))
    note = "not steady in the end" if drift > STEADY * abs(steady) else ""
    return Step(run.time[half:end] - begin, values[half:end], steady, note, float(largest))


def yaw_rate_response_time(run: Run) -> Number:
    """Time until the yaw rate reaches 90 % of its steady state [s]."""
    return _response_time(run, "yaw_rate")


def lateral_acceleration_response_time(run: Run) -> Number:
    """Time until the lateral acceleration reaches 90 % of its steady state [s]."""
    return _response_time(run, "lateral_acceleration")


def roll_angle_response_time(run: Run) -> Number:
    """Time until the roll angle reaches 90 % of its steady state [s]."""
    return _response_time(run, "roll_angle")


def yaw_rate_peak_response_time(run: Run) -> Number:
    """Time until the yaw rate has its first peak [s]; no value without overshoot."""
    step = step_response(run, "yaw_rate")
    if step is None:
        return missing("s", "needs a step of the steering wheel")
    found = _peak(step)
    return Number(None, "s", "does not overshoot") if found is None else Number(found[0], "s", step.note)


def yaw_rate_overshoot(run: Run) -> Number:
    """Overshoot of the yaw rate over its steady state, as a share of it."""
    return _overshoot(run, "yaw_rate")


def lateral_acceleration_overshoot(run: Run) -> Number:
    """Overshoot of the lateral acceleration over its steady state, as a share of it."""
    return _overshoot(run, "lateral_acceleration")


def roll_angle_overshoot(run: Run) -> Number:
    """Overshoot of the roll angle over its steady state, as a share of it."""
    return _overshoot(run, "roll_angle")


def tb_factor(run: Run) -> Number:
    """TB factor [rad s]: peak response time of the yaw rate times the steady side slip angle, without sign.

    Small is good: the car answers quickly and its tail stays behind its nose.

    Source: M. Mitschke, H. Wallentowitz, Dynamik der Kraftfahrzeuge.
    """
    time, slip = yaw_rate_peak_response_time(run), step_response(run, "side_slip_angle")
    if not time.applies or slip is None:
        return missing("rad s", "needs a step of the steering wheel")
    return (
        Number(None, "rad s", time.note)
        if time.value is None
        else Number(time.value * abs(slip.steady), "rad s", slip.note)
    )


def yaw_rate_gain(run: Run) -> Number:
    """Steady yaw rate per steering wheel angle after a step [1/s]."""
    return _gain(run, "yaw_rate", "1/s")


def lateral_acceleration_gain(run: Run) -> Number:
    """Steady lateral acceleration per steering wheel angle after a step [m/s²/rad]."""
    return _gain(run, "lateral_acceleration", "m/s²/rad")


def roll_angle_gain(run: Run) -> Number:
    """Steady roll angle per steering wheel angle after a step [rad/rad]."""
    return _gain(run, "roll_angle", "1")


def side_slip_angle_steady(run: Run) -> Number:
    """Steady side slip angle of the centre of gravity after a step [rad], negative: the car points into a left turn."""
    step = step_response(run, "side_slip_angle")
    return (
        missing("rad", "needs a step of the steering wheel") if step is None else Number(step.steady, "rad", step.note)
    )


def _response_time(run: Run, channel: str) -> Number:
    step = step_response(run, channel)
    if step is None:
        return missing("s", "needs a step of the steering wheel")
    if step.steady == 0.0:
        return Number(None, "s", "does not respond")
    share = step.values / step.steady
    at = first(share >= REACHED)
    if at is None:
        return Number(None, "s", "does not get there")
    if at == 0:
        return Number(float(step.time[0]), "s", step.note)
    between = (REACHED - share[at - 1]) / (share[at] - share[at - 1])
    return Number(float(step.time[at - 1] + between * (step.time[at] - step.time[at - 1])), "s", step.note)


def _peak(step: Step) -> tuple[float, float] | None:
    """Time of the largest value and its share of the steady state; None without overshoot."""
    if step.steady == 0.0:
        return None
    share = step.values / step.steady
    at = int(np.argmax(share))
    return (float(step.time[at]), float(share[at])) if share[at] > 1.0 + 1e-3 and at < len(share) - 1 else None


def _overshoot(run: Run, channel: str) -> Number:
    step = step_response(run, channel)
    if step is None:
        return missing("1", "needs a step of the steering wheel")
    found = _peak(step)
    return Number(0.0, "1", "does not overshoot") if found is None else Number(found[1] - 1.0, "1", step.note)


def _gain(run: Run, channel: str, unit: str) -> Number:
    step = step_response(run, channel)
    return (
        missing(unit, "needs a step of the steering wheel")
        if step is None
        else Number(step.steady / step.angle, unit, step.note)
    )
