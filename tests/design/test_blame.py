"""Errors name the file in which the user wrote what is wrong, and its key there."""

from __future__ import annotations

import shutil

import pytest
from typer.testing import CliRunner

from design.case import load_case
from design.cli import app
from design.running import jobs_of, prepare, simulated
from susp_mj import InputError
from vehicles.reading import FOLDER, load_vehicle

CASE = """
title = "overridden"
model = "{model}"
[manoeuvre]
kind = "bump"
[[configuration]]
name = "as it is"
vehicle = "s_class"
characteristics = "configuration_4"
[[configuration]]
name = "overridden"
vehicle = "{car}"
characteristics = "configuration_4"
load = "full"
{more}
"""


def refused(folder, more, model="handling", car="s_class") -> str:
    """The line with which the second configuration of a case ends."""
    path = folder / "mine.toml"
    path.write_text(CASE.format(model=model, car=car, more=more), encoding="utf-8")
    with pytest.raises(InputError) as caught:
        simulated(prepare(jobs_of(*load_case(path))[1]))
    assert "\n" not in str(caught.value)
    return str(caught.value)


ALONE = {
    "front.spring.frequency": ('"-1 Hz"', "greater than 0"),
    "front.spring.rate": ("3", "unknown key"),
    "front.spring": ('{ kind = "lineer" }', "did you mean 'linear'"),
    "front.spring.kind": ('"lineer"', "did you mean 'linear'"),
    "front.track": ('"3 kg"', "'3 kg'"),
    "front.track.width": ("3", "is not a table"),
    "front.kinematics.travel": ("[0.1, 0.2, 0.1]", "0.1"),
    "front.handling_tyre": ('{ kind = "linear" }', "is required"),
    "front.handling_tyre.file": ('"none.tir"', "no file 'none.tir'"),
    "front.handling_tyre.inflation_pressure": ('"2 bar"', "MF 5.2 does not depend on it"),
    "front.handling_tyre.vertical_stiffness": ('"10 N/mm"', "would press the tyre in"),
    "rear.kinematics.steer": ("3", "3"),
    "loads.full.sprung_mass": ('"-3 kg"', "at least"),
    "loads.full.cg.0": ("3", "between the axles"),
    "loads.full.cg.2": ("-3", "below the ground"),
    "powertrain.gears": ("[]", ""),
    "steering.ratio": ("nan", "finite"),
    "brakes.kind": ('"no"', "no"),
    "wheel_base": ("3", "did you mean 'wheelbase'"),
    "name": ('"mine"', "named by its file"),
    "characteristics.x": ("3", "cannot be overridden"),
}
"""Overrides that are wrong by themselves, and what is said of them."""
TOGETHER = {
    "front.spring.stops": ('{ rebound = "-0.3 m", compression = "0.3 m" }', "front.kinematics.travel: "),
    "loads.full.sprung_mass": ('"9000 kg"', "front.spring: cannot carry load 'full'"),
    "loads.full.corner_mass": ("{ front = 300 }", "loads.full: give either"),
    "rear.dampr.rates": ("[3]", "rear.dampr: unknown key; did you mean 'damper'"),
}
"""Overrides that are wrong on this car, and what they make wrong of it."""


@pytest.mark.parametrize("path", ALONE)
def test_an_override_that_is_wrong_is_the_mistake_of_the_case(tmp_path, path):
    value, why = ALONE[path]
    line = refused(tmp_path, f'set = {{ "rear.track" = "1.5 m", "{path}" = {value} }}')
    assert line.startswith(f"mine.toml: configuration.1.set.{path}")
    assert why in line
    assert "s_class.toml" not in line


@pytest.mark.parametrize("path", TOGETHER)
def test_an_override_that_makes_another_value_wrong_names_both_files(tmp_path, path):
    value, why = TOGETHER[path]
    line = refused(
        tmp_path, f'set = {{ "rear.track" = "1.5 m", "{path}" = {value}, "front.track" = 1.5 }}', "full_7dof"
    )
    assert line.startswith(f"mine.toml: configuration.1.set.{path}: laid over s_class.toml: {why}")


def test_a_mistake_of_the_cars_file_stays_its_own(tmp_path):
    text = (FOLDER / "s_class.toml").read_text(encoding="utf-8")
    (tmp_path / "car.toml").write_text(text.replace('"-1.6680 m"', '"1.6680 m"'), encoding="utf-8")
    line = refused(tmp_path, 'set = { "rear.track" = "1.5 m" }', car="car.toml")
    assert line.startswith("car.toml: loads.full.cg.0: 1.668 m is not allowed")


def test_a_mistake_of_a_tyre_file_stays_its_own(tmp_path):
    (tmp_path / "worn.tir").write_text("[MODEL]\n")
    shutil.copy(FOLDER / "s_class.toml", tmp_path / "car.toml")
    line = refused(tmp_path, 'set = { "front.handling_tyre.file" = "worn.tir" }', car="car.toml")
    assert line.startswith("worn.tir: MODEL.")


def test_from_python_the_source_says_that_the_file_is_overridden():
    with pytest.raises(InputError) as caught:
        load_vehicle("chapter3", "linear", {"rear.damper.rates": [-5]})
    assert str(caught.value).startswith("chapter3.toml with overrides: rear.damper.rates.0: ")


@pytest.mark.parametrize(
    ("arguments", "line"),
    [
        (("--vehicle", "chapter4"), "--vehicle: no vehicle 'chapter4'; did you mean 'chapter3'"),
        (("--vehicle", "none.toml"), "--vehicle: 'none.toml': no such file"),
        (("--characteristics", "linaer"), "--characteristics: chapter3.toml has no set 'linaer'"),
        (("--load", "ko", "heavy"), "--load: chapter3.toml has no load case 'heavy'"),
        (("--axle", "front"), "--axle: chapter3.toml has no axle 'front'"),
        (("--model", "quarter"), "--model: 'quarter' unknown; did you mean 'quarter_2dof'"),
        (("--height", "8 kg"), "--height: '8 kg'"),
        (("--duration", "1e9"), "--duration: 1e+09 s is too long"),
        (("--workers", "0"), "--workers: 0 is not allowed"),
    ],
)
def test_a_wrong_option_of_a_script_is_named_as_it_was_written(tmp_path, arguments, line):
    done = CliRunner().invoke(app, ["drive", "bump", "-c", "linear", "--out", str(tmp_path / "out"), *arguments])
    assert isinstance(done.exception, InputError)
    assert str(done.exception).startswith(line)
