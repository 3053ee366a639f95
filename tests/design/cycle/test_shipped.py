"""Cycle files that ship: they are read, fit their cars, and hold what they say."""

from __future__ import annotations

import pytest

from design.cycle.candidate import Layout
from design.cycle.cycling import assess
from design.cycle.ledger import Answered
from design.cycle.targets import available_cycles, load_targets
from evaluation.numbers import NUMBERS, Number


def layout_of(name: str) -> Layout:
    return Layout.open(*load_targets(name))


@pytest.mark.parametrize("name", available_cycles())
def test_a_shipped_cycle_fits_its_car(name):
    layout = layout_of(name)
    assert layout.targets.title and layout.targets.check
    earlier = {}
    for place, asked in enumerate(layout.targets.candidate):
        candidate = layout.by_hand(place, asked.name or str(place), earlier)
        earlier[candidate.name] = candidate
        layout.vehicle(candidate)


def hitting(asked):
    """Runs that all hit a stop once."""
    return [Answered({name: Number(1.0, NUMBERS[name].unit) for name in each.numbers}) for each in asked]


def test_the_walk_goes_through_the_steps_although_the_load_range_is_missed():
    """Configuration 1 cannot carry the load range; damping and stop hits are shown all the same, bars are not."""
    layout = layout_of("appendix9")
    outcome = assess(layout, layout.by_hand(0, "1", {}), hitting)
    assert not outcome.kept and outcome.missed[0].step == "load range"
    shown = list(dict.fromkeys(each.step for each in outcome.findings))
    assert shown == ["load range", "damping", "steps"]
    hits = [each for each in outcome.missed if each.target == "stop hits"]
    assert {each.where for each in hits} == {
        f"{a} axle, {load}" for a in ("front", "rear") for load in ("empty", "ko", "full")
    }


def test_without_it_a_candidate_ends_at_the_first_step_that_it_misses():
    layout = layout_of("appendix9")
    hasty = layout.targets.candidate[0].model_copy(update={"through": None})
    layout.targets.__dict__["candidate"] = (hasty,)
    outcome = assess(layout, layout.by_hand(0, "1", {}), hitting)
    assert {each.step for each in outcome.findings} == {"load range"}
