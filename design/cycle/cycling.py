"""The cycle itself: candidates tried step by step, discarded with the reason, repaired, until one is kept."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from evaluation.story import Attempt, Finding
from susp_mj.errors import InputError, choices
from susp_mj.names import AXLES
from vehicles.rates import RollNeeds

from .candidate import Candidate, Layout
from .characteristics import (
    POSSIBLE,
    Ask,
    Tried,
    bars,
    damping,
    frequencies,
    load_range,
    needs_of,
    possible,
    rolled,
    steps,
)
from .checks import check
from .knobs import KNOBS, Values
from .repair import Repair, repair
from .targets import STEPS

Heard = Callable[[Candidate, Finding], None]


@dataclass(frozen=True)
class Outcome:
    """What became of a candidate.

    Attributes:
        candidate: as it was at the end, its bars laid out.
        findings: as far as it came.
        repair: what it is changed into; None if it is kept, or not to be repaired.
    """

    candidate: Candidate
    findings: tuple[Finding, ...]
    repair: Repair | None

    @property
    def kept(self) -> bool:
        """Whether every target was met."""
        return bool(self.findings) and all(each.passed for each in self.findings)

    @property
    def missed(self) -> list[Finding]:
        """Targets that were not."""
        return [each for each in self.findings if not each.passed]

    @property
    def possible(self) -> bool:
        """Whether the candidate is a car at all."""
        return all(each.target != POSSIBLE for each in self.findings)


def assess(layout: Layout, candidate: Candidate, ask: Ask, heard: Heard = lambda candidate, finding: None) -> Outcome:
    """Hold a candidate against the targets, step by step up to the first in which it misses one, or to the one that it
    shall go through."""
    findings: list[Finding] = []

    def failed(found: Iterable[Finding]) -> list[Finding]:
        step = list(found)
        for each in step:
            heard(candidate, each)
        findings.extend(step)
        return [each for each in step if not each.passed]

    wrong = possible(layout, candidate)
    if wrong is not None:
        failed([wrong])
        return Outcome(candidate, tuple(findings), Repair({}, "these knobs make no spring or damper"))
    missed: list[Finding] = []
    goes_on = candidate.through is not None
    for step in _steps(layout, candidate, ask):
        candidate = step.tried.candidate
        missed += failed(step.findings)
        goes_on = goes_on and step.name in STEPS and step.name != candidate.through
        if missed and not goes_on:
            first = [each for each in missed if each.step == missed[0].step]
            return Outcome(candidate, tuple(findings), repair(step.tried, first, step.repair))
    return Outcome(candidate, tuple(findings), None)


@dataclass(frozen=True)
class _Step:
    name: str
    tried: Tried
    findings: Iterable[Finding]
    repair: str | None = None


def _steps(layout: Layout, candidate: Candidate, ask: Ask) -> Iterator[_Step]:
    """Every step of the cycle in its order; the bars are laid out on the way."""
    tried = Tried.of(layout, candidate, ask)
    for name, step in (
        ("load range", load_range),
        ("frequencies", frequencies),
        ("damping", damping),
        ("steps", steps),
    ):
        yield _Step(name, tried, step(tried))
    needs = needs_of(tried)
    if needs is not None:
        if candidate.bars:
            yield _Step("bars", tried, bars(tried, needs))
            tried = with_bars(tried, needs)
        yield _Step("roll", tried, rolled(tried))
    for asked in layout.targets.check:
        yield _Step(asked.name, tried, check(tried, asked), asked.repair)


def with_bars(tried: Tried, needs: RollNeeds) -> Tried:
    """The candidate with the bars that its springs leave room for; none where they exceed the need."""
    layout = tried.layout
    laid_out = {f"{name}.bar": max(0.0, needs.bars[name]) for name in AXLES}
    free = {knob: rate for knob, rate in laid_out.items() if knob not in layout.fixed}
    candidate = replace(tried.candidate, turned={**tried.candidate.turned, **free})
    return replace(tried, candidate=candidate, car=layout.vehicle(candidate))


@dataclass(frozen=True)
class Branch:
    """A further line of candidates, begun from an earlier one.

    Attributes:
        parent: name of the earlier candidate.
        change: knob -> value in SI.
        because: one phrase.
    """

    parent: str
    change: Values
    because: str = "branched by hand"


def cycle(
    layout: Layout, ask: Ask, heard: Heard = lambda candidate, finding: None, branches: Sequence[Branch] = ()
) -> list[Outcome]:
    """Try candidates until one is kept, or none is left.

    Those set up by hand are all tried, in their order; without any, one is laid out. If none of them is kept, the last
    one is repaired, and its repair again, until one meets every target, cannot be repaired, or `most` were tried.
    Branches follow in the same way.

    Raises:
        InputError: a parent that is no earlier candidate.
    """
    outcomes: list[Outcome] = []
    names = _names({each.name for each in layout.targets.candidate if each.name})
    for candidate in _first(layout, names, outcomes):
        outcomes.append(assess(layout, candidate, ask, heard))
    if not any(each.kept for each in outcomes):
        _repaired(layout, outcomes, names, ask, heard)
    for place, branch in enumerate(branches):
        parent = next((each.candidate for each in outcomes if each.candidate.name == branch.parent), None)
        if parent is None:
            known = choices([each.candidate.name for each in outcomes], branch.parent)
            raise InputError(f"no candidate '{branch.parent}'; {known}", key=f"branch {place + 1}")
        child = parent.turn(next(names), branch.because, branch.change)
        outcomes.append(assess(layout, child, ask, heard))
        _repaired(layout, outcomes, names, ask, heard)
    return outcomes


def _repaired(layout: Layout, outcomes: list[Outcome], names: Iterator[str], ask: Ask, heard: Heard) -> None:
    """Repair the last candidate, and what comes of it; a repair that leads back to an earlier one ends it."""
    for _ in range(layout.targets.most - 1):
        last = outcomes[-1]
        if last.kept or last.repair is None or not last.repair.changes or not last.candidate.repair:
            return
        child = last.candidate.turn("", last.repair.because, last.repair.changes)
        same = next((each.candidate.name for each in outcomes if _laid_out_alike(each.candidate, child)), None)
        if same is not None:
            end = f"the repair for it, {last.repair.because}, leads back to {same}: two targets contradict each other"
            outcomes[-1] = replace(last, repair=Repair({}, end))
            return
        outcomes.append(assess(layout, replace(child, name=next(names)), ask, heard))


def _laid_out_alike(one: Candidate, other: Candidate) -> bool:
    """Whether two candidates differ in their bars at most, which are laid out anew."""
    springs = [
        {knob: value for knob, value in each.turned.items() if not knob.endswith(".bar")} for each in (one, other)
    ]
    return one.characteristics == other.characteristics and springs[0] == springs[1]


def _first(layout: Layout, names: Iterator[str], outcomes: Sequence[Outcome]) -> Iterator[Candidate]:
    """Candidates that no repair leads to."""
    if not layout.targets.candidate:
        yield layout.proposed(next(names))
    for place, asked in enumerate(layout.targets.candidate):
        earlier = {each.candidate.name: each.candidate for each in outcomes}
        yield layout.by_hand(place, asked.name or next(names), earlier)


def _names(taken: set[str]) -> Iterator[str]:
    """A to Z, then A2 to Z2 and so on, without those that are taken."""
    number = 1
    while True:
        for letter in "ABCDEFGHIJKLMNOPQRSTUVWXYZ":
            name = letter if number == 1 else f"{letter}{number}"
            if name not in taken:
                yield name
        number += 1


def attempt(layout: Layout, outcome: Outcome) -> Attempt:
    """A candidate's part of the story."""
    candidate = outcome.candidate
    values = layout.values(candidate)
    return Attempt(
        candidate.name,
        candidate.because,
        candidate.parent,
        {name: (values[name], knob.unit) for name, knob in KNOBS.items()},
        candidate.changed,
        outcome.findings,
        outcome.kept,
        _reason(outcome),
    )


