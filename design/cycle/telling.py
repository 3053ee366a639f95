"""From the outcomes of a cycle to its story: what pages, files and films show."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from evaluation.characteristics import Characteristic, characteristic
from evaluation.display import quantity_text
from evaluation.story import Attempt, Story
from susp_mj.elements import GRAVITY
from susp_mj.names import AXLES
from susp_mj.recording import versions
from susp_mj.run import Run

from ..running import Report
from .candidate import Candidate, Layout
from .characteristics import Ask, Tried, place_name
from .checks import places_of, run_of, trade_offs
from .components import component_rows
from .cycling import Outcome, attempt, kept_of, verdict
from .ledger import Answered, Asked, Ledger
from .reach import reach
from .targets import STEPS

SHOWN = 4
"""So many candidates are shown on the steps, the last ones."""

Runs = Mapping[str, Mapping[str, Mapping[str, Run]]]
Wanted = tuple[tuple[str, str, str], Asked]
"""Check, place and candidate of a run, and the run."""


def story(layout: Layout, outcomes: Sequence[Outcome], ledger: Ledger, progress: Report) -> Story:
    """The whole story, with the knobs that move what was missed, and the runs that figures show."""
    targets = layout.targets

    def ask(asked: list[Asked]) -> list[Answered]:
        return ledger.ask(asked, progress)

    attempts: list[Attempt] = []
    latest = {finding.key: place for place, outcome in enumerate(outcomes) for finding in outcome.missed}
    for place, outcome in enumerate(outcomes):
        progress(f"knobs of {outcome.candidate.name}", place / len(outcomes))
        looked_at = [key for key, last in latest.items() if last == place]  # each target where it was missed last
        influences = reach(layout, outcome, looked_at, ask)
        attempts.append(replace(attempt(layout, outcome), influences=influences))
    last = kept_of(outcomes)
    kept = None if last is None else last.candidate
    progress("trade-offs", 0.0)
    return Story(
        targets.title,
        targets.description,
        f"{layout.file.title}, {layout.file.path.name}",
        attempts,
        verdict(outcomes),
        trade_offs(Tried.of(layout, kept, ask), _ratios(layout, kept, ask)) if kept is not None else (),
        {each.candidate.name: curves(layout, each.candidate) for each in outcomes if each.possible},
        {
            load: {axle: layout.own(targets.characteristics).corner_mass(axle, load) * GRAVITY for axle in AXLES}
            for load in targets.loads
        },
        _runs(layout, outcomes, ledger, progress),
        notes(layout),
        {"targets": layout.path.name, "vehicle": layout.file.path.name, **dict(versions())},
        component_rows(layout.vehicle(kept), targets) if kept is not None else {},
    )


def _ratios(layout: Layout, candidate: Candidate, ask: Ask) -> dict[str, Tried]:
    """The candidate with each compression to rebound ratio of the targets on both axles."""
    return {
        ratio: Tried.of(
            layout,
            replace(candidate, turned={**candidate.turned, **{f"{axle}.ratio": ratio for axle in AXLES}}),
            ask,
        )
        for ratio in layout.targets.trade_off.ratios
    }


def curves(layout: Layout, candidate: Candidate) -> list[Characteristic]:
    """Characteristics of a candidate's axles."""
    car = layout.vehicle(candidate)
    return [characteristic(f"{name} axle", car.axle(name)) for name in AXLES]


def _runs(layout: Layout, outcomes: Sequence[Outcome], ledger: Ledger, progress: Report) -> Runs:
    """Runs of the kept and the last discarded candidate on every check that they reached, and of the last candidates
    on the steps at the lightest and the heaviest load: check -> place -> candidate -> run."""
    wanted = [*_on_steps(layout, outcomes, ledger.ask), *_on_checks(layout, outcomes, ledger.ask)]
    runs = ledger.runs([asked for _, asked in wanted], progress)
    found: dict[str, dict[str, dict[str, Run]]] = {}
    for ((check, where, candidate), _), run in zip(wanted, runs, strict=True):
        if run is not None:
            found.setdefault(check, {}).setdefault(where, {})[candidate] = run
    return found


def _on_steps(layout: Layout, outcomes: Sequence[Outcome], ask: Ask) -> Iterator[Wanted]:
    for outcome in [each for each in outcomes if each.possible][-SHOWN:]:
        tried = Tried.of(layout, outcome.candidate, ask)
        for height in layout.targets.travel.steps:
            for axle in AXLES:
                for load in _extremes(tried, axle):
                    names = (f"step of {quantity_text(height, 'm')}", place_name(load, axle), outcome.candidate.name)
                    yield names, tried.step(height, axle, load)


def _on_checks(layout: Layout, outcomes: Sequence[Outcome], ask: Ask) -> Iterator[Wanted]:
    for outcome in _compared(outcomes):
        tried, reached = Tried.of(layout, outcome.candidate, ask), {each.step for each in outcome.findings}
        for check in layout.targets.check:
            if check.name in reached:
                for load, axle in places_of(layout, check):
                    names = (check.name, place_name(load, axle), outcome.candidate.name)
                    yield names, run_of(tried, check, load, axle)


def _extremes(tried: Tried, axle: str) -> list[str]:
    """The lightest and the heaviest load on an axle."""
    by_force = sorted(tried.layout.targets.loads, key=lambda load: tried.corner_force(axle, load))
    return list(dict.fromkeys((by_force[0], by_force[-1])))


def _compared(outcomes: Sequence[Outcome]) -> list[Outcome]:
    """The last discarded candidate that reached the checks, and the kept one."""
    kept = [each for each in outcomes if each.kept]
    checks = [each for each in outcomes if not each.kept and each.findings[-1].step not in STEPS]
    return [*checks[-1:], *kept]


def notes(layout: Layout) -> list[str]:
    """What is assumed: defaults that decide, and estimates of the car."""
    targets = layout.targets
    told = [
        (
            targets.ride,
            "rebound_force",
            f"the springs keep {quantity_text(targets.ride.rebound_force, 'N')} at the rebound stop",
        ),
        (
            targets.dampers,
            "ratio",
            f"damping ratios lie between {targets.dampers.ratio.min} and {targets.dampers.ratio.max}",
        ),
        (targets.dampers, "above", f"beyond its first zone a damper has {targets.dampers.above:g} of its rate"),
        (targets.dampers, "most", f"damper rates end at {quantity_text(targets.dampers.most, 'N s/m')}"),
        (targets.travel, "steps", f"steps of {', '.join(quantity_text(each, 'm') for each in targets.travel.steps)}"),
    ]
    if targets.roll is not None:
        told += [
            (
                targets.roll,
                "bar_share",
                f"a bar carries at most {targets.roll.bar_share.max} of an axle's roll stiffness",
            ),
            (targets.roll, "tolerance", f"the roll angle is met within {quantity_text(targets.roll.tolerance, 'rad')}"),
        ]
    defaults = [f"by default {words}" for part, key, words in told if key not in part.model_fields_set]
    sources = layout.own(targets.characteristics).sources
    estimates = sorted(key for key, text in sources.items() if str(text).startswith("estimated"))
    return [*defaults, *([f"estimated in the vehicle file: {', '.join(estimates)}"] if estimates else [])]
