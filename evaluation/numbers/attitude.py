"""Numbers of the body's attitude and of the wheel load's distribution, and the anti-roll bars that a target needs."""

from __future__ import annotations

import math

import numpy as np

from susp_mj.roll import bar_rate, required_roll_stiffness
from susp_mj.run import Run

from .number import Answer, Measure, Runs, no_question
from .runs import NOT_ON_RIG, drives, facts, is_a, known, on_rig, parameter, recorded
from .turns import FIT, TIGHTENED, followed, tightening

_LAST = 0.5  # s; a car that drives freely is held in a turn if nothing changes for this long


def pitch_angle_max(run: Run) -> Answer:
    """Largest nose-down pitch from the initial attitude [rad]."""
    return _largest(run, "pitch_angle", 1.0)


def pitch_angle_min(run: Run) -> Answer:
    """Largest nose-up pitch from the initial attitude [rad], negative."""
    return _largest(run, "pitch_angle", -1.0)


def roll_angle_max(run: Run) -> Answer:
    """Largest roll from the initial attitude, to either side [rad], without sign."""
    roll = (run["roll_angle"] - run["roll_angle"][0])[: followed(run)]
    at = int(np.argmax(np.abs(roll)))
    if abs(roll[at]) < 1e-9:
        return Answer(0.0, "does not roll")
    side = "left side up" if roll[at] > 0 else "right side up"
    return Answer(abs(float(roll[at])), f"{side} at {run.time[at]:.3f} s")


def roll_angle_final(run: Run) -> Answer:
    """Roll at the end of the run, from the initial attitude [rad], positive left side up."""
    return Answer(float(run["roll_angle"][-1] - run["roll_angle"][0]))


def roll_gradient(run: Run) -> Answer:
    """Roll per lateral acceleration [rad/(m/s²)].

    Where the lateral acceleration is held, at the end of the run; in a turn that a freely driving car tightens slowly,
    the slope between 1 and 4 m/s².
    """
    if run not in TIGHTENED:
        return Answer(float((run["roll_angle"][-1] - run["roll_angle"][0]) / run["lateral_acceleration"][-1]))
    turning = tightening(run)
    value = turning.gradient(turning.side * turning.part(run["roll_angle"]))
    return Answer(
        value, f"between {FIT[0]:g} and {FIT[1]:g} m/s²" if value is not None else f"does not reach {FIT[1]:g} m/s²"
    )


def load_share_front(run: Run) -> Answer:
    """Front axle's share of the wheel loads at the end of the run."""
    loads = {station: load[-1] for station, load in run.stations("wheel_load").items()}
    front = sum(load for station, load in loads.items() if station.startswith("f"))
    if not front or front == sum(loads.values()):
        return no_question("needs two axles")
    return Answer(float(front / sum(loads.values())))


def load_transfer_front(run: Run) -> Answer:
    """Lateral load transfer of the front axle at the end: half of right minus left, against the start [N]."""
    return Answer(_transfer(run, "fl", "fr"))


def load_transfer_rear(run: Run) -> Answer:
    """Lateral load transfer of the rear axle at the end: half of right minus left, against the start [N]."""
    return Answer(_transfer(run, "rl", "rr"))


def load_transfer_share(run: Run) -> Answer:
    """Front axle's share of the lateral load transfer at the end."""
    front, rear = _transfer(run, "fl", "fr"), _transfer(run, "rl", "rr")
    if abs(front + rear) < 1.0:
        return no_question("needs a lateral load transfer on both axles")
    return Answer(front / (front + rear))


def anti_roll_bar_front(run: Run) -> Answer:
    """Rate of the front anti-roll bar that the required roll flexibility and distribution need, at the wheel [N/m]."""
    return _bar(run, "front")


def anti_roll_bar_rear(run: Run) -> Answer:
    """Rate of the rear anti-roll bar that the required roll flexibility and distribution need, at the wheel [N/m]."""
    return _bar(run, "rear")


