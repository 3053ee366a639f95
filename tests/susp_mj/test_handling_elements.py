"""Kinematics, compliance, steering, power train, brakes and air of the shipped cars, against figures worked out
here."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

import vehicles
from susp_mj import InputError
from susp_mj.elements import GRAVITY, Aerodynamics, Brakes, Compliance, Kinematics, Powertrain, Steering
from susp_mj.elements.tyres.tir import load_tyre
from vehicles import available_vehicles, load_vehicle

CARS = [name for name in available_vehicles() if load_vehicle(name).steering is not None]
TYRES = Path(vehicles.__file__).parent / "tyres"
LINES = [
    (
        {"front.kinematics.travel": [-0.12, 0.0, "0 mm"]},
        "front.kinematics.travel.2: 0 m follows 0 m; travels must increase strictly",
    ),
    (
        {"front.kinematics.travel": [-0.12, 0.01, 0.12]},
        "front.kinematics.travel: -0.12 to 0.12 m has no point at 0; the table must have one there",
    ),
    ({"front.kinematics.travel": [0.0]}, "front.kinematics.travel: [0.0] is not allowed; give two travels at least"),
    (
        {"front.kinematics.travel": [-0.09, 0.0, 0.12]},
        "front.kinematics.travel: -0.09 to 0.12 m does not cover the stops, -0.1 to 0.1 m; it must reach from stop "
        "to stop",
    ),
    (
        {"rear.kinematics.travel": [-0.12, 0.0, 0.08]},
        "rear.kinematics.travel: -0.12 to 0.08 m does not cover the stops, -0.1 to 0.1 m; it must reach from stop "
        "to stop",
    ),
    ({"front.kinematics.steer": [0.0]}, "front.kinematics.steer: [0.0] is not allowed; give two steer angles at least"),
    (
        {"front.kinematics.steer": [-0.7, 0.7, 0.6]},
        "front.kinematics.steer.2: 0.6 rad follows 0.7 rad; steer angles must increase strictly",
    ),
    (
        {"front.kinematics.steer": [-0.7, 0.1, 0.7]},
        "front.kinematics.steer: -0.7 to 0.7 rad has no point at 0; the table must have one there",
    ),
    (
        {"front.kinematics.steer": [-0.2, 0.0, 0.7]},
        "front.kinematics.steer: -0.2 to 0.7 rad does not cover the steering, -0.5818 to 0.5818 rad (steering.limit "
        "/ steering.ratio)",
    ),
    (
        {"rear.kinematics.steer": [-0.7, 0.0, 0.7]},
        "rear.kinematics.steer: is not allowed; only the front wheels are steered",
    ),
    ({"front.kinematics.lateral": [0.0, 0.1]}, "front.kinematics.lateral: 2 values are not allowed; travel has 3"),
    (
        {"front.kinematics.lateral": [-0.02, "1 mm", 0.02]},
        "front.kinematics.lateral.1: 0.001 m is not allowed at travel 0; it must be 0 there",
    ),
    (
        {"front.kinematics.longitudinal": [-0.02, "1 mm", 0.02]},
        "front.kinematics.longitudinal.1: 0.001 m is not allowed at travel 0; it must be 0 there",
    ),
    (
        {"front.kinematics.lateral": ["1 deg", 0, 0]},
        "front.kinematics.lateral.0: '1 deg' has the wrong unit; expected one like m",
    ),
    ({"front.kinematics.toe": [0.1, 0.0]}, "front.kinematics.toe: 2 values are not allowed; travel has 3"),
    (
        {"front.kinematics.toe": "1 deg"},
        "front.kinematics.toe: '1 deg' is not a table; write a list of angles, or of lists of them",
    ),
    (
        {"front.kinematics.toe": ["1 deg", "0 m", "1 deg"]},
        "front.kinematics.toe.1: '0 m' has the wrong unit; expected one like rad",
    ),
    (
        {"front.kinematics.toe": [[0, 0], [0, 0], [0, 0]]},
        "front.kinematics.toe.0: a row of 2 is not allowed; give one value",
    ),
    (
        {"front.kinematics.steer": [-0.7, 0.0, 0.7], "front.kinematics.toe": [[0, 0, 0], [0, 0, "x"], [0, 0, 0]]},
        "front.kinematics.toe.1.2: 'x' is not a number with a unit; write it like '1 rad'",
    ),
    (
        {"front.kinematics.steer": [-0.7, 0.0, 0.7], "front.kinematics.toe": [[0, 0, 0], [0, 0], [0, 0, 0]]},
        "front.kinematics.toe.1: a row of 2 is not allowed; give one value, or 3 as steer has",
    ),
    (
        {"front.kinematics.steer": [-0.7, 0.0, 0.7], "front.kinematics.toe": [[0, 0, 0], 0, [0, 0, 0]]},
        "front.kinematics.toe.1: a row of 1 is not allowed; the first row has 3",
    ),
    (
        {"front.kinematics.tow": [0, 0, 0]},
        "front.kinematics.tow: unknown key; did you mean 'toe'? "
        "choose travel, steer, lateral, longitudinal, longitudinal_centre, toe, camber",
    ),
    ({"front.compliance.toe": [0, 0, 0]}, "front.compliance.lateral_force: is required by toe"),
    (
        {"front.compliance.lateral_force": [-1, 0, 1]},
        "front.compliance.lateral_force: stands alone; give toe or camber with it",
    ),
    (
        {"front.compliance.lateral_force": [0], "front.compliance.toe": [0]},
        "front.compliance.lateral_force: [0.0] is not allowed; give two forces at least",
    ),
    (
        {"front.compliance.lateral_force": ["-1 kN", "0 N", "-1 N"], "front.compliance.toe": [0, 0, 0]},
        "front.compliance.lateral_force.2: -1 N follows 0 N; forces must increase strictly",
    ),
    (
        {"front.compliance.lateral_force": ["-1 kN", "1 N"], "front.compliance.toe": [0, 0]},
        "front.compliance.lateral_force: -1000 to 1 N has no point at 0; the table must have one there",
    ),
    (
        {"front.compliance.lateral_force": ["-1 kN", "0 N", "1 kN"], "front.compliance.camber": [0, 0]},
        "front.compliance.camber: 2 values are not allowed; lateral_force has 3",
    ),
    (
        {"front.compliance.lateral_force": ["-1 kN", "0 N", "1 kN"], "front.compliance.toe": [0, 0.1, 0.2]},
        "front.compliance.toe.1: 0.1 rad is not allowed at lateral_force 0; it must be 0 there",
    ),
    (
        {"front.compliance.longitudinal_force": ["-1 kN", "0 N", "1 kN"]},
        "front.compliance.longitudinal_force: stands alone; give toe_longitudinal with it",
    ),
    ({"front.compliance.toe_aligning": [0.1]}, "front.compliance.aligning_moment: is required by toe_aligning"),
    (
        {"front.compliance.aligning_moment": ["-1 Nm", "0 Nm", "-1 N m"], "front.compliance.toe_aligning": [0, 0, 0]},
        "front.compliance.aligning_moment.2: -1 N m follows 0 N m; moments must increase strictly",
    ),
    ({"steering.ratio": 0}, "steering.ratio: 0.0 is not allowed; it must be greater than 0.0"),
    (
        {"steering.stiffness": "20000 N/m"},
        "steering.stiffness: '20000 N/m' has the wrong unit; expected one like N m/rad",
    ),
    ({"steering.ackermann": 1.2}, "steering.ackermann: 1.2 is not allowed; it must be at most 1.0"),
    ({"steering.limit": "-3 rad"}, "steering.limit: -3.0 is not allowed; it must be greater than 0.0"),
    (
        {"steering.damping": None},
        "steering.damping: None is not a quantity; write a number in N m s/rad or a text like '1 N m s/rad'",
    ),
    (
        {"steering.trial": 0.02},
        "steering.trial: unknown key; did you mean 'trail'? choose ratio, stiffness, damping, "
        "knuckle_inertia, trail, scrub, ackermann, limit",
    ),
    ({"powertrain.driven": "all"}, "powertrain.driven: 'all' is not allowed; choose 'rear' or 'front'"),
    (
        {"powertrain.speed.3": "1400 1/min"},
        "powertrain.speed.3: 1400 1/min follows 1500 1/min; the torque map must increase strictly in speed",
    ),
    ({"powertrain.speed.0": -1}, "powertrain.speed.0: -1.0 is not allowed; it must be at least 0.0"),
    ({"powertrain.full_torque": [1, 2]}, "powertrain.full_torque: 2 values are not allowed; speed has 9"),
    ({"powertrain.drag_torque": [-1, -2]}, "powertrain.drag_torque: 2 values are not allowed; speed has 9"),
    ({"powertrain.drag_torque.2": 3}, "powertrain.drag_torque.2: 3.0 is not allowed; it must be at most 0.0"),
    (
        {"powertrain.full_torque.2": -20},
        "powertrain.full_torque.2: -20 N m is not allowed; it must be above the drag torque of -18.5 N m",
    ),
    (
        {"powertrain.idle_speed": "400 1/min"},
        "powertrain.idle_speed: 400 1/min is not allowed; the torque map reaches from 500 1/min to 6400 1/min",
    ),
    ({"powertrain.gears": []}, "powertrain.gears: [] is not allowed; give one ratio at least"),
    ({"powertrain.gears.2": 2.5}, "powertrain.gears.2: 2.5 follows 2; the ratios must decrease strictly"),
    ({"powertrain.gears.2": -1}, "powertrain.gears.2: -1.0 is not allowed; it must be greater than 0.0"),
    (
        {"powertrain.shift_up": "6500 rpm"},
        "powertrain.shift_up: 6500 1/min is not allowed; the torque map ends at 6400 1/min",
    ),
    (
        {"powertrain.shift_down": "6000 rpm"},
        "powertrain.shift_down: 6000 1/min is not allowed; it must be at least idle_speed, 800 1/min, and below "
        "shift_up, 5900 1/min",
    ),
    (
        {"powertrain.shift_down": "700 rpm"},
        "powertrain.shift_down: 700 1/min is not allowed; it must be at least idle_speed, 800 1/min, and below "
        "shift_up, 5900 1/min",
    ),
    (
        {"powertrain.shift_down": "3500 rpm"},
        "powertrain.shift_down: 3500 1/min is not allowed; the shift from ratio 2 to 3.68 ends at 6440 1/min, "
        "which must be below shift_up, 5900 1/min, or the gearbox hunts",
    ),
    ({"powertrain.efficiency": 1.1}, "powertrain.efficiency: 1.1 is not allowed; it must be at most 1.0"),
    ({"powertrain.inertia": "1 kg"}, "powertrain.inertia: '1 kg' has the wrong unit; expected one like kg m²"),
    ({"powertrain.shift_time": -1}, "powertrain.shift_time: -1.0 is not allowed; it must be at least 0.0"),
    ({"powertrain.speed.3": "2000 1/s"}, "powertrain.speed.3: '2000 1/s' has the wrong unit; expected one like rad/s"),
    ({"brakes.front_share": 1.5}, "brakes.front_share: 1.5 is not allowed; it must be at most 1.0"),
    ({"brakes.torque": 0}, "brakes.torque: 0.0 is not allowed; it must be greater than 0.0"),
    ({"aerodynamics.area": 0}, "aerodynamics.area: 0.0 is not allowed; it must be greater than 0.0"),
    ({"aerodynamics.drag": -0.1}, "aerodynamics.drag: -0.1 is not allowed; it must be at least 0.0"),
    (
        {"aerodynamics.lift": 0.1},
        "aerodynamics.lift: unknown key; did you mean 'lift_rear'? choose kind, area, drag, lift_front, lift_rear, "
        "side, yaw, density",
    ),
    ({"aerodynamics.side": "2 1/m"}, "aerodynamics.side: '2 1/m' has the wrong unit; expected one like 1/rad"),
    ({"front.wheel_inertia": 0}, "front.wheel_inertia: 0.0 is not allowed; it must be greater than 0.0"),
]


@pytest.mark.parametrize(
    ("overrides", "line"), LINES, ids=[" and ".join(overrides) + f" {i}" for i, (overrides, _) in enumerate(LINES)]
)
def test_mistakes(overrides, line):
    with pytest.raises(InputError) as caught:
        load_vehicle("bmw_320i", overrides=overrides)
    assert str(caught.value) == f"bmw_320i.toml with overrides: {line}"


# ---- tables


def test_what_is_not_given_is_zero():
    kinematics = Kinematics(travel=(-0.1, 0.0, 0.1), steer=("-30 deg", 0, "30 deg"))
    np.testing.assert_array_equal(kinematics.path("lateral"), np.zeros(3))
    np.testing.assert_array_equal(kinematics.path("longitudinal"), np.zeros(3))
    np.testing.assert_array_equal(kinematics.angles("toe"), np.zeros((3, 3)))
    np.testing.assert_array_equal(Kinematics(travel=(-0.1, 0.0)).angles("camber"), np.zeros((2, 1)))
    assert kinematics.roll_centre_height(1.5) == 0
    assert Compliance().toe == ()


def test_angles_over_travel_alone_hold_at_every_steer_angle():
    plain = Kinematics(travel=(-0.1, 0.0, 0.1), steer=(-0.5, 0, 0.5), camber=("1 deg", 0, "-2 deg"))
    np.testing.assert_allclose(plain.angles("camber"), np.radians([[1] * 3, [0] * 3, [-2] * 3]))
    rows = Kinematics(
        travel=(-0.1, 0.0, 0.1), steer=(-0.5, 0, 0.5), camber=([0.1, 0.2, 0.3], [0, 0, 0], ["1 deg", 0.5, 0.6])
    )
    assert rows.angles("camber")[2, 0] == pytest.approx(math.radians(1))
    assert rows.angles("camber")[0, 2] == 0.3


@pytest.mark.parametrize(
    "travel", [np.linspace(-0.1, 0.1, 11), np.array([-0.1, -0.03, 0.0, 0.01, 0.1]), np.array([0.0, 0.05, 0.12])]
)
def test_roll_centre_of_a_wheel_on_an_arc(travel):
    """A patch that turns about an instant centre (distance d inboard, h above the ground) has its roll centre at t h /
    2 d."""
    d, h, track = 1.2, 0.18, 1.52
    kinematics = Kinematics(travel=tuple(travel), lateral=tuple(h / d * travel - 0.7 * travel**2))
    assert kinematics.roll_centre_height(track) == pytest.approx(track / 2 * h / d, rel=1e-9)


def test_sign_of_the_lateral_path():
    """Compression turns a patch below the instant centre outwards: planar rotation of (d, -h) by a small angle."""
    d, h, angle = 1.2, 0.18, 1e-3
    turned = np.array([[math.cos(angle), -math.sin(angle)], [math.sin(angle), math.cos(angle)]]) @ [d, -h]
    outwards, up = turned - [d, -h]
    assert outwards / up == pytest.approx(h / d, rel=1e-2)


def test_the_gearbox_rule_is_the_same_for_both_shifts():
    """A shift down that ends just below shift_up is allowed; then a shift up ends just above shift_down."""
    data = load_vehicle("bmw_320i").powertrain.model_dump()
    limit = data["shift_up"] * data["gears"][1] / data["gears"][0]
    allowed = Powertrain.model_validate({**data, "shift_down": limit * 0.999})
    assert allowed.shift_up * allowed.gears[1] / allowed.gears[0] > allowed.shift_down
    with pytest.raises(ValueError, match="hunts"):
        Powertrain.model_validate({**data, "shift_down": limit * 1.001})


# ---- the shipped cars


def total(car, load="ko"):
    """Mass [kg], distance behind the front axle and height [m] of the whole car's centre of gravity."""
    case, front, rear = car.loads[load], 2 * car.front.unsprung_mass, 2 * car.rear.unsprung_mass
    mass = case.sprung_mass + front + rear
    behind = (case.sprung_mass * -case.cg[0] + rear * car.wheelbase) / mass
    height = (case.sprung_mass * (car.wheel_radius + case.cg[2]) + (front + rear) * car.wheel_radius) / mass
    return mass, behind, height


