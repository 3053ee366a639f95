"""The car that drives freely under these manoeuvres: what must hold whatever its numbers are."""

from __future__ import annotations

import math

import numpy as np
import pytest

from evaluation.numbers import NUMBERS
from evaluation.numbers.steering_frequency import steering_response
from evaluation.numbers.turns import deviation, followed
from manoeuvres import (
    Acceleration,
    Braking,
    Bump,
    CrossSlope,
    Crosswind,
    LaneChange,
    RampSteer,
    RoadStep,
    SplitMu,
    SteadyCircle,
    StepSteer,
    SuspensionRig,
    SweptSteer,
    UnevenRoad,
)
from susp_mj import simulate
from vehicles import load_vehicle
from vehicles.mjcf import build


@pytest.fixture(scope="module")
def car():
    return load_vehicle("s_class", "configuration_4")


@pytest.fixture(scope="module")
def plant(car):
    return build(car, "handling")


@pytest.fixture(scope="module")
def rig(car):
    return build(car, "handling", rig="k_and_c")


def test_the_car_meets_a_bump_once_and_where_an_oscillation_model_does(plant, car):
    manoeuvre = Bump(height="40 mm", speed="72 km/h")
    run = simulate(plant, manoeuvre)
    other = simulate(build(car, "full_7dof"), manoeuvre)
    for station in ("fl", "rr"):
        road, expected = run[f"{station}_road_height"], other[f"{station}_road_height"]
        assert road.max() == pytest.approx(0.04, abs=1e-4)
        assert run.time[np.argmax(road)] == pytest.approx(other.time[np.argmax(expected)], abs=0.01)


def test_left_and_right_tracks_are_left_and_right(plant):
    run = simulate(plant, UnevenRoad(left_height="20 mm", right_height="-10 mm"))
    assert run["fl_road_height"].max() == pytest.approx(0.02, abs=1e-4)
    assert run["rr_road_height"].min() == pytest.approx(-0.01, abs=1e-4)


def test_a_road_under_the_wheels_alone_is_a_test_rig_for_a_standing_car(plant):
    run = simulate(plant, RoadStep(height="20 mm", duration=2.0))
    assert run["fl_road_height"][-1] == pytest.approx(0.02)
    assert np.abs(run["speed"]).max() < 0.1
    assert run["body_displacement"][-1] - run["body_displacement"][0] == pytest.approx(0.02, abs=1e-3)


@pytest.mark.parametrize("radius", [80.0, -80.0])
def test_the_driver_keeps_the_circle_round_after_round(plant, radius):
    run = simulate(plant, SteadyCircle(radius=radius, speed="50 km/h", increase=0.01, duration=45.0))
    assert run["yaw_angle"][-1] * math.copysign(1, radius) > 2 * math.pi, "more than a round"
    assert np.abs(deviation(run)).max() < 0.5
    assert followed(run) == len(run.time)
    assert run["lateral_acceleration"][-1] == pytest.approx(run["speed"][-1] ** 2 / radius, rel=0.03)


def test_circle_and_ramp_find_the_same_car(plant):
    ramp, circle = simulate(plant, RampSteer()), simulate(plant, SteadyCircle(duration=45.0, speed="40 km/h"))
    for number in (NUMBERS["understeer_gradient"], NUMBERS["roll_angle_at_4"]):
        assert number(circle).value == pytest.approx(number(ramp).value, rel=0.15), number.name


def test_a_turn_to_the_right_mirrors_one_to_the_left(plant):
    left, right = simulate(plant, RampSteer(duration=5.0)), simulate(plant, RampSteer(duration=5.0, rate="-25 deg/s"))
    for name in (
        "lateral_acceleration_max",
        "understeer_gradient",
        "roll_angle_at_4",
        "inner_wheel_load_front",
        "travel_left_rebound_front",
    ):
        assert NUMBERS[name](right).value == pytest.approx(NUMBERS[name](left).value, rel=5e-3), name