def _bar(run: Run, axle: str) -> Answer:
    """Bar from a run on the roll rig: the springs' secant rate at the held angle, heave left free."""
    left, right = f"{axle[0]}l", f"{axle[0]}r"
    forces, travels = run.stations("spring_force"), run.stations("suspension_deflection")
    secant = float((forces[left][-1] - forces[right][-1]) / (travels[left][-1] - travels[right][-1]))
    angle, front_share = parameter(run, "angle"), parameter(run, "front_share")
    stiffness = required_roll_stiffness(facts(run)["roll_lever"], parameter(run, "lateral_acceleration"), angle)
    share = front_share if axle == "front" else 1 - front_share
    rate = bar_rate(stiffness, share, facts(run)[f"track_{axle}"], secant)
    words = f"springs {secant:.0f} N/m at {math.degrees(angle):.1f}°"
    if rate < 0:
        return Answer(0.0, f"none: the springs alone exceed the target by {-rate:.0f} N/m ({words})")
    return Answer(rate, words)


def _is_held(run: Run) -> bool:
    """Whether something drives the body and is held at the end, so that the end of the run is a state and not an
    instant."""
    if drives(run):
        return run not in TIGHTENED and _turns_steadily(run)
    return not on_rig(run) and any(
        name in run and run[name][-1] != 0.0
        for name in ("lateral_acceleration", "longitudinal_acceleration", "roll_target")
    )


def _turns_steadily(run: Run) -> bool:
    """Whether a freely driving car ends in a steady turn: steering wheel, speed and lateral acceleration no longer
    change."""
    last = run.time > run.time[-1] - _LAST
    acceleration, steering, speed = (
        run[name][last] for name in ("lateral_acceleration", "steering_wheel_angle", "speed")
    )
    mean = abs(float(acceleration.mean()))
    return bool(
        mean > 0.5
        and np.ptp(acceleration) < 0.05 * mean
        and np.ptp(steering) < 1e-3
        and np.ptp(speed) < 0.02 * speed.max()
    )


def _is_held_in_a_turn(run: Run) -> bool:
    return "lateral_acceleration" in run and run["lateral_acceleration"][-1] != 0.0 and _is_held(run)


def _transfer(run: Run, left: str, right: str) -> float:
    """Half of right minus left at the end, against the start [N]."""
    difference = run[f"{right}_wheel_load"] - run[f"{left}_wheel_load"]
    return float(difference[-1] - difference[0]) / 2


def _largest(run: Run, channel: str, sign: float) -> Answer:
    values = sign * (run[channel] - run[channel][0])[: followed(run)]
    at = int(np.argmax(values))
    return Answer(sign * float(values[at]), f"at {run.time[at]:.3f} s")


HELD = Runs(_is_held, "needs a held force or angle")
HELD_TURN = Runs(lambda run: run in TIGHTENED or _is_held_in_a_turn(run), "needs a held lateral acceleration")
ROLL_RIG = Runs(lambda run: is_a(run, "required_roll"), "needs a car with roll centres on the roll rig")
FRONT, REAR = recorded("fl_wheel_load", "fr_wheel_load"), recorded("rl_wheel_load", "rr_wheel_load")
NUMBERS = (
    Measure(pitch_angle_max, "rad", recorded("pitch_angle") & NOT_ON_RIG),
    Measure(pitch_angle_min, "rad", recorded("pitch_angle") & NOT_ON_RIG),
    Measure(roll_angle_max, "rad", recorded("roll_angle") & NOT_ON_RIG),
    Measure(roll_angle_final, "rad", recorded("roll_angle") & HELD),
    Measure(roll_gradient, "rad/(m/s²)", recorded("roll_angle") & HELD_TURN),
    Measure(load_share_front, "1", HELD),
    Measure(load_transfer_front, "N", HELD & FRONT),
    Measure(load_transfer_rear, "N", HELD & REAR),
    Measure(load_transfer_share, "1", HELD & FRONT & REAR),
    Measure(anti_roll_bar_front, "N/m", ROLL_RIG & known("roll_lever", "track_front") & recorded("fl_spring_force")),
    Measure(anti_roll_bar_rear, "N/m", ROLL_RIG & known("roll_lever", "track_rear") & recorded("rl_spring_force")),
)
