"""Classical Runge-Kutta shows its order: half the step, a sixteenth of the error."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from susp_mj import simulate
from vehicles.mjcf import build

from ..builders.cars import LinearQuarterCar
from ..builders.manoeuvres import SmoothBump

CAR = LinearQuarterCar(damping=1500.0)


@pytest.mark.parametrize(("model", "tyre"), [("quarter_2dof", CAR.tyre), ("quarter_1dof", None)])
def test_fourth_order(model, tyre):
    car = replace(CAR.reference(), tyre=tyre)
    plant = build(CAR.vehicle(), model)
    manoeuvre = SmoothBump()
    road = manoeuvre.reference()
    times = np.linspace(0.2, 1.4, 13)
    exact = solve_ivp(
        lambda t, s: car.rates(s, road.height(t), road.rate(t))[0],
        (0, 1.5),
        car.at_rest(),
        method="DOP853",
        t_eval=times,
        rtol=2e-13,
        atol=1e-15,
        max_step=2e-3,
    ).y[0]
    errors = []
    for step in (4e-3, 2e-3, 1e-3):
        run = simulate(plant, manoeuvre, step=step)
        places = np.round(times / step).astype(int)
        errors.append(np.abs(run["body_displacement"][places] - exact).max())
    ratios = np.array(errors[:-1]) / np.array(errors[1:])
    assert np.all((ratios > 12) & (ratios < 20)), (errors, ratios)
    assert errors[-1] < 1e-7


def test_free_decay_is_the_matrix_exponential():
    """The linear quarter car after the road has moved: ``exp(A t)`` carries one state into the next."""
    plant = build(CAR.vehicle(), "quarter_2dof")
    run = simulate(plant, SmoothBump(duration=2.0, centre=0.5, width=0.08), step=5e-4)
    k, c, kt, ms, mu = CAR.rate, CAR.damping, CAR.tyre, CAR.sprung, CAR.unsprung
    # state: body, wheel, their velocities, as departures from rest
    matrix = np.array(
        [[0, 0, 1, 0], [0, 0, 0, 1], [-k / ms, k / ms, -c / ms, c / ms], [k / mu, -(k + kt) / mu, c / mu, -c / mu]],
        dtype=float,
    )
    body = run["body_displacement"] - run["body_displacement"][0]
    wheel = run["wheel_displacement"] - run["wheel_displacement"][0]
    speeds = run["body_velocity"], run["body_velocity"] + run["suspension_speed"]
    begin = 2000  # 1 s, six widths behind the middle of the bump: the road is flat to 1e-19 m
    state = np.array([body[begin], wheel[begin], speeds[0][begin], speeds[1][begin]])
    assert np.abs(state[:2]).max() > 1e-3, "the car still moves"
    for later in (2100, 2500, 3000, 4000):
        expected = expm(matrix * 5e-4 * (later - begin)) @ state
        np.testing.assert_allclose(
            [body[later], wheel[later], speeds[0][later], speeds[1][later]], expected, rtol=0, atol=1e-9
        )