def wheel_load(car, axle, load="ko"):
    mass, behind, _ = total(car, load)
    share = behind / car.wheelbase
    return mass * GRAVITY * (share if axle == "rear" else 1 - share) / 2


def slope(table, arguments):
    """At the argument 0."""
    return float(np.gradient(np.ravel(table), arguments, edge_order=2)[list(arguments).index(0.0)])


def straight(kinematics, name):
    """Column of steer angle 0."""
    return kinematics.angles(name)[:, list(kinematics.steer).index(0.0) if kinematics.steer else 0]


@pytest.mark.parametrize("name", CARS)
@pytest.mark.parametrize("axle", ["front", "rear"])
def test_wheels_stand_where_the_car_says(name, axle):
    """Loaded radius of the tyre against the height of the wheel centres; roll centre against the axle's own figure."""
    car = load_vehicle(name)
    each = car.axle(axle)
    load = wheel_load(car, axle)
    assert load == pytest.approx((car.corner_mass(axle, "ko") + each.unsprung_mass) * GRAVITY, rel=1e-12)
    tyre = each.handling_tyre
    assert tyre.radius - load / tyre.vertical_stiffness == pytest.approx(car.wheel_radius, abs=0.005)
    assert each.kinematics.roll_centre_height(each.track) == pytest.approx(each.roll_centre_height, abs=2e-4)
    assert tyre.vertical_stiffness == pytest.approx(each.tyre.rate, rel=1e-5)


