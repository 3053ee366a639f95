"""The car that drives freely as a plant: its memory, its file, its trim, its rig, what it refuses."""

from __future__ import annotations

import math
import re
from typing import ClassVar, Literal

import mujoco
import numpy as np
import pytest
from numba import njit

from susp_mj.compiled.memory import record as compiled_record
from susp_mj.elements import CONTACT, CONTACT_TYRES, ContactTyre, Law, Path, PreviewDriver, register
from susp_mj.errors import InputError, SimulationError
from susp_mj.features import Patch
from susp_mj.handling.block import (
    CAR_NUMERIC,
    CAR_SIGNALS,
    HEAD,
    SIGNALS,
    WHEEL,
    WHEEL_SIGNALS,
    WHEEL_STATE,
    CarNumbers,
    car_block,
    names_of,
    table,
    table_of_tables,
)
from susp_mj.plant import Plant
from susp_mj.roads import Road, cosine_bump
from susp_mj.simulation import simulate
from vehicles.mjcf import HANDLING, K_AND_C, build, write
from vehicles.reading import load_vehicle

from ..builders.cars import PlainCar
from ..builders.manoeuvres import Driven

CORNERS = ("fl", "fr", "rl", "rr")


@pytest.fixture(scope="module")
def saloon():
    return build(load_vehicle("s_class", "configuration_4"), HANDLING)


@pytest.fixture(scope="module")
def rig():
    return build(load_vehicle("s_class", "configuration_4"), HANDLING, rig=K_AND_C)


# ---- memory