def _reason(outcome: Outcome) -> str:
    """Why a candidate was discarded, in words."""
    if outcome.kept:
        return ""
    words = "; ".join(each.words for each in outcome.missed)
    end = outcome.repair
    return words if end is None or end.changes else f"{words}. {end.because[0].upper()}{end.because[1:]}"


def kept_of(outcomes: Sequence[Outcome]) -> Outcome | None:
    """The candidate that is kept: of several that meet every target the one that was tried last."""
    return next((each for each in reversed(outcomes) if each.kept), None)


def verdict(outcomes: Sequence[Outcome]) -> str:
    """One sentence: which candidate is kept, or which target cannot be met and by how much."""
    kept = kept_of(outcomes)
    if kept is not None:
        discarded = sum(not each.kept for each in outcomes)
        return (
            f"{kept.candidate.name} is kept, {discarded or 'no'} other{'s' * (discarded != 1)} discarded: it meets all "
            f"{len(kept.findings)} targets."
        )
    last = outcomes[-1]
    if not last.candidate.repair:
        return f"No candidate that was set up by hand meets the targets; {last.candidate.name}: {_reason(last)}."
    if last.repair is not None and last.repair.changes:
        count = len(outcomes)
        return f"None of {count} candidates meets the targets; {last.candidate.name} was the last: {_reason(last)}."
    return f"The targets cannot be met: {_reason(last)}."