@pytest.mark.parametrize("name", CARS)
def test_the_tyres_range_covers_a_whole_axle_on_one_wheel(name):
    car = load_vehicle(name)
    for load in car.loads:
        for axle in ("front", "rear"):
            assert 2 * wheel_load(car, axle, load) < getattr(car, axle).handling_tyre.ranges.FZMAX


@pytest.mark.parametrize("name", CARS)
def test_camber_and_roll_centre_change_as_on_real_axles(name):
    """In bump the top goes inwards, and the roll centre sinks with the body or stays."""
    car = load_vehicle(name)
    for axle in (car.front, car.rear):
        kinematics = axle.kinematics
        assert (np.diff(straight(kinematics, "camber")) < 0).all()
        assert (np.diff(kinematics.path("lateral"), 2) <= 0).all()


@pytest.mark.parametrize("name", CARS)
def test_understeer(name):
    """Steer angle over lateral acceleration from tyre, steering, compliance and roll, by hand with the linear single
    track."""
    car = load_vehicle(name)
    acceleration = 1.0
    mass, _, height = total(car)
    stiffness, roll = {}, 0.0
    for axle in ("front", "rear"):
        each = car.axle(axle)
        bar = each.anti_roll_bar.rate if each.anti_roll_bar else 0.0
        stiffness[axle] = (float(each.spring.rate_at(0.01)) + bar) * each.track**2 / 2
    roll = mass * height * acceleration / (sum(stiffness.values()) - mass * GRAVITY * height)
    steer = {}
    for axle in ("front", "rear"):
        each = car.axle(axle)
        force = wheel_load(car, axle) / GRAVITY * acceleration
        tyre = each.handling_tyre
        at = [tyre.evaluate(0.0, slip, 0.0, wheel_load(car, axle)) for slip in (-0.005, 0.005)]
        cornering = -(at[1].lateral_force - at[0].lateral_force) / 0.01
        trail = (at[1].aligning_moment - at[0].aligning_moment) / 0.01 / cornering
        angle = force / cornering
        if each.compliance.lateral_force:  # inwards on the outer wheel, whose toe-out is understeer in front
            angle -= slope(each.compliance.toe, each.compliance.lateral_force) * force
            angle += slope(each.compliance.toe_aligning, each.compliance.aligning_moment) * force * trail
        angle -= slope(straight(each.kinematics, "toe"), each.kinematics.travel) * each.track / 2 * roll
        if axle == "front":
            angle += force * (car.steering.trail + trail) / car.steering.stiffness
        steer[axle] = math.degrees(angle) * GRAVITY
        assert 0.01 < trail < 0.06
    assert 0.3 < steer["front"] - steer["rear"] < 5  # degrees at the road wheels per g


