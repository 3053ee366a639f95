"""Linearisation: closed forms of the quarter car, agreement of transfer function and sweep, modes of the whole car."""

from __future__ import annotations

import numpy as np
import pytest

from evaluation.numbers.frequency import amplification
from manoeuvres import VerticalSweep
from susp_mj import InputError, simulate
from susp_mj.linear import linearise
from vehicles import load_vehicle
from vehicles.mjcf import OSCILLATION, build

from ..builders.cars import LinearQuarterCar

CAR = LinearQuarterCar()
MS, MU, K, C, KT = CAR.sprung, CAR.unsprung, CAR.rate, CAR.damping, CAR.tyre


def quarter_transfer(frequency):
    """Body over road of the two-mass quarter car."""
    s = 2j * np.pi * frequency
    link = C * s + K
    wheel = KT / (MU * s**2 + link + KT - link**2 / (MS * s**2 + link))
    return wheel * link / (MS * s**2 + link)


def test_transfer_function_is_the_closed_form():
    linear = linearise(build(CAR.vehicle(), "quarter_2dof"))
    frequency = np.geomspace(0.1, 50, 60)
    found = linear.transfer("body_displacement", {"road_height": 1.0}, frequency)
    np.testing.assert_allclose(found, quarter_transfer(frequency), rtol=1e-6)
    acceleration = linear.transfer("body_acceleration", {"road_height": 1.0}, frequency)
    np.testing.assert_allclose(acceleration, found * (2j * np.pi * frequency) ** 2, rtol=1e-6)


def test_modes_are_the_closed_form():
    modes = linearise(build(CAR.vehicle(), "quarter_2dof")).modes()
    roots = np.roots([MS * MU, C * (MS + MU), K * (MS + MU) + KT * MS, KT * C, K * KT])
    expected = sorted((abs(r) / 2 / np.pi, -r.real / abs(r)) for r in roots if r.imag > 0)
    np.testing.assert_allclose([(m.frequency, m.damping) for m in modes], expected, rtol=1e-6)


def test_rigid_wheel_sees_the_rate_of_the_road():
    """(c s + k)/(m s² + c s + k): the damper feels the road's speed at once."""
    linear = linearise(build(CAR.vehicle(), "quarter_1dof"))
    frequency = np.geomspace(0.1, 30, 40)
    s = 2j * np.pi * frequency
    expected = (C * s + K) / (MS * s**2 + C * s + K)
    np.testing.assert_allclose(
        linear.transfer("body_displacement", {"road_height": 1.0}, frequency), expected, rtol=1e-6
    )


def test_sweep_agrees_with_the_transfer_function():
    plant = build(CAR.vehicle(), "quarter_2dof")
    found = amplification(simulate(plant, VerticalSweep(amplitude=0.02, duration=60.0)), "wheel_load")
    exact = linearise(plant).transfer("wheel_load", {"road_height": 1.0}, found.frequency)
    error = np.abs(found.ratio / exact - 1)
    assert error.max() < 0.03
    assert np.median(error) < 0.005


@pytest.mark.parametrize("model", OSCILLATION)
def test_modes_of_the_saloon(model):
    """As many body modes as body freedoms, near the design frequencies; all decay."""
    car = load_vehicle("s_class", "configuration_4").without_friction()
    modes = linearise(build(car, model)).modes()
    assert all(0 < mode.damping <= 1 for mode in modes)
    body = [mode for mode in modes if mode.oscillates and mode.frequency < 4]
    assert len(body) == len(OSCILLATION[model].freedoms)
    assert all(0.6 < mode.frequency < 2.2 for mode in body)
    for mode in modes:
        assert max(abs(amplitude) for amplitude in mode.shape.values()) == pytest.approx(1.0)


def test_unknown_channel_lists_the_known():
    linear = linearise(build(load_vehicle("chapter3", "linear").without_friction(), "quarter_2dof"))
    with pytest.raises(InputError, match="did you mean 'wheel_load'"):
        linear.transfer("wheel_loads", {}, np.array([1.0]))


@pytest.mark.parametrize("characteristics", ["configuration_1", "configuration_2", "configuration_4"])
def test_modes_at_a_kink_are_the_mean_of_its_sides(characteristics):
    """The front axle carries the same at loads ko and full but for the last digits: so are its modes."""
    car = load_vehicle("s_class", characteristics).without_friction()
    ko, full = (linearise(build(car, "quarter_1dof", load, "front")).modes()[0] for load in ("ko", "full"))
    assert full.frequency == pytest.approx(ko.frequency, rel=0.01)
    assert full.damping == pytest.approx(ko.damping, rel=0.01)
