"""The energy balance closes: what the road puts in is stored, or spent in damper, mount and friction."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import cumulative_simpson

from manoeuvres import Bump, RoadStep
from susp_mj import simulate
from vehicles import load_vehicle
from vehicles.mjcf import build

MS, MU, G, KT, K1 = 483.5, 39.5, 9.81, 176e3, 400e3
STEP = 2.5e-4


def work(force, speed):
    """Integral of force times speed over time, from 0."""
    return cumulative_simpson(force * speed, dx=STEP, initial=0)


def road_speed(manoeuvre, plant, time):
    return manoeuvre.drive(plant.meaning.inputs[0], time)[1]


def spring_energy(case, x):
    """Energy [J] stored since x = 0 in the spring between its stops, by its closed form."""
    w2 = (2 * np.pi * 1.2) ** 2
    if case == "nonlinear":
        return 4743 * G / w2 * (np.exp(w2 * x / G) - 1)
    return 4743 * x + 4743 / G * w2 * x**2 / 2


@pytest.mark.parametrize("case", ["linear", "nonlinear", "soft_linear"])
def test_sprung_wheel(case):
    plant = build(load_vehicle("chapter3", case), "quarter_2dof")
    manoeuvre = Bump(duration=2.0)
    run = simulate(plant, manoeuvre, step=STEP)
    body, body_speed = run["body_displacement"], run["body_velocity"]
    x, v = run["suspension_deflection"], run["suspension_speed"]
    wheel, wheel_speed = run["wheel_displacement"], body_speed + v
    load = run["wheel_load"]
    assert np.abs(x).max() < 0.1, "the closed form of the stored energy holds between the stops"

    kinetic = MS * body_speed**2 / 2 + MU * wheel_speed**2 / 2
    potential = G * (MS * body + MU * wheel) + spring_energy(case, x) + load**2 / (2 * KT)
    stored = kinetic + potential
    supplied = work(load, road_speed(manoeuvre, plant, run.time))
    lost = work(run["damper_force"], v) + work(run["friction_force"], v)
    balance = stored - stored[0] - supplied + lost
    scale = np.abs(stored - stored[0]).max()
    assert scale > 100.0
    assert np.abs(balance).max() < 5e-6 * scale

    # of the damper's work, the mount keeps F²/2k1 and the rod spends the rest, at every instant
    mount = run["damper_force"] ** 2 / (2 * K1)
    rod_speed = np.gradient(x - run["damper_force"] / K1, STEP)
    spent = work(run["damper_force"], v) - mount
    assert spent[-1] > 10.0
    assert np.all(np.diff(spent) > -1e-8 * scale)
    assert np.all(run["damper_force"] * rod_speed > -1e-9)
    assert np.all(run["friction_force"] * v >= 0.0)


@pytest.mark.parametrize("manoeuvre", [RoadStep(duration=2.0), Bump(height=0.03, duration=2.0)], ids=["step", "bump"])
@pytest.mark.parametrize("case", ["linear", "nonlinear"])
def test_massless_wheel(case, manoeuvre):
    plant = build(load_vehicle("chapter3", case), "quarter_1dof")
    run = simulate(plant, manoeuvre, step=STEP)
    x, v = run["suspension_deflection"], run["suspension_speed"]
    assert run["wheel_load"].min() > 0.0
    stored = MS * run["body_velocity"] ** 2 / 2 + MS * G * run["body_displacement"] + spring_energy(case, x)
    supplied = work(run["wheel_load"], road_speed(manoeuvre, plant, run.time))
    lost = work(run["damper_force"], v) + work(run["friction_force"], v)
    scale = np.abs(stored - stored[0]).max()
    assert np.abs(stored - stored[0] - supplied + lost).max() < 1e-4 * scale


def test_an_undamped_car_keeps_its_energy():
    """No damper to speak of: after the road is flat again the energy stays, for a hundred periods of the wheel."""
    vehicle = load_vehicle(
        "chapter3", "linear", {"rear.friction": None, "rear.damper": {"kind": "zoned", "rates": [1e-9]}}
    )
    run = simulate(build(vehicle, "quarter_2dof"), Bump(height=0.03, duration=10.0), step=5e-4)
    wheel_speed = run["body_velocity"] + run["suspension_speed"]
    stored = (
        MS * run["body_velocity"] ** 2 / 2
        + MU * wheel_speed**2 / 2
        + G * (MS * run["body_displacement"] + MU * run["wheel_displacement"])
        + spring_energy("linear", run["suspension_deflection"])
        + run["wheel_load"] ** 2 / (2 * KT)
    )
    assert run["wheel_load"].min() > 0.0
    after = stored[run.time > 0.4] - stored[0]
    assert after[0] > 10.0
    assert np.ptp(after) < 1e-5 * after[0]
