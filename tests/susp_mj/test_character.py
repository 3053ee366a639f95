"""Traits: a closed set of words that a plugin may add to, and none that is misspelt."""

from __future__ import annotations

import pytest

from evaluation.numbers import driving, is_a
from susp_mj import InputError
from susp_mj.character import TRAITS, Character, register_trait
from susp_mj.run import Run


@pytest.fixture
def tip_in(monkeypatch):
    monkeypatch.setitem(TRAITS, "tip_in", "the accelerator is pressed for a moment")
    return "tip_in"


def test_a_trait_of_ones_own_holds_of_runs_that_have_it(tip_in):
    own, other = (Run([], {}, {"character": Character("", traits).plain()}) for traits in ((tip_in,), ("braking",)))
    assert is_a(own, tip_in) and not is_a(other, tip_in)
    assert is_a(own, "braking", tip_in)


def test_a_trait_has_one_meaning(tip_in):
    register_trait(tip_in, TRAITS[tip_in])
    with pytest.raises(InputError, match="trait 'braking' is taken: the brakes are applied as it begins"):
        register_trait("braking", "the driver brakes a promise")


@pytest.mark.parametrize(
    "use", [lambda name: Character("", (name,)), lambda name: driving(name, ""), lambda name: is_a(Run([], {}), name)]
)
@pytest.mark.parametrize("trait", TRAITS)
def test_a_misspelt_trait_is_named_with_its_neighbour(use, trait):
    use(trait)
    with pytest.raises(InputError, match=rf"^trait '{trait}s' unknown; did you mean '{trait}'\?"):
        use(f"{trait}s")


def test_a_run_of_a_plugin_that_is_not_loaded_is_read(tip_in, monkeypatch):
    plain = Character("Tip-in", ("braking", tip_in), begin=0.5).plain()
    assert Character.read(plain).traits == ("braking", tip_in)
    monkeypatch.delitem(TRAITS, tip_in)
    assert Character.read(plain) == Character("Tip-in", ("braking",), begin=0.5)
