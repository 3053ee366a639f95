"""Every oscillation model of an axle, a side or the whole car against an independent solver of small-angle
equations."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import cumulative_simpson

from manoeuvres import Bump, LateralForce, LongitudinalForce, RoadStep
from susp_mj import simulate
from vehicles import load_vehicle
from vehicles.mjcf import build

from ..builders.cars import LINEAR_CAR
from .reference import bump_road, step_road
from .reference_car import Car, Excitation, solve
from .thesis_cars import PLACES, S_CLASS

LINEAR_DATA = LINEAR_CAR.reference()
CARS = {"linear": LINEAR_DATA, **S_CLASS}
DURATION = 1.5
FINE = 2.5e-4
"""Step at which the integration of mount and damper plays no part."""
STEP, SPEED = 0.02, 15.0
STATIONS = ("fl", "fr", "rl", "rr", "front", "rear")


def on(stations, road):
    return Excitation(dict.fromkeys(stations, road))


def bump(car):
    """The rear axle of a car with two axles meets the bump later."""
    return Excitation({w.station: bump_road(0.03, 2.5, SPEED, 0.1 - w.x / SPEED) for w in car.wheels})


def rise(level):
    return step_road(level, 0.1, 0.2)


# name: manoeuvre of the product, the same for the reference
MANOEUVRES = {
    "step": (RoadStep(height=STEP, start=0.1, rise_time=0.03), lambda car: on(STATIONS, step_road(STEP, 0.1, 0.03))),
    "left step": (
        RoadStep(height=STEP, start=0.1, rise_time=0.03, wheels=("fl", "rl")),
        lambda car: on(("fl", "rl"), step_road(STEP, 0.1, 0.03)),
    ),
    "right drop": (
        RoadStep(height=-0.06, start=0.1, rise_time=0.02, wheels=("right",)),
        lambda car: on(("fr", "rr"), step_road(-0.06, 0.1, 0.02)),
    ),
    "bump": (Bump(height=0.03, length=2.5, speed=SPEED, start=0.1), bump),
    "lateral": (
        LateralForce(acceleration=4.0, start=0.1, rise_time=0.2),
        lambda car: Excitation({}, lateral=rise(4.0)),
    ),
    "right turn": (
        LateralForce(acceleration=-4.0, start=0.1, rise_time=0.2),
        lambda car: Excitation({}, lateral=rise(-4.0)),
    ),
    "hard turn": (
        LateralForce(acceleration=7.0, start=0.1, rise_time=0.2),
        lambda car: Excitation({}, lateral=rise(7.0)),
    ),
    "braking": (
        LongitudinalForce(acceleration=-5.0, start=0.1, rise_time=0.2),
        lambda car: Excitation({}, longitudinal=rise(-5.0)),
    ),
}
MODELS = [("axle_2dof", "front"), ("axle_2dof", "rear"), ("pitch_2dof", None), ("full_3dof", None)]
MODELS += [("axle_4dof", "front"), ("axle_4dof", "rear"), ("full_7dof", None)]
SIDES, LENGTH = ("axle_2dof", "full_3dof", "axle_4dof", "full_7dof"), ("pitch_2dof", "full_3dof", "full_7dof")
NEEDS = {"left step": SIDES, "lateral": SIDES, "braking": LENGTH}


def vehicle(name):
    """The product's car of a name in `CARS`."""
    return LINEAR_CAR.vehicle() if name == "linear" else load_vehicle("s_class", name, PLACES)


def histories(name, model, axle, load, manoeuvre, *, step=FINE, duration=DURATION):
    """The product's run (None: at the step it chooses by itself), the reference's history and the reference's car."""
    product, reference = MANOEUVRES[manoeuvre]
    plant = build(vehicle(name), model, load=load, axle=axle)
    every = None if step is None else round(1e-3 / step)
    run = simulate(plant, product.model_copy(update={"duration": duration}), step=step, record_every=every)
    car = Car.of(CARS[name], model, load, axle or "")
    expected = solve(car, reference(car), duration)
    np.testing.assert_allclose(run.time, expected.time, rtol=0, atol=1e-12)
    return run, expected, car


def deviations(run, expected, car):
    """Largest deviation of each channel over its range; over a scale of 10 mm, 10 mrad or 1 kN where nothing moves."""
    pairs = {"body_displacement": (expected.heave, 1e-2)}
    if "pitch" in car.freedoms:
        pairs["pitch_angle"] = (expected.pitch, 1e-2)
    if "roll" in car.freedoms:
        pairs["roll_angle"] = (expected.roll, 1e-2)
    for i, wheel in enumerate(car.wheels):
        pairs[f"{wheel.station}_wheel_load"] = (expected.load[:, i], 1e3)
        pairs[f"{wheel.station}_suspension_deflection"] = (expected.travel[:, i], 1e-2)
    found = {}
    for name, (values, scale) in pairs.items():
        span = np.ptp(values)
        found[name] = float(np.abs(run[name] - values).max() / (span if span > 1e-3 * scale else scale))
    return found


