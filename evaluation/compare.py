"""Comparison: several configurations under one manoeuvre, with numbers and verdicts side by side."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from susp_mj.run import Run

from .characteristics import Characteristic
from .numbers.number import Criterion, Number

if TYPE_CHECKING:
    from susp_mj.linear import Mode


@dataclass(frozen=True)
class Configuration:
    """One configuration's outcome.

    Attributes:
        name: as the case file calls it; the label in every plot.
        title: what it is, one line.
        run: its run.
        numbers: evaluation numbers by name.
        characteristics: of the suspensions that its model uses.
        modes: of the model linearised at static equilibrium, friction left out, by rising frequency.
        transfer: for a sweep, channel -> (frequency [Hz], exact complex amplification) of the linearised model.
    """

    name: str
    title: str
    run: Run
    numbers: Mapping[str, Number]
    characteristics: Sequence[Characteristic] = ()
    modes: Sequence[Mode] = ()
    transfer: Mapping[str, tuple[np.ndarray, np.ndarray]] = field(default_factory=dict)

    @property
    def facts(self) -> dict[str, str]:
        """What was run, for the summary."""
        meta = self.run.meta
        return {
            "vehicle": meta["vehicle"],
            "load": meta["load"],
            "model": meta["model"],
            "manoeuvre": meta["manoeuvre"]["kind"],
        }


@dataclass(frozen=True)
class Claim:
    """A published statement beside what came out.

    Attributes:
        text: the statement, with its source.
        expected: what it says, e.g. "11.24 ± 0.05 m/s²".
        result: what came out, e.g. "11.241 m/s²".
        holds: whether it does.
    """

    text: str
    expected: str
    result: str
    holds: bool


@dataclass(frozen=True)
class Comparison:
    """Everything a report shows.

    Attributes:
        title: of the case.
        description: a sentence or two; may be empty.
        configurations: in the order of the case file; the order fixes their colours.
        criteria: by number name.
        claims: published statements beside results; empty for a user's own case.
        videos: file names of videos beside the report.
    """

    title: str
    description: str
    configurations: Sequence[Configuration]
    criteria: Mapping[str, Criterion] = field(default_factory=dict)
    claims: Sequence[Claim] = ()
    videos: Sequence[str] = ()

    def verdicts(self, configuration: Configuration) -> dict[str, dict[str, Any]]:
        """Criteria of one configuration: ``{name: {value, unit, min, max, passed}}``."""
        return {
            name: {
                "value": configuration.numbers[name].value,
                "unit": configuration.numbers[name].unit,
                "min": criterion.minimum,
                "max": criterion.maximum,
                "passed": criterion.passed(configuration.numbers[name].value),
            }
            for name, criterion in self.criteria.items()
        }

    @property
    def passed(self) -> bool:
        """Whether every configuration meets every criterion."""
        return all(verdict["passed"] for each in self.configurations for verdict in self.verdicts(each).values())

    def summary(self) -> list[dict[str, Any]]:
        """One entry per configuration, plain JSON values."""
        return [
            {
                "configuration": each.name,
                **each.facts,
                "modes": [{"frequency": m.frequency, "damping": m.damping} for m in each.modes],
                "numbers": {
                    name: {"value": n.value, "unit": n.unit, "note": n.note} for name, n in each.numbers.items()
                },
                "criteria": self.verdicts(each),
            }
            for each in self.configurations
        ]
