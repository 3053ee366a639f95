"""Comparison: several configurations under one manoeuvre, with numbers and verdicts side by side."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from susp_mj.run import Run
from susp_mj.units import readable

from .characteristics import Characteristic
from .numbers import NUMBERS
from .numbers.difference import Difference, difference
from .numbers.number import Criterion, Number, Verdict

if TYPE_CHECKING:
    from susp_mj.linear import Mode


@dataclass(frozen=True)
class Configuration:
    """One configuration whose run came to its end.

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

    @property
    def asked(self) -> Mapping[str, Any]:
        """What its case asked for (`design.running.Prepared.asked`); empty of a run that no case asked for."""
        return self.run.meta.get("asked", {})


@dataclass(frozen=True)
class Failure:
    """A configuration whose run did not come to its end, and why.

    Attributes:
        name, title, facts, asked: as those of a `Configuration`.
        reason: one line.
        run: the run up to there; None if it had not begun.
    """

    name: str
    title: str
    facts: Mapping[str, str]
    reason: str
    run: Run | None = None
    asked: Mapping[str, Any] = field(default_factory=dict)


Outcome = Configuration | Failure


@dataclass(frozen=True)
class Claim:
    """A published statement beside what came out.

    Attributes:
        text: the statement.
        expected: what it says, e.g. "11.24 ± 0.05 m/s²".
        result: what came out, e.g. "11.241 m/s²".
        holds: whether it does.
        source: where it is published, e.g. "figure 3.4".
        why: what explains the result, a sentence or two.
        known: whether it is known not to hold, `why` being the reason.
    """

    text: str
    expected: str
    result: str
    holds: bool
    source: str = ""
    why: str = ""
    known: bool = False

    @property
    def verdict(self) -> str:
        """In words whether it holds."""
        return "agrees" if self.holds else "does not agree, as is known" if self.known else "does not agree"

    def plain(self) -> dict[str, Any]:
        """As JSON values."""
        return {
            "text": self.text,
            "source": self.source,
            "expected": self.expected,
            "result": self.result,
            "holds": bool(self.holds),
            "known": self.known,
            "why": self.why,
        }


@dataclass(frozen=True)
class Comparison:
    """Everything a report shows.

    Attributes:
        title: of the case.
        description: a sentence or two; may be empty.
        outcomes: of the configurations, in the order of the case file.
        criteria: by number name.
        claims: published statements beside results; empty for a user's own case.
        videos: file names of videos beside the report.
        baseline: name of the configuration that the others are compared with in per cent; empty for none.
        descriptions: what numbers are, by name; where it says nothing, `NUMBERS` does.
    """

    title: str
    description: str
    outcomes: Sequence[Outcome]
    criteria: Mapping[str, Criterion] = field(default_factory=dict)
    claims: Sequence[Claim] = ()
    videos: Sequence[str] = ()
    baseline: str = ""
    descriptions: Mapping[str, str] = field(default_factory=dict)

    @property
    def configurations(self) -> list[Configuration]:
        """Those whose run came to its end; the order fixes their colours."""
        return [each for each in self.outcomes if isinstance(each, Configuration)]

    @property
    def failures(self) -> list[Failure]:
        """Those whose run did not."""
        return [each for each in self.outcomes if isinstance(each, Failure)]

    def verdicts(self, configuration: Configuration) -> dict[str, Verdict]:
        """The criteria held against the numbers of one configuration, by number name."""
        return {name: Verdict(configuration.numbers[name], criterion) for name, criterion in self.criteria.items()}

    def differences(self, configuration: Configuration) -> dict[str, Difference]:
        """Numbers of a configuration less those of the baseline, by name; empty for the baseline and without one."""
        baseline = next((each for each in self.configurations if each.name == self.baseline), configuration)
        if baseline is configuration:
            return {}
        return {
            name: difference(number, baseline.numbers[name])
            for name, number in configuration.numbers.items()
            if name in baseline.numbers
        }

    def differing(self) -> list[str]:
        """Names of the numbers in which a configuration can be told from the baseline: both have a value."""
        found = [self.differences(each) for each in self.configurations]
        return list(dict.fromkeys(name for each in found for name, known in each.items() if known.value is not None))

    def description_of(self, number: str) -> str:
        """What a number is; empty where nobody knows."""
        return self.descriptions.get(number) or (NUMBERS[number].description if number in NUMBERS else "")

    @property
    def passed(self) -> bool:
        """Whether every configuration has a run and meets every criterion."""
        verdicts = [verdict for each in self.configurations for verdict in self.verdicts(each).values()]
        return not self.failures and all(verdict.passed for verdict in verdicts)

    def summary(self) -> list[dict[str, Any]]:
        """One entry per configuration, plain JSON values."""
        return [self._summary(each) for each in self.outcomes]

    def _summary(self, outcome: Outcome) -> dict[str, Any]:
        what = {"configuration": outcome.name, **outcome.facts, "asked": _asked(outcome)}
        if isinstance(outcome, Failure):
            return {**what, "failed": outcome.reason, "modes": [], "numbers": {}, "criteria": {}}
        return {
            **what,
            "modes": [{"frequency": mode.frequency, "damping": mode.damping} for mode in outcome.modes],
            "numbers": {
                name: {"value": number.value, "unit": number.unit, "note": number.note}
                for name, number in outcome.numbers.items()
            },
            "criteria": {name: verdict.plain() for name, verdict in self.verdicts(outcome).items()},
            **self._differences(outcome),
        }

    def _differences(self, configuration: Configuration) -> dict[str, Any]:
        found = self.differences(configuration)
        return {"differences": {name: each.plain() for name, each in found.items()}} if found else {}


def _asked(outcome: Outcome) -> dict[str, Any]:
    """What the case asked for, and the step that the run was integrated with."""
    step = None if outcome.run is None else outcome.run.meta.get("step")
    return {**outcome.asked, **({} if step is None else {"step": readable(step, "s")})}
