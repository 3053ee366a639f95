"""Case files: what they accept, what they refuse in one line, and what a run leaves behind."""

from __future__ import annotations

import json
import shutil
from pathlib import Path

import numpy as np
import pytest

from design.case import available_cases, load_case
from design.results import carry_out, staged
from design.running import run_case
from susp_mj import InputError, Run

CASE = """
title = "two dampers"
model = "quarter_2dof"
numbers = ["body_acceleration_max", "wheel_load_min"]
[manoeuvre]
kind = "bump"
height = "40 mm"
speed = "50 km/h"
duration = "1 s"
[[configuration]]
name = "a"
vehicle = "chapter3"
characteristics = "linear"
[[configuration]]
name = "b"
vehicle = "chapter3"
characteristics = "linear"
set = { "rear.damper.rates" = ["1200 N s/m"] }
[criteria]
body_acceleration_max = { max = "5 m/s²" }
"""


def write(folder: Path, text: str) -> Path:
    path = folder / "mine.toml"
    path.write_text(text)
    return path


def test_every_shipped_case_runs(tmp_path):
    assert available_cases()
    for name in available_cases():
        comparison = run_case(*load_case(name))
        assert len(comparison.configurations) >= 1
        for each in comparison.configurations:
            assert all(np.isfinite(number.value) for number in each.numbers.values() if number.value is not None)


def test_a_run_leaves_summary_runs_plots_and_report(tmp_path):
    out = tmp_path / "out"
    comparison = carry_out(*load_case(write(tmp_path, CASE)), out)
    summary = json.loads((out / "summary.json").read_text())
    first, second = summary["configurations"]
    assert {"configuration", "vehicle", "load", "model", "manoeuvre", "numbers", "criteria"} <= set(first)
    assert first["numbers"]["body_acceleration_max"]["unit"] == "m/s²"
    verdict = first["criteria"]["body_acceleration_max"]
    assert verdict["max"] == 5.0
    assert verdict["min"] is None
    assert verdict["passed"] == (verdict["value"] <= 5.0)
    assert first["numbers"]["body_acceleration_max"]["value"] > second["numbers"]["body_acceleration_max"]["value"]
    assert summary["versions"]["mujoco"]
    saved = Run.load(out / "runs" / "a.nc")
    assert np.array_equal(saved["wheel_load"], comparison.configurations[0].run["wheel_load"])
    assert list((out / "plots").glob("*.svg"))
    assert (out / "report.html").stat().st_size > 10_000
    assert not [path for path in out.iterdir() if path.name.startswith(".")]


def test_same_case_same_files(tmp_path):
    case = load_case(write(tmp_path, CASE))
    for name in ("one", "two"):
        carry_out(*case, tmp_path / name)
    for part in ("report.html", "plots"):
        first, second = tmp_path / "one" / part, tmp_path / "two" / part
        files = [first] if first.is_file() else sorted(first.iterdir())
        assert files
        for file in files:
            other = second if second.is_file() else second / file.name
            assert file.read_bytes() == other.read_bytes(), file.name


