"""Numbers of the body's attitude and of the wheel load's distribution, and the anti-roll bars that a target needs."""

from __future__ import annotations

import math

import numpy as np

from susp_mj.run import Run

from .number import Number
from .turns import FIT, RIG, SLOWLY_TIGHTENED, drives, followed, kind, tightening

GRAVITY = 9.81
_LAST = 0.5  # s; a car that drives freely is held in a turn if nothing changes for this long


def pitch_angle_max(run: Run) -> Number:
    """Largest nose-down pitch from the initial attitude [rad]."""
    return _largest(run, "pitch_angle", 1.0)


def pitch_angle_min(run: Run) -> Number:
    """Largest nose-up pitch from the initial attitude [rad], negative."""
    return _largest(run, "pitch_angle", -1.0)


def roll_angle_max(run: Run) -> Number:
    """Largest roll from the initial attitude, to either side [rad], without sign."""
    if "roll_angle" not in run:
        return _without("roll_angle", "rad")
    if kind(run) == RIG:
        return Number(None, "rad", "the rig holds the body", applies=False)
    roll = (run["roll_angle"] - run["roll_angle"][0])[: followed(run)]
    at = int(np.argmax(np.abs(roll)))
    if abs(roll[at]) < 1e-9:
        return Number(0.0, "rad", "does not roll")
    side = "left side up" if roll[at] > 0 else "right side up"
    return Number(abs(float(roll[at])), "rad", f"{side} at {run.time[at]:.3f} s")


def roll_angle_final(run: Run) -> Number:
    """Roll at the end of the run, from the initial attitude [rad], positive left side up."""
    if "roll_angle" not in run:
        return _without("roll_angle", "rad")
    if not _is_held(run):
        return _not_held("rad")
    return Number(float(run["roll_angle"][-1] - run["roll_angle"][0]), "rad")


def roll_gradient(run: Run) -> Number:
    """Roll per lateral acceleration [rad/(m/s²)].

    Where the lateral acceleration is held, at the end of the run; in a turn that a freely driving car tightens slowly,
    the slope between 1 and 4 m/s².
    """
    unit = "rad/(m/s²)"
    turning = tightening(run)
    if turning is not None and "roll_angle" in run:
        value = turning.gradient(turning.side * turning.part(run["roll_angle"]))
        return Number(
            value,
            unit,
            f"between {FIT[0]:g} and {FIT[1]:g} m/s²" if value is not None else f"does not reach {FIT[1]:g} m/s²",
        )
    held = "lateral_acceleration" in run and run["lateral_acceleration"][-1] != 0.0 and _is_held(run)
    if not held or "roll_angle" not in run:
        return Number(None, unit, "needs a held lateral acceleration", applies=False)
    return Number(float((run["roll_angle"][-1] - run["roll_angle"][0]) / run["lateral_acceleration"][-1]), unit)


def load_share_front(run: Run) -> Number:
    """Front axle's share of the wheel loads at the end of the run."""
    if not _is_held(run):
        return _not_held("1")
    loads = {station: load[-1] for station, load in run.stations("wheel_load").items()}
    front = sum(load for station, load in loads.items() if station.startswith("f"))
    if not front or front == sum(loads.values()):
        return Number(None, "1", "needs two axles", applies=False)
    return Number(float(front / sum(loads.values())), "1")


def load_transfer_front(run: Run) -> Number:
    """Lateral load transfer of the front axle at the end: half of right minus left, against the start [N]."""
    return _transfer(run, "fl", "fr")


def load_transfer_rear(run: Run) -> Number:
    """Lateral load transfer of the rear axle at the end: half of right minus left, against the start [N]."""
    return _transfer(run, "rl", "rr")


def load_transfer_share(run: Run) -> Number:
    """Front axle's share of the lateral load transfer at the end."""
    front, rear = load_transfer_front(run).value, load_transfer_rear(run).value
    if front is None or rear is None or abs(front + rear) < 1.0:
        return Number(None, "1", "needs a lateral load transfer on both axles", applies=False)
    return Number(front / (front + rear), "1")


