"""Where two models describe the same motion, they must give it: each pair under the conditions that make the simpler
one exact."""

from __future__ import annotations

import numpy as np
import pytest

from manoeuvres import Bump, LateralForce, RoadStep
from susp_mj import simulate
from vehicles.mjcf import build

from ..builders.cars import STOPS, STOPS_OF_FILE, LinearAxle, LinearCar
from .reference import bump_road, constant_frequency_spring, constant_rate_spring, zoned_damper
from .reference_car import AxleData, Car, CarData, Excitation, solve

FRONT, REAR, ROLL = 1.25, 1.45, 620.0
MASS = 1500.0
CAR = LinearCar(
    wheelbase=2.7,
    wheel_radius=0.31,
    loads={"ko": (MASS, (-FRONT, 0.0, 0.27), (ROLL, MASS * FRONT * REAR, 3000.0))},
    front=LinearAxle(
        rate=24e3, damping=2600.0, unsprung=40.0, tyre=190e3, bar=9000.0, track=1.5, spring_base=1.5, roll_centre=0.06
    ),
    rear=LinearAxle(
        rate=24e3, damping=2800.0, unsprung=45.0, tyre=200e3, bar=4000.0, track=1.5, spring_base=1.1, roll_centre=0.13
    ),
)
DIGRESSIVE = {"kind": "zoned", "limits": [0.15], "ratio": "1:2"}
CURVED = {
    "front.damper": {**DIGRESSIVE, "rates": [2600.0, 1200.0]},
    "rear.damper": {**DIGRESSIVE, "rates": [2800.0, 1300.0]},
    "rear.spring": {"kind": "constant_frequency", "frequency": 1.3, "stops": STOPS_OF_FILE},
}
"""What is not linear about the car."""
STEP = RoadStep(height=0.03, start=0.1, rise_time=0.04, duration=1.5)
BUMP = Bump(height=0.04, length=2.5, speed=15.0, start=0.1, duration=1.5)
SLOW_STEP = RoadStep(height=0.02, start=0.1, rise_time=0.15, duration=1.0)
SLOW_LEFT_STEP = SLOW_STEP.model_copy(update={"wheels": ("left",)})


def car(**overrides):
    return CAR.vehicle(CURVED | {key.replace("__", "."): value for key, value in overrides.items()})


def apart(found, expected):
    """Largest deviation over the range of what is expected."""
    span = np.ptp(expected)
    assert span > 1e-3
    return np.abs(found - expected).max() / span


@pytest.mark.parametrize("manoeuvre", [STEP, BUMP], ids=["step", "bump"])
def test_a_car_whose_axles_decouple_is_two_quarter_cars(manoeuvre):
    """Jyy = m l1 l2 and a road equal left and right: OM7 over each axle moves as the OM5 of that axle."""
    vehicle = car()
    whole = simulate(build(vehicle, "full_7dof"), manoeuvre)
    for axle, ahead in (("front", FRONT), ("rear", -REAR)):
        delay = (0.0 if axle == "front" else 2.7 / 15.0) if manoeuvre is BUMP else 0.0
        later = manoeuvre.model_copy(update={"start": manoeuvre.start + delay})
        alone = simulate(build(vehicle, "quarter_2dof", axle=axle), later)
        over_axle = whole["body_displacement"] - ahead * whole["pitch_angle"]
        assert apart(over_axle, alone["body_displacement"]) < 1e-6
        for side in "lr":
            for quantity in ("wheel_load", "suspension_deflection", "wheel_displacement"):
                assert apart(whole[f"{axle[0]}{side}_{quantity}"], alone[quantity]) < 1e-6, quantity
    assert np.abs(whole["roll_angle"]).max() < 1e-12


def test_the_axles_couple_with_another_pitch_inertia():
    """The counterpart: the test above can tell."""
    vehicle = car(**{"loads.ko.inertia": [620.0, 2400.0, 3000.0]})
    whole, alone = (
        simulate(build(vehicle, model, axle=axle), STEP)
        for model, axle in (("full_7dof", None), ("quarter_2dof", "front"))
    )
    assert apart(whole["body_displacement"] - FRONT * whole["pitch_angle"], alone["body_displacement"]) > 1e-3