def test_a_vehicle_file_beside_the_case_is_found(tmp_path):
    import vehicles

    shutil.copy(Path(vehicles.__file__).parent / "chapter3.toml", tmp_path / "mine_car.toml")
    path = write(tmp_path, CASE.replace('vehicle = "chapter3"', 'vehicle = "mine_car.toml"'))
    assert run_case(*load_case(path)).configurations[0].run.meta["vehicle"] == "mine_car"


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ('model = "quarter_2dof"', 'model = "quarter_2dofs"', ["mine.toml: model: ", "did you mean 'quarter_2dof'"]),
        ('kind = "bump"', 'kind = "bmup"', ["mine.toml: manoeuvre.kind: ", "did you mean 'bump'"]),
        ('height = "40 mm"', 'hight = "40 mm"', ["mine.toml: manoeuvre.hight: ", "did you mean 'height'"]),
        ('height = "40 mm"', 'height = "40 kg"', ["mine.toml: manoeuvre.height: ", "'40 kg'", "m"]),
        ('speed = "50 km/h"', "speed = -3", ["mine.toml: manoeuvre.speed: ", "-3", "greater than 0"]),
        (
            'duration = "1 s"',
            "duration = 0.1",
            ["mine.toml: manoeuvre.start: ", "0.2 s is not allowed", "ends after 0.1 s"],
        ),
        ('duration = "1 s"', "duration = nan", ["mine.toml: manoeuvre.duration: ", "nan", "finite"]),
        (
            'vehicle = "chapter3"',
            'vehicle = "chapter4"',
            ["mine.toml: configuration.0.vehicle: ", "chapter4", "chapter3"],
        ),
        (
            'vehicle = "chapter3"',
            'vehicle = "none.toml"',
            ["mine.toml: configuration.0.vehicle: ", "none.toml': no such file"],
        ),
        (
            'characteristics = "linear"',
            'characteristics = "linaer"',
            ["mine.toml: configuration.0.characteristics: chapter3.toml has no set 'linaer'; did you mean 'linear'"],
        ),
        ('name = "b"', 'name = "a"', ["mine.toml: configuration: ", "'a' names two configurations"]),
        (
            'name = "b"',
            'name = "A"',
            ["mine.toml: configuration: ", "'A' names two configurations", "'a' is too much like it"],
        ),
        ('duration = "1 s"', "duration = 1e9", ["mine.toml: manoeuvre.duration: ", "too long", "10000 s"]),
        (
            'name = "b"',
            'name = "b"\nload = "heavy"',
            ["mine.toml: configuration.1.load: chapter3.toml with overrides has no load case 'heavy'; choose ko"],
        ),
        (
            'name = "b"',
            'name = "b"\naxle = "front"',
            ["mine.toml: configuration.1.axle: chapter3.toml with overrides has no axle 'front'; choose rear"],
        ),
        (
            '["1200 N s/m"]',
            '["-5 N s/m"]',
            ["mine.toml: configuration.1.set.rear.damper.rates.0: ", "-5", "greater than 0"],
        ),
        (
            '"rear.damper.rates"',
            '"rear.dampr.rates"',
            [
                "mine.toml: configuration.1.set.rear.dampr.rates: laid over chapter3.toml: rear.dampr: ",
                "did you mean 'damper'",
            ],
        ),
        ('max = "5 m/s²"', 'max = "5 m"', ["mine.toml: criteria.body_acceleration_max.max: ", "'5 m'", "m/s²"]),
        ('max = "5 m/s²"', 'max = "5 m/s²", min = 9', ["mine.toml: criteria.body_acceleration_max: ", "9", "5"]),
        (
            "body_acceleration_max = {",
            "body_acceleration_maximum = {",
            ["mine.toml: criteria: ", "did you mean 'body_acceleration_max'"],
        ),
        ('numbers = ["body', 'numbers = ["bdy', ["mine.toml: numbers: ", "did you mean 'body_acceleration_max'"]),
        (
            "[[configuration]]",
            "[[configurations]]",
            ["mine.toml: configurations: unknown key", "did you mean 'configuration'"],
        ),
        ('title = "two dampers"', 'title = "two', ["mine.toml: is not TOML", "line 2"]),
        ('title = "two dampers"', "step = 0\ntitle = 'x'", ["mine.toml: step: ", "greater than 0"]),
    ],
)
def test_bad_input_is_one_line_that_names_place_and_choices(tmp_path, old, new, expected):
    out = tmp_path / "out"
    assert old in CASE
    with pytest.raises(InputError) as caught:
        carry_out(*load_case(write(tmp_path, CASE.replace(old, new, 1))), out)
    text = str(caught.value)
    assert "\n" not in text
    for part in expected:
        assert part in text
    assert not out.exists()


@pytest.mark.parametrize(
    ("criterion", "expected"),
    [
        ('body_aceleration_max = { max = "8 m/s²" }', ["criteria: 'body_aceleration_max' unknown", "did you mean"]),
        ('body_acceleration_max = { max = "8 mm" }', ["criteria.body_acceleration_max.max: '8 mm'", "m/s²"]),
        ('stop_hits = { min = "2 mm" }', ["criteria.stop_hits.min: '2 mm'", "none"]),
        ("overshoot = { min = 0.4, max = 0.3 }", ["criteria.overshoot: min 0.4 lies above max 0.3"]),
    ],
)
def test_criteria_are_checked_when_the_case_is_read(tmp_path, criterion, expected):
    path = write(tmp_path, CASE.split("[criteria]", maxsplit=1)[0] + f"[criteria]\n{criterion}\n")
    with pytest.raises(InputError) as caught:
        load_case(path)
    text = str(caught.value)
    assert "\n" not in text and len(text) < 500
    for part in ("mine.toml: ", *expected):
        assert part in text


def test_criteria_in_engineers_units(tmp_path):
    text = CASE.replace('{ max = "5 m/s²" }', '{ max = "5 m/s²" }\nroll_angle_max = { min = "-1 deg", max = "3 deg" }')
    bands = load_case(write(tmp_path, text))[0].bands()
    assert bands["body_acceleration_max"].maximum == 5.0 and bands["body_acceleration_max"].minimum is None
    assert bands["roll_angle_max"].maximum == pytest.approx(np.radians(3.0))


def test_missing_case_lists_the_shipped_ones():
    with pytest.raises(InputError, match=r"no case 'chapter_3'; did you mean 'chapter3'"):
        load_case("chapter_3")


def test_unwritable_output_is_refused_before_anything_is_simulated(tmp_path):
    blocker = tmp_path / "file"
    blocker.write_text("in the way")
    with pytest.raises(InputError, match="cannot be written"):
        carry_out(*load_case(write(tmp_path, CASE)), blocker / "out")
    assert blocker.read_text() == "in the way"


def test_an_error_while_writing_leaves_the_folder_as_it_was(tmp_path):
    out = tmp_path / "deep" / "out"
    with pytest.raises(RuntimeError), staged(out) as stage:
        (stage / "half.txt").write_text("half")
        raise RuntimeError
    assert not (tmp_path / "deep").exists()
    out.mkdir(parents=True)
    (out / "mine.txt").write_text("keep")
    with pytest.raises(RuntimeError), staged(out) as stage:
        (stage / "mine.txt").write_text("half")
        raise RuntimeError
    assert [path.name for path in out.iterdir()] == ["mine.txt"]
    assert (out / "mine.txt").read_text() == "keep"
