"""What a knob is said to move is what it moves."""

from __future__ import annotations

import pytest

from design.cycle.cycling import assess, cycle
from design.cycle.reach import reach

from .conftest import TARGETS


def keys(outcome):
    return [each.key for each in outcome.missed]


def test_damping_moves_its_ratio_in_proportion_and_stiffness_against_it(bench):
    table = bench()
    outcome = assess(table.layout, table.layout.proposed("A"), table.ledger.ask)
    found = reach(table.layout, outcome, keys(outcome), table.ledger.ask)
    missed = outcome.missed[0]
    assert {each.target for each in found} == {missed.key}
    assert found[0].knob == "rear.damping" and found[0].moved == pytest.approx(0.1 * missed.value)
    frequency = next(each for each in found if each.knob == "rear.frequency")
    assert frequency.moved == pytest.approx(missed.value * (1 / 1.05 - 1), rel=0.02)
    assert any("bars" in key for key in frequency.also)


def test_a_held_knob_is_not_named(bench):
    table = bench(TARGETS + "[hold]\n'rear.damping' = true\n")
    outcome = cycle(table.layout, table.ledger.ask)[-1]
    assert not outcome.kept and "held" in outcome.repair.because
    assert all(each.knob != "rear.damping" for each in reach(table.layout, outcome, keys(outcome), table.ledger.ask))


def test_more_roll_stiffness_asked_of_a_bar_rolls_less(bench):
    table = bench(TARGETS.replace("front_share = 0.6", "front_share = 0.6\ntolerance = '0.0001 deg'"))
    outcome = assess(table.layout, table.layout.proposed("A").turn("B", "", {"rear.damping": 1700.0}), table.ledger.ask)
    assert outcome.missed[0].step == "roll"
    bars = [each for each in reach(table.layout, outcome, keys(outcome), table.ledger.ask) if each.knob.endswith("bar")]
    assert bars and all(each.moved < 0 for each in bars)
