"""What a run tells of its road: written as JSON and read back the same."""

from __future__ import annotations

import json

import pytest

from manoeuvres import MANOEUVRES
from susp_mj.features import (
    FEATURES,
    Bump,
    Circle,
    Cones,
    Course,
    CrossSlope,
    Gust,
    Lane,
    Patch,
    Roughness,
    as_json,
    features_in,
)

EXAMPLES = {
    "bump": Bump((2.0, 4.0), 0.08, (-2.0, 0.0)),
    "random": Roughness((0.0, 400.0), "C"),
    "cross_slope": CrossSlope((5.0, 25.0), 0.025),
    "patch": Patch((10.0, 510.0), (-20.0, 0.0), 0.3),
    "gust": Gust((27.0, 61.0), -20.0),
    "cones": Cones(((11.0, 1.3), (26.0, -1.3)), 0.15, (Lane((11.0, 26.0), (-1.1, 1.1)),)),
    "path": Course((0.0, 1.0, 2.0), (0.0, 0.1, 0.3)),
    "circle": Circle(-40.0),
}


def through_json(features):
    return features_in({"road": {"features": json.loads(json.dumps(as_json(features)))}})


@pytest.mark.parametrize("kind", FEATURES)
def test_every_feature_is_read_back_as_it_was_written(kind):
    feature = EXAMPLES[kind]
    assert as_json([feature])[0]["kind"] == kind
    assert through_json([feature]) == (feature,)


@pytest.mark.parametrize("kind", MANOEUVRES)
def test_every_manoeuvre_says_what_lies_on_its_road(kind):
    road = MANOEUVRES[kind]().road()
    if road is not None:
        assert road.shown and through_json(road.shown) == road.shown
        assert set(road.patches) <= set(road.shown)


def test_runs_saved_earlier_are_read():
    saved = [
        {"kind": "path", "radius": 100.0},
        {"kind": "bump", "x": [2.0, 4.0], "y": [0.0, 2.0], "side": "left", "height": 0.03},
        {"kind": "patch", "x": [10.0, 510.0], "y": [-20.0, 0.0], "friction": 0.3},
        {"kind": "monument", "x": 3.0},
    ]
    assert features_in({"road": {"features": saved}}) == (
        Circle(100.0),
        Bump((2.0, 4.0), 0.03, (0.0, 2.0)),
        Patch((10.0, 510.0), (-20.0, 0.0), 0.3),
    )


@pytest.mark.parametrize("meta", [{}, {"road": None}, {"road": {}}])
def test_a_run_without_a_road_shows_nothing(meta):
    assert features_in(meta) == ()
