"""Numbers of the response to a step of the steering wheel: response times, overshoot, steady-state gains, TB factor.

Time counts from the instant at which the steering wheel has made half its way. The steady state is the mean over the
last fifth of the time for which the angle is held. Gains are per steering wheel angle.

Source: ISO 7401:2011, step input; M. Mitschke, H. Wallentowitz, Dynamik der Kraftfahrzeuge.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from susp_mj.run import Run

from .number import Answer, Measure, Runs
from .runs import character, driving
from .turns import first

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


def step_response(run: Run, channel: str) -> Step:
    """Response of a channel to the step of the steering wheel."""
    steering = run["steering_wheel_angle"] - run["steering_wheel_angle"][0]
    largest = steering[int(np.argmax(np.abs(steering)))]
    turned = steering / largest
    half, held = int(np.argmax(turned >= 0.5)), int(np.argmax(turned >= 0.999))
    given_up = first(turned[held:] < 0.999)
    end = len(turned) if given_up is None else held + given_up
    begin = (
        run.time[half - 1] + (0.5 - turned[half - 1]) / (turned[half] - turned[half - 1]) * run.step
        if half
        else run.time[half]
    )
    start = min(character(run).begin, float(begin))
    before = float(np.interp(start, run.time, run[channel]))
    values = run[channel] - before
    averaged = values[end - max((end - held) // 5, 1) : end]
    steady = float(averaged.mean())
    drift = abs(float(averaged[-1] - averaged[0]))
    note = "not steady in the end" if drift > STEADY * abs(steady) else ""
    return Step(run.time[half:end] - begin, values[half:end], steady, note, float(largest))


def yaw_rate_response_time(run: Run) -> Answer:
    """Time until the yaw rate reaches 90 % of its steady state [s]."""
    return _response_time(run, "yaw_rate")


def lateral_acceleration_response_time(run: Run) -> Answer:
    """Time until the lateral acceleration reaches 90 % of its steady state [s]."""
    return _response_time(run, "lateral_acceleration")


def roll_angle_response_time(run: Run) -> Answer:
    """Time until the roll angle reaches 90 % of its steady state [s]."""
    return _response_time(run, "roll_angle")


def yaw_rate_peak_response_time(run: Run) -> Answer:
    """Time until the yaw rate has its first peak [s]; no value without overshoot."""
    step = step_response(run, "yaw_rate")
    found = _peak(step)
    return Answer(None, "does not overshoot") if found is None else Answer(found[0], step.note)


def yaw_rate_overshoot(run: Run) -> Answer:
    """Overshoot of the yaw rate over its steady state, as a share of it."""
    return _overshoot(run, "yaw_rate")


def lateral_acceleration_overshoot(run: Run) -> Answer:
    """Overshoot of the lateral acceleration over its steady state, as a share of it."""
    return _overshoot(run, "lateral_acceleration")


def roll_angle_overshoot(run: Run) -> Answer:
    """Overshoot of the roll angle over its steady state, as a share of it."""
    return _overshoot(run, "roll_angle")


def tb_factor(run: Run) -> Answer:
    """TB factor [rad s]: peak response time of the yaw rate times the steady side slip angle, without sign.

    Small is good: the car answers quickly and its tail stays behind its nose.

    Source: M. Mitschke, H. Wallentowitz, Dynamik der Kraftfahrzeuge.
    """
    time, slip = yaw_rate_peak_response_time(run), step_response(run, "side_slip_angle")
    return time if time.value is None else Answer(time.value * abs(slip.steady), slip.note)


def yaw_rate_gain(run: Run) -> Answer:
    """Steady yaw rate per steering wheel angle after a step [1/s]."""
    return _gain(run, "yaw_rate")


def lateral_acceleration_gain(run: Run) -> Answer:
    """Steady lateral acceleration per steering wheel angle after a step [m/s²/rad]."""
    return _gain(run, "lateral_acceleration")


def roll_angle_gain(run: Run) -> Answer:
    """Steady roll angle per steering wheel angle after a step [rad/rad]."""
    return _gain(run, "roll_angle")


def side_slip_angle_steady(run: Run) -> Answer:
    """Steady side slip angle of the centre of gravity after a step [rad], negative: the car points into a left turn."""
    step = step_response(run, "side_slip_angle")
    return Answer(step.steady, step.note)


def _response_time(run: Run, channel: str) -> Answer:
    step = step_response(run, channel)
    if step.steady == 0.0:
        return Answer(None, "does not respond")
    share = step.values / step.steady
    at = first(share >= REACHED)
    if at is None:
        return Answer(None, "does not get there")
    if at == 0:
        return Answer(float(step.time[0]), step.note)
    between = (REACHED - share[at - 1]) / (share[at] - share[at - 1])
    return Answer(float(step.time[at - 1] + between * (step.time[at] - step.time[at - 1])), step.note)


def _peak(step: Step) -> tuple[float, float] | None:
    """Time of the largest value and its share of the steady state; None without overshoot."""
    if step.steady == 0.0:
        return None
    share = step.values / step.steady
    at = int(np.argmax(share))
    return (float(step.time[at]), float(share[at])) if share[at] > 1.0 + 1e-3 and at < len(share) - 1 else None


def _overshoot(run: Run, channel: str) -> Answer:
    step = step_response(run, channel)
    found = _peak(step)
    return Answer(0.0, "does not overshoot") if found is None else Answer(found[1] - 1.0, step.note)


def _gain(run: Run, channel: str) -> Answer:
    step = step_response(run, channel)
    return Answer(step.steady / step.angle, step.note)


TURNED = Runs(lambda run: bool(np.ptp(run["steering_wheel_angle"]) > 0.0), "the steering wheel stands still")
STEPPED = driving("steering_step", "needs a step of the steering wheel") & TURNED
NUMBERS = (
    Measure(yaw_rate_response_time, "s", STEPPED),
    Measure(lateral_acceleration_response_time, "s", STEPPED),
    Measure(roll_angle_response_time, "s", STEPPED),
    Measure(yaw_rate_peak_response_time, "s", STEPPED),
    Measure(yaw_rate_overshoot, "1", STEPPED),
    Measure(lateral_acceleration_overshoot, "1", STEPPED),
    Measure(roll_angle_overshoot, "1", STEPPED),
    Measure(tb_factor, "rad s", STEPPED),
    Measure(yaw_rate_gain, "1/s", STEPPED),
    Measure(lateral_acceleration_gain, "m/s²/rad", STEPPED),
    Measure(roll_angle_gain, "1", STEPPED),
    Measure(side_slip_angle_steady, "rad", STEPPED),
)
