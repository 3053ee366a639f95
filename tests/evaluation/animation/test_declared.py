"""A film goes by what a run says of itself: a manoeuvre of another name is shown as the one it is made from."""

from __future__ import annotations

from functools import cache

import pytest

from evaluation.animation.clip import Clip
from evaluation.animation.film import KINDS
from evaluation.animation.handling.camera import camera_for, inside
from evaluation.animation.kinds import kind_of
from evaluation.animation.style import LAYOUTS, Style
from evaluation.animation.titles import describe
from evaluation.animation.window import window_of
from manoeuvres import MANOEUVRES
from susp_mj import simulate
from vehicles import load_vehicle
from vehicles.mjcf import build

from ...builders.manoeuvres import under_another_kind

DURATIONS = {"braking_in_turn": 6.0, "swept_steer": 10.0, "vertical_sweep": 10.0}
"""Of manoeuvres that do not fit into two seconds [s]."""


@cache
def plant(model, rig):
    return build(load_vehicle("s_class", "configuration_4"), model, rig=rig)


def film_of(run, layout):
    """Everything that is chosen for a film of one run."""
    clips, window = [Clip("one", run)], window_of([run], 30, None)
    kind = kind_of(clips)
    hud = KINDS[kind][1](clips, window, (1280, 720), Style(layout=layout))
    placed = (camera_for(run), inside(run)) if kind.free else ()
    return kind, window, placed, describe(run), hud.boxes, hud.views, [trace.title for trace in hud.traces]


@pytest.mark.parametrize("kind", MANOEUVRES)
def test_a_subclass_is_filmed_as_its_parent(kind):
    manoeuvre, duration = MANOEUVRES[kind], DURATIONS.get(kind, 2.0)
    parent, child = (
        simulate(plant(each.default_model, each.rig), each(duration=duration))
        for each in (manoeuvre, under_another_kind(manoeuvre))
    )
    assert (parent.meta["manoeuvre"]["kind"], child.meta["manoeuvre"]["kind"]) == (kind, "own")
    for layout in LAYOUTS if kind_of([Clip("one", parent)]).free else ("side_by_side",):
        assert film_of(child, layout) == film_of(parent, layout)
