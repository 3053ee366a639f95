"""Channels by names that do not depend on the model."""

from __future__ import annotations

import numpy as np
import pytest

from evaluation.channels import channel_of
from manoeuvres import StepSteer, UnevenRoad
from susp_mj import InputError, simulate
from susp_mj.names import stand_ins
from vehicles import load_vehicle
from vehicles.mjcf import build
from vehicles.models import MODELS, OSCILLATION


def driven(model, axle=None):
    plant = build(load_vehicle("s_class", "configuration_4"), model, axle=axle)
    return simulate(plant, UnevenRoad(duration=0.6, left_height=0.03, right_height=0.01))


def test_what_stands_for_a_station():
    assert stand_ins("fl", ("fl", "front")) == ("fl",)
    assert stand_ins("fl", ("front", "rear")) == ("front",)
    assert stand_ins("front", ("fl", "fr", "rl", "rr")) == ("fl", "fr")
    assert stand_ins("front", ("fl", "rl")) == ()
    assert stand_ins("rr", ("",)) == ("",)


@pytest.mark.parametrize("model", MODELS)
def test_one_name_is_found_in_every_model(model):
    one = model != "handling" and OSCILLATION[model].axles == 1
    for axle in ("front", "rear") if one else (None,):
        run = driven(model, axle)
        for station in ("fl", "front", "rr", "rear"):
            for quantity in ("suspension_deflection", "body_acceleration"):
                if one and not station.startswith(axle[0]):
                    with pytest.raises(InputError, match=f"no channel '{station} {quantity}'"):
                        channel_of(run, f"{station} {quantity}")
                    continue
                found = channel_of(run, f"{station} {quantity}")
                assert found.values.shape == run.time.shape and found.quantity == quantity
                assert bool(found.note) == (f"{station}_{quantity}" not in run)


def test_a_name_of_the_run_itself_is_taken_as_it_is():
    run = driven("full_7dof")
    found = channel_of(run, "fl_suspension_deflection")
    assert found.values is run["fl_suspension_deflection"] and not found.note
    np.testing.assert_array_equal(channel_of(run, "fl suspension_deflection").values, found.values)
    mean = channel_of(run, "front suspension_deflection")
    np.testing.assert_allclose(
        mean.values, (run["fl_suspension_deflection"] + run["fr_suspension_deflection"]) / 2, atol=1e-15
    )
    assert "the mean of fl_suspension_deflection and fr_suspension_deflection" in mean.note


def test_a_point_of_the_body_moves_as_the_suspension_says():
    """Without a tyre the wheel follows the road: body = road less deflection, up to where it began."""
    run = driven("full_3dof")
    for station in ("fl", "rr"):
        above = channel_of(run, f"{station} body_displacement").values
        expected = run[f"{station}_road_height"] - run[f"{station}_suspension_deflection"]
        np.testing.assert_allclose(above - above[0], expected - expected[0], atol=1e-9)
        second = channel_of(run, f"{station} body_acceleration").values
        speed = channel_of(run, f"{station} body_velocity").values
        np.testing.assert_allclose(np.gradient(speed, run.time)[2:-2], second[2:-2], atol=0.05 * np.ptp(second))


def test_angular_accelerations_of_the_handling_car_are_rates_of_its_rates():
    run = simulate(build(load_vehicle("s_class"), "handling"), StepSteer(duration=1.5, angle=1.2))
    for angle in ("pitch", "roll"):
        rate = np.gradient(run[f"{angle}_rate"], run.time)
        acceleration = run[f"{angle}_acceleration"]
        np.testing.assert_allclose(rate[1:-1], acceleration[1:-1], atol=5e-3 * np.ptp(acceleration))


def test_an_unknown_name_lists_the_choices():
    with pytest.raises(InputError, match="no channel 'fl suspension_deflexion'; did you mean"):
        channel_of(driven("full_3dof"), "fl suspension_deflexion")
