"""Manoeuvres: every rate is the derivative of its value, and each road has the shape that it names."""

from __future__ import annotations

from typing import Literal

import numpy as np
import pytest

from manoeuvres import MANOEUVRES, Bump, RoadStep, VerticalSweep, find_manoeuvre, register
from susp_mj import InputError
from susp_mj.description import validate
from susp_mj.meaning import Input

WHEEL = Input("road_height", "", 0.0, 0.0, ())
REAR = Input("road_height", "rl", -3.081, 0.7, ())
HELD = ("speed_target",)
"""Inputs that may stay as they are from the beginning."""


def place_for(quantity, x=0.0):
    return Input(quantity, "", x, 0.0, ())


def kinds_and_needs():
    for kind, manoeuvre in MANOEUVRES.items():
        for quantity in manoeuvre.needs:
            yield pytest.param(kind, quantity, id=f"{kind} {quantity}")


@pytest.mark.parametrize("kind", MANOEUVRES)
def test_registered_under_its_own_name(kind):
    manoeuvre = MANOEUVRES[kind]()
    assert manoeuvre.kind == kind
    assert manoeuvre.duration > 0
    assert manoeuvre.needs
    assert MANOEUVRES[kind].__doc__


def test_names_and_aliases():
    assert all(find_manoeuvre(kind) == kind for kind in MANOEUVRES)
    assert all(find_manoeuvre(each.german.upper()) == kind for kind, each in MANOEUVRES.items())
    assert find_manoeuvre("Bodenwelle") == "bump"
    with pytest.raises(InputError, match="did you mean 'bump'"):
        find_manoeuvre("bum")


def test_a_manoeuvre_of_one_s_own_is_registered_once():
    class Kerb(RoadStep):
        """A high step."""

        kind: Literal["kerb"] = "kerb"

    register(Kerb)
    try:
        assert MANOEUVRES[find_manoeuvre("kerb")] is Kerb
        assert find_manoeuvre("schwelle") == "step", "the German name stays the parent's"
        register(Kerb)
        with pytest.raises(InputError, match="'kerb' of Other is taken"):
            register(type("Other", (Kerb,), {"__module__": __name__}))
    finally:
        del MANOEUVRES["kerb"]


@pytest.mark.parametrize(("kind", "quantity"), list(kinds_and_needs()))
@pytest.mark.parametrize("x", [0.0, -3.0])
def test_rate_is_the_derivative_of_the_value(kind, quantity, x):
    manoeuvre = MANOEUVRES[kind]()
    place = place_for(quantity, x)
    time = np.linspace(0.01, manoeuvre.duration - 0.01, 4001)
    h = 1e-6
    value, rate = manoeuvre.drive(place, time)
    assert value.shape == rate.shape == time.shape
    slope = (manoeuvre.drive(place, time + h)[0] - manoeuvre.drive(place, time - h)[0]) / (2 * h)
    assert np.abs(rate).max() > 0 or quantity in HELD
    np.testing.assert_allclose(rate, slope, rtol=0, atol=1e-4 * np.abs(rate).max())


@pytest.mark.parametrize(("kind", "quantity"), list(kinds_and_needs()))
def test_value_is_the_integral_of_the_rate(kind, quantity):
    """Catches what points may miss: a jump in the value without its rate."""
    manoeuvre = MANOEUVRES[kind]()
    time = np.linspace(0.0, manoeuvre.duration, int(min(manoeuvre.duration, 60) * 8000) + 1)
    value, rate = manoeuvre.drive(place_for(quantity), time)
    integral = np.concatenate([[0.0], np.cumsum((rate[1:] + rate[:-1]) / 2 * np.diff(time))])
    np.testing.assert_allclose(value - value[0], integral, rtol=0, atol=1e-3 * np.abs(value).max())


@pytest.mark.parametrize(("kind", "quantity"), list(kinds_and_needs()))
def test_starts_at_rest(kind, quantity):
    manoeuvre = MANOEUVRES[kind]()
    value, rate = manoeuvre.drive(place_for(quantity), np.array([0.0]))
    assert value[0] == pytest.approx(manoeuvre.driving_speed() if quantity in HELD else 0.0, abs=1e-12)
    assert rate[0] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("kind", MANOEUVRES)
def test_other_inputs_stay_zero(kind):
    assert MANOEUVRES[kind]().drive(place_for("something_else"), np.arange(3.0)) is None


@pytest.mark.parametrize("kind", MANOEUVRES)
def test_needs_are_checked(kind):
    manoeuvre = MANOEUVRES[kind]()
    manoeuvre.check([place_for(quantity) for quantity in manoeuvre.needs], "a model")
    with pytest.raises(InputError, match=f"a model has no input '{manoeuvre.needs[0]}'"):
        manoeuvre.check([], "a model")


@pytest.mark.parametrize("kind", MANOEUVRES)
@pytest.mark.parametrize(
    ("fields", "key"),
    [
        ({"duration": 0}, "duration"),
        ({"duration": "3 m"}, "duration"),
        ({"duratoin": 3}, "duratoin"),
        ({"kind": "other"}, "kind"),
    ],
)
def test_mistakes_in_a_case_file(kind, fields, key):
    with pytest.raises(InputError) as caught:
        validate(MANOEUVRES[kind], fields, source="case.toml", key="manoeuvre")
    assert caught.value.key == f"manoeuvre.{key}"
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("kind", MANOEUVRES)
def test_survives_its_own_json(kind):
    manoeuvre = MANOEUVRES[kind]()
    assert type(manoeuvre).model_validate_json(manoeuvre.model_dump_json()) == manoeuvre


# ---- bump