@pytest.mark.parametrize("record", [HEAD, WHEEL, CAR_SIGNALS, WHEEL_SIGNALS, WHEEL_STATE])
def test_compiled_code_reads_and_writes_every_number_by_its_name(record):
    at = compiled_record(record)
    numbers, names = np.arange(1.0, record.itemsize // 8 + 1), names_of(record)
    lines = [f"    r.{name}[1] = 2 * r.{name}[1]" if name == "ratios" else f"    r.{name} *= 2" for name in names]
    scope: dict = {"at": at}
    exec("def double(address):\n    r = at(address)\n" + "\n".join(lines), scope)
    njit(scope["double"])(np.uint64(numbers.ctypes.data))
    doubled = numbers.view(record)[0]
    for name in names:
        place = record.fields[name][1] // 8
        if name == "ratios":
            assert doubled[name].tolist() == [place + 1, 2 * (place + 2), *range(place + 3, place + 13)]
        else:
            assert doubled[name] == 2 * (place + 1)


def test_the_block_refuses_a_name_that_it_does_not_have():
    with pytest.raises(ValueError, match="colour"):
        car_block({"colour": 1.0}, [{}] * 4, [])


def test_equal_tables_share_their_place_in_the_block():
    numbers = np.arange(7.0)
    block = car_block({}, [{}] * 4, [("path", i, numbers) for i in range(4)])
    assert len(block) == CarNumbers.size() + 7
    places = CarNumbers(block).wheels.path
    assert len(set(places)) == 1
    np.testing.assert_array_equal(block[int(places[0]) :], numbers)


@pytest.mark.parametrize("x", [-0.13, -0.12, -0.031, 0.0, 0.0499, 0.12, 0.2])
def test_tables_give_values_and_slopes_of_the_curves(x):
    """A parabola and a cubic are met exactly inside; outside both go straight on."""
    from susp_mj.compiled.handling import lookup

    z = np.linspace(-0.12, 0.12, 9)
    numbers = table(z, 0.2 * z - 1.5 * z**2, z**3, smooth=True)
    first, first_slope, second, second_slope = lookup.both_looked_up.py_func(numbers, x)
    inside = min(max(x, -0.12), 0.12)
    assert first == pytest.approx(0.2 * inside - 1.5 * inside**2 + (0.2 - 3 * inside) * (x - inside), abs=1e-12)
    assert first_slope == pytest.approx(0.2 - 3 * inside, abs=1e-10)
    assert second == pytest.approx(inside**3 + 3 * inside**2 * (x - inside), abs=1e-12)
    assert second_slope == pytest.approx(3 * inside**2, abs=1e-10)


def test_tables_of_tables_are_linear_between_their_rows_and_held_outside(saloon):
    z = np.linspace(-0.1, 0.1, 5)
    numbers = table_of_tables(-0.2, 0.2, [table(z, z + s, 2 * z, smooth=True) for s in (-0.2, 0.0, 0.2)])
    assert numbers[:4].tolist() == pytest.approx([-0.2, 5.0, 3.0, (len(numbers) - 4) / 3])


# ---- file


def test_the_written_file_drives_the_same(saloon, tmp_path):
    path = write(load_vehicle("s_class", "configuration_4"), HANDLING, tmp_path / "car.xml")
    again = Plant.from_mjcf(path)
    assert again.meaning.driving
    manoeuvre = Driven(duration=1.5, inputs={"steering_wheel_angle": [(0.2, 0.0), (0.4, 1.0)]})
    first, second = simulate(saloon, manoeuvre), simulate(again, manoeuvre)
    for channel in first:
        np.testing.assert_array_equal(first[channel], second[channel], err_msg=channel)


def test_a_file_with_actuators_in_another_order_is_refused(tmp_path):
    path = write(load_vehicle("bmw_320i"), HANDLING, tmp_path / "car.xml")
    text = path.read_text()
    path.write_text(text.replace("<actuator>", '<actuator><motor name="mine" joint="fl_travel"/>', 1))
    with pytest.raises(InputError, match=f"{CAR_NUMERIC}: actuator 'fl_tyre' is not where the car's numbers say"):
        Plant.from_mjcf(path)


def test_a_file_without_the_end_of_its_numbers_is_refused(tmp_path):
    path = write(load_vehicle("bmw_320i"), HANDLING, tmp_path / "car.xml")
    text = path.read_text()
    text = re.sub(rf'(name="{CAR_NUMERIC}") size="\d+"', r"\1", text)
    start = text.index(f'name="{CAR_NUMERIC}"')
    data = text.index('data="', start) + len('data="')
    end = text.index('"', data)
    path.write_text(text[:data] + " ".join(text[data:end].split()[:-5]) + text[end:])
    with pytest.raises(InputError, match="must be the first custom numeric, and whole"):
        Plant.from_mjcf(path)


def test_the_car_stands_in_a_viewer_that_knows_no_manoeuvre(saloon):
    """With the callbacks installed and nothing attached the tyres carry the car."""
    from susp_mj.compiled import install

    install(saloon.laws)
    data = mujoco.MjData(saloon.model)
    for _ in range(2000):
        mujoco.mj_step(saloon.model, data)
    assert abs(data.qpos[2] - saloon.model.body("chassis").pos[2]) < 0.01


# ---- trim and speed


def test_the_car_begins_in_static_equilibrium_of_its_loads():
    for load in ("ko", "empty", "full"):
        vehicle = load_vehicle("s_class", "configuration_4")
        run = simulate(build(vehicle, HANDLING, load), Driven(duration=0.5, speed=0.0))
        case = vehicle.loads[load]
        assert case.sprung_mass is not None
        weight = 9.81 * (case.sprung_mass + 4 * 39.5)
        assert sum(run[f"{c}_wheel_load"][0] for c in CORNERS) == pytest.approx(weight, rel=1e-6)
        front = 2 * (vehicle.corner_mass("front", load) + 39.5) * 9.81
        # the body pitches a little on its springs, which moves its centre of gravity
        assert run["fl_wheel_load"][0] + run["fr_wheel_load"][0] == pytest.approx(front, rel=5e-3)
        assert np.abs(run["body_acceleration"]).max() < 1e-7
        assert np.abs(run["speed"]).max() < 1e-9


def test_a_speed_beyond_the_cars_is_refused_with_its_top_speed(saloon):
    with pytest.raises(
        InputError, match=r"100 m/s \(360.0 km/h\) is not allowed; the car goes \d\d\.\d m/s \(2\d\d km/h\) at most"
    ):
        simulate(saloon, Driven(duration=1.0, speed=100.0))


def test_the_top_speed_is_where_power_meets_resistance():
    """Plain car: ``T i/R = 1/2 rho c A v² + f m g`` in top gear."""
    resistance, drag = 0.012, 0.35
    vehicle = PlainCar(rolling_resistance=resistance, drag=drag).vehicle()
    plant = build(vehicle, HANDLING)
    with pytest.raises(InputError) as caught:
        simulate(plant, Driven(duration=1.0, speed=120.0))
    top = float(str(caught.value).split("the car goes ")[1].split(" ")[0])
    train, radius = vehicle.powertrain, vehicle.rear.handling_tyre.radius
    assert train is not None

    def surplus(speed, gear):
        engine = speed / radius * gear * train.final_drive
        torque = float(table_value(train.speed, train.full_torque, engine))
        return torque * gear * train.final_drive / radius - 1.225 * drag * speed**2 - resistance * PlainCar.mass * 9.81

    speeds = np.linspace(20, 110, 4001)
    reachable = [
        v
        for v in speeds
        if v / radius * train.gears[-1] * train.final_drive < train.speed[-1] and surplus(v, train.gears[-1]) > 0
    ]
    assert top == pytest.approx(max(reachable), rel=0.03)  # coupling and tyres slip


def table_value(x, y, at):
    from scipy.interpolate import PchipInterpolator

    return PchipInterpolator(x, y)(min(at, x[-1]))


def test_cross_slope_is_held_straight_by_a_trimmed_angle(saloon):
    """The car runs straight across the fall line: side forces carry ``m g s``, nothing yaws."""
    slope = 0.03
    run = simulate(saloon, Driven(duration=2.0, speed=20.0, ground=Road(cross_slope=slope)))
    assert np.ptp(run["yaw_angle"]) < 1e-7
    assert np.abs(run["position_y"]).max() < 1e-7
    assert np.abs(run["lateral_acceleration"]).max() < 1e-6
    assert abs(run["steering_wheel_angle"][0]) > 1e-3
    side = sum(run[f"{c}_lateral_force"][0] for c in CORNERS)
    mass = saloon.model.body_subtreemass[1]
    assert side == pytest.approx(mass * 9.81 * math.sin(math.atan(slope)), rel=0.05)


# ---- driving


def test_the_speed_controller_follows_its_target(saloon):
    run = simulate(saloon, Driven(duration=20.0, speed=15.0, inputs={"speed_target": [(1.0, 15.0), (8.0, 20.0)]}))
    assert run["speed"][-1] == pytest.approx(20.0, abs=0.05)
    assert run["speed"].max() < 20.6


def test_a_car_at_full_throttle_shifts_and_respects_its_limiter(saloon):
    inputs = {"accelerator": [(0.5, 0.0), (0.6, 1.0)], "speed_control": [(0.0, 1.0), (0.5, 1.0), (0.501, 0.0)]}
    run = simulate(saloon, Driven(duration=15.0, speed=0.0, inputs=inputs))
    assert set(np.unique(run["gear"])) >= {1.0, 2.0, 3.0}
    assert (np.diff(run["gear"]) >= 0).all()
    limit = load_vehicle("s_class").powertrain.speed[-1]
    assert run["engine_speed"].max() < 1.04 * limit
    hundred = run.time[np.argmax(run["speed"] > 100 / 3.6)] - 0.5
    assert 5.5 < hundred < 8.0  # s; the real car with this engine is quoted with 6.5 s


def test_braking_deceleration_is_that_of_the_brake_torque(saloon):
    """Moderate braking, engine uncoupled from the balance: ``sum of torques = F R_e``, ``m a = F + air + rolling``."""
    inputs = {"brake_pedal": [(0.5, 0.0), (0.7, 0.25)], "speed_control": [(0.0, 1.0), (0.5, 1.0), (0.501, 0.0)]}
    run = simulate(saloon, Driven(duration=2.5, speed=30.0, inputs=inputs))
    force = sum(run[f"{c}_longitudinal_force"][-1] for c in CORNERS)
    vehicle = load_vehicle("s_class", "configuration_4")
    air = vehicle.aerodynamics
    assert air is not None
    drag = air.density * air.area / 2 * air.drag * run["speed"][-1] ** 2
    mass = saloon.model.body_subtreemass[1]
    assert run["longitudinal_acceleration"][-1] == pytest.approx((force - drag) / mass, rel=0.01)
    torque = sum(run[f"{c}_brake_torque"][-1] - run[f"{c}_drive_torque"][-1] for c in CORNERS)
    assert -force * 0.331 == pytest.approx(torque, rel=0.05)
    share = sum(run[f"f{s}_brake_torque"][-1] for s in "lr") / sum(run[f"{c}_brake_torque"][-1] for c in CORNERS)
    assert share == pytest.approx(vehicle.brakes.front_share, abs=1e-3)


def test_locked_wheels_stand_still_and_the_car_stops_and_stays(saloon):
    inputs = {"brake_pedal": [(0.5, 0.0), (0.7, 1.0)], "speed_control": [(0.0, 1.0), (0.5, 1.0), (0.501, 0.0)]}
    run = simulate(saloon, Driven(duration=6.5, speed=20.0, inputs=inputs))
    sliding = (run.time > 1.5) & (run.time < 2.0)
    assert np.abs(run["fl_wheel_speed"][sliding]).max() < 0.1
    assert np.allclose(run["fl_slip_ratio"][sliding], -1.0, atol=0.01)
    assert np.ptp(run["position_x"][-500:]) < 2e-3
    assert abs(run["yaw_angle"][-1]) < 1e-6
    assert run["position_x"].max() - run["position_x"][-1] < 0.15  # springs back by the wind-up of its tyres, no more


def test_split_friction_turns_the_car_towards_the_grip(saloon):
    road = Road(patches=(Patch((15.0, 1e3), (-10.0, 0.0), 0.3),))
    inputs = {"brake_pedal": [(1.0, 0.0), (1.1, 0.4)], "speed_control": [(0.0, 1.0), (1.0, 1.0), (1.001, 0.0)]}
    run = simulate(saloon, Driven(duration=1.8, speed=22.0, ground=road, inputs=inputs))
    assert run["fr_longitudinal_force"][-1] > run["fl_longitudinal_force"][-1] + 500  # braking forces are negative
    assert run["yaw_angle"][-1] > 0.01


def test_friction_patch_scales_what_a_locked_wheel_transmits(saloon):
    inputs = {"brake_pedal": [(0.3, 0.0), (0.4, 1.0)], "speed_control": [(0.0, 1.0), (0.3, 1.0), (0.301, 0.0)]}
    means = []
    for friction in (1.0, 0.5):
        road = Road(patches=(Patch((-10.0, 1e3), (-10.0, 10.0), friction),))
        run = simulate(saloon, Driven(duration=1.8, speed=25.0, ground=road, inputs=inputs))
        means.append(run["fl_longitudinal_force"][-300:].mean() / run["fl_wheel_load"][-300:].mean())
    tyre = load_vehicle("s_class").front.handling_tyre
    law = [tyre.evaluate(kappa=-1.0, load=6000.0, friction=friction).longitudinal_force for friction in (1.0, 0.5)]
    assert 0.4 < law[1] / law[0] < 0.5
    assert means[1] / means[0] == pytest.approx(law[1] / law[0], rel=0.03)


def test_side_wind_pushes_and_turns_the_car_as_its_coefficients_say():
    """Plain car at once after a step of wind: ``m a_y = 1/2 rho A c_s V² beta`` before it has begun to turn."""
    extra = {"aerodynamics.side": 2.0, "aerodynamics.yaw": 0.3}
    plant = build(PlainCar(overrides=extra).vehicle(), HANDLING)
    run = simulate(plant, Driven(duration=0.6, speed=30.0, inputs={"wind_y": [(0.499, 0.0), (0.5, 8.0)]}))
    at = int(np.searchsorted(run.time, 0.5)) + 2
    pressure = 1.225 * 2.0 / 2 * (30.0**2 + 8.0**2)
    beta = math.atan2(8.0, 30.0)
    assert run["lateral_acceleration"][at] * PlainCar.mass == pytest.approx(pressure * 2.0 * beta, rel=0.1)
    turning = (run["yaw_rate"][at + 3] - run["yaw_rate"][at]) / 3e-3
    moment = pressure * (1.5572 + 1.5238) * 0.3 * beta
    offset = (
        1.5572 - (1.5572 + 1.5238) / 2
    )  # the side force acts amid the wheels, this far behind the centre of gravity's projection
    assert turning * PlainCar.yaw_inertia == pytest.approx(moment - pressure * 2.0 * beta * offset, rel=0.1)


def test_a_bump_on_the_road_reaches_front_and_rear_where_it_lies(saloon):
    x = np.arange(0.0, 40.0, 0.02)
    height, _ = cosine_bump(x - 10.0, 0.03, 1.0)
    run = simulate(saloon, Driven(duration=1.5, speed=20.0, ground=Road(x=x, height=height[:, None])))
    front = run.time[np.argmax(run["fl_road_height"])]
    rear = run.time[np.argmax(run["rl_road_height"])]
    assert run["fl_road_height"].max() == pytest.approx(0.03, rel=1e-3)
    assert front == pytest.approx(10.5 / 20.0, abs=2e-3)
    assert rear - front == pytest.approx(3.081 / 20.0, abs=2e-3)
    np.testing.assert_allclose(run["fl_road_height"], run["fr_road_height"], atol=1e-12)


def test_four_post_inputs_drive_a_standing_car(saloon):
    posts = {f"{c}_road_height": [(0.2, 0.0), (1.2, 0.02)] for c in CORNERS}
    run = simulate(saloon, Driven(duration=4.0, speed=0.0, inputs=posts))
    assert run["body_displacement"][-1] - run["body_displacement"][0] == pytest.approx(0.02, abs=2e-3)


def test_the_driver_follows_a_circle_and_a_lane_change(saloon):
    circle = PreviewDriver(Path(radius=60.0), understeer=0.0025)
    run = simulate(saloon, Driven(duration=12.0, speed=14.0, steerer=circle))
    assert abs(run["path_deviation"][-1]) < 0.3
    radius = math.hypot(run["position_x"][-1], run["position_y"][-1] - 60.0)
    assert radius == pytest.approx(60.0 - run["path_deviation"][-1], abs=1e-6)
    assert run["lateral_acceleration"][-1] == pytest.approx(run["speed"][-1] ** 2 / radius, rel=0.02)
    x = np.linspace(0.0, 120.0, 241)
    y = 3.5 * (1 - np.cos(np.pi * np.clip((x - 30) / 30, 0, 1))) / 2
    run = simulate(saloon, Driven(duration=6.0, speed=20.0, steerer=PreviewDriver(Path(x=x, y=y), understeer=0.0025)))
    assert run["position_y"][-1] == pytest.approx(3.5, abs=0.1)
    assert np.abs(run["path_deviation"]).max() < 0.6


def test_a_car_that_falls_over_says_so(saloon):
    road = Road(patches=(Patch((-1e3, 1e3), (-1e3, 1e3), 3.0),))
    with pytest.raises(SimulationError, match="the car fell over at t = "):
        simulate(
            saloon,
            Driven(duration=12.0, speed=25.0, ground=road, inputs={"steering_wheel_angle": [(0.5, 0.0), (2.0, 4.0)]}),
        )


# ---- rig


def test_bump_on_the_rig_follows_the_tables(rig):
    posts = {f"{c}_road_height": [(0.2, 0.0), (3.2, 0.06)] for c in CORNERS}
    run = simulate(rig, Driven(duration=3.5, speed=0.0, inputs=posts))
    kinematics = load_vehicle("s_class").front.kinematics
    middle = list(kinematics.steer).index(0.0)
    travel = run["fl_suspension_deflection"]
    toe = np.interp(travel, kinematics.travel, kinematics.angles("toe")[:, middle])
    camber = np.interp(travel, kinematics.travel, kinematics.angles("camber")[:, middle])
    lateral = np.interp(travel, kinematics.travel, kinematics.path("lateral"))
    assert np.ptp(travel) > 0.04
    np.testing.assert_allclose(run["fl_steer_angle"], -toe, atol=3e-5)
    np.testing.assert_allclose(run["fr_steer_angle"], toe, atol=3e-5)
    np.testing.assert_allclose(run["fl_inclination_angle"], camber, atol=5e-5)
    np.testing.assert_allclose(run["fl_contact_y"], lateral, atol=2e-4)  # straight lines miss a parabola by this much
    np.testing.assert_allclose(run["fr_contact_y"], -lateral, atol=2e-4)


def test_lateral_force_on_the_rig_gives_the_compliance_of_the_table(rig):
    force = {f"{c}_lateral_force": [(0.2, 0.0), (2.2, 2000.0)] for c in CORNERS}
    run = simulate(rig, Driven(duration=3.0, speed=0.0, inputs=force))
    front = load_vehicle("s_class").front
    middle = list(front.kinematics.steer).index(0.0)
    for corner, side in (("fl", 1), ("fr", -1)):
        inwards = -side * 2000.0
        travel = run[f"{corner}_suspension_deflection"]
        kinematic = np.interp(travel, front.kinematics.travel, front.kinematics.angles("camber")[:, middle])
        elastic = np.interp(inwards, front.compliance.lateral_force, front.compliance.camber)
        found = run[f"{corner}_inclination_angle"][-1] - run[f"{corner}_inclination_angle"][0]
        assert found == pytest.approx(elastic + kinematic[-1] - kinematic[0], abs=3e-4)  # straight lines between points


def test_forces_on_the_rig_lift_the_suspension_by_virtual_work(rig):
    """A braking force F on the patch compresses the front suspension by ``F x'(z)`` over the wheel rate: anti-dive."""
    force = {f"{c}_longitudinal_force": [(0.2, 0.0), (2.2, -2000.0)] for c in ("fl", "fr")}
    run = simulate(rig, Driven(duration=4.0, speed=0.0, inputs=force))
    kinematics = load_vehicle("s_class").front.kinematics
    slope = np.gradient(kinematics.path("longitudinal"), kinematics.travel)[list(kinematics.travel).index(0.0)]
    load = run["fl_wheel_load"][-1] - run["fl_wheel_load"][0]
    spring = sum(
        run[f"fl_{part}_force"][-1] - run[f"fl_{part}_force"][0]
        for part in ("spring", "stop", "damper", "friction", "bar")
    )
    assert load - spring == pytest.approx(2000.0 * slope, rel=0.03)


def test_the_rig_holds_the_body(rig):
    run = simulate(rig, Driven(duration=3.0, speed=0.0, inputs={"roll_target": [(0.2, 0.0), (2.0, 0.05)]}))
    assert run["roll_angle"][-1] == pytest.approx(0.05, abs=2e-4)
    assert abs(run["pitch_angle"][-1]) < 1e-4
    assert abs(run["body_displacement"][-1]) < 1e-4


# ---- what is refused


@pytest.mark.parametrize(
    ("override", "message"),
    [
        ({"steering": None}, "model 'handling' needs what this car does not give: steering"),
        ({"front.wheel_inertia": None}, "front.wheel_inertia"),
    ],
)
def test_a_car_that_lacks_something_is_refused(override, message):
    with pytest.raises(InputError, match=message):
        build(load_vehicle("s_class", overrides=override), HANDLING)


def test_chapter_3s_quarter_car_cannot_drive():
    with pytest.raises(InputError, match="model 'handling' needs what this car does not give: wheelbase"):
        build(load_vehicle("chapter3", "linear"), HANDLING)


@pytest.mark.parametrize(("rig", "axle"), [("roll", None), (None, "rear")])
def test_rigs_and_axles_that_it_does_not_have(rig, axle):
    with pytest.raises(InputError, match=r"rig|axle"):
        build(load_vehicle("s_class"), HANDLING, rig=rig, axle=axle)


def test_signals_have_unique_names():
    assert len(set(SIGNALS)) == len(SIGNALS)


def test_drive_pushes_along_the_wheel_centres_path_and_brakes_along_the_patchs(saloon):
    """Work of the forces over the travel: the rear springs' force changes by ``F x'``, x' that of the centre or of the
    patch.

    The wheel's load less its suspension's forces is what the path carries; weight and inertia of the wheel are in it
    from the start.
    """
    kinematics = load_vehicle("s_class").rear.kinematics
    origin = list(kinematics.travel).index(0.0)
    slopes = {
        name: np.gradient(kinematics.path(name), kinematics.travel)[origin]
        for name in ("longitudinal", "longitudinal_centre")
    }
    assert abs(slopes["longitudinal"]) > 2 * abs(slopes["longitudinal_centre"]) > 0.05
    turn = (slopes["longitudinal_centre"] - slopes["longitudinal"]) / 0.316
    off = {"speed_control": [(0.0, 1.0), (0.5, 1.0), (0.501, 0.0)]}
    for pedal, value in (("accelerator", 0.5), ("brake_pedal", 0.3)):
        run = simulate(saloon, Driven(duration=2.5, speed=15.0, inputs={pedal: [(0.5, 0.0), (0.8, value)], **off}))
        parts = sum(run[f"rl_{part}_force"] for part in ("spring", "stop", "damper", "friction", "bar"))
        carried, force, torque = (
            each[-300:].mean() - each[0]
            for each in (run["rl_wheel_load"] - parts, run["rl_longitudinal_force"], run["rl_drive_torque"])
        )
        expected = -slopes["longitudinal"] * force - turn * torque
        assert abs(force) > 500.0
        assert carried == pytest.approx(expected, abs=0.02 * abs(force)), pedal


# ---- tyres of every kind


def saturating_contact(kappa, tan_alpha, camber, load, rolling, lateral, friction, p, out):
    """Side force ``mu F_z`` approached exponentially; rolls without loss."""
    for i in range(5):
        out[i] = 0.0
    out[5], out[6], out[7] = 0.3, 0.3, p[0]
    most = p[1] * friction * load
    out[0] = most * math.tanh(20.0 * kappa)
    out[1] = -most * math.tanh(15.0 * tan_alpha)


class SaturatingTyre(ContactTyre):
    """A tyre of the user's own."""

    law: ClassVar[Law] = Law("saturating_contact_of_the_tests", saturating_contact, role=CONTACT)
    kind: Literal["saturating_of_the_tests"] = "saturating_of_the_tests"
    grip: float = 1.0

    def parameters(self):
        return (self.radius, self.grip)


@pytest.mark.parametrize(
    "tyre",
    [
        {"kind": "magic_formula", "file": "mf61_205_60R15.tir"},
        {"kind": "magic_formula", "file": "pac2002_245_40R18.tir"},
        {"kind": "saturating_of_the_tests", "radius": 0.33, "vertical_stiffness": 2e5, "grip": 0.8},
    ],
    ids=lambda tyre: str(tyre.get("file", tyre["kind"])),
)
def test_the_car_drives_on_every_kind_of_tyre(tyre, monkeypatch):
    monkeypatch.setitem(CONTACT_TYRES, "saturating_of_the_tests", SaturatingTyre)  # taken out again afterwards
    register(SaturatingTyre)
    car = load_vehicle("bmw_320i", overrides={"front.handling_tyre": tyre, "rear.handling_tyre": tyre})
    run = simulate(
        build(car, HANDLING),
        Driven(duration=4.0, speed=20.0, inputs={"steering_wheel_angle": [(0.5, 0.0), (0.8, 1.0)]}),
    )
    assert np.ptp(run["speed"][:400]) < 1e-7  # trimmed
    assert 3.0 < run["lateral_acceleration"][-1] < 8.5
    assert run["lateral_acceleration"][-1] == pytest.approx(run["speed"][-1] * run["yaw_rate"][-1], rel=0.05)
    loads = sum(run[f"{c}_wheel_load"][-1] for c in CORNERS)
    assert loads == pytest.approx((965.71 + 4 * 31.896) * 9.81, rel=0.02)
