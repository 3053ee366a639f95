"""Time histories of the quarter cars against an independent stiff solver, and the figures of the thesis' chapter 3."""

from __future__ import annotations

import functools

import numpy as np
import pytest

from manoeuvres import Bump, RoadStep
from susp_mj import simulate
from vehicles import load_vehicle
from vehicles.mjcf import build

from .reference import (
    QuarterCar,
    bump_road,
    linear_spring,
    progressive_spring,
    solve,
    step_road,
    zoned_damper,
)
from .thesis_cars import CHAPTER_3

CHAPTER3_BUMP = bump_road(0.08, 2.0, 50 / 3.6, 0.2)


@functools.cache
def reference(case):
    return solve(CHAPTER_3[case], CHAPTER3_BUMP, 3.0)


@functools.cache
def product(case):
    return simulate(build(load_vehicle("chapter3", case), "quarter_2dof"), Bump())


def test_the_solver_agrees_with_another_method():
    """The yardstick itself: an implicit Runge-Kutta method gives the same motion as the multistep one."""
    other = solve(CHAPTER_3["nonlinear"], CHAPTER3_BUMP, 1.0, method="Radau", rtol=1e-8)
    assert np.abs(other.body - reference("nonlinear").body[: len(other.body)]).max() < 1e-6


@pytest.mark.parametrize("case", CHAPTER_3)
def test_body_height(case):
    run, expected = product(case), reference(case)
    assert len(run.time) == 3001
    np.testing.assert_allclose(run.time, expected.time, rtol=0, atol=1e-12)
    assert np.abs(run["body_displacement"] - expected.body).max() < 0.05e-3


@pytest.mark.parametrize("case", CHAPTER_3)
def test_travel_and_wheel_load(case):
    run, expected = product(case), reference(case)
    assert np.abs(run["suspension_deflection"] - expected.travel).max() < 0.1e-3
    assert np.sqrt(np.mean((run["wheel_load"] - expected.load) ** 2)) < 3.0


# case: largest upward and downward acceleration [m/s²], smallest wheel load [N]; chapter 3 and the stiff solver
FIGURES = {"linear": (11.24, -11.42, 0.0), "nonlinear": (7.89, -5.80, 1823.0), "soft_linear": (8.27, -6.74, 1439.0)}


@pytest.mark.parametrize("case", CHAPTER_3)
def test_figures_of_chapter_3(case):
    up, down, load = FIGURES[case]
    run = product(case)
    assert run["body_acceleration"].max() == pytest.approx(up, abs=0.05)
    assert run["body_acceleration"].min() == pytest.approx(down, abs=0.05)
    assert run["wheel_load"].min() == pytest.approx(load, rel=0.01, abs=1e-9)
    motion = reference(case)
    assert motion.acceleration.max() == pytest.approx(up, abs=0.05)
    assert motion.acceleration.min() == pytest.approx(down, abs=0.05)


def test_only_the_linear_car_loses_contact():
    off = product("linear")["wheel_load"] == 0.0
    assert product("linear").time[np.argmax(off)] == pytest.approx(0.3, abs=0.02)
    np.testing.assert_array_equal(
        np.flatnonzero(off)[[0, -1]], np.flatnonzero(reference("linear").load == 0.0)[[0, -1]]
    )
    assert product("nonlinear")["wheel_load"].min() > 0
    assert product("soft_linear")["wheel_load"].min() > 0


def test_the_nonlinear_suspension_uses_more_travel():
    assert product("nonlinear")["suspension_deflection"].max() > product("linear")["suspension_deflection"].max() + 0.02