def anti_roll_bar_front(run: Run) -> Number:
    """Rate of the front anti-roll bar that the required roll flexibility and distribution need, at the wheel [N/m]."""
    return _bar(run, "front")


def anti_roll_bar_rear(run: Run) -> Number:
    """Rate of the rear anti-roll bar that the required roll flexibility and distribution need, at the wheel [N/m]."""
    return _bar(run, "rear")


def required_roll_stiffness(lever: float, lateral_acceleration: float, angle: float, gravity: float = GRAVITY) -> float:
    """Roll stiffness ``K = m h (a_y + g phi)/phi`` [N m/rad] for the roll angle phi at the lateral acceleration a_y.

    Args:
        lever: m h [kg m], h the height of the centre of gravity above the roll axis.
        lateral_acceleration: a_y [m/s²].
        angle: phi [rad].
        gravity: 0 leaves the overturning of the rolled body out.

    Source: thesis appendix 9; the gravity term is reconstructed.
    """
    return lever * (lateral_acceleration + gravity * angle) / angle


def bar_rate(roll_stiffness: float, share: float, track: float, spring_rate: float) -> float:
    """Bar rate at the wheel [N/m] that completes an axle: ``c = K share 2/t² - k``; negative if the springs exceed it.

    Args:
        roll_stiffness: K of the whole car [N m/rad].
        share: of this axle.
        track: t [m].
        spring_rate: secant rate k of one wheel's spring over the roll [N/m].
    """
    return roll_stiffness * share * 2 / track**2 - spring_rate


def _bar(run: Run, axle: str) -> Number:
    """Bar from a run on the roll rig: the springs' secant rate at the held angle, heave left free."""
    left, right = f"{axle[0]}l", f"{axle[0]}r"
    manoeuvre, facts = run.meta.get("manoeuvre", {}), run.meta.get("facts", {})
    forces, travels = run.stations("spring_force"), run.stations("suspension_deflection")
    if manoeuvre.get("kind") != "roll_angle" or "roll_lever" not in facts or left not in forces or right not in forces:
        return Number(None, "N/m", "needs a car with roll centres on the roll rig", applies=False)
    secant = float((forces[left][-1] - forces[right][-1]) / (travels[left][-1] - travels[right][-1]))
    stiffness = required_roll_stiffness(facts["roll_lever"], manoeuvre["lateral_acceleration"], manoeuvre["angle"])
    share = manoeuvre["front_share"] if axle == "front" else 1 - manoeuvre["front_share"]
    rate = bar_rate(stiffness, share, facts[f"track_{axle}"], secant)
    words = f"springs {secant:.0f} N/m at {math.degrees(manoeuvre['angle']):.1f}°"
    if rate < 0:
        return Number(0.0, "N/m", f"none: the springs alone exceed the target by {-rate:.0f} N/m ({words})")
    return Number(rate, "N/m", words)


def _is_held(run: Run) -> bool:
    """Whether something drives the body and is held at the end, so that the end of the run is a state and not an
    instant."""
    if drives(run) or kind(run) == RIG:
        return drives(run) and kind(run) not in SLOWLY_TIGHTENED and _turns_steadily(run)
    return any(
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


def _not_held(unit: str) -> Number:
    return Number(None, unit, "needs a held force or angle", applies=False)


def _transfer(run: Run, left: str, right: str) -> Number:
    loads = run.stations("wheel_load")
    if not _is_held(run):
        return _not_held("N")
    if left not in loads or right not in loads:
        return Number(None, "N", "needs both wheels of the axle", applies=False)
    difference = loads[right] - loads[left]
    return Number(float(difference[-1] - difference[0]) / 2, "N")


def _largest(run: Run, channel: str, sign: float) -> Number:
    if channel not in run:
        return _without(channel, "rad")
    if kind(run) == RIG:
        return Number(None, "rad", "the rig holds the body", applies=False)
    values = sign * (run[channel] - run[channel][0])[: followed(run)]
    at = int(np.argmax(values))
    return Number(sign * float(values[at]), "rad", f"at {run.time[at]:.3f} s")


def _without(channel: str, unit: str) -> Number:
    return Number(None, unit, f"the model has no {channel}", applies=False)