@pytest.mark.parametrize("height", [0.08, -0.05])
def test_bump(height):
    """0.144 s over 2 m at 50 km/h, as high as it says in the middle, flat before and after."""
    bump = Bump(height=height, length=2.0, speed="50 km/h", start=0.2)
    time = np.linspace(0, 1, 100001)
    road, rate = bump.drive(WHEEL, time)
    assert road[np.argmax(np.abs(road))] == pytest.approx(height, rel=1e-9)
    assert time[np.argmax(np.abs(road))] == pytest.approx(0.2 + 0.072, abs=1e-5)
    moved = time[np.abs(rate) > 1e-9]
    assert moved[0] == pytest.approx(0.2, abs=2e-5)
    assert moved[-1] == pytest.approx(0.344, abs=2e-5)
    quarter = bump.drive(WHEEL, np.array([0.2 + 0.036]))
    assert quarter[0][0] == pytest.approx(height / 2, rel=1e-9)
    assert quarter[1][0] == pytest.approx(np.pi * height / 0.144, rel=1e-9), "steepest at a quarter: pi h v/L"
    assert np.sum(road) * 1e-5 == pytest.approx(height / 2 * 0.144, rel=1e-6), "on average half as high"


def test_the_rear_axle_meets_the_bump_later():
    bump = Bump(speed=20.0)
    time = np.linspace(0, 2, 2001)
    delay = 3.081 / 20.0
    for front, rear in zip(bump.drive(WHEEL, time), bump.drive(REAR, time + delay), strict=True):
        np.testing.assert_allclose(rear, front, rtol=0, atol=1e-12)
    assert not bump.drive(REAR, time[time < 0.2 + delay])[0].any()


# ---- step


@pytest.mark.parametrize("height", [0.03, -0.05])
def test_step_with_rise_time(height):
    step = RoadStep(height=height, start=0.3, rise_time=0.04)
    road, rate = step.drive(WHEEL, np.array([0.0, 0.3, 0.31, 0.32, 0.33, 0.34, 1.0]))
    half = np.sqrt(0.5)
    expected = height * np.array([0, 0, (1 - half) / 2, 0.5, (1 + half) / 2, 1, 1])
    np.testing.assert_allclose(road, expected, rtol=0, atol=1e-15)
    assert rate[3] == pytest.approx(np.pi / 2 * height / 0.04, rel=1e-12)
    np.testing.assert_allclose(rate[[0, 6]], 0.0, rtol=0, atol=1e-12)


def test_step_without_rise_time():
    """At the start the road is up already; the rate never shows."""
    time = np.array([0.0, 0.2 - 1e-9, 0.2, 0.2 + 1e-9, 3.0])
    road, rate = RoadStep(height=0.03, rise_time=0.0).drive(WHEEL, time)
    np.testing.assert_array_equal(road, [0.0, 0.0, 0.03, 0.03, 0.03])
    np.testing.assert_array_equal(rate, 0.0)


def test_the_step_comes_under_every_wheel_at_once():
    time = np.linspace(0, 1, 1001)
    np.testing.assert_array_equal(RoadStep().drive(REAR, time)[0], RoadStep().drive(WHEEL, time)[0])


# ---- sweep


def test_sweep_frequency_and_phase():
    """Exponential from f0 to f1, and the phase is the integral of the frequency."""
    sweep = VerticalSweep(start_frequency=0.5, end_frequency=16.0, duration=20.0)
    time = np.linspace(0, 20, 400001)
    kept = sweep.record(time)
    frequency, phase = kept["excitation_frequency"], kept["excitation_phase"]
    assert frequency[0] == pytest.approx(0.5)
    assert frequency[-1] == pytest.approx(16.0)
    np.testing.assert_allclose(frequency[::80000], 0.5 * 2.0 ** np.arange(6), rtol=1e-12)
    integral = np.concatenate([[0.0], np.cumsum(np.pi * (frequency[1:] + frequency[:-1]) * np.diff(time))])
    np.testing.assert_allclose(phase, integral, rtol=0, atol=1e-5)


@pytest.mark.parametrize("constant_speed", [True, False])
def test_sweep_amplitude(constant_speed):
    """Constant, or falling so that the road's speed amplitude stays."""
    sweep = VerticalSweep(
        amplitude=0.01, start_frequency=0.5, end_frequency=16.0, duration=20.0, constant_speed=constant_speed
    )
    time = np.linspace(0, 20, 400001)
    road, rate = sweep.drive(WHEEL, time)
    for begin, end in ((3.0, 8.0), (15.0, 19.0)):
        part = (time > begin) & (time < end)
        frequency = sweep.record(time)["excitation_frequency"][part]
        if constant_speed:
            assert np.abs(rate[part]).max() == pytest.approx(0.01 * 2 * np.pi * 0.5, rel=0.01)
            assert np.abs(road[part] * frequency / 0.5).max() == pytest.approx(0.01, rel=0.01)
        else:
            assert np.abs(road[part]).max() == pytest.approx(0.01, rel=0.001)


def test_sweep_must_rise():
    with pytest.raises(InputError, match="must lie above") as caught:
        validate(VerticalSweep, {"start_frequency": 5, "end_frequency": 5})
    assert caught.value.key == "end_frequency"


@pytest.mark.parametrize("kind", MANOEUVRES)
def test_what_is_readable_is_the_same_manoeuvre(kind):
    manoeuvre = MANOEUVRES[kind]()
    again = type(manoeuvre)(**manoeuvre.readable())
    for name, value in manoeuvre.model_dump().items():
        assert getattr(again, name) == (pytest.approx(value, rel=1e-9) if isinstance(value, float) else value)
