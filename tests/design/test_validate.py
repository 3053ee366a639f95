"""`susp-mj validate`: exit codes, what it leaves behind, one line for what is wrong."""

from __future__ import annotations

import json

import numpy as np
import pytest
from typer.testing import CliRunner

from design.case import load_case
from design.cli import app
from design.validate import asked, validated
from manoeuvres import Bump
from susp_mj import InputError, simulate
from vehicles import load_vehicle
from vehicles.mjcf import build

CASE = """\
title = "Bump"
model = "quarter_2dof"

[manoeuvre]
kind = "bump"
duration = 1.5

[[configuration]]
name = "linear"
vehicle = "chapter3"
characteristics = "linear"
"""
MAP = """\
[validation]
filter = "CFC 60"

[[validation.signal]]
channel = "rear body_acceleration"
column = "a z"
tolerance = { gain = 0.03 }
"""


@pytest.fixture
def case(tmp_path):
    path = tmp_path / "bump.toml"
    path.write_text(CASE)
    (tmp_path / "map.toml").write_text(MAP)
    run = simulate(build(load_vehicle("chapter3", "linear"), "quarter_2dof"), Bump(duration=1.5))
    noise = np.random.default_rng(1).normal(0, 0.02, len(run.time))
    for name, factor in (("same", 1.0), ("other", 1.1)):
        values = (factor * run["body_acceleration"] + noise) / 9.80665
        rows = np.column_stack([run.time + 0.1, values])
        np.savetxt(tmp_path / f"{name}.csv", rows, "%.6f", ";", header="time [s];a z [g]", comments="")
    return path


def called(folder, *arguments):
    """`susp-mj validate`, its errors raised."""
    return CliRunner().invoke(app, ["validate", str(folder / "bump.toml"), *map(str, arguments)])


@pytest.mark.parametrize(("name", "code"), [("same", 0), ("other", 1)])
def test_inside_is_0_and_outside_1_with_everything_left_behind(case, name, code):
    folder = case.parent
    result = called(folder, folder / f"{name}.csv", "--map", folder / "map.toml", "--out", folder / "out")
    assert result.exit_code == code, result.output
    assert ("OUTSIDE" in result.output) is bool(code)
    assert "CFC 60 (SAE J211, -3 dB at 100 Hz)" in result.output and "-0.1000 s on its time" in result.output
    assert sorted(each.name for each in (folder / "out").iterdir()) == [
        "plots",
        "run.nc",
        "validation.html",
        "validation.json",
    ]
    found = json.loads((folder / "out" / "validation.json").read_text())
    assert found["inside"] is not bool(code)
    (channel,) = found["channels"]
    assert channel["errors"]["of_peak"] == pytest.approx(100 * (0.0 if code == 0 else 1 - 1 / 1.1), abs=0.5)
    page = (folder / "out" / "validation.html").read_text()
    assert 'src="http' not in page and ("✗ Outside." in page) is bool(code)


def test_the_table_may_stand_in_the_case_file(case):
    case.write_text(CASE + MAP)
    what = asked(*load_case(case))
    assert what.settings.filter == "CFC 60"
    assert validated(what, [case.parent / "same.csv", case.parent / "same.csv"], case.parent / "out").inside


def test_what_is_wrong_is_one_line(case):
    folder = case.parent
    loaded, path = load_case(case)
    with pytest.raises(InputError, match=r"same\.csv: no column is called like a channel"):
        validated(asked(loaded, path), [folder / "same.csv"], folder / "out")
    with pytest.raises(InputError, match=r"gone\.csv: no such file"):
        validated(asked(loaded, path), [folder / "gone.csv"], folder / "out")
    (folder / "map.toml").write_text(MAP.replace("CFC 60", "CFC 61"))
    with pytest.raises(InputError, match=r"map\.toml: filter: no class 61; choose CFC 60"):
        asked(loaded, path, folder / "map.toml")
    (folder / "map.toml").write_text(MAP.replace("body_acceleration", "body_jerk"))
    with pytest.raises(InputError, match=r"map\.toml: validation: no channel 'rear body_jerk'"):
        validated(asked(loaded, path, folder / "map.toml"), [folder / "same.csv"], folder / "out")
    (folder / "map.toml").write_text(MAP.replace("CFC 60", "CFC 1000"))
    with pytest.raises(InputError, match=r"map.toml: validation.filter: CFC 1000 .* \(run\)"):
        validated(asked(loaded, path, folder / "map.toml"), [folder / "same.csv"], folder / "out")
    assert not (folder / "out").exists()


def test_one_of_several_configurations_is_named(case):
    case.write_text(CASE + CASE[CASE.index("[[") :].replace("linear", "nonlinear"))
    loaded, path = load_case(case)
    with pytest.raises(InputError, match=r"--configuration: bump\.toml has several; choose linear, nonlinear"):
        asked(loaded, path)
    with pytest.raises(InputError, match=r"--configuration: no configuration 'linaer'; did you mean 'linear'"):
        asked(loaded, path, configuration="linaer")
    assert asked(loaded, path, configuration="nonlinear").job.setting.characteristics == "nonlinear"
