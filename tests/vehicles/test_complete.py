"""Cars in a load case: settled once, balanced, and in the handling model the same for both wheels of an axle."""

from __future__ import annotations

import numpy as np
import pytest

from susp_mj.elements import GRAVITY
from susp_mj.handling.block import table, tables
from vehicles import Vehicle, load_vehicle
from vehicles.complete import CompleteCar, LoadedCar
from vehicles.mjcf import HANDLING, MODELS, build

CARS = {name: load_vehicle(name) for name in ("s_class", "bmw_320i")}
LOADS = [(name, load) for name, car in CARS.items() for load in car.loads]


@pytest.mark.parametrize(("name", "load"), LOADS)
def test_the_axles_carry_the_body(name, load):
    car = LoadedCar.of(CARS[name], load, ("front", "rear"))
    front, rear = (2 * axle.corner_mass for axle in car.axles)
    assert front + rear == pytest.approx(car.body.mass, rel=1e-12)
    assert rear * car.wheelbase == pytest.approx(-car.body.cg[0] * car.body.mass, rel=1e-12)


@pytest.mark.parametrize("name", CARS)
def test_in_the_design_position_spring_and_tyre_carry_what_stands_on_them(name):
    """In every load case: a load changes the masses, not the elements."""
    for load in CARS[name].loads:
        for axle in LoadedCar.of(CARS[name], load, ("front", "rear")).axles:
            unsprung = axle.unsprung_mass * GRAVITY
            assert float(axle.values.tyre.evaluate(0.0)) == pytest.approx(axle.static_load, rel=1e-12)
            spring = float(axle.values.spring.force_at(0.0))
            assert spring == pytest.approx(axle.static_load - unsprung, rel=0.05)


@pytest.mark.parametrize(("name", "load"), LOADS)
def test_a_complete_car_stands_on_pressed_in_tyres(name, load):
    car = CompleteCar.of(CARS[name], load)
    for axle in car.axles:
        pressed_in = axle.handling_tyre.radius - axle.hub_height
        assert pressed_in * axle.handling_tyre.vertical_stiffness == pytest.approx(axle.static_load, rel=1e-12)
    hubs = sorted(axle.hub_height for axle in car.axles)
    assert hubs[0] <= car.cg_height - car.body.cg[2] <= hubs[1]


def test_a_quarter_car_has_no_body_of_its_own():
    car = LoadedCar.of(load_vehicle("chapter3"), "ko", ("rear",))
    assert (car.body, car.wheelbase, car.axles[0].corner_mass) == (None, 0.0, 483.5)


@pytest.mark.parametrize("model", MODELS)
def test_a_model_settles_each_of_its_axles_once(model, monkeypatch):
    settled = []
    settle = Vehicle.axle
    monkeypatch.setattr(Vehicle, "axle", lambda car, name: settled.append(name) or settle(car, name))
    build(CARS["s_class"], model)
    assert len(settled) == len(set(settled))


def test_both_wheels_of_an_axle_read_the_same_tables():
    wheels = build(CARS["s_class"], HANDLING).car.wheels
    for name in ("path", "angles", "swing", "elastic_lateral", "elastic_longitudinal", "elastic_aligning"):
        places = wheels[name]
        assert places[0] == places[1] and places[2] == places[3], name


@pytest.mark.parametrize("smooth", [True, False])
@pytest.mark.parametrize("points", [2, 3, 5, 21])
def test_tables_made_together_are_those_made_one_by_one(points, smooth):
    random = np.random.default_rng(points)
    places, curves = np.cumsum(random.uniform(0.01, 0.05, points)), random.normal(size=(4, 2, points))
    for together, alone in zip(tables(places, curves, smooth=smooth), curves, strict=True):
        np.testing.assert_array_equal(together, table(places, *alone, smooth=smooth))
