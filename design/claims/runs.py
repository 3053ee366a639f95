"""Runs of the saloon of appendix 9 that claims are held against, side by side."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeVar

from evaluation.numbers import Number, evaluate
from susp_mj.batch import side_by_side
from susp_mj.errors import SimulationError
from susp_mj.run import Run

from ..case import Setting
from ..running import Job, Prepared, Report, prepare, simulated

Key = TypeVar("Key")
CAR = "s_class"


@dataclass(frozen=True)
class Answered:
    """What a run gave.

    Attributes:
        numbers: by name; empty if there is no run to the end.
        failed: why there is none, one line; empty if there is.
    """

    numbers: Mapping[str, Number] = field(default_factory=dict)
    failed: str = ""

    def value(self, name: str) -> float | None:
        """A number; None if it has no value, or there is no run to the end."""
        number = self.numbers.get(name)
        return None if number is None else number.value

    def sure(self, name: str) -> float:
        """A number that every such run has; not a number if there is no run to the end."""
        found = self.value(name)
        return float("nan") if found is None else found


def wanted(
    characteristics: str,
    model: str,
    load: str,
    manoeuvre: Mapping[str, Any],
    numbers: Sequence[str],
    axle: str | None = None,
    change: Mapping[str, Any] | None = None,
) -> Job:
    """One run of the saloon; `change` are overrides by dotted path."""
    name = ", ".join(part for part in (characteristics.replace("_", " "), axle, load) if part)
    setting = Setting(
        name=name, vehicle=CAR, characteristics=characteristics, load=load, axle=axle, set=dict(change or {})
    )
    return Job(setting, model, manoeuvre, numbers)


def numbers_of(jobs: Mapping[Key, Job], task: str, progress: Report, workers: int | None = None) -> dict[Key, Answered]:
    """The numbers of every run, or why it has none.

    Raises:
        InputError: what is asked for does not fit the car.
    """
    answers = side_by_side(
        list(jobs.values()),
        prepare,
        simulated,
        lambda done: _answer(*done),
        workers=workers,
        progress=lambda place, done: progress(task, done),
    )
    return dict(zip(jobs, answers, strict=True))


def _answer(prepared: Prepared, run: Run | SimulationError) -> Answered:
    if isinstance(run, SimulationError):
        return Answered(failed=str(run))
    return Answered(evaluate(run, tuple(prepared.job.numbers)))
