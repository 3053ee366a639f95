"""The car that drives freely against closed forms: single-track model, lateral load transfer, energy, symmetry,
straight running."""

from __future__ import annotations

import json
import math
from pathlib import Path

import mujoco
import numpy as np
import pytest

from susp_mj.simulation import simulate
from vehicles.mjcf import HANDLING, build
from vehicles.reading import load_vehicle

from ..builders.cars import PlainCar
from ..builders.manoeuvres import Driven

FORMS = {form["id"]: form for form in json.loads((Path(__file__).parent / "closed_forms.json").read_text())}
RATIO = PlainCar.ratio
CARS = [("s_class", "configuration_3"), ("s_class", "configuration_5"), ("bmw_320i", None)]


def turn(angle: float, rise: float = 0.5, start: float = 0.5):
    """Steering wheel input that brings the front wheels to `angle` [rad] and holds them there."""
    return {"steering_wheel_angle": [(start, 0.0), (start + rise, RATIO * angle)]}


# ---- single-track model


@pytest.fixture(scope="module")
def bicycle():
    given = FORMS["bicycle_2090"]["inputs"]
    car = PlainCar(
        mass=given["m"],
        yaw_inertia=given["Iz"],
        front=given["a"],
        rear=given["b"],
        cornering=(given["Cf"], given["Cr"]),
    )
    return build(car.vehicle(), HANDLING)


def test_the_plain_car_has_the_single_track_models_mass_and_yaw_inertia(bicycle):
    given, model = FORMS["bicycle_2090"]["inputs"], bicycle.model
    assert model.body_subtreemass[1] == pytest.approx(given["m"], rel=1e-5)
    bodies = range(1, model.nbody)
    place = np.zeros((model.nbody, 3))
    for body in range(2, model.nbody):
        place[body] = place[model.body_parentid[body]] + model.body_pos[body]
    middle = sum(model.body_mass[b] * place[b] for b in bodies) / given["m"]
    about_z = sum(model.body_inertia[b][2] + model.body_mass[b] * np.sum((place[b] - middle)[:2] ** 2) for b in bodies)
    assert about_z == pytest.approx(given["Iz"], rel=1e-3)
    front = place[model.body("fl_carrier").id][0] - middle[0]
    assert front == pytest.approx(given["a"], abs=1e-4)


def test_yaw_lateral_and_side_slip_gain_of_the_single_track_model(bicycle):
    expected = FORMS["bicycle_2090"]["expected"]
    angle = 0.008
    run = simulate(bicycle, Driven(duration=5.0, speed=20.0, inputs=turn(angle)))
    assert abs(run["lateral_acceleration"]).max() < 1.0
    assert run["yaw_rate"][-1] / angle == pytest.approx(expected["yaw_gain"], rel=2e-3)
    assert run["lateral_acceleration"][-1] / angle == pytest.approx(expected["ay_gain"], rel=2e-3)
    assert run["side_slip_angle"][-1] / angle == pytest.approx(expected["beta_gain"], rel=5e-3)


@pytest.mark.parametrize("speed", [10.0, 30.0, 40.0])
def test_understeer_gradient_of_the_single_track_model(bicycle, speed):
    expected = FORMS["bicycle_2090"]["expected"]["K_us_rad_per_ms2"]
    given = FORMS["bicycle_2090"]["inputs"]
    angle = 0.003
    run = simulate(bicycle, Driven(duration=8.0, speed=speed, inputs=turn(angle)))
    curvature = run["yaw_rate"][-1] / run["speed"][-1]
    gradient = (angle - (given["a"] + given["b"]) * curvature) / run["lateral_acceleration"][-1]
    assert gradient == pytest.approx(expected, rel=5e-3)


