"""Every model of every car: the written file moves the same, the callbacks act on names a reader knows."""

from __future__ import annotations

import numpy as np
import pytest

from manoeuvres import Bump, LateralForce
from susp_mj import InputError, Plant, simulate
from vehicles import load_vehicle
from vehicles.mjcf import OSCILLATION, build, write


@pytest.mark.parametrize("model", OSCILLATION)
def test_a_written_model_moves_bit_for_bit_the_same(model, tmp_path):
    car = load_vehicle("s_class", "configuration_3")
    plant = build(car, model, "full")
    again = Plant.from_mjcf(write(car, model, tmp_path / f"{model}.xml", "full"))
    assert again.meaning == plant.meaning
    first, second = (simulate(each, Bump(height=0.03, speed=20.0, duration=0.6)) for each in (plant, again))
    assert list(first) == list(second)
    for name in first:
        np.testing.assert_array_equal(first[name], second[name], err_msg=name)


@pytest.mark.parametrize("model", OSCILLATION)
def test_parts_carry_the_names_of_their_corners(model):
    plant = build(load_vehicle("s_class", "configuration_3"), model)
    names = [plant.model.actuator(i).name for i in range(plant.model.nu)]
    for station in (travel.station for travel in plant.meaning.travels):
        prefix = f"{station}_" if station else ""
        assert {f"{prefix}spring", f"{prefix}stop", f"{prefix}damper", f"{prefix}friction"} <= set(names)


def test_left_and_right_bars_are_equal_and_opposite():
    run = simulate(build(load_vehicle("s_class", "configuration_3"), "full_7dof"), LateralForce(acceleration=3.0))
    for left, right in (("fl", "fr"), ("rl", "rr")):
        np.testing.assert_allclose(run[f"{left}_bar_force"], -run[f"{right}_bar_force"], atol=1e-9)
    rate = load_vehicle("s_class", "configuration_3").axle("front").anti_roll_bar.rate
    difference = run["fl_suspension_deflection"] - run["fr_suspension_deflection"]
    np.testing.assert_allclose(run["fl_bar_force"], rate * difference / 2, atol=1e-6)


def test_a_bar_torn_from_its_other_half_is_refused(tmp_path):
    path = write(load_vehicle("s_class", "configuration_3"), "full_3dof", tmp_path / "car.xml")
    text = path.read_text().splitlines()
    (first,) = (i for i, line in enumerate(text) if 'name="fr_spring"' in line)
    text.insert(first, '    <motor name="mine" joint="heave"/>')
    path.write_text("\n".join(text))
    with pytest.raises(InputError, match=r"fl_bar.*partner"):
        Plant.from_mjcf(path)


@pytest.mark.parametrize(
    ("model", "change", "text"),
    [
        ("full_7dof", {"wheelbase": None}, "wheelbase"),
        ("axle_2dof", {"rear.track": None}, "rear.track"),
        ("quarter_2dof", {"rear.unsprung_mass": None}, "rear.unsprung_mass"),
        ("quarter_2dof", {"rear.tyre": None}, "rear.tyre"),
    ],
)
def test_a_missing_value_is_named(model, change, text):
    car = load_vehicle("s_class", "configuration_3", change)
    with pytest.raises(InputError, match=text):
        build(car, model)


def test_a_quarter_car_cannot_be_a_whole_one():
    with pytest.raises(InputError, match=r"chapter3.toml: loads.ko: model full_3dof needs sprung_mass|no axle 'front'"):
        build(load_vehicle("chapter3", "linear"), "full_3dof")