def side_of(pitch_inertia):
    """The left half of the car in the reference: half the body, two wheels with mass, heave and pitch."""
    front = AxleData(
        lambda preload: constant_rate_spring(preload, 24e3),
        zoned_damper([2600, 1200], [0.15], 1, 2),
        STOPS,
        unsprung=40.0,
        tyre=190e3,
    )
    rear = AxleData(
        lambda preload: constant_frequency_spring(preload, 1.3),
        zoned_damper([2800, 1300], [0.15], 1, 2),
        STOPS,
        unsprung=45.0,
        tyre=200e3,
    )
    data = CarData(2.7, 0.31, {"ko": (MASS, (-FRONT, 0.0, 0.27), (ROLL, pitch_inertia))}, front, rear)
    side = Car.of(data, "full_7dof")
    left = tuple(wheel for wheel in side.wheels if wheel.y > 0)
    middle = tuple(type(wheel)(**{**vars(wheel), "y": 0.0, "bar": 0.0}) for wheel in left)
    return Car(
        MASS / 2, (1.0, pitch_inertia / 2), (-FRONT, 0.0), 0.58, ("z", "pitch"), middle, sprung_wheels=True, beam=False
    )


def test_a_symmetric_car_is_twice_its_side():
    """OM7 on a road equal left and right against a half car of four degrees of freedom."""
    whole = simulate(build(car(**{"loads.ko.inertia": [620.0, 2300.0, 3000.0]}), "full_7dof"), BUMP)
    half = solve(
        side_of(2300.0),
        Excitation({"fl": bump_road(0.04, 2.5, 15.0, 0.1), "rl": bump_road(0.04, 2.5, 15.0, 0.1 + 2.7 / 15.0)}),
        1.5,
    )
    assert apart(whole["body_displacement"], half.heave) < 1e-4
    assert apart(whole["pitch_angle"], half.pitch) < 1e-4
    for i, axle in enumerate("fr"):
        assert apart(whole[f"{axle}l_wheel_load"], half.load[:, i]) < 1e-4
        np.testing.assert_allclose(whole[f"{axle}r_wheel_load"], whole[f"{axle}l_wheel_load"], rtol=0, atol=1e-8)


@pytest.mark.parametrize("manoeuvre", [STEP, BUMP], ids=["step", "bump"])
def test_a_side_on_massless_wheels_is_half_a_symmetric_car(manoeuvre):
    """OM3 = OM4 on a road equal left and right."""
    vehicle = car(**{"loads.ko.inertia": [620.0, 2300.0, 3000.0]})
    side, whole = (simulate(build(vehicle, model), manoeuvre) for model in ("pitch_2dof", "full_3dof"))
    for quantity in ("body_displacement", "pitch_angle", "body_acceleration"):
        np.testing.assert_allclose(whole[quantity], side[quantity], rtol=0, atol=1e-10)
    for axle in ("front", "rear"):
        for corner in (f"{axle[0]}l", f"{axle[0]}r"):
            np.testing.assert_allclose(whole[f"{corner}_wheel_load"], side[f"{axle}_wheel_load"], rtol=0, atol=1e-6)
    assert np.abs(whole["roll_angle"]).max() < 1e-12


@pytest.mark.parametrize("axle", ["front", "rear"])
def test_a_massless_car_whose_axles_decouple_is_two_quarter_cars(axle):
    """Jyy = m l1 l2: OM4 over each axle moves as OM1."""
    vehicle = car()
    whole, alone = (
        simulate(build(vehicle, "full_3dof"), STEP),
        simulate(build(vehicle, "quarter_1dof", axle=axle), STEP),
    )
    ahead = FRONT if axle == "front" else -REAR
    assert apart(whole["body_displacement"] - ahead * whole["pitch_angle"], alone["body_displacement"]) < 1e-7
    assert apart(whole[f"{axle[0]}l_wheel_load"], alone["wheel_load"]) < 1e-7