def test_step_response_follows_the_single_track_model_in_time():
    """Yaw rate and side slip of the linear two-state model, integrated on its own, with the tyres' relaxation length as
    a lag.

    Stiff springs: the body must not roll, or its centre of gravity moves sideways over the wheels.
    """
    from scipy.integrate import solve_ivp

    g, v, angle, sigma = FORMS["bicycle_2090"]["inputs"], 20.0, 0.006, 0.05
    inputs = turn(angle, rise=0.2)
    stiff = PlainCar(
        mass=g["m"], yaw_inertia=g["Iz"], front=g["a"], rear=g["b"], cornering=(g["Cf"], g["Cr"]), height=0.33,
        wheel_rate=(1e6, 1e6), damping=(3e4, 3e4), tyre_rate=3e6,
    )  # fmt: skip
    run = simulate(build(stiff.vehicle(), HANDLING), Driven(duration=3.0, speed=v, inputs=inputs))

    moments, angles = np.array(inputs["steering_wheel_angle"]).T

    def rates(t, state):
        beta, r, front, rear = state
        steer = float(np.interp(t, moments, angles)) / RATIO
        fy, ry = -g["Cf"] * front, -g["Cr"] * rear
        return [
            (fy + ry) / (g["m"] * v) - r,
            (g["a"] * fy - g["b"] * ry) / g["Iz"],
            (v * (beta + g["a"] * r / v - steer) - v * front) / sigma,
            (v * (beta - g["b"] * r / v) - v * rear) / sigma,
        ]

    expected = solve_ivp(rates, (0, 3), [0, 0, 0, 0], t_eval=run.time, rtol=1e-8, atol=1e-10, max_step=0.01).y
    for name, values in (("side_slip_angle", expected[0]), ("yaw_rate", expected[1])):
        assert np.abs(run[name] - values).max() < 0.01 * np.abs(values).max(), name


# ---- roll and load transfer


def test_roll_and_load_transfer_of_the_closed_form():
    """Light wheels of little inertia (their gyroscopic moment is no part of the formula), stiff tyres, straight wheel
    paths."""
    form = FORMS["load_transfer"]
    g, expected = form["inputs"], form["expected"]
    wheels = 4 * 2.0
    car = PlainCar(
        mass=g["m"] + wheels,
        unsprung=2.0,
        wheel_inertia=0.05,
        front=(g["m"] * g["a"] + wheels / 2 * (g["a"] + g["b"])) / (g["m"] + wheels),
        rear=(g["m"] * g["b"] + wheels / 2 * (g["a"] + g["b"])) / (g["m"] + wheels),
        height=(g["m"] * g["h"] + wheels * PlainCar.RADIUS) / (g["m"] + wheels),
        track=g["tf"],
        roll_centre=(g["zf"], g["zr"]),
        wheel_rate=(2 * g["Kf"] / g["tf"] ** 2, 2 * g["Kr"] / g["tr"] ** 2),
        tyre_rate=1e7,
        cornering=(150000.0, 150000.0),
        damping=(6000.0, 5000.0),
    )
    run = simulate(build(car.vehicle(), HANDLING), Driven(duration=8.0, speed=20.0, inputs=turn(0.0531, rise=2.0)))
    share = g["ay"] / run["lateral_acceleration"][-1]
    assert share == pytest.approx(1.0, abs=0.02)
    assert math.degrees(run["roll_angle"][-1]) * share == pytest.approx(expected["phi_deg"], rel=0.02)
    for axle, transfer in (("f", expected["dFz_f"]), ("r", expected["dFz_r"])):
        found = (run[f"{axle}r_wheel_load"][-1] - run[f"{axle}l_wheel_load"][-1]) / 2
        assert found * share == pytest.approx(transfer, rel=0.02)


def test_a_turning_wheel_tilts_the_car_by_its_gyroscopic_moment():
    """Heavier wheels by 4 dJ: the load transfer grows by ``4 dJ w r / t``, w their speed and r the yaw rate."""
    runs = []
    for inertia in (0.05, 3.05):
        car = PlainCar(wheel_inertia=inertia, wheel_rate=(4e5, 4e5), tyre_rate=1e6, damping=(2e4, 2e4))
        plant = build(car.vehicle(), HANDLING)
        runs.append(simulate(plant, Driven(duration=6.0, speed=20.0, inputs=turn(0.02))))
    transfer = [sum(run[f"{a}r_wheel_load"][-1] - run[f"{a}l_wheel_load"][-1] for a in "fr") / 2 for run in runs]
    moment = 4 * 3.0 * runs[1]["fl_wheel_speed"][-1] * runs[1]["yaw_rate"][-1]
    assert (transfer[1] - transfer[0]) * PlainCar.track == pytest.approx(moment, rel=0.05)


# ---- energy


