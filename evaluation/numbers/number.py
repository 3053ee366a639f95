"""Number: one evaluation result with its unit; Criterion: the band it has to lie in."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from susp_mj.run import Run


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


Evaluate = Callable[[Run], Number]


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