def test_the_saloon_steers_itself_out_of_the_curve():
    """Each part of kinematics and compliance understeers: outer front wheel toes out, outer rear wheel toes in."""
    car = load_vehicle("s_class")
    assert slope(straight(car.front.kinematics, "toe"), car.front.kinematics.travel) < 0
    assert slope(straight(car.rear.kinematics, "toe"), car.rear.kinematics.travel) > 0
    assert slope(car.front.compliance.toe, car.front.compliance.lateral_force) == pytest.approx(
        math.radians(-0.04) / 1000
    )
    assert slope(car.rear.compliance.toe, car.rear.compliance.lateral_force) == pytest.approx(math.radians(0.01) / 1000)


def test_anti_dive_and_anti_squat_of_the_saloon():
    """Share of the load transfer ``m a h / l`` that the axle's path carries: ``x' (share of the force) l / h``."""
    car = load_vehicle("s_class")
    _, _, height = total(car)
    lever = car.wheelbase / height
    front = slope(car.front.kinematics.path("longitudinal"), car.front.kinematics.travel)
    rear = slope(car.rear.kinematics.path("longitudinal"), car.rear.kinematics.travel)
    assert front * car.brakes.front_share * lever == pytest.approx(0.30, abs=0.02)
    driven = slope(car.rear.kinematics.path("longitudinal_centre"), car.rear.kinematics.travel)
    assert -rear * (1 - car.brakes.front_share) * lever == pytest.approx(0.32, abs=0.02)
    assert -driven * lever == pytest.approx(0.40, abs=0.02)


