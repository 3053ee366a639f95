"""Reach: which knobs move a missed target most, and what else they move, by turning each a little through the same
runs."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, replace

from evaluation.story import Finding, Influence
from susp_mj.elements.dampers import ratio_of
from susp_mj.names import AXLES
from vehicles.vehicle import DESIGN_LOAD

from .candidate import Candidate, Layout
from .characteristics import (
    ONE_MASS,
    Ask,
    Tried,
    bars,
    damping,
    frequencies,
    load_range,
    needs_of,
    place_name,
    possible,
    roll_runs,
    rolled,
    steps,
)
from .checks import check, places_of, run_of
from .cycling import Outcome, with_bars
from .knobs import KNOBS, ratio_text
from .ledger import Asked

TURN = 0.1
"""Share by which a knob is turned; a frequency by half of it, its spring's rate then moves as much."""
LEAST_BAR = 1000.0
"""[N/m] by which a bar is turned at least."""
RIDE = "body_acceleration_max"
MOST, ALSO = 3, 3
"""So many knobs are named for a target, and so many things that each moves besides."""
LEAST, BESIDES = 5e-3, 0.02
"""A missed target, and anything else, moves if it does so by more than this share of its size or its bounds."""


def reach(layout: Layout, outcome: Outcome, targets: Collection[str], ask: Ask) -> list[Influence]:
    """The knobs that move what a candidate missed: three for each target.

    Springs are turned with the bars laid out anew, as a repair would do it; a bar by itself.

    Args:
        targets: keys of the findings that are looked at.
    """
    missed = [each for each in outcome.missed if each.key in targets]
    if not missed or (missed[0].value is None and all(each.value is None for each in missed)):
        return []
    tries = {knob: each for knob in KNOBS if (each := _turned(layout, outcome.candidate, knob)) is not None}
    ask([run for _, candidate in tries.values() for run in _manoeuvres(layout, candidate, ask, missed)])
    turned = {
        knob: Turned(
            words, *(_held_against(layout, each, ask, missed) for each in (_written(layout, outcome, knob), new))
        )
        for knob, (words, new) in tries.items()
    }
    return [each for target in missed for each in _strongest(target, turned)]


@dataclass(frozen=True)
class Turned:
    """A knob by how much in words, and the findings before and after."""

    words: str
    before: Mapping[str, Finding]
    after: Mapping[str, Finding]


def _written(layout: Layout, outcome: Outcome, knob: str) -> Candidate:
    """The candidate with a knob where it stands, but in the kind of spring or damper that turning it makes."""
    candidate = outcome.candidate
    turned = {**candidate.turned, knob: layout.values(candidate)[knob]}
    return replace(candidate, turned=turned, bars=candidate.bars and KNOBS[knob].part != "bar")


def _turned(layout: Layout, candidate: Candidate, knob: str) -> tuple[str, Candidate] | None:
    """A candidate with one knob turned, and by how much in words; None for one that is held or at its end."""
    if knob in layout.held:
        return None
    value = layout.values(candidate)[knob]
    part = KNOBS[knob].part
    if isinstance(value, str):
        compression, rebound = ratio_of(value)
        new = ratio_text((compression * (1 + TURN), rebound))
        words = f"compression share +{100 * TURN:.0f} %"
    elif part == "bar":
        by = max(TURN * value, LEAST_BAR)
        new, words = value + by, f"+{by / 1000:.1f} kN/m"
        candidate = replace(candidate, bars=False)
    else:
        share = TURN / 2 if knob.endswith("frequency") else TURN
        new, words = value * (1 + share), f"+{100 * share:.0f} %"
    candidate = replace(candidate, turned={**candidate.turned, knob: new})
    return None if possible(layout, candidate) is not None else (words, candidate)


