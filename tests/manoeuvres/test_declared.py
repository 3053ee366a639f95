"""What a manoeuvre declares counts, never its name: a subclass under another kind is judged and shown as its parent."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from evaluation.animation.handling.camera import camera_for
from evaluation.animation.titles import describe
from evaluation.animation.window import window_of
from evaluation.numbers import NUMBERS
from evaluation.numbers.runs import car, character, drives
from evaluation.plots.drawing import draw
from evaluation.turning import turning_table
from manoeuvres import MANOEUVRES, StepSteer
from manoeuvres.driving import Driving
from susp_mj import simulate
from susp_mj.character import Character
from vehicles import load_vehicle
from vehicles.mjcf import MODELS, build

from ..builders.manoeuvres import under_another_kind
from ..builders.runs import Bicycle, compared, driven

GIVEN = {
    "vertical_sweep": {"duration": 10.0},
    "random_road": {"duration": 2.0},
    "suspension_rig": {"duration": 4.0},
    "acceleration": {"speed": 10.0},
}


def run_of(manoeuvre):
    """A made-up run of a car that drives, turning at least slowly; a simulated one of everything else."""
    if isinstance(manoeuvre, Driving):
        time = np.arange(round(manoeuvre.duration * 1000) + 1) * 1e-3
        steers = np.any(driven(manoeuvre, "steering_wheel_angle", time))
        return Bicycle().run(manoeuvre, None if steers else np.radians(60.0) * time / time[-1])
    car = load_vehicle("s_class", "configuration_4")
    return simulate(build(car, manoeuvre.default_model, rig=manoeuvre.rig), manoeuvre)


@pytest.mark.parametrize("kind", MANOEUVRES)
def test_a_subclass_is_judged_and_shown_as_its_parent(kind):
    parent = MANOEUVRES[kind](**GIVEN.get(kind, {}))
    child = under_another_kind(MANOEUVRES[kind])(**GIVEN.get(kind, {}))
    assert child.kind == "own" != parent.kind
    runs = [run_of(each) for each in (parent, child)]
    assert [run.meta["manoeuvre"]["kind"] for run in runs] == [kind, "own"]
    first, second = ({name: number(run) for name, number in NUMBERS.items()} for run in runs)
    assert second == first and any(number.applies for number in first.values())
    assert describe(runs[1]) == describe(runs[0])
    comparisons = [compared(run) for run in runs]
    assert turning_table(comparisons[1]) == turning_table(comparisons[0])
    plots = [draw(each) for each in comparisons]
    assert plots[1] == plots[0] and plots[0]
    assert window_of([runs[1]], 25, None) == window_of([runs[0]], 25, None)
    if drives(runs[0]):
        assert camera_for(runs[1]) == camera_for(runs[0])


def test_simulate_keeps_what_a_manoeuvre_declares():
    plant = build(load_vehicle("s_class", "configuration_4"), "handling")
    parent, child = (each(duration=0.6) for each in (StepSteer, under_another_kind(StepSteer)))
    runs = [simulate(plant, each) for each in (parent, child)]
    assert {car(run) for run in runs} == {"handling"}
    assert character(runs[0]) == character(runs[1]) == replace(StepSteer.character, begin=0.5)
    assert [run.meta["title"].split(": ")[1].split()[0] for run in runs] == ["step_steer", "own"]


@pytest.mark.parametrize("kind", MANOEUVRES)
def test_what_is_declared_is_complete(kind):
    manoeuvre = MANOEUVRES[kind]
    assert manoeuvre.character.title, "so that a subclass is called the same"
    assert manoeuvre.german and manoeuvre.german != kind
    assert manoeuvre.default_model in MODELS
    assert manoeuvre.begins == "start" or manoeuvre.begins in manoeuvre.model_fields
    declared = manoeuvre().declared()
    assert Character.read(declared.plain()) == declared
    assert 0 <= declared.begin < manoeuvre().duration
    assert ("tightened" in declared.traits) == (declared.average > 0)


def test_a_script_is_titled_as_its_film():
    from design.script import case_from_arguments

    title = case_from_arguments("split_mu", ["--vehicle", "s_class", "--load", "ko"]).case.title
    assert (
        title
        == f"{MANOEUVRES['split_mu']().declared().title}: s_class (load ko)"
        == "Split friction: s_class (load ko)"
    )


def test_one_default_load_for_scripts_and_case_files():
    from design.case import usual_load

    assert usual_load(StepSteer, ("ko", "empty")) == "empty"
    assert usual_load(StepSteer, ("ko", "full")) == "ko"
    assert usual_load(MANOEUVRES["bump"](), ("ko", "empty")) == "ko"