def test_coast_down_of_the_plain_car_balances():
    """Kinetic energy lost = work of air, rolling resistance, engine and sliding, 0.5 % over ten seconds."""
    resistance, drag = 0.012, 0.3
    vehicle = PlainCar(rolling_resistance=resistance, drag=drag).vehicle()
    run = simulate(build(vehicle, HANDLING), Driven(duration=10.0, speed=30.0, control=0.0))
    spin = {c: run[f"{c}_wheel_speed"] for c in ("fl", "fr", "rl", "rr")}
    speed = run["longitudinal_velocity"]
    kinetic = PlainCar.mass * speed**2 / 2 + sum(PlainCar.wheel_inertia * w**2 / 2 for w in spin.values())
    air = 1.225 * 2.0 / 2 * drag * speed**3
    power = -air
    for corner, w in spin.items():
        radius = getattr(vehicle, "front" if corner[0] == "f" else "rear").handling_tyre.radius
        power = power + run[f"{corner}_drive_torque"] * w - resistance * radius * run[f"{corner}_wheel_load"] * w
        power = power - run[f"{corner}_longitudinal_force"] * (speed - w * radius)
    work = float(np.sum((power[1:] + power[:-1]) / 2) * run.step)
    lost = kinetic[-1] - kinetic[0]
    assert lost < -1e5
    assert work == pytest.approx(lost, rel=0.005)


@pytest.mark.parametrize(("name", "characteristics"), CARS)
def test_coast_down_of_the_cars_balances(name, characteristics):
    vehicle = load_vehicle(name, characteristics)
    plant = build(vehicle, HANDLING)
    run = simulate(plant, Driven(duration=10.0, speed=30.0, control=0.0))
    speed, air = run["longitudinal_velocity"], vehicle.aerodynamics
    assert air is not None
    mass = plant.model.body_subtreemass[1]
    kinetic, power = mass * speed**2 / 2, -air.density * air.area / 2 * air.drag * speed**3
    every = slice(None, None, 10)
    power = power[every]
    for corner in ("fl", "fr", "rl", "rr"):
        axle = getattr(vehicle, "front" if corner[0] == "f" else "rear")
        tyre = axle.handling_tyre.mounted("LEFT" if corner[1] == "l" else "RIGHT")
        w = run[f"{corner}_wheel_speed"]
        kinetic = kinetic + axle.wheel_inertia * w**2 / 2
        channels = ("slip_ratio", "slip_angle", "camber_angle", "wheel_load", "steer_angle")
        kappa, alpha, camber, load, steer = (run[f"{corner}_{each}"][every] for each in channels)
        at = [
            tyre.evaluate(k, math.tan(a), c, z, rolling=v)
            for k, a, c, z, v in zip(kappa, alpha, camber, load, speed[every], strict=True)
        ]
        rolling = np.array([each.rolling_moment for each in at])
        radius = np.array([each.rolling_radius for each in at])
        along, across = run[f"{corner}_longitudinal_force"][every], run[f"{corner}_lateral_force"][every]
        forward, sideways = speed[every] * np.cos(steer), -speed[every] * np.sin(steer)
        power = power + run[f"{corner}_drive_torque"][every] * w[every] + rolling * w[every]
        power = power + along * (forward - w[every] * radius) + across * sideways
    work = float(np.sum((power[1:] + power[:-1]) / 2) * run.step * 10)
    lost = kinetic[-1] - kinetic[0]
    assert lost < -5e4
    assert work == pytest.approx(lost, rel=0.005)


# ---- drive shafts and brakes


def test_a_drive_shaft_turns_the_wheel_and_a_brake_the_carrier_too():
    """At given slips, thus at given forces of the road, all that a drive shaft does is turn its wheel: a wheel that
    spins up on ice lifts nothing. A brake holds the carrier by its torque T, which adds ``T theta'`` to the travel,
    theta the carrier's turn over the travel.
    """
    from susp_mj.compiled import install

    vehicle = load_vehicle("s_class", "configuration_4")
    plant = build(vehicle, HANDLING)
    model = plant.model
    install(plant.laws)

    def applied(engine: float, brake: float) -> np.ndarray:
        data = mujoco.MjData(model)
        data.qvel[0] = 15.0
        for corner in ("fl", "fr", "rl", "rr"):
            data.qvel[model.joint(f"{corner}_spin").dofadr[0]] = 15.0 / 0.33
            data.act[model.actuator_actadr[model.actuator(f"{corner}_tyre").id] + 2] = 1.0
        data.act[model.actuator_actadr[model.actuator("engine").id]] = engine
        data.ctrl[model.actuator("brake").id] = brake
        mujoco.mj_forward(model, data)
        return np.array([data.qfrc_applied[model.joint(f"rl_{part}").dofadr[0]] for part in ("travel", "spin")])

    rest, driven, braked = applied(150.0, 0.0), applied(250.0, 0.0), applied(150.0, 0.5)
    assert driven[1] - rest[1] > 1000.0
    assert driven[0] == rest[0]
    torque = rest[1] - braked[1]
    assert vehicle.brakes is not None
    assert vehicle.rear is not None
    assert torque == pytest.approx(0.5 * vehicle.brakes.torque * (1 - vehicle.brakes.front_share) / 2, rel=1e-9)
    kinematics = vehicle.rear.kinematics
    assert kinematics is not None
    origin = kinematics.travel.index(0.0)
    turn = (
        np.gradient(kinematics.path("longitudinal_centre") - kinematics.path("longitudinal"), kinematics.travel)[origin]
        / 0.316
    )
    assert abs(turn) > 0.1
    assert braked[0] - rest[0] == pytest.approx(torque * turn, rel=2e-3)