def _manoeuvres(layout: Layout, candidate: Candidate, ask: Ask, missed: list[Finding]) -> list[Asked]:
    """The runs that a candidate is held against, but for steps, to be asked for side by side."""
    tried = _laid_out(layout, candidate, ask)
    return [*roll_runs(tried), *_ride_runs(tried)] + [
        run_of(tried, asked, *place)
        for asked in layout.targets.check
        if asked.name in {each.step for each in missed}
        for place in places_of(layout, asked, {each.where for each in missed})
    ]


def _laid_out(layout: Layout, candidate: Candidate, ask: Ask) -> Tried:
    """The candidate, with its bars laid out anew if that is wished."""
    tried = Tried.of(layout, candidate, ask)
    needs = needs_of(tried) if candidate.bars else None
    return tried if needs is None else with_bars(tried, needs)


def _held_against(layout: Layout, candidate: Candidate, ask: Ask, missed: list[Finding]) -> dict[str, Finding]:
    """Findings of the steps in closed form, of the roll, and of the step that was missed, by key."""
    names = {each.step for each in missed}
    tried = Tried.of(layout, candidate, ask)
    found: list[Finding] = [*load_range(tried), *frequencies(tried), *damping(tried)]
    if "steps" in names:
        found += steps(tried)
    needs = needs_of(tried)
    if needs is not None:
        found += bars(tried, needs)
        tried = with_bars(tried, needs) if candidate.bars else tried
        found += rolled(tried)
    found += _ride(tried)
    for asked in layout.targets.check:
        if asked.name in names:
            found += check(tried, asked, {each.where for each in missed})
    return {each.key: each for each in found}


def _ride_runs(tried: Tried) -> list[Asked]:
    """A step of middling height under either axle in the design position; none where no steps are asked for."""
    heights = sorted(tried.layout.targets.travel.steps)
    if not heights:
        return []
    manoeuvre = {"kind": "step", "height": heights[(len(heights) - 1) // 2], "duration": 1.5}
    return [tried.run(f"ride, {name} axle", ONE_MASS, DESIGN_LOAD, name, manoeuvre, (RIDE,)) for name in AXLES]


def _ride(tried: Tried) -> Iterable[Finding]:
    """Peak acceleration of the body on that step, as something that every knob may move."""
    asked = _ride_runs(tried)
    for run, answer in zip(asked, tried.ask(asked), strict=True):
        if not answer.failed:
            height = 1000 * float(run.manoeuvre["height"])
            where, title = place_name(run.load, run.axle), f"body acceleration on a step of {height:.0f} mm"
            yield Finding("ride", title, where, "", {}, answer.numbers[RIDE].value, "m/s²")


def _strongest(target: Finding, turned: Mapping[str, Turned]) -> list[Influence]:
    """The knobs that move a target most, with what else they move."""
    found = []
    for knob, each in turned.items():
        moved = _moved(each.before.get(target.key), each.after.get(target.key))
        if moved is not None and abs(moved) > LEAST * _size(each.before[target.key]):
            also = sorted(_also(target.key, each.before, each.after), key=lambda one: -one[0])[:ALSO]
            influence = Influence(target.key, knob, each.words, moved, target.unit, {key: by for _, key, by in also})
            found.append(influence)
    return sorted(found, key=lambda each: -abs(each.moved))[:MOST]


def _also(
    target: str, before: Mapping[str, Finding], after: Mapping[str, Finding]
) -> Iterable[tuple[float, str, tuple[float, str]]]:
    for key, finding in before.items():
        moved = _moved(finding, after.get(key))
        if key != target and moved is not None and abs(moved) > BESIDES * _size(finding):
            yield abs(moved) / _size(finding), key, (moved, finding.unit)


def _moved(before: Finding | None, after: Finding | None) -> float | None:
    if before is None or after is None or before.value is None or after.value is None:
        return None
    return after.value - before.value


def _size(finding: Finding) -> float:
    """What a change of a finding is measured by: its value or its bounds, whichever is largest."""
    sizes = [abs(each) for each in (finding.value, finding.minimum, finding.maximum) if each is not None]
    return max(sizes, default=0.0) or 1.0
