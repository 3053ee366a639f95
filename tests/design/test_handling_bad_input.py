"""Bad input of the car that drives freely: one line that names file, key, value and what is allowed, and no folder left
behind."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from design.case import load_case, read_manoeuvre
from design.results import carry_out
from evaluation.numbers import NUMBERS
from susp_mj import Plant, simulate
from susp_mj.elements.tyres.tir import load_tyre
from susp_mj.errors import InputError
from susp_mj.handling.block import CAR_NUMERIC, HEAD, WHEEL
from vehicles.mjcf import build, write
from vehicles.reading import FOLDER, load_vehicle

SALOON = (FOLDER / "s_class.toml").read_text(encoding="utf-8")
OWN_TYRE = 'file = "pac2002_235_55R17_reconstructed.tir"'
TYRES = {
    name: (FOLDER / "tyres" / f"{name}.tir").read_text(encoding="utf-8")
    for name in ("pac2002_235_55R17", "mf61_205_60R15")
}


def changed(text: str, old: str, new: str) -> str:
    assert old in text, old
    return text.replace(old, new, 1)


def without(text: str, key: str) -> str:
    return changed(text, next(line for line in text.splitlines() if re.match(rf"{key}\s*=", line)), "")


def with_value(text: str, key: str, value: str) -> str:
    return changed(text, next(line for line in text.splitlines() if re.match(rf"{key}\s*=", line)), f"{key} = {value}")


def case_text(manoeuvre: str, more: str = "") -> str:
    return (
        f'title = "t"\nmodel = "handling"\n[manoeuvre]\n{manoeuvre}\n[[configuration]]\n'
        f'name = "a"\nvehicle = "s_class"\n{more}'
    )


def line_of_case(tmp_path: Path, manoeuvre: str, more: str = "") -> str:
    """The one line that a case with this manoeuvre ends with; nothing of its results may stay."""
    path = tmp_path / "mine.toml"
    path.write_text(case_text(manoeuvre, more), encoding="utf-8")
    with pytest.raises(InputError) as caught:
        case, source = load_case(path)
        carry_out(case, source, tmp_path / "out")
    assert not (tmp_path / "out").exists()
    assert "\n" not in str(caught.value)
    return str(caught.value)


def line_of_vehicle(tmp_path: Path, text: str) -> str:
    path = tmp_path / "mine.toml"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError) as caught:
        build(load_vehicle(path), "handling")
    assert "\n" not in str(caught.value)
    return str(caught.value)


def line_of_tyre(tmp_path: Path, text: str) -> str:
    path = tmp_path / "mine.tir"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(InputError) as caught:
        load_tyre(path)
    assert "\n" not in str(caught.value)
    return str(caught.value)


@pytest.mark.parametrize(("name", "key"), [("pac2002_235_55R17", "PCY1"), ("mf61_205_60R15", "PKY1")])
def test_a_tyre_file_with_a_missing_coefficient(tmp_path, name, key):
    assert line_of_tyre(tmp_path, without(TYRES[name], key)) == f"mine.tir: LATERAL_COEFFICIENTS.{key}: is required"


def test_a_car_whose_tyre_file_misses_a_coefficient_names_that_file(tmp_path):
    (tmp_path / "worn.tir").write_text(without(TYRES["pac2002_235_55R17"], "PCY1"), encoding="utf-8")
    line = line_of_vehicle(tmp_path, changed(SALOON, "pac2002_235_55R17_reconstructed.tir", "worn.tir"))
    assert line == "worn.tir: LATERAL_COEFFICIENTS.PCY1: is required"


def test_a_torque_map_that_is_not_monotone_in_speed(tmp_path):
    line = line_of_vehicle(tmp_path, changed(SALOON, '"1000 1/min", "1500 1/min"', '"1500 1/min", "1000 1/min"'))
    assert (
        line == "mine.toml: powertrain.speed.2: 1000 1/min follows 1500 1/min; "
        "the torque map must increase strictly in speed"
    )


def test_a_table_over_travel_that_does_not_cover_the_stops(tmp_path):
    line = line_of_vehicle(tmp_path, changed(SALOON, "travel = [-0.12, -0.10,", "travel = [-0.09, -0.085,"))
    assert line == (
        "mine.toml: front.kinematics.travel: -0.09 to 0.12 m does not cover the stops, -0.1 to 0.1 m; it must reach "
        "from stop to stop"
    )


def test_a_manoeuvre_faster_than_the_car_can_go(tmp_path):
    line = line_of_case(tmp_path, 'kind = "step_steer"\nspeed = "400 km/h"')
    found = re.fullmatch(
        r"mine\.toml: manoeuvre\.speed: 111\.1 m/s \(400\.0 km/h\) is not allowed; "
        r"the car goes (\S+) m/s \(\d+ km/h\) at most",
        line,
    )
    assert found is not None
    assert 60 < float(found[1]) < 90


@pytest.mark.parametrize(
    ("key", "value", "line"),
    [
        ("USE_MODE", "1e400", "mine.tir: MODEL.USE_MODE: '1e400' is not a finite number"),
        ("USE_MODE", "3.5", "mine.tir: MODEL.USE_MODE: '3.5' is not a mode; write a whole number, 0 at least"),
        ("USE_MODE", "-6", "mine.tir: MODEL.USE_MODE: '-6' is not a mode; write a whole number, 0 at least"),
        ("LGYR", "abc", "mine.tir: SCALING_COEFFICIENTS.LGYR: 'abc' is not a number"),
        (
            "PKY2",
            "1e-300",
            "mine.tir: a coefficient is out of all bounds: at slip 0 and a load of 4000 N the forces are not finite",
        ),
    ],
)
def test_a_damaged_tyre_file(tmp_path, key, value, line):
    assert line_of_tyre(tmp_path, with_value(TYRES["pac2002_235_55R17"], key, value)) == line


def test_a_pressure_is_refused_where_it_is_written(tmp_path):
    line = line_of_vehicle(
        tmp_path,
        changed(SALOON, OWN_TYRE, f'{OWN_TYRE}\ninflation_pressure = "2 bar"'),
    )
    assert (
        line == "mine.toml: front.handling_tyre.inflation_pressure: MF 5.2 does not depend on it; take a tyre of MF 6.1"
    )


def test_a_tyre_that_cannot_carry_the_car(tmp_path):
    line = line_of_vehicle(
        tmp_path,
        changed(SALOON, OWN_TYRE, f'{OWN_TYRE}\nvertical_stiffness = "10 N/mm"'),
    )
    assert line.startswith(
        "mine.toml: front.handling_tyre.vertical_stiffness: 10000 N/m is not allowed; 5028 N would press"
    )
    assert line.endswith("more than half its radius of 345 mm")


def test_a_centre_of_gravity_below_the_ground(tmp_path):
    line = line_of_vehicle(tmp_path, changed(SALOON, '"0.3259 m"', '"-3 m"'))
    assert (
        line == "mine.toml: loads.ko.cg.2: -3 m is not allowed; the centre of gravity would lie 2.68 m below the ground"
    )


@pytest.mark.parametrize(
    ("manoeuvre", "line"),
    [
        (
            'kind = "step_steer"\nangle = 85',  # degrees were meant
            "mine.toml: manoeuvre: step_steer turns the steering wheel by 51.07 rad (2926 deg); it goes 9.425 rad "
            "(540 deg) to either "
            "side (steering.limit of s_class.toml)",
        ),
        (
            'kind = "suspension_rig"\ntest = "steer"\nsteering_wheel_angle = "720 deg"',
            "mine.toml: manoeuvre: suspension_rig turns the steering wheel by 12.57 rad (720 deg); it goes 9.425 "
            "rad (540 deg) to either "
            "side (steering.limit of s_class.toml)",
        ),
        (
            'kind = "step_steer"\nduration = 1e9',
            "mine.toml: manoeuvre.duration: 1e+09 s is too long for a step of 1 ms; allowed are 1e+07 steps, 10000 s",
        ),
        (
            'kind = "bump"\nlength = "10 mm"',
            "mine.toml: manoeuvre.length: 0.01 m is not allowed for a car that drives freely; it must be from 0.2 m "
            "to 20 km",
        ),
        (
            'kind = "uneven_road"\nlength = 1e12',
            "mine.toml: manoeuvre.length: 1e+12 m is not allowed for a car that drives freely; it must be from 0.2 "
            "m to 20 km",
        ),
        (
            'kind = "sine_steer"\nfrequency = "100 Hz"',
            "mine.toml: manoeuvre.frequency: 100.0 is not allowed; it must be at most 50.0",
        ),
        (
            'kind = "lenksweep"\nend_frequency = "100 Hz"',
            "mine.toml: manoeuvre.end_frequency: 100.0 is not allowed; it must be at most 50.0",
        ),
        (
            'kind = "cross_slope"\ntransition = 1e14',
            "mine.toml: manoeuvre.transition: 1e+14 is not allowed; it must be at most 20000.0",
        ),
        (
            'kind = "random_road"\ntrack = 1e6',
            "mine.toml: manoeuvre.track: 1000000.0 is not allowed; it must be at most 10.0",
        ),
    ],
)
def test_manoeuvres_that_cannot_be(tmp_path, manoeuvre, line):
    assert line_of_case(tmp_path, manoeuvre).replace("100000000000000.0", "1e+14") == line


def test_a_car_that_tips_over_its_nose_says_so(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(case_text('kind = "bump"\nheight = "2 m"'), encoding="utf-8")
    (failure,) = carry_out(*load_case(path), tmp_path / "out").failures
    said = r"s_class, handling, bump: the car fell over at t = \d\.\d+ s, its pitch angle -?\d\d°"
    assert re.fullmatch(said, failure.reason)


def test_a_lane_change_that_ends_before_its_lanes_is_none_without_cones():
    run = simulate(
        build(load_vehicle("s_class"), "handling"), read_manoeuvre({"kind": "lane_change", "speed": "5 km/h"})
    )
    for name in ("cones_hit", "lane_departure"):
        number = NUMBERS[name](run)
        assert number.value is None
        assert number.note == "does not get to x = 111 m"


def test_a_circle_that_is_left_at_once_has_no_inner_wheel_load():
    run = simulate(
        build(load_vehicle("s_class"), "handling"),
        read_manoeuvre({"kind": "steady_circle", "radius": 5, "duration": 8}),
    )
    for name in ("inner_wheel_load_front", "inner_wheel_load_rear"):
        number = NUMBERS[name](run)
        assert number.value is None
        assert number.note == "does not follow its circle until it turns"


def place(name, *, wheel=False):
    """Where a number of the car, or of its first wheel, stands in the block."""
    return (WHEEL.fields[name][1] + HEAD.itemsize if wheel else HEAD.fields[name][1]) // 8


@pytest.mark.parametrize(
    ("at", "value", "line"),
    [
        (
            place("full_torque"),
            1e9,
            "'full_torque' is not where the car's numbers say; leave places and lengths as they are",
        ),
        (
            place("path", wheel=True),
            1e9,
            "'path' is not where the car's numbers say; leave places and lengths as they are",
        ),
        (
            place("tyre_parameters", wheel=True),
            -5,
            "'tyre_parameters' is not where the car's numbers say; leave places",
        ),
        (place("steering", wheel=True), 9999, "'steering' of a wheel lies outside the model; keep the order"),
        (place("gears"), 99, "99 gears are not allowed; 1 to 12 are"),
        (place("wind_x"), 5000, "5000 is not allowed for 'wind_x'; the model has 34 actuators, 0 to 33"),
        (place("freedoms"), 3, "is written for 3 freedoms, the model has 16; add no joints, build the car anew"),
        (
            place("engine_inertia"),
            0,
            "radius of a wheel, engine_inertia and steering_ratio must be greater than 0",
        ),
    ],
)
def test_a_written_file_with_numbers_changed_by_hand(tmp_path, at, value, line):
    path = write(load_vehicle("s_class"), "handling", tmp_path / "mine.xml")
    text = path.read_text(encoding="utf-8")
    found = re.search(rf'<numeric name="{CAR_NUMERIC}"[^>]*data="([^"]*)"', text)
    assert found is not None
    numbers = found[1].split()
    numbers[at] = f"{value:g}"
    path.write_text(text[: found.start(1)] + " ".join(numbers) + text[found.end(1) :], encoding="utf-8")
    with pytest.raises(InputError) as caught:
        Plant.from_mjcf(path)
    assert str(caught.value).startswith(f"{path}: {CAR_NUMERIC}: {line}")


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        (f'name="{CAR_NUMERIC}"', 'name="other"', "is required; it holds the numbers of model handling"),
        (
            'name="fl_steering"',
            'name="other"',
            "actuator 'fl_steering' is not where the car's numbers say; keep the order",
        ),
    ],
)
def test_a_written_file_with_names_changed_by_hand(tmp_path, old, new, line):
    path = write(load_vehicle("s_class"), "handling", tmp_path / "mine.xml")
    path.write_text(changed(path.read_text(encoding="utf-8"), old, new), encoding="utf-8")
    with pytest.raises(InputError) as caught:
        Plant.from_mjcf(path)
    assert str(caught.value) == f"{path}: {CAR_NUMERIC}: {line}"