COMBINATIONS = [
    (name, model, axle, "ko", manoeuvre)
    for manoeuvre in ("step", "left step", "bump", "lateral", "braking")
    for model, axle in MODELS
    for name in ("linear", "configuration_3")
    if model in NEEDS.get(manoeuvre, (model,))
]
COMBINATIONS += [
    (name, model, axle, load, "left step" if model in SIDES else "bump")
    for model, axle in MODELS
    for name, load in (
        ("linear", "one_sided"),
        ("linear", "empty"),
        ("linear", "full"),
        ("configuration_4", "empty"),
        ("configuration_4", "full"),
    )
    if load != "one_sided" or model in SIDES
]
COMBINATIONS += [("linear", model, axle, "one_sided", "right turn") for model, axle in MODELS if model in SIDES]


@pytest.mark.parametrize(("name", "model", "axle", "load", "manoeuvre"), COMBINATIONS, ids=str)
def test_motion_and_wheel_loads(name, model, axle, load, manoeuvre):
    run, expected, car = histories(name, model, axle, load, manoeuvre)
    found = deviations(run, expected, car)
    assert max(found.values()) < (1e-6 if name == "linear" else 1e-3), found
    assert expected.load.min() > 0.0, "the wheels stay on the road"
    moved = expected.roll if "roll" in car.freedoms and manoeuvre not in ("step", "bump", "braking") else expected.heave
    assert np.ptp(moved) > 5e-3 or manoeuvre == "braking"


@pytest.mark.parametrize("name", ["linear", "configuration_3"])
@pytest.mark.parametrize("model", ["full_3dof", "full_7dof"])
def test_wheels_that_leave_the_road(name, model):
    """The right wheels drop off a kerb faster than they can follow, or than a massless one is pushed."""
    run, expected, car = histories(name, model, None, "ko", "right drop")
    assert (expected.load[:, 1] == 0.0).any()
    found = deviations(run, expected, car)
    assert max(value for channel, value in found.items() if "load" not in channel) < 1e-3, found
    for i, wheel in enumerate(car.wheels):
        load = run[f"{wheel.station}_wheel_load"]
        assert load.min() >= 0.0
        assert np.sqrt(np.mean((load - expected.load[:, i]) ** 2)) < 1e-3 * np.ptp(expected.load[:, i])
        assert abs(int((load == 0.0).sum()) - int((expected.load[:, i] == 0.0).sum())) <= 2


@pytest.mark.parametrize(("name", "model"), [(n, m) for n in S_CLASS for m in ("full_7dof", "full_3dof")])
def test_the_road_cannot_pull_in_a_turn(name, model):
    """Links and springs together lift an inner wheel; its load ends at zero, whatever share of it the links carry."""
    run, expected, car = histories(name, model, None, "ko", "hard turn", duration=1.0)
    assert (expected.load == 0.0).any()
    assert all(run[f"{wheel.station}_wheel_load"].min() >= 0.0 for wheel in car.wheels)
    found = deviations(run, expected, car)
    assert max(found.values()) < 1e-3, found


def test_a_massless_beam_stays_on_the_road_while_one_spring_seat_pulls():
    """The road cannot pull on a wheel; a seat inside the track may pull on the beam as long as both wheels press on the
    road."""
    drop = RoadStep(height=-0.035, start=0.1, rise_time=0.03, duration=0.6, wheels=("right",))
    run = simulate(build(vehicle("linear"), "axle_2dof", axle="rear"), drop, step=FINE, record_every=4)
    car = Car.of(LINEAR_DATA, "axle_2dof", "ko", "rear")
    expected = solve(car, on(("rr",), step_road(-0.035, 0.1, 0.03)), 0.6)
    assert expected.load.min() > 200.0
    narrow = 1.05 / 1.47  # a wheel's load is shared between the seats as (1 + b/t)/2 and (1 - b/t)/2
    seat = (expected.load[:, 1] * (1 + 1 / narrow) + expected.load[:, 0] * (1 - 1 / narrow)) / 2
    assert seat.min() < -50.0
    found = deviations(run, expected, car)
    assert max(found.values()) < 1e-6, found


@pytest.mark.parametrize("manoeuvre", ["step", "bump"])
@pytest.mark.parametrize(("model", "axle"), MODELS)
def test_the_default_step_is_short_enough(model, axle, manoeuvre):
    """The step that a user gets without asking resolves the mounts of the shipped car."""
    run, expected, car = histories("configuration_3", model, axle, "ko", manoeuvre, step=None, duration=0.8)
    found = deviations(run, expected, car)
    assert max(found.values()) < 1e-3, found