# Further laws: the third spring description with both stops hit, a damper of three zones, no mount, no friction at all.
STOPS = {"rebound": -0.06, "compression": 0.05, "rate": 5e5}
VARIANTS = {
    "progressive spring into its stops": (
        {
            "rear.spring": {
                "kind": "progressive",
                "frequency": 1.1,
                "preload": 4743,
                "rebound_force": 3100,
                "compression_force": 8000,
                "progressive_from": 0.02,
                "exponent": 2.5,
                "stops": STOPS,
            },
            "rear.damper.rates": [900],
        },
        QuarterCar(
            483.5,
            progressive_spring(4743, 1.1, lower=(-0.06, 3100), upper=(0.05, 8000), onset=0.02, exponent=2.5),
            zoned_damper([900], []),
            stops=(-0.06, 0.05, 5e5),
        ),
    ),
    "three zones": (
        {
            "rear.damper": {
                "kind": "zoned",
                "rates": [1500, 2500, 700],
                "limits": [0.1, 0.3],
                "ratio": "2:1",
                "mount": {"rate": 3e5},
            }
        },
        QuarterCar(
            483.5,
            linear_spring(4743, 1.2),
            zoned_damper([1500, 2500, 700], [0.1, 0.3], 2, 1),
            mount=3e5,
            rod_friction=0.0,
        ),
    ),
    "damper without mount": (
        {"rear.damper": {"kind": "zoned", "rates": [1500, 600], "limits": [0.2], "ratio": "1:2", "friction": 40}},
        QuarterCar(
            483.5, linear_spring(4743, 1.2), zoned_damper([1500, 600], [0.2], 1, 2), mount=None, rod_friction=40.0
        ),
    ),
    "no friction": (
        {"rear.friction": None, "rear.damper": {"kind": "zoned", "rates": [1500]}},
        QuarterCar(
            483.5,
            linear_spring(4743, 1.2),
            zoned_damper([1500], []),
            mount=None,
            rod_friction=0.0,
            linkage_friction=0.0,
        ),
    ),
}


@pytest.mark.parametrize("name", VARIANTS)
@pytest.mark.parametrize("height", [0.08, -0.06])
def test_other_characteristics(name, height):
    overrides, car = VARIANTS[name]
    run = simulate(
        build(load_vehicle("chapter3", "linear", overrides), "quarter_2dof"), Bump(height=height, duration=1.5)
    )
    expected = solve(car, bump_road(height, 2.0, 50 / 3.6, 0.2), 1.5)
    assert np.abs(run["body_displacement"] - expected.body).max() < 0.05e-3
    assert np.abs(run["suspension_deflection"] - expected.travel).max() < 0.1e-3
    if "stops" in name and height > 0:
        assert expected.travel.max() > 0.05
        assert expected.travel.min() < -0.06


def rigid(car):
    return QuarterCar(car.sprung, car.spring, car.damper, tyre=None)


@pytest.mark.parametrize("case", CHAPTER_3)
@pytest.mark.parametrize(
    ("manoeuvre", "road", "flies"),
    [
        (Bump(height=0.02, duration=2), bump_road(0.02, 2.0, 50 / 3.6, 0.2), False),
        (Bump(height=0.08, duration=2), bump_road(0.08, 2.0, 50 / 3.6, 0.2), True),
        (RoadStep(height=0.03, duration=2), step_road(0.03, 0.2, 0.02), False),
        (RoadStep(height=-0.05, duration=2), step_road(-0.05, 0.2, 0.02), True),
    ],
    ids=["low bump", "high bump", "step up", "step down"],
)
def test_massless_wheel(case, manoeuvre, road, flies):
    """The rigid massless wheel follows the road, and the road cannot pull."""
    run = simulate(build(load_vehicle("chapter3", case), "quarter_1dof"), manoeuvre)
    expected = solve(rigid(CHAPTER_3[case]), road, 2.0)
    assert np.abs(run["body_displacement"] - expected.body).max() < 0.05e-3
    assert np.abs(run["suspension_deflection"] - expected.travel).max() < 0.05e-3
    assert run["wheel_load"].min() >= 0.0
    assert run["body_acceleration"].max() == pytest.approx(expected.acceleration.max(), rel=0.01)
    in_the_air = expected.load == 0.0
    if case == "linear":
        assert in_the_air.any() == flies
    if in_the_air.any():
        assert abs(int(np.sum(run["wheel_load"] == 0.0)) - int(in_the_air.sum())) <= 2
        assert run["body_acceleration"].min() == pytest.approx(-9.81, abs=1e-9)
    np.testing.assert_allclose(run["wheel_load"], 483.5 * (run["body_acceleration"] + 9.81), rtol=0, atol=1e-6)
