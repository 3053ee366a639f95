"""Dampers with a law of the user's own, without and with an inner state, against an independent solver and a closed
form; what they leave out is named as they are registered."""

from __future__ import annotations

import math
from typing import ClassVar, Literal

import numpy as np
import pytest

from evaluation.characteristics import characteristic
from manoeuvres import Bump
from susp_mj import InputError, simulate
from susp_mj.components import MotionRatio, damper_at_component
from susp_mj.elements import DAMPERS, LAWS, Damper, HydraulicDamper, Law, Spring, register
from susp_mj.errors import CallbackError
from susp_mj.linear import linearise
from susp_mj.units import Damping, Stiffness
from vehicles import load_vehicle
from vehicles.mjcf import build

from .reference import QuarterCar, bump_road, solve

RATE, SQUARE, MOUNT = 1500.0, 2500.0, 400e3


def quadratic_force(deflection, speed, state, p):
    """``c v + k v |v|``; p = c, k."""
    return (p[0] + p[1] * abs(speed)) * speed


class QuadraticDamper(Damper):
    """``F = c v + k v |v|``."""

    law: ClassVar[Law] = Law("quadratic_damper_of_the_tests", quadratic_force)
    kind: Literal["quadratic"] = "quadratic"
    rate: Damping
    square: float  # N s²/m²

    def parameters(self):
        return (self.rate, self.square)


def maxwell_force(deflection, speed, state, p):
    """``k1 (x - y)``; p = k1, c."""
    return p[0] * (deflection - state)


def maxwell_rod_speed(deflection, speed, state, p):
    """dy/dt of the rod behind the mount."""
    return p[0] * (deflection - state) / p[1]


class MaxwellDamper(Damper):
    """A linear damper behind a mount: ``F = k1 (x - y) = c dy/dt``."""

    law: ClassVar[Law] = Law("maxwell_damper_of_the_tests", maxwell_force, maxwell_rod_speed)
    kind: Literal["maxwell"] = "maxwell"
    rate: Damping
    mount_rate: Stiffness

    def parameters(self):
        return (self.mount_rate, self.rate)

    def force_at(self, speed):
        return self.rate * np.asarray(speed, float)

    def time_constant(self):
        return self.rate / self.mount_rate


@pytest.fixture(autouse=True)
def registered():
    for damper in (QuadraticDamper, MaxwellDamper):
        register(damper)
    yield
    for damper in (QuadraticDamper, MaxwellDamper):
        del DAMPERS[damper.model_fields["kind"].default], LAWS[damper.law.number]


def car(damper, **more):
    return load_vehicle("chapter3", "linear", {"rear.damper": damper, **more})


QUADRATIC = {"kind": "quadratic", "rate": RATE, "square": SQUARE}
MAXWELL = {"kind": "maxwell", "rate": 3000.0, "mount_rate": MOUNT}


def speed_of(force):
    """Inverse of the quadratic characteristic."""
    return math.copysign((math.sqrt(RATE**2 + 4 * SQUARE * abs(force)) - RATE) / (2 * SQUARE), force)


def test_a_quadratic_damper_against_the_stiff_solver():
    damper = (lambda v: (RATE + SQUARE * abs(v)) * v, speed_of)
    rate = 4743 / 9.81 * (2 * math.pi * 1.2) ** 2
    reference = QuarterCar(483.5, lambda x: 4743 + rate * x, damper, mount=None, rod_friction=0.0)
    run = simulate(build(car(QUADRATIC), "quarter_2dof"), Bump())
    expected = solve(reference, bump_road(0.08, 2.0, 50 / 3.6, 0.2), 3.0)
    assert np.abs(run["body_displacement"] - expected.body).max() < 0.05e-3


def test_a_damper_with_an_inner_state_is_the_mounted_one():
    """Without rod friction a linear damper behind a mount is the same whoever writes its law."""
    ours = build(car({"kind": "zoned", "rates": [3000.0], "mount": {"rate": MOUNT}}), "quarter_2dof")
    own = build(car(MAXWELL), "quarter_2dof")
    assert [each.seconds for each in own.meaning.time_constants] == pytest.approx(
        [each.seconds for each in ours.meaning.time_constants]
    )
    expected, run = simulate(ours, Bump()), simulate(own, Bump())
    for name in expected:
        scale = np.abs(expected[name]).max()
        np.testing.assert_allclose(run[name], expected[name], rtol=0, atol=1e-9 * scale + 1e-12, err_msg=name)


def test_its_mode_is_that_of_the_law_at_rest():
    plain = {"kind": "zoned", "rates": [RATE]}
    linear = [build(car(each, **{"rear.friction": None}), "quarter_2dof") for each in (plain, QUADRATIC)]
    expected, found = (linearise(plant).modes() for plant in linear)
    for a, b in zip(expected, found, strict=True):
        assert (b.frequency, b.damping) == pytest.approx((a.frequency, a.damping), rel=1e-4)


@pytest.mark.parametrize("damper", [QUADRATIC, MAXWELL])
def test_its_characteristic_is_drawn_and_taken_to_the_component(damper):
    axle = car(damper).axle("rear")
    drawn = characteristic("rear axle", axle)
    np.testing.assert_allclose(drawn.damper_force, axle.damper.force_at(drawn.speed), rtol=1e-14)
    component = damper_at_component(axle.damper, MotionRatio.model_validate(0.8))
    v = np.linspace(-1.0, 1.0, 41)
    np.testing.assert_allclose(component.force_at(0.8 * v) * 0.8, axle.damper.force_at(v), rtol=5e-3, atol=0.2)


@pytest.mark.parametrize(("key", "value"), [("friction", 25.0), ("mount", {"rate": 4e5})])
def test_friction_and_mount_belong_to_the_piecewise_ones(key, value):
    with pytest.raises(InputError, match="unknown") as caught:
        car({**QUADRATIC, key: value})
    assert caught.value.key == f"rear.damper.{key}"


def test_too_stiff_for_the_step_is_said_by_its_key():
    with pytest.raises(InputError, match="too stiff for a step of 40 ms") as caught:
        simulate(build(car(MAXWELL, **{"rear.friction": None}), "quarter_2dof"), Bump(), step=0.04)
    assert caught.value.key == "rear.damper"


def test_what_a_law_asks_for_beyond_itself_is_said():
    class OwnLawOfAPiecewise(HydraulicDamper):
        law: ClassVar[Law] = QuadraticDamper.law
        kind: Literal["own_law"] = "own_law"

        def branches(self):
            return (np.arange(2.0),) * 2, (np.arange(2.0),) * 2

    class SaysNothingOfItsState(Damper):
        law: ClassVar[Law] = MaxwellDamper.law
        kind: Literal["silent"] = "silent"

        def parameters(self):
            return (MOUNT, 3000.0)

    class ElastomerSpring(Spring):
        law: ClassVar[Law] = MaxwellDamper.law
        kind: Literal["elastomer"] = "elastomer"

        def parameters(self):
            return (MOUNT, 3000.0)

    for element, text in (
        (OwnLawOfAPiecewise, "has a law of its own, 'quadratic_damper_of_the_tests'; then it derives from Damper"),
        (SaysNothingOfItsState, "must define force_at, time_constant"),
        (ElastomerSpring, "must define time_constant for it"),
    ):
        with pytest.raises(CallbackError, match=text):
            register(element)