@pytest.mark.parametrize(("beam", "four_wheels"), [("axle_4dof", "full_7dof"), ("axle_2dof", "full_3dof")])
def test_an_axle_is_a_car_whose_rear_cannot_hold_it_upright(beam, four_wheels):
    """OM6 and OM2 front, springs at the wheels, against OM7 and OM4 on three wheels, so to speak.

    A beam with its mass in the wheels is two single wheels. The car gets the front axle's share of roll inertia as a
    whole, a rear track of 0.1 mm without a bar (no roll stiffness), a rear roll centre at the height of the centre of
    gravity (the rear's share of the mass does not topple) and Jyy = m l1 l2, so that the rear takes no part.
    """
    manoeuvre = STEP.model_copy(update={"wheels": ("fl",)})
    axle = simulate(build(car(), beam, axle="front"), manoeuvre)
    tricycle = car(
        **{
            "loads.ko.inertia": [ROLL * REAR / (FRONT + REAR), 2718.75, 3000.0],
            "rear.track": 1e-4,
            "rear.spring_base": 1e-4,
            "rear.anti_roll_bar.rate": 0.0,
            "rear.roll_centre_height": 0.58,
        }
    )
    whole = simulate(build(tricycle, four_wheels), manoeuvre)
    assert apart(whole["roll_angle"], axle["roll_angle"]) < 1e-6
    assert apart(whole["body_displacement"] - FRONT * whole["pitch_angle"], axle["body_displacement"]) < 1e-6
    for corner in ("fl", "fr"):
        assert apart(whole[f"{corner}_wheel_load"], axle[f"{corner}_wheel_load"]) < 1e-6


STIFF, LIGHT = 4e7, 0.4


@pytest.mark.parametrize(
    ("simple", "full", "axle", "manoeuvre"),
    [
        ("quarter_1dof", "quarter_2dof", "front", SLOW_STEP),
        ("quarter_1dof", "quarter_2dof", "rear", SLOW_STEP),
        ("axle_2dof", "axle_4dof", "front", SLOW_LEFT_STEP),
        ("axle_2dof", "axle_4dof", "rear", SLOW_LEFT_STEP),
        ("full_3dof", "full_7dof", None, SLOW_LEFT_STEP),
        ("full_3dof", "full_7dof", None, LateralForce(start=0.1, duration=1.0)),
    ],
)
def test_stiff_tyres_and_light_wheels_are_no_tyres(simple, full, axle, manoeuvre):
    """OM5, OM6 and OM7 tend to OM1, OM2 and OM4: the body's difference is small, and falls as the compliance of the
    tyre does."""
    step = 5e-5
    expected = simulate(build(car(), simple, axle=axle), manoeuvre, step=step, record_every=20)
    moved = [
        name
        for name in ("body_displacement", "roll_angle")
        if name in expected.channels and np.ptp(expected[name]) > 2e-3
    ]
    loads = [name for name in expected.channels if name.endswith("wheel_load")]
    difference = {}
    for softer in (1.0, 4.0):
        tyre = {f"{each}.tyre.rate": STIFF / softer for each in ("front", "rear")}
        light = {f"{each}.unsprung_mass": LIGHT for each in ("front", "rear")}
        found = simulate(build(car(**tyre, **light), full, axle=axle), manoeuvre, step=step, record_every=20)
        difference[softer] = {name: apart(found[name], expected[name]) for name in moved}
        if softer == 1.0:
            for name in loads:  # on average: the wheel still rings where a slope jumps
                assert np.sqrt(np.mean((found[name] - LIGHT * 9.81 - expected[name]) ** 2)) < 1e-3 * np.ptp(
                    expected[name]
                ), name
    assert moved
    for name in moved:
        assert difference[1.0][name] < 2e-3
        assert difference[4.0][name] / difference[1.0][name] == pytest.approx(4.0, rel=0.1)
