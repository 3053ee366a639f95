"""Numbers of a run: questions that name their unit and the runs they are for, and their answers."""

from __future__ import annotations

from collections.abc import Sequence

from susp_mj.errors import InputError, choices
from susp_mj.run import Run

from . import (
    attitude,
    braking,
    comfort,
    compliance,
    cornering,
    course,
    frequency,
    kinematics,
    ride,
    steering_frequency,
    transient,
    travel_left,
    wheel_lift,
)
from .number import EVERY_RUN, Answer, Criterion, Measure, Number, Runs, Verdict, no_question
from .runs import (
    DRIVES,
    NOT_ON_RIG,
    beginning,
    car,
    character,
    drives,
    driving,
    facts,
    is_a,
    known,
    on_rig,
    on_tyres,
    parameter,
    recorded,
)

NUMBERS: dict[str, Measure] = {
    each.name: each
    for each in (
        *cornering.NUMBERS,
        *wheel_lift.NUMBERS,
        *transient.NUMBERS,
        *steering_frequency.NUMBERS,
        *braking.NUMBERS,
        *course.NUMBERS,
        *travel_left.NUMBERS,
        *kinematics.NUMBERS,
        *compliance.NUMBERS,
        *ride.NUMBERS,
        *comfort.NUMBERS,
        *attitude.NUMBERS,
        *frequency.NUMBERS,
    )
}
"""Every number by its name, in the order of reports."""


def register(measure: Measure) -> None:
    """Add a number of your own; from then on reports show it and case files may name it.

    Raises:
        InputError: it is no `Measure`, or the name is taken.
    """
    if not isinstance(measure, Measure):
        raise InputError(f"a {type(measure).__name__} is no number; give Measure(function, unit, runs)")
    if measure.name in NUMBERS:
        raise InputError(f"number '{measure.name}' is taken", source="register")
    NUMBERS[measure.name] = measure


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
    "DRIVES",
    "EVERY_RUN",
    "NOT_ON_RIG",
    "NUMBERS",
    "Answer",
    "Criterion",
    "Measure",
    "Number",
    "Runs",
    "Verdict",
    "beginning",
    "car",
    "character",
    "drives",
    "driving",
    "evaluate",
    "facts",
    "is_a",
    "known",
    "no_question",
    "on_rig",
    "on_tyres",
    "parameter",
    "recorded",
    "register",
]