def test_camber_over_steer_is_that_of_an_inclined_axis():
    """Rotation of the left wheel's axle about an axis with 6 deg of caster and 12 deg of inclination."""
    kinematics = load_vehicle("s_class").front.kinematics
    caster, inclination = math.radians(6), math.radians(12)
    axis = np.array([-math.tan(caster), -math.tan(inclination), 1.0])
    axis /= np.linalg.norm(axis)
    start = straight(kinematics, "camber")[list(kinematics.travel).index(0.0)]
    for j, angle in enumerate(kinematics.steer):
        spin = np.array([0.0, 1.0, 0.0])
        turned = (
            spin * math.cos(angle)
            + np.cross(axis, spin) * math.sin(angle)
            + axis * (axis @ spin) * (1 - math.cos(angle))
        )
        top_outwards = -math.asin(turned[2])
        camber = kinematics.angles("camber")[list(kinematics.travel).index(0.0), j] - start
        assert camber == pytest.approx(top_outwards, abs=math.radians(0.25))


@pytest.mark.parametrize("name", CARS)
def test_the_steering_is_damped(name):
    steering = load_vehicle(name).steering
    critical = 2 * math.sqrt(steering.stiffness * steering.knuckle_inertia)
    assert 0.3 < steering.damping / critical < 0.7
    assert 25 < math.degrees(steering.largest_wheel_angle) < 45