@pytest.mark.parametrize(("model", "axle"), MODELS)
def test_accelerations(model, axle):
    """Of the body, the wheels and the driver's seat; the seat of the shipped car lies 1.45 m behind the front axle,
    0.38 m left."""
    run, expected, car = histories("configuration_3", model, axle, "ko", "left step" if model in SIDES else "step")
    pitching, rolling = expected.pitch_acceleration, expected.roll_acceleration
    pairs = {"body_acceleration": expected.acceleration}
    if "pitch" in car.freedoms:
        pairs["pitch_acceleration"] = pitching
    if "roll" in car.freedoms:
        pairs["roll_acceleration"] = rolling
    if model.startswith("full"):
        pairs["seat_acceleration"] = expected.acceleration + 0.38 * rolling - (1.5572 - 1.45) * pitching
    for i, wheel in enumerate(car.wheels):
        if car.sprung_wheels:
            pairs[f"{wheel.station}_wheel_acceleration"] = expected.wheel_acceleration[:, i]
    for channel, values in pairs.items():
        assert np.ptp(values) > 0.01
        assert np.abs(run[channel] - values).max() < 3e-3 * np.ptp(values), channel


MIRROR = {"fl": "fr", "fr": "fl", "rl": "rr", "rr": "rl"}


@pytest.mark.parametrize("name", ["linear", "configuration_3"])
@pytest.mark.parametrize(("model", "axle"), [each for each in MODELS if each[0] in SIDES])
def test_left_and_right_mirror(name, model, axle):
    plant = build(vehicle(name), model, axle=axle)
    left, right = (simulate(plant, RoadStep(height=STEP, duration=1.0, wheels=(side,))) for side in ("left", "right"))
    assert np.ptp(left["roll_angle"]) > 5e-3
    for channel in set(left.channels) - {"seat_acceleration"}:  # the driver sits on one side
        station, _, quantity = channel.partition("_")
        other = f"{MIRROR[station]}_{quantity}" if station in MIRROR else channel
        sign = -1.0 if channel.startswith("roll") else 1.0
        scale = max(np.abs(left[channel]).max(), 1.0)
        np.testing.assert_allclose(right[other], sign * left[channel], rtol=0, atol=1e-12 * scale, err_msg=channel)


def test_energy_is_only_lost():
    """Once the road lies still, the energy of body, wheels, springs, bars and tyres falls by what the dampers take.

    The body sinks as it rolls about its axis.
    """
    step, end = 2.5e-4, 0.2
    manoeuvre = RoadStep(height=STEP, start=0.1, rise_time=end - 0.1, duration=4.0, wheels=("fl", "rr"))
    run = simulate(build(vehicle("linear"), "full_7dof"), manoeuvre, step=step)
    assert all(run[f"{s}_wheel_load"].min() > 0.0 for s in MIRROR)
    energy = 1500 * run["body_velocity"] ** 2 / 2 + 2500 * run["pitch_rate"] ** 2 / 2 + 620 * run["roll_rate"] ** 2 / 2
    above_axis = 1500 / 2.9 * (1.6 * (0.58 - 0.06) + 1.3 * (0.58 - 0.13))
    energy += 9.81 * (1500 * run["body_displacement"] - above_axis * run["roll_angle"] ** 2 / 2)
    taken = np.zeros_like(energy)
    for axle, data, length, other in (("f", LINEAR_DATA.front, 1.3, 1.6), ("r", LINEAR_DATA.rear, -1.6, 1.3)):
        preload, rate, damping = (
            1500 * 9.81 * other / 2.9 / 2,
            {"f": 24e3, "r": 21e3}[axle],
            {"f": 1900.0, "r": 2100.0}[axle],
        )
        for side, y in (("l", data.track / 2), ("r", -data.track / 2)):
            x, v = run[f"{axle}{side}_suspension_deflection"], run[f"{axle}{side}_suspension_speed"]
            wheel = run[f"{axle}{side}_wheel_displacement"]
            wheel_speed = run["body_velocity"] + y * run["roll_rate"] - length * run["pitch_rate"] + v
            energy += data.unsprung * (wheel_speed**2 / 2 + 9.81 * wheel) + preload * x + rate * x**2 / 2
            energy += run[f"{axle}{side}_wheel_load"] ** 2 / (2 * data.tyre)
            taken += cumulative_simpson(damping * v**2, dx=step, initial=0)
        twist = run[f"{axle}l_suspension_deflection"] - run[f"{axle}r_suspension_deflection"]
        energy += data.bar * twist**2 / 4
    after = run.time >= end
    left, lost = energy[after] - energy[-1], taken[after] - taken[after][0]
    assert left[0] > 5.0
    assert np.diff(left).max() <= 0.0
    np.testing.assert_allclose(left[0] - left, lost, rtol=0, atol=1e-7 * left[0])


def test_the_solver_agrees_with_another_method():
    """The yardstick itself."""
    car = Car.of(S_CLASS["configuration_3"], "full_7dof")
    excitation = on(("fl", "rl"), step_road(STEP, 0.1, 0.03))
    one, other = solve(car, excitation, 0.5), solve(car, excitation, 0.5, method="Radau", rtol=1e-7)
    for name in ("heave", "pitch", "roll", "load"):
        assert np.abs(getattr(one, name) - getattr(other, name)).max() < 2e-5 * np.ptp(getattr(one, name)), name