def test_step_and_sweep_agree_at_low_frequency(plant):
    """The steady yaw gain of a small step is the gain of the sweep at its low end, within what 0.26 Hz changes."""
    step = simulate(plant, StepSteer(angle="30 deg"))
    found = steering_response(simulate(plant, SweptSteer()), "yaw_rate")
    assert found.gain[0] == pytest.approx(NUMBERS["yaw_rate_gain"](step).value, rel=0.06)
    assert found.coherence.min() > 0.9


def test_the_lane_change_is_driven_without_a_cone_and_not_at_any_speed(plant):
    assert NUMBERS["cones_hit"](simulate(plant, LaneChange())).value == 0.0
    fast = simulate(plant, LaneChange(speed="120 km/h"))
    assert NUMBERS["cones_hit"](fast).value > 0.0


def test_brakes_and_engine(plant):
    run = simulate(plant, Braking(pedal=0.3))
    assert 2.0 < NUMBERS["braking_deceleration"](run).value < 8.0
    static = {station: load[0] for station, load in run.stations("wheel_load").items()}
    assert NUMBERS["braking_load_share_front"](run).value > (static["fl"] + static["fr"]) / sum(static.values())
    assert NUMBERS["braking_lateral_deviation"](run).value < 0.05
    run = simulate(plant, Acceleration())
    assert 4.0 < NUMBERS["acceleration_time_100"](run).value < 12.0
    assert NUMBERS["acceleration_distance_100"](run).value < NUMBERS["acceleration_time_100"](run).value * 100 / 3.6


@pytest.mark.parametrize(("side", "sign"), [("right", 1.0), ("left", -1.0)])
def test_the_car_turns_to_the_side_with_grip(plant, side, sign):
    run = simulate(plant, SplitMu(side=side, pedal=0.3, duration=2.5))
    assert sign * run["yaw_angle"][-1] > math.radians(1.0)
    steered = simulate(plant, SplitMu(side=side, pedal=0.3, duration=2.5, steered=True))
    assert abs(steered["yaw_angle"][-1]) < abs(run["yaw_angle"][-1])


def test_wind_and_slope_push_the_car_and_a_driver_holds_it(plant):
    for manoeuvre, sign in ((Crosswind(), 1.0), (Crosswind(wind=-20.0), -1.0), (CrossSlope(), -1.0)):
        run = simulate(plant, manoeuvre)
        assert sign * run["position_y"][-1] > 0.1
        held = simulate(plant, manoeuvre.model_copy(update={"steered": True}))
        assert abs(held["position_y"][-1]) < abs(run["position_y"][-1]) / 3


def test_the_rig_reads_back_what_the_vehicle_file_says(car, rig):
    """Bump steer, bump camber and the roll centre are the slopes of the axle's own tables; the ratio is the
    steering's."""
    run = simulate(rig, SuspensionRig())
    for axle in ("front", "rear"):
        table = car.axle(axle).kinematics
        near = np.abs(np.asarray(table.travel)) <= 0.03
        for name in ("bump_steer", "bump_camber"):
            values = np.asarray(table.toe if name == "bump_steer" else table.camber)
            values = values if values.ndim == 1 else values[:, values.shape[1] // 2]
            slope = np.polyfit(np.asarray(table.travel)[near], values[near], 1)[0]
            assert NUMBERS[f"{name}_{axle}"](run).value == pytest.approx(slope, rel=0.05), (name, axle)
        expected = table.roll_centre_height(car.axle(axle).track)
        assert NUMBERS[f"roll_centre_height_{axle}"](run).value == pytest.approx(expected, rel=0.05)
    assert NUMBERS["steering_ratio"](simulate(rig, SuspensionRig(test="steer"))).value == pytest.approx(
        car.steering.ratio, rel=0.02
    )


def test_roll_stiffness_on_the_rig_is_that_of_springs_and_bars(car, rig):
    """Within what the travel does to progressive springs: (k + c) t²/2."""
    run = simulate(rig, SuspensionRig(test="roll"))
    for axle in ("front", "rear"):
        part = car.axle(axle)
        bar = part.anti_roll_bar.rate if part.anti_roll_bar is not None else 0.0
        expected = (float(part.spring.rate_at(0.0)) + bar) * part.track**2 / 2
        assert NUMBERS[f"roll_stiffness_{axle}"](run).value == pytest.approx(expected, rel=0.12), axle
