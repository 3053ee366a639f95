"""Steady lateral acceleration on linear springs: roll angle and load transfer against statics by hand."""

from __future__ import annotations

import math

import numpy as np
import pytest

from manoeuvres import LateralForce
from susp_mj import simulate
from vehicles.mjcf import build

from ..builders.cars import LinearAxle, LinearCar

# sprung mass, height of its centre of gravity over the ground, roll centres, distances of the axles, track, roll
# stiffnesses
M, H, ZF, ZR, A, B, T, KF, KR, AY, G = 1913.0, 0.6459, 0.08, 0.12, 1.5572, 1.5238, 1.4, 50e3, 34e3, 7.0, 9.81
MF, MR = M * B / (A + B), M * A / (A + B)
ABOVE = (MF * (H - ZF) + MR * (H - ZR)) / M
# the closed form's figures: roll in degrees, load moved from left to right on each axle
PHI, DF, DR = 5.676213497441539, 3916.617178909782, 2986.0735093769254
CAR = LinearCar(
    wheelbase=A + B,
    wheel_radius=0.32,
    loads={"ko": (M, (-A, 0.0, H - 0.32), (769.0, 3928.0, 4315.0))},
    front=LinearAxle(rate=2 * KF / T**2, damping=6000.0, track=T, roll_centre=ZF),
    rear=LinearAxle(rate=2 * KR / T**2, damping=6000.0, track=T, roll_centre=ZR),
)


def by_hand(front, rear, acceleration=AY):
    """Roll angle [rad] and load transfer of each axle [N] from the roll stiffnesses: ``K phi = m h (a_y + g phi)``."""
    phi = M * ABOVE * acceleration / (front + rear - M * G * ABOVE)
    return phi, (front * phi + MF * acceleration * ZF) / T, (rear * phi + MR * acceleration * ZR) / T


def steady(model, axle=None, acceleration=AY, **overrides):
    """Roll angle and transfers at the end of a run that has come to rest."""
    vehicle = CAR.vehicle({key.replace("__", "."): value for key, value in overrides.items()})
    turn = LateralForce(acceleration=acceleration, duration=8.0, rise_time=1.0)
    run = simulate(build(vehicle, model, axle=axle), turn)
    assert np.abs(run["roll_acceleration"][-500:]).max() < 1e-6
    transfer = {
        each[0]: (run[f"{each[0]}r_wheel_load"][-1] - run[f"{each[0]}l_wheel_load"][-1]) / 2
        for each in ("front", "rear")
        if f"{each[0]}l_wheel_load" in run.channels
    }
    assert min(run[name][-1] for name in run.channels if name.endswith("wheel_load")) > 100.0
    return run["roll_angle"][-1], transfer


def test_by_hand_is_the_closed_form():
    phi, front, rear = by_hand(KF, KR)
    assert math.degrees(phi) == pytest.approx(PHI, rel=1e-9)
    assert (front, rear) == pytest.approx((DF, DR), rel=1e-9)


def test_massless_wheels():
    phi, moved = steady("full_3dof")
    assert math.degrees(phi) == pytest.approx(PHI, rel=1e-6)
    assert (moved["f"], moved["r"]) == pytest.approx((DF, DR), rel=1e-6)


def test_stiff_tyres():
    """The closed form knows no tyres: within 2 % on tyres a hundred times as stiff as the springs."""
    phi, moved = steady("full_7dof", front__tyre__rate=5e6, rear__tyre__rate=5e6)
    assert math.degrees(phi) == pytest.approx(PHI, rel=0.02)
    assert (moved["f"], moved["r"]) == pytest.approx((DF, DR), rel=0.02)
    assert math.degrees(phi) > PHI


@pytest.mark.parametrize("acceleration", [AY - 2.0, -AY + 2.0], ids=["left turn", "right turn"])
def test_tyres_in_series(acceleration):
    """With tyres each side gives way twice; the links tilt the wheels' line on the tyres besides.

    Axle by axle, d the load moved and f the part of it that passes through the springs: tyres tilt by ``2 d / (k_t
    t)``, springs by ``2 f / (k t)`` on top, and ``d = f + m a_y z / t``. Both axles share one roll angle.
    """
    tyre = 176e3 * T**2 / 2
    series = [1 / (1 / tyre + 1 / k) for k in (KF, KR)]
    links = [MF * acceleration * ZF, MR * acceleration * ZR]
    # spring moment of an axle: series * (phi - links / tyre)
    lost = sum(k * link / tyre for k, link in zip(series, links, strict=True))
    phi = (M * ABOVE * acceleration + lost) / (sum(series) - M * G * ABOVE)
    expected = [(k * (phi - link / tyre) + link) / T for k, link in zip(series, links, strict=True)]
    found, moved = steady("full_7dof", acceleration=acceleration)
    assert found == pytest.approx(phi, rel=1e-3)
    assert (moved["f"], moved["r"]) == pytest.approx(tuple(expected), rel=1e-3)


@pytest.mark.parametrize(("model", "tolerance"), [("full_3dof", 1e-8), ("full_7dof", 1e-3)])
@pytest.mark.parametrize("bar", [0.0, 8000.0])
def test_all_of_the_overturning_moment_reaches_the_ground(model, tolerance, bar):
    """``dFz_f t + dFz_r t = m a_y h + m g h_ra phi``, whatever springs and bars do with it."""
    phi, moved = steady(model, acceleration=5.0, rear__anti_roll_bar__rate=bar)
    assert (moved["f"] + moved["r"]) * T == pytest.approx(M * 5.0 * H + M * G * ABOVE * phi, rel=tolerance)


@pytest.mark.parametrize("model", ["full_3dof", "full_7dof"])
def test_a_bar_moves_load_to_its_axle(model):
    """A bar of rate c adds the roll stiffness ``c t²/2`` to its axle alone."""
    phi, moved = steady(
        model, acceleration=4.0, front__tyre__rate=5e6, rear__tyre__rate=5e6, rear__anti_roll_bar__rate=10e3
    )
    expected = by_hand(KF, KR + 10e3 * T**2 / 2, 4.0)
    tolerance = 1e-6 if model == "full_3dof" else 0.02
    assert (phi, moved["f"], moved["r"]) == pytest.approx(expected, rel=tolerance)
    assert moved["f"] < by_hand(KF, KR, 4.0)[1]


@pytest.mark.parametrize("base", [1.4, 1.0])
@pytest.mark.parametrize(("model", "tolerance"), [("axle_2dof", 1e-6), ("axle_4dof", 0.02)])
def test_rigid_axle(model, tolerance, base):
    """The front axle alone: springs at the spring base, roll stiffness ``k b²/2``, the bar at the wheels."""
    rate = 70e3
    overrides = {
        "front__spring_base": base,
        "front__spring__rate": rate,
        "front__anti_roll_bar__rate": 12e3,
        "front__tyre__rate": 5e6,
    }
    phi, moved = steady(model, axle="front", acceleration=4.0, **overrides)
    stiffness = rate * base**2 / 2 + 12e3 * T**2 / 2
    expected = MF * (H - ZF) * 4.0 / (stiffness - MF * G * (H - ZF))
    assert phi == pytest.approx(expected, rel=tolerance)
    assert moved["f"] == pytest.approx((stiffness * expected + MF * 4.0 * ZF) / T, rel=tolerance)
