"""Manoeuvres of a car that drives freely: what its driver does, the road it meets, and lanes as the standard has
them."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from design.case import available_cases, load_case, read_manoeuvre
from design.script import case_from_arguments
from manoeuvres import (
    MANOEUVRES,
    Acceleration,
    Braking,
    BrakingInTurn,
    Bump,
    CrossSlope,
    Crosswind,
    LaneChange,
    RampSteer,
    RandomRoad,
    SineSteer,
    SplitMu,
    SteadyCircle,
    StepSteer,
    SuspensionRig,
    SweptSteer,
    UnevenRoad,
    VerticalSweep,
    find_manoeuvre,
)
from manoeuvres.driving import Driving
from manoeuvres.lane_change import CONE
from manoeuvres.sweeping import Sweep
from susp_mj import InputError
from susp_mj.description import validate
from susp_mj.features import Course
from susp_mj.meaning import Input

ROOT = Path(__file__).parents[2]
GERMAN = {
    "zuziehen": RampSteer,
    "lenkwinkelsprung": StepSteer,
    "lenksweep": SweptSteer,
    "lenkeinsinus": SineSteer,
    "kreisfahrt": SteadyCircle,
    "beschleunigung": Acceleration,
    "bremsen": Braking,
    "bremsen_in_der_kurve": BrakingInTurn,
    "mu_split": SplitMu,
    "seitenwind": Crosswind,
    "querneigung": CrossSlope,
    "doppelter_fahrspurwechsel": LaneChange,
    "kennwerte": SuspensionRig,
}


def place(quantity, station="", x=0.0, y=0.0):
    return Input(quantity, station, x, y, ())


def value(manoeuvre, quantity, time, **where):
    return manoeuvre.drive(place(quantity, **where), np.atleast_1d(np.asarray(time, float)))[0]


DRIVING = [kind for kind, manoeuvre in MANOEUVRES.items() if issubclass(manoeuvre, Driving)]


@pytest.mark.parametrize("kind", DRIVING)
def test_a_driving_manoeuvre_says_what_the_speed_controller_does(kind):
    manoeuvre = MANOEUVRES[kind]()
    begin = np.array([0.0])
    assert value(manoeuvre, "speed_target", begin)[0] == pytest.approx(manoeuvre.driving_speed())
    assert value(manoeuvre, "speed_control", begin)[0] == 1.0


@pytest.mark.parametrize("kind", ["bump", "uneven_road", "random_road"])
def test_a_road_is_driven_at_its_speed_too(kind):
    manoeuvre = MANOEUVRES[kind]()
    assert value(manoeuvre, "speed_target", 1.0)[0] == manoeuvre.speed == manoeuvre.driving_speed()
    assert value(manoeuvre, "speed_control", 1.0)[0] == 1.0


def test_a_sweep_of_the_road_is_a_rig_for_a_standing_car():
    assert VerticalSweep(speed=20.0).driving_speed() == 0.0


@pytest.mark.parametrize(("german", "manoeuvre"), GERMAN.items())
def test_german_names(german, manoeuvre):
    assert MANOEUVRES[find_manoeuvre(german)] is manoeuvre


def test_the_thesis_names_are_scripts():
    for german in ("zuziehen", "lenkwinkelsprung", "lenksweep", "lenkeinsinus"):
        script = ROOT / "manoeuvres" / f"{german}.py"
        assert f'manoeuvre_script("{find_manoeuvre(german)}")' in script.read_text()
        result = subprocess.run(
            [sys.executable, str(script), "--help"], capture_output=True, text=True, timeout=60, check=False
        )
        words = " ".join(result.stdout.split())
        assert result.returncode == 0 and "--speed" in words and "(default handling)" in words


def test_models_that_scripts_take_by_themselves():
    assert MANOEUVRES["ramp_steer"].default_model == MANOEUVRES["suspension_rig"].default_model == "handling"
    assert MANOEUVRES["bump"].default_model == "quarter_2dof"
    assert MANOEUVRES["lateral_force"].default_model == "full_3dof"
    case = case_from_arguments("ramp_steer", []).case
    assert case.model == "handling"
    assert [(each.vehicle, each.characteristics) for each in case.configuration] == [
        ("s_class", "configuration_3"),
        ("s_class", "configuration_4"),
    ]
    case = case_from_arguments("bump", ["-m", "handling", "-c", "configuration_5"]).case
    assert [(each.vehicle, each.characteristics) for each in case.configuration] == [("s_class", "configuration_5")]
    assert case_from_arguments("bump", []).case.configuration[0].vehicle == "chapter3"


@pytest.mark.parametrize("name", [name for name in available_cases() if name.startswith("handling_")])
def test_shipped_cases_are_understood(name):
    case, path = load_case(name)
    assert case.model == "handling"
    read_manoeuvre(case.manoeuvre, path)


def test_every_driving_manoeuvre_has_a_case():
    kinds = {
        find_manoeuvre(load_case(name)[0].manoeuvre["kind"])
        for name in available_cases()
        if name.startswith("handling_")
    }
    missing = sorted({*DRIVING, "bump", "suspension_rig"} - kinds)
    assert not missing, "add " + ", ".join(f"design/cases/handling_{kind}.toml" for kind in missing)


def test_a_model_that_cannot_steer_is_refused_in_one_line():
    with pytest.raises(
        InputError, match="model full_7dof has no input 'steering_wheel_angle', which manoeuvre ramp_steer drives"
    ):
        RampSteer().check([place("road_height")], "full_7dof")
    with pytest.raises(InputError, match="no input 'lateral_force', which test 'lateral_force' drives"):
        SuspensionRig(test="lateral_force").check([place("heave_target")], "mine")


# ---- steering


def test_ramp():
    ramp = RampSteer(rate="25 deg/s", start=0.5, limit="100 deg")
    angles = np.degrees(value(ramp, "steering_wheel_angle", [0.0, 0.5, 1.5, 4.4, 4.6, 8.0]))
    np.testing.assert_allclose(angles, [0, 0, 25, 97.5, 100, 100], atol=1e-9)
    left = RampSteer(rate="-25 deg/s")
    assert np.degrees(value(left, "steering_wheel_angle", 2.5)[0]) == pytest.approx(-50)


def test_step_and_its_return():
    step = StepSteer(angle="85 deg", rate="500 deg/s", hold=2.0)
    assert step.rise_time == pytest.approx(0.17)
    times = [0.5, 0.585, 0.67, 2.0, 2.67, 2.755, 2.84, 6.0]
    np.testing.assert_allclose(
        np.degrees(value(step, "steering_wheel_angle", times)), [0, 42.5, 85, 85, 85, 42.5, 0, 0], atol=1e-9
    )
    assert np.degrees(value(StepSteer(), "steering_wheel_angle", 6.0)[0]) == pytest.approx(85)


def test_one_sine_and_no_more():
    sine = SineSteer(amplitude="60 deg", frequency="0.5 Hz")
    np.testing.assert_allclose(
        np.degrees(value(sine, "steering_wheel_angle", [0.5, 1.0, 1.5, 2.0, 2.5, 3.0])),
        [0, 60, 0, -60, 0, 0],
        atol=1e-9,
    )
    two = SineSteer(amplitude="60 deg", frequency="0.5 Hz", periods=2)
    assert np.degrees(value(two, "steering_wheel_angle", 3.0)[0]) == pytest.approx(60)


@pytest.mark.parametrize("linear", [False, True])
def test_the_phase_is_the_integral_of_the_frequency(linear):
    sweep = Sweep(0.2, 2.8, 30.0, linear)
    time = np.linspace(0, 30, 300001)
    frequency, phase = sweep.frequency(time), sweep.phase(time)
    assert frequency[[0, -1]] == pytest.approx([0.2, 2.8])
    integral = np.concatenate([[0.0], np.cumsum(np.pi * (frequency[1:] + frequency[:-1]) * np.diff(time))])
    np.testing.assert_allclose(phase, integral, rtol=0, atol=1e-6)


def test_steering_sweep_fades_in_and_out():
    sweep = SweptSteer(amplitude="30 deg")
    time = np.linspace(0, 60, 60001)
    angle = np.degrees(value(sweep, "steering_wheel_angle", time))
    assert np.abs(angle).max() == pytest.approx(30, abs=0.05)
    assert np.abs(angle[time > 58.0]).max() < 1e-9, "straight while the response dies away"
    assert np.abs(angle[(time > 10) & (time < 57)]).max() == pytest.approx(30, abs=0.05)
    kept = sweep.record(time)
    assert kept["excitation_frequency"][-1] == pytest.approx(2.8)
    with pytest.raises(InputError, match="must lie above start_frequency") as caught:
        validate(SweptSteer, {"start_frequency": 3})
    assert caught.value.key == "end_frequency"
    with pytest.raises(InputError, match="leave half of the run"):
        validate(SweptSteer, {"duration": 3})


def test_the_circle_s_speed_raises_the_lateral_acceleration_evenly():
    circle = SteadyCircle(radius="-60 m", speed="20 km/h", increase=0.2, start=5.0, limit=6.0)
    time = np.linspace(0, 80, 8001)
    acceleration = value(circle, "speed_target", time) ** 2 / 60.0
    begin = (20 / 3.6) ** 2 / 60
    np.testing.assert_allclose(acceleration, np.minimum(begin + 0.2 * np.maximum(time - 5, 0), 6.0), rtol=1e-12)
    assert circle.driver().path.radius == -60.0
    for fields, key in (({"radius": 2}, "radius"), ({"speed": 60, "radius": 50}, "speed")):
        with pytest.raises(InputError) as caught:
            validate(SteadyCircle, fields)
        assert caught.value.key == key


# ---- pedals, wind, ground


def test_pedals():
    np.testing.assert_allclose(
        value(Braking(pedal=0.4), "brake_pedal", [0.5, 0.6, 0.7, 5.0]), [0, 0.2, 0.4, 0.4], atol=1e-12
    )
    np.testing.assert_allclose(value(Braking(), "speed_control", [0.5, 0.6, 0.7, 5.0]), [1, 0.5, 0, 0], atol=1e-12)
    np.testing.assert_allclose(
        value(Acceleration(pedal=0.8), "accelerator", [0.5, 0.6, 0.7]), [0, 0.4, 0.8], atol=1e-12
    )
    turn = BrakingInTurn(angle="40 deg", brake_start=5.0, pedal=0.2)
    assert value(turn, "brake_pedal", 4.9)[0] == 0.0 and value(turn, "brake_pedal", 5.3)[0] == pytest.approx(0.2)
    assert np.degrees(value(turn, "steering_wheel_angle", 8.0)[0]) == pytest.approx(40)
    for fields in ({"brake_start": 1.0}, {"brake_start": 12.0}, {"pedal": 1.2}):
        with pytest.raises(InputError):
            validate(BrakingInTurn, fields)


@pytest.mark.parametrize(("side", "low", "high"), [("right", -20.0, 0.0), ("left", 0.0, 20.0)])
def test_slippery_side(side, low, high):
    manoeuvre = SplitMu(side=side, speed=20.0, start=0.5, friction=0.25)
    (patch,) = manoeuvre.road().patches
    assert (patch.x[0], patch.y, patch.friction) == (10.0, (low, high), 0.25)
    assert manoeuvre.road().shown == (patch,)
    assert manoeuvre.driver() is None
    assert SplitMu(steered=True).driver() is not None


def test_gust_is_as_long_as_its_zone():
    """The integral of the wind over the way is wind times length, flanks included."""
    gust = Crosswind(wind=-15.0, length=30.0, flank=4.0, speed=25.0)
    time = np.linspace(0, 5, 50001)
    wind = value(gust, "wind_y", time)
    assert wind.min() == pytest.approx(-15.0) and wind[0] == wind[-1] == 0.0
    assert np.trapezoid(wind, time) * 25.0 == pytest.approx(-15.0 * 30.0, rel=1e-6)
    moved = time[np.abs(wind) > 1e-9] * 25.0
    assert moved[0] == pytest.approx(12.5, abs=0.1) and moved[-1] == pytest.approx(12.5 + 34.0, abs=0.1)
    with pytest.raises(InputError, match="must not exceed the length"):
        validate(Crosswind, {"length": 2.0})


def test_cross_slope_begins_level():
    manoeuvre = CrossSlope(slope=0.03, speed=20.0, start=0.5, transition=20.0)
    road = manoeuvre.road()
    lean = (road.height[:, 1] - road.height[:, 0]) / (road.y[1] - road.y[0])
    np.testing.assert_allclose(lean[road.x <= 10.0], 0.0, atol=1e-15)
    np.testing.assert_allclose(lean[road.x >= 30.0], 0.03, rtol=1e-12)
    assert np.interp(20.0, road.x, lean) == pytest.approx(0.015, rel=1e-3)


# ---- roads: the same by time for an oscillation model and by place for a car that drives


def height_on(road, x, y):
    column = 0 if len(road.y) == 1 else int(np.argmin(np.abs(road.y - y)))
    return np.interp(x, road.x, road.height[:, column])


@pytest.mark.parametrize(
    "manoeuvre", [Bump(speed=22.0), UnevenRoad(speed=22.0), RandomRoad(speed=22.0, duration=5.0, shortest=1.0)]
)
@pytest.mark.parametrize(("x", "y"), [(0.0, 0.7), (-3.081, 0.7), (-3.081, -0.7)])
def test_road_by_place_is_the_road_by_time(manoeuvre, x, y):
    time = np.linspace(0.0, manoeuvre.duration, 4001)
    by_time = value(manoeuvre, "road_height", time, x=x, y=y)
    by_place = height_on(manoeuvre.road(), 22.0 * time + x, y)
    assert np.ptp(by_time) > 0.005
    np.testing.assert_allclose(by_place, by_time, rtol=0, atol=0.01 * np.abs(by_time).max())


def test_a_road_ends_level():
    for road in (Bump().road(), UnevenRoad().road()):
        assert np.abs(road.height[[0, 1, -2, -1]]).max() == 0.0
        np.testing.assert_allclose(np.diff(road.x), road.x[1] - road.x[0], rtol=1e-9)
    with pytest.raises(InputError, match="20 km"):
        RandomRoad(duration=2000.0).road()


# ---- ISO 3888-1


@pytest.mark.parametrize("width", [1.7, 2.0])
def test_lanes_of_iso_3888_1(width):
    manoeuvre = LaneChange(vehicle_width=width, speed=20.0, start=0.5)
    first, second, third = manoeuvre.lanes
    begin = 10.0
    assert [lane.x[0] - begin for lane in manoeuvre.lanes] == [0.0, 45.0, 95.0]
    assert [lane.x[1] - lane.x[0] for lane in manoeuvre.lanes] == [15.0, 25.0, 15.0]
    for lane, share in zip(manoeuvre.lanes, (1.1, 1.2, 1.3), strict=True):
        assert lane.y[1] - lane.y[0] == pytest.approx(share * width + 0.25)
    assert first.centre == pytest.approx(0.0)
    assert second.y[0] - first.y[0] == pytest.approx(3.5)
    assert third.y[0] == pytest.approx(first.y[0])


def test_cones_stand_outside_their_lanes():
    manoeuvre = LaneChange()
    (cones, path) = manoeuvre.road().features
    assert len(cones.points) == 18 and isinstance(path, Course)
    for lane in manoeuvre.lanes:
        mine = [point for point in cones.points if lane.x[0] <= point[0] <= lane.x[1]]
        assert sorted({x for x, _ in mine}) == pytest.approx([lane.x[0], (lane.x[0] + lane.x[1]) / 2, lane.x[1]])
        assert sorted({y for _, y in mine}) == pytest.approx([lane.y[0] - CONE, lane.y[1] + CONE])


def test_the_driver_s_path_joins_the_middles_of_the_lanes_smoothly():
    manoeuvre = LaneChange()
    first, second, third = manoeuvre.lanes
    x = np.linspace(0.0, 160.0, 16001)
    y = manoeuvre.path(x)
    for lane in (first, second, third):
        room = 8.0
        inside = (x >= lane.x[0] + (0 if lane is first else room)) & (x <= lane.x[1] - (0 if lane is third else room))
        np.testing.assert_allclose(y[inside], lane.centre, atol=1e-12)
    curvature = np.gradient(np.gradient(y, x), x)
    assert np.abs(np.diff(curvature)).max() < 2e-4, "no jump of the curvature"
    peak = 10 / np.sqrt(3) * second.centre / (30 + 16) ** 2
    assert np.abs(curvature[x < 70]).max() == pytest.approx(peak, rel=0.01), "minimum jerk: 10/sqrt(3) h/L²"
    driver = manoeuvre.driver()
    np.testing.assert_allclose(np.interp(x, driver.path.x, driver.path.y), y, atol=2e-3)


# ---- rig


@pytest.mark.parametrize(
    ("test", "quantity", "amplitude"),
    [
        ("bump", "heave_target", 0.06),
        ("roll", "roll_target", np.radians(4)),
        ("steer", "steering_wheel_angle", np.radians(360)),
        ("lateral_force", "lateral_force", 2000.0),
        ("longitudinal_force", "longitudinal_force", 2000.0),
        ("aligning_moment", "aligning_moment", 100.0),
    ],
)
def test_a_test_on_the_rig_moves_one_input_to_both_sides_and_back(test, quantity, amplitude):
    rig = SuspensionRig(test=test)
    assert rig.rig == "k_and_c" and rig.swept == quantity
    time = np.linspace(0, 20, 20001)
    values, rates = rig.drive(place(quantity, "fl", y=0.7), time)
    assert values.max() == pytest.approx(amplitude, rel=1e-6) and values.min() == pytest.approx(-amplitude, rel=1e-6)
    assert values[0] == 0.0 and values[-1] == pytest.approx(0.0, abs=1e-9 * amplitude)
    np.testing.assert_allclose(np.gradient(values, time)[1:-1], rates[1:-1], atol=1e-4 * np.abs(rates).max())
    others = {
        "heave_target",
        "roll_target",
        "steering_wheel_angle",
        "lateral_force",
        "longitudinal_force",
        "aligning_moment",
        "road_height",
    }
    assert all(rig.drive(place(other, "fl"), time) is None for other in others - {quantity})


def test_opposed_forces():
    rig = SuspensionRig(test="lateral_force", opposed=True)
    time = np.linspace(0, 20, 101)
    left, right = (
        rig.drive(place("lateral_force", station, y=y), time)[0] for station, y in (("fl", 0.7), ("fr", -0.7))
    )
    np.testing.assert_array_equal(left, -right)
    with pytest.raises(InputError, match="only forces and moments"):
        validate(SuspensionRig, {"test": "bump", "opposed": True})