@pytest.mark.parametrize(("name", "power"), [("s_class", 225e3), ("bmw_320i", 75e3)])
def test_rated_power(name, power):
    powertrain = load_vehicle(name).powertrain
    assert (np.array(powertrain.speed) * powertrain.full_torque).max() == pytest.approx(power, rel=0.01)


def test_torque_of_the_v8():
    """460 N m from 2700 to 4250 1/min and nowhere more."""
    powertrain = load_vehicle("s_class").powertrain
    flat = [
        speed * 30 / math.pi
        for speed, torque in zip(powertrain.speed, powertrain.full_torque, strict=True)
        if torque == 460
    ]
    assert (min(flat), max(flat)) == (pytest.approx(2700), pytest.approx(4250))
    assert max(powertrain.full_torque) == 460


@pytest.mark.parametrize(("name", "low", "high"), [("s_class", 255, 300), ("bmw_320i", 170, 195)])
def test_top_speed(name, low, high):
    """Rated power against drag and a rolling resistance of 1 %; the real S 500 is limited to 250 km/h."""
    car = load_vehicle(name)
    power = (np.array(car.powertrain.speed) * car.powertrain.full_torque).max() * car.powertrain.efficiency
    mass, _, _ = total(car)
    air = car.aerodynamics
    speeds = np.linspace(20, 100, 8001)
    needed = (0.5 * air.density * air.area * air.drag * speeds**2 + 0.01 * mass * GRAVITY) * speeds
    assert low < 3.6 * speeds[np.searchsorted(needed, power)] < high


@pytest.mark.parametrize("name", CARS)
def test_full_pedal_is_above_1_g(name):
    car = load_vehicle(name)
    assert 1.0 < car.brakes.torque / car.wheel_radius / total(car)[0] / GRAVITY < 1.6


def test_the_saloons_brakes_lock_the_front_axle_first():
    """At 0.8 g the front axle's share of the force exceeds its share of the load."""
    car = load_vehicle("s_class")
    _, behind, height = total(car)
    front_load = 1 - behind / car.wheelbase + 0.8 * height / car.wheelbase
    assert front_load < car.brakes.front_share < front_load + 0.1


