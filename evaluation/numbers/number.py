"""Number: one evaluation result with its unit; Measure: the question that it answers; Criterion: the band for it;
Verdict: whether it lies in there."""

from __future__ import annotations

import inspect
import math
from collections.abc import Callable
from dataclasses import dataclass
from numbers import Real
from typing import Any

from susp_mj.errors import InputError, short, wrong_answer
from susp_mj.run import Run

from ..display import band_text


@dataclass(frozen=True)
class Number:
    """What an evaluation found.

    Attributes:
        value: in SI `unit`, or None where the question has no answer for this run (`note` says why).
        unit: SI unit.
        note: one phrase, e.g. the place or instant; empty if there is nothing to add.
        applies: whether the question makes sense for this kind of run at all; a report leaves it out otherwise.
    """

    value: float | None
    unit: str
    note: str = ""
    applies: bool = True


@dataclass(frozen=True)
class Answer:
    """What the function of a measure returns; value, note and applies as in `Number`, the unit is the measure's."""

    value: float | None
    note: str = ""
    applies: bool = True


def no_question(note: str) -> Answer:
    """Answer to a question that turns out to make no sense for the run."""
    return Answer(None, note, applies=False)


@dataclass(frozen=True)
class Runs:
    """A kind of run; ``a & b`` are the runs that are both, ``run in a`` asks whether a run is one.

    Attributes:
        holds: whether a run is of the kind.
        otherwise: what a run is or has not that is of another kind, one phrase.
    """

    holds: Callable[[Run], bool]
    otherwise: str
    also: tuple[Runs, ...] = ()

    def __and__(self, other: Runs) -> Runs:
        return Runs(self.holds, self.otherwise, (*self.also, other))

    def __contains__(self, run: Run) -> bool:
        return self.refuse(run) is None

    def refuse(self, run: Run) -> str | None:
        """Why a run is of another kind, or None."""
        if not self.holds(run):
            return self.otherwise
        return next((reason for each in self.also if (reason := each.refuse(run)) is not None), None)


EVERY_RUN = Runs(lambda run: True, "")


@dataclass(frozen=True)
class Measure:
    """A question to a run that is answered by a number.

    Attributes:
        function: gives the answer for a run of the kind; its name is the number's, its docstring says what it is.
        unit: SI unit of the number, "1" for a pure one.
        runs: for which runs the question makes sense.

    Raises:
        InputError: a value of another type.
    """

    function: Callable[[Run], Answer]
    unit: str
    runs: Runs = EVERY_RUN

    def __post_init__(self) -> None:
        for key, kind in (("unit", str), ("runs", Runs)):
            value = getattr(self, key)
            if not isinstance(value, kind):
                raise InputError(f"{key} of number '{self.name}' is a {type(value).__name__}, not a {kind.__name__}")

    def __call__(self, run: Run) -> Number:
        """The number of a run.

        Raises:
            InputError: what the function gives is no answer.
        """
        reason = self.runs.refuse(run)
        answer = self._checked(self.function(run)) if reason is None else no_question(reason)
        return Number(answer.value, self.unit, answer.note, answer.applies)

    def _checked(self, answer: Any) -> Answer:
        """An answer whose value is finite or None, and whose note is a text."""
        given = short(answer)
        if isinstance(answer, Answer):
            finite = answer.value is None or (isinstance(answer.value, Real) and math.isfinite(answer.value))
            if finite and isinstance(answer.note, str):
                return answer
            given = f"Answer({short(answer.value)}, {short(answer.note)})"
        wanted = "an Answer(value, note), its value finite, or None and the note says why"
        raise wrong_answer(self.function, f"{given} for number '{self.name}'", wanted)

    @property
    def name(self) -> str:
        """Name in case files, summaries and reports."""
        return self.function.__name__

    @property
    def description(self) -> str:
        """What it is: the opening paragraph of the function's docstring, on one line."""
        return " ".join((inspect.getdoc(self.function) or "").split("\n\n")[0].split())


@dataclass(frozen=True)
class Criterion:
    """Band for a number; a bound of None is open. A number without value fails every criterion."""

    minimum: float | None
    maximum: float | None

    def passed(self, value: float | None) -> bool:
        """Whether the value lies in the band, bounds included."""
        if value is None:
            return False
        return (self.minimum is None or value >= self.minimum) and (self.maximum is None or value <= self.maximum)


@dataclass(frozen=True)
class Verdict:
    """A number held against the band for it."""

    number: Number
    criterion: Criterion

    @property
    def passed(self) -> bool:
        """Whether the number lies in the band."""
        return self.criterion.passed(self.number.value)

    @property
    def band(self) -> str:
        """The band with its unit, e.g. "at least 1.0 mm"."""
        return band_text(self.criterion.minimum, self.criterion.maximum, self.number.unit)

    def plain(self) -> dict[str, Any]:
        """As plain JSON values."""
        return {
            "value": self.number.value,
            "unit": self.number.unit,
            "min": self.criterion.minimum,
            "max": self.criterion.maximum,
            "passed": self.passed,
        }