# ---- straight and mirrored


@pytest.mark.parametrize(("name", "characteristics"), CARS)
@pytest.mark.parametrize("speed", [5.0, 20.0, 45.0])
def test_straight_running_is_steady_from_the_first_instant(name, characteristics, speed):
    run = simulate(build(load_vehicle(name, characteristics), HANDLING), Driven(duration=3.0, speed=speed))
    assert np.abs(run["yaw_angle"]).max() < 1e-10
    assert np.abs(run["position_y"]).max() < 1e-9
    assert np.abs(run["speed"] - speed).max() < 1e-9
    for channel in (
        "roll_angle",
        "pitch_angle",
        "body_displacement",
        "fl_wheel_load",
        "rr_suspension_deflection",
        "engine_speed",
    ):
        assert np.ptp(run[channel]) < 1e-7 * max(1.0, abs(run[channel][0])), channel
    for channel in ("body_acceleration", "lateral_acceleration", "longitudinal_acceleration"):
        assert np.abs(run[channel]).max() < 1e-7, channel


MIRRORED = {
    "lateral_acceleration": -1,
    "yaw_rate": -1,
    "roll_angle": -1,
    "body_displacement": 1,
    "speed": 1,
    "position_y": -1,
}
MIRRORED_WHEELS = {
    "wheel_load": 1,
    "suspension_deflection": 1,
    "slip_angle": -1,
    "camber_angle": -1,
    "lateral_force": -1,
    "longitudinal_force": 1,
}


@pytest.mark.parametrize(("name", "characteristics"), CARS)
def test_left_and_right_turns_mirror(name, characteristics):
    plant = build(load_vehicle(name, characteristics), HANDLING)
    left, right = (
        simulate(plant, Driven(duration=4.0, speed=20.0, inputs={"steering_wheel_angle": [(0.5, 0.0), (0.7, angle)]}))
        for angle in (1.4, -1.4)
    )
    assert abs(left["lateral_acceleration"]).max() > 5.0
    pairs = [(name, name, sign) for name, sign in MIRRORED.items()]
    for quantity, sign in MIRRORED_WHEELS.items():
        pairs += [
            (f"{a}_{quantity}", f"{b}_{quantity}", sign)
            for a, b in (("fl", "fr"), ("fr", "fl"), ("rl", "rr"), ("rr", "rl"))
        ]
    for one, other, sign in pairs:
        size = max(1.0, float(np.abs(left[one]).max()))
        assert np.abs(left[one] - sign * right[other]).max() < 1e-9 * size, one


def test_the_same_run_twice_is_the_same_bit_for_bit():
    plant = build(load_vehicle("s_class", "configuration_3"), HANDLING)
    manoeuvre = Driven(duration=2.0, speed=20.0, inputs={"steering_wheel_angle": [(0.2, 0.0), (0.4, 1.5)]})
    one, other = simulate(plant, manoeuvre), simulate(plant, manoeuvre)
    for channel in one:
        np.testing.assert_array_equal(one[channel], other[channel], err_msg=channel)


def test_halving_the_step_converges():
    """Fourth order cannot be expected of characteristics with kinks; an error that falls with the step can."""
    plant = build(load_vehicle("s_class", "configuration_4"), HANDLING)
    manoeuvre = Driven(duration=3.0, speed=20.0, inputs={"steering_wheel_angle": [(0.5, 0.0), (0.7, 1.48)]})
    runs = [simulate(plant, manoeuvre, step=1e-3 / n, record_every=n) for n in (1, 2, 8)]
    for channel in ("lateral_acceleration", "roll_angle", "side_slip_angle", "fl_wheel_load"):
        size = np.ptp(runs[2][channel])
        errors = [np.abs(run[channel] - runs[2][channel]).max() / size for run in runs[:2]]
        assert errors[0] < 5e-4, channel
        assert errors[1] < 0.6 * errors[0] or errors[1] < 2e-5, channel