def test_the_saloons_tyre_is_put_together_from_two_published_ones():
    """Lateral and aligning coefficients of the passenger car template; everything else as in the scaled sedan tyre."""
    scaled, saloon = (load_tyre(TYRES / f"pac2002_235_55R17{end}.tir") for end in ("", "_reconstructed"))
    lateral, aligning = saloon.lateral, saloon.aligning
    assert (lateral.PCY1, lateral.PDY1, lateral.PDY2, lateral.PDY3) == (1.3223, 1.0141, -0.12274, -1.0426)
    assert (lateral.PKY1, lateral.PKY2, lateral.PTY1, lateral.PTY2) == (-19.797, 1.7999, 1.9, 2.25)
    assert (lateral.PVY1, lateral.PVY3, lateral.PVY4) == (0.031305, -0.092912, -0.27907)
    assert (aligning.QBZ1, aligning.QDZ1, aligning.SSZ1) == (7.5088, 0.062582, 0.022576)
    for section in ("longitudinal", "vertical", "radius", "ranges", "scaling", "rolling"):
        assert getattr(saloon, section) == getattr(scaled, section), section
    weights = ("RBY1", "RBY2", "RBY3", "RCY1")
    assert all(getattr(lateral, key) == getattr(scaled.lateral, key) for key in weights)


def test_the_saloons_tyre_carries_the_leaning_outer_wheel():
    """Leaning out of the turn by 7 degrees under 9.2 kN it carries 0.9 of its load, the scaled sedan tyre 0.81."""
    scaled, saloon = (load_tyre(TYRES / f"pac2002_235_55R17{end}.tir") for end in ("", "_reconstructed"))
    slips = np.radians(np.linspace(0.0, 15.0, 200))

    def grip(tyre):
        forces = [tyre.evaluate(0.0, slip, math.radians(-7.0), 9200.0).lateral_force for slip in slips]
        return max(np.abs(forces)) / 9200.0

    assert grip(saloon) == pytest.approx(0.90, abs=0.01)
    assert grip(scaled) == pytest.approx(0.81, abs=0.01)


def test_the_scaled_tyre_is_the_published_one_at_a_larger_load():
    """Similarity: equal friction and equal ``C/F_z`` at equal shares of the nominal load."""
    published, scaled = (load_tyre(TYRES / name) for name in ("pac2002_245_40R18.tir", "pac2002_235_55R17.tir"))
    published = published.model_copy(update={"scaling": published.scaling.model_copy(update={"LFZO": 1.0})})
    for share in (0.3, 1.0, 1.9):
        forces = []
        for tyre in (published, scaled):
            load = share * tyre.vertical.FNOMIN
            out = tyre.evaluate(0.0, 0.05, 0.02, load)
            forces.append([out.lateral_force / load, out.longitudinal_force / load])
        np.testing.assert_allclose(forces[0], forces[1], rtol=1e-9)
    nominal, largest = scaled.vertical.FNOMIN, scaled.ranges.FZMAX
    assert nominal == pytest.approx(775 / 650 * published.vertical.FNOMIN, rel=1e-3)
    assert largest == pytest.approx(775 / 650 * published.ranges.FZMAX, rel=1e-3)


def test_the_bmws_tyre_is_that_of_commonroad():
    """Combined-slip coefficients of parameters_tire.yaml; the pure-slip ones that both sources give are equal."""
    tyre, published = load_tyre(TYRES / "pac2002_commonroad.tir"), load_tyre(TYRES / "pac2002_245_40R18.tir")
    longitudinal, lateral = tyre.longitudinal, tyre.lateral
    assert (longitudinal.RBX1, longitudinal.RBX2, longitudinal.RCX1) == (13.276, -13.778, 1.2568)
    assert (longitudinal.REX1, longitudinal.RHX1) == (0.65225, 0.0050722)
    assert (lateral.RBY1, lateral.RBY2, lateral.RBY3, lateral.RCY1) == (7.1433, 9.1916, -0.027856, 1.0719)
    assert (lateral.REY1, lateral.RHY1, lateral.RVY1, lateral.RVY3) == (-0.27572, 5.7448e-06, -0.027825, -0.27568)
    assert (lateral.RVY4, lateral.RVY5, lateral.RVY6) == (12.12, 1.9, -10.704)
    for section in ("longitudinal", "lateral"):
        for name, value in getattr(published, section).model_dump().items():
            if name.startswith("P"):
                assert getattr(getattr(tyre, section), name) == value, name


@pytest.mark.parametrize("name", CARS)
def test_bounds_of_the_small_parts(name):
    car = load_vehicle(name)
    assert isinstance(car.steering, Steering)
    assert isinstance(car.brakes, Brakes)
    assert isinstance(car.aerodynamics, Aerodynamics)
    assert car.aerodynamics.side > 0 < car.aerodynamics.yaw
    assert car.powertrain.driven == "rear"
