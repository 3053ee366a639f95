"""Results that are saved: report and film anew, folders side by side, all without simulating."""

from __future__ import annotations

import json
import shutil
from dataclasses import fields, replace
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from design.case import load_case, read_manoeuvre
from design.cli import app
from design.results import carry_out
from design.saved import compare_folders, renew_film, renew_report
from evaluation.characteristics import characteristic
from evaluation.compare import Claim
from evaluation.numbers import NUMBERS, Number
from evaluation.numbers.difference import difference
from evaluation.pages.report import write_report
from evaluation.saving import load, save
from susp_mj import InputError, Run
from vehicles import load_vehicle

from .test_running import LOW
from .test_running import STEP as TALL

BUMP = """
title = "a bump"
model = "quarter_2dof"
manoeuvre = { kind = "bump", height = "60 mm", duration = "1 s" }
[criteria]
body_acceleration_max = { max = "8 m/s²" }
[[configuration]]
name = "as it is"
vehicle = "chapter3"
characteristics = "nonlinear"
[[configuration]]
name = "1:3"
vehicle = "chapter3"
characteristics = "nonlinear"
set = { "rear.damper.ratio" = "1:3" }
"""
LOWER = BUMP.replace("60 mm", "40 mm").replace('max = "8', 'max = "6')
SWEEP = """
title = "a sweep"
model = "quarter_2dof"
manoeuvre = { kind = "vertical_sweep", amplitude = "10 mm", duration = "5 s" }
[[configuration]]
name = "linear"
vehicle = "chapter3"
characteristics = "linear"
"""
WHOLE = """
title = "a bump under four wheels"
model = "full_7dof"
manoeuvre = { kind = "bump", height = "60 mm", duration = "1 s" }
[[configuration]]
name = "four wheels"
vehicle = "s_class"
characteristics = "configuration_4"
"""
STEP = TALL.replace('numbers = ["lateral_acceleration_max"]', 'plugins = ["my_number.py"]') + LOW
MY_NUMBER = '''
from evaluation import numbers


def largest_of_mine(run):
    """Largest of my own [1]; nobody else knows it."""
    return numbers.Answer(1.0)


numbers.register(numbers.Measure(largest_of_mine, "1"))
'''
CASES = {"bump": BUMP, "lower": LOWER, "sweep": SWEEP, "whole": WHOLE, "step": STEP}


def claims(comparison):
    return [Claim("it moves", "> 0", "much", holds=True), Claim("it flies", "1 m", "1 mm", holds=False)]


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    """A folder of results for each case."""
    place = tmp_path_factory.mktemp("results")
    (place / "my_number.py").write_text(MY_NUMBER)
    for name, text in CASES.items():
        (place / f"{name}.toml").write_text(text)
        carry_out(*load_case(place / f"{name}.toml"), place / name, claims=claims if name == "bump" else None)
    yield place
    NUMBERS.pop("largest_of_mine", None)


@pytest.fixture(autouse=True)
def nothing_is_simulated(request, monkeypatch):
    request.getfixturevalue("results")

    def simulate(*arguments, **options):
        pytest.fail("simulates")

    monkeypatch.setattr("design.running.simulate", simulate)


def call(*arguments):
    return CliRunner().invoke(app, [str(each) for each in arguments])


def refused(*arguments) -> str:
    """The one line of a call that is refused as bad input."""
    result = call(*arguments)
    assert isinstance(result.exception, InputError), result.output
    line = str(result.exception)
    assert "\n" not in line
    return line


def summary_of(folder: Path) -> dict:
    return json.loads((folder / "summary.json").read_text())


@pytest.mark.parametrize("name", CASES)
def test_a_report_anew_is_the_report_of_the_run_byte_for_byte(results, tmp_path, monkeypatch, name):
    """Also of a number whose plugin is not there."""
    monkeypatch.delitem(NUMBERS, "largest_of_mine")
    folder = shutil.copytree(results / name, tmp_path / name)
    was = (folder / "report.html").read_bytes()
    assert (b"Largest of my own" in was) == (name == "step")
    (folder / "report.html").unlink()
    result = call("report", folder)
    assert result.exit_code == 0, result.output
    assert (folder / "report.html").read_bytes() == was
    assert sorted(each.name for each in folder.iterdir()) == sorted(each.name for each in (results / name).iterdir())


def test_results_without_any_run_have_their_report_too(results, tmp_path):
    saved = load(results / "step")
    fallen = replace(saved, comparison=replace(saved.comparison, outcomes=saved.comparison.failures))
    save(fallen, tmp_path)
    was = write_report(fallen.comparison, tmp_path / "report.html").read_bytes()
    assert b"tall has no run." in was
    assert renew_report(tmp_path).read_bytes() == was
    assert "has no run to show" in refused("film", tmp_path)


@pytest.mark.parametrize("name", CASES)
def test_what_is_saved_is_strict_json_and_comes_back_bit_for_bit(results, name):
    def refuse(constant):
        pytest.fail(f"{constant} is no JSON")

    json.loads((results / name / "comparison.json").read_text(), parse_constant=refuse)
    case, _ = load_case(results / f"{name}.toml")
    saved = load(results / name)
    assert saved.film == case.film.model_dump()
    assert saved.comparison.criteria == case.bands()
    summary = summary_of(results / name)
    assert [each.name for each in saved.comparison.outcomes] == [
        each["configuration"] for each in summary["configurations"]
    ]
    assert json.loads(json.dumps(saved.comparison.summary())) == summary["configurations"]
    for each in saved.comparison.configurations:
        car = load_vehicle(each.facts["vehicle"], each.asked.get("characteristics"), each.asked.get("set"))
        for curve in each.characteristics:
            again = characteristic(curve.title, car.axle(curve.title.removesuffix(" axle")))
            for field in fields(curve):
                mine, its = getattr(curve, field.name), getattr(again, field.name)
                if isinstance(mine, np.ndarray):
                    assert np.array_equal(mine, its, equal_nan=True)
            assert curve.elements == again.elements
            assert curve.tyre is again.tyre is None or curve.tyre.equals(again.tyre)


def test_a_run_says_what_was_asked_for(results):
    for name, text in (("bump", "60 mm"), ("step", "120 deg")):
        case, _ = load_case(results / f"{name}.toml")
        manoeuvre = read_manoeuvre(case.manoeuvre)
        for entry, setting in zip(summary_of(results / name)["configurations"], case.configuration, strict=True):
            asked = entry["asked"]
            assert asked.get("set", {}) == setting.set
            assert asked["characteristics"] == setting.characteristics
            assert asked["step"] == {"1:3": "0.5 ms"}.get(setting.name, "1 ms")
            assert text in asked["parameters"].values()
            assert set(asked["parameters"]) <= set(type(manoeuvre).model_fields)
            again = read_manoeuvre({**asked["parameters"], "kind": manoeuvre.kind})
            assert again.model_dump(exclude={"kind"}, exclude_none=True) == pytest.approx(
                manoeuvre.model_dump(exclude={"kind"}, exclude_none=True), rel=1e-9
            )
            (run,) = (results / name / "runs").glob(f"{setting.name.replace(' ', '_').replace(':', '_')}.nc")
            kept = Run.load(run).meta["asked"]
            assert {**kept, "step": asked["step"]} == asked
    report = (results / "bump" / "report.html").read_text()
    assert "with rear.damper.ratio = 1:3" in report
    assert "bump, duration 1 s, height 60 mm, length 2 m, speed 50 km/h" in report


def test_the_film_is_put_into_the_report_as_by_a_run_with_video(results, tmp_path, monkeypatch):
    def render(clips, path, *, progress, **how):
        assert how["quality"] == "fine"
        path.write_bytes(repr([(clip.label, float(clip.run["body_acceleration"].sum())) for clip in clips]).encode())
        return path

    monkeypatch.setattr("evaluation.animation.render.render_video", render)
    folder = shutil.copytree(results / "bump", tmp_path / "bump")
    renew_film(folder, {})
    with_film = (folder / "report.html").read_bytes()
    assert b"data:video/mp4" in with_film
    assert renew_report(folder).read_bytes() == with_film
    (folder / "video.mp4").unlink()
    assert renew_report(folder).read_bytes() == (results / "bump" / "report.html").read_bytes()


def test_a_wrong_film_is_refused_and_changes_nothing(results, tmp_path):
    folder = shutil.copytree(results / "bump", tmp_path / "bump")
    before = {each: each.read_bytes() for each in folder.rglob("*") if each.is_file()}
    assert "camera" in refused("film", folder, "--camera", "from_the_moon")
    assert "ghost" in refused("film", folder, "--ghost")
    assert {each: each.read_bytes() for each in folder.rglob("*") if each.is_file()} == before


@pytest.mark.parametrize(
    ("value", "baseline", "unit", "text"),
    [
        (1.1, 1.0, "m", "+10.0 %"),
        (-1.1, -1.0, "m", "+10.0 %"),
        (0.5, -1.0, "m", "−150.0 %"),
        (1.0, 1.0, "m", "0.0 %"),
        (0.9999999, 1.0, "m", "0.0 %"),
        (0.02, 0.0, "m", "+20.0 mm"),
        (-0.02, 1e-9, "m", "−20.0 mm"),
        (0.0, 0.0, "m", "0.0 mm"),
        (2.0, 0.0, "1", "+2"),
        (50.0, 0.1, "1", "+49.9"),
        (1.0, 0.1, "1", "+900.0 %"),
        (None, 1.0, "m", "–"),
        (1.0, None, "m", "–"),
    ],
)
def test_difference_in_words(value, baseline, unit, text):
    assert difference(Number(value, unit), Number(baseline, unit)).text == text


def test_differences_are_those_of_the_numbers_of_both_folders(results, tmp_path):
    compared = compare_folders([results / "bump", results / "lower"], tmp_path / "out", baseline="lower/1:3")
    names = [f"{folder}/{name}" for folder in ("bump", "lower") for name in ("as it is", "1:3")]
    assert [each.name for each in compared.outcomes] == names
    numbers = {
        f"{folder}/{entry['configuration']}": entry["numbers"]
        for folder in ("bump", "lower")
        for entry in summary_of(results / folder)["configurations"]
    }
    summary = summary_of(tmp_path / "out")
    assert summary["baseline"] == "lower/1:3"
    for entry in summary["configurations"]:
        name = entry["configuration"]
        assert entry["numbers"].items() <= numbers[name].items()
        if name == "lower/1:3":
            assert "differences" not in entry
            continue
        for number, found in entry["differences"].items():
            value, base = numbers[name][number]["value"], numbers["lower/1:3"][number]["value"]
            if value is None or base is None:
                assert found == {"value": None, "percent": None}
            else:
                assert found["value"] == value - base
                assert (
                    found["percent"] is None
                    if base == 0
                    else found["percent"] == pytest.approx(100 * (value / base - 1))
                )
    for name in names:
        folder, configuration = name.split("/")
        file = configuration.replace(" ", "_").replace(":", "_")
        before, after = (
            Run.load(results / folder / "runs" / f"{file}.nc"),
            Run.load(tmp_path / "out" / "runs" / f"{folder}_{file}.nc"),
        )
        assert before.meta == after.meta
        assert all(np.array_equal(before[channel], after[channel]) for channel in before)


def test_what_differs_is_said_in_one_line(results, tmp_path):
    said = compare_folders([results / "bump", results / "lower"], tmp_path / "out").description
    assert "What differs: height 60 mm (bump), 40 mm (lower)." in said
    assert "Bands that differ are those of the baseline, else of the first: body_acceleration_max." in said
    assert "\n" not in said
    assert said in (tmp_path / "out" / "report.html").read_text()


def test_criteria_are_those_of_the_folder_of_the_baseline(results, tmp_path):
    folders = [results / "bump", results / "lower"]
    for baseline, bound in (("bump/1:3", 8.0), ("lower/1:3", 6.0)):
        compared = compare_folders(folders, tmp_path / "out", baseline=baseline)
        assert compared.criteria["body_acceleration_max"].maximum == bound


def test_results_of_a_comparison_are_results(results, tmp_path):
    compare_folders([results / "bump", results / "lower"], tmp_path / "out")
    was = (tmp_path / "out" / "report.html").read_bytes()
    assert renew_report(tmp_path / "out").read_bytes() == was
    again = compare_folders([tmp_path / "out", results / "whole"], tmp_path / "again")
    assert [each.name for each in again.outcomes][-1] == "four wheels"
    assert len(again.outcomes) == 5


def test_a_folder_beside_itself_differs_in_nothing(results, tmp_path):
    shutil.copytree(results / "bump", tmp_path / "a" / "same")
    shutil.copytree(results / "bump", tmp_path / "b" / "same")
    compared = compare_folders([tmp_path / "a" / "same", tmp_path / "b" / "same"], tmp_path / "out")
    assert [each.name for each in compared.outcomes][::2] == ["a/same/as it is", "b/same/as it is"]
    assert compared.description == ""
    twin = compared.configurations[2]
    assert {each.value for each in compared.differences(twin).values()} <= {0.0, None}


def test_another_model_is_drawn_where_both_have_the_channel(results, tmp_path):
    compared = compare_folders([results / "bump", results / "whole"], tmp_path / "out")
    assert "model quarter_2dof (bump), full_7dof (whole)" in compared.description
    drawn = {each.stem for each in (tmp_path / "out" / "plots").glob("*.svg")}
    assert {"body_acceleration", "spring_force_characteristic"} <= drawn
    assert drawn.isdisjoint({"wheel_load", "suspension_deflection", "pitch_angle", "element_forces"})
    common = set.intersection(*(set(each.numbers) for each in compared.configurations))
    assert "body_acceleration_max" in common
    assert set(compared.differences(compared.configurations[-1])) == common


def test_other_manoeuvres_share_their_numbers_and_characteristics(results, tmp_path):
    result = call("compare", results / "bump", results / "sweep", results / "step", "--out", tmp_path / "out")
    assert result.exit_code == 0, result.output
    assert "manoeuvre bump (bump), vertical_sweep (sweep), step_steer (step)" in " ".join(result.output.split())
    assert "tall: no run, " in result.output
    drawn = {each.stem for each in (tmp_path / "out" / "plots").glob("*.svg")}
    assert drawn
    assert all(name.endswith("_characteristic") for name in drawn)
    assert "Criteria left out, not every configuration has the number: " in " ".join(result.output.split())


def test_cars_that_turn_are_held_against_each_other_by_roll_and_lift(results, tmp_path):
    shutil.copytree(results / "step", tmp_path / "again")
    result = call("compare", results / "step", tmp_path / "again", "--out", tmp_path / "out")
    assert result.exit_code == 0, result.output
    assert "Roll and wheel lift" in result.output
    assert "Roll and wheel lift" in (tmp_path / "out" / "report.html").read_text()


@pytest.mark.parametrize(
    ("arguments", "parts"),
    [
        ([], ["compare: give one or more folders"]),
        (["no_such"], ["no_such: no such folder"]),
        (["bump", "empty"], ["empty: holds no results with comparison.json"]),
        (["bump", "bump"], ["bump: is given twice"]),
        (["bump", "--baseline", "as it was"], ["baseline: 'as it was' unknown", "did you mean 'as it is'"]),
        (["step", "bump", "--baseline", "tall"], ["baseline: 'tall' has no run"]),
        (["step"], ["compare: 1 configuration has a run; two are needed"]),
        (["bump", "no_run"], ["no_run/runs/1_3.nc: no such file"]),
        (["bump", "cut"], ["cut/runs/1_3.nc: is damaged, or not the run that was saved here"]),
        (["bump", "half"], ["half/comparison.json: is damaged"]),
        (["bump", "old"], ["old/comparison.json: is of another version (0)"]),
        (["bump", "less"], ["less/comparison.json: is damaged (KeyError: 'outcomes')"]),
    ],
)
def test_bad_input_is_one_line_and_leaves_nothing(results, tmp_path, monkeypatch, arguments, parts):
    monkeypatch.chdir(tmp_path)
    for name in ("bump", "step"):
        shutil.copytree(results / name, tmp_path / name)
    for name in ("no_run", "cut", "half", "old", "less"):
        shutil.copytree(results / "bump", tmp_path / name)
    Path("empty").mkdir()
    Path("no_run/runs/1_3.nc").unlink()
    Path("cut/runs/1_3.nc").write_bytes(Path("cut/runs/1_3.nc").read_bytes()[:20000])
    Path("half/comparison.json").write_text(Path("half/comparison.json").read_text()[:5000])
    Path("old/comparison.json").write_text('{"format": 0}')
    Path("less/comparison.json").write_text('{"format": 1, "title": "", "description": "", "film": {}}')
    before = sorted(tmp_path.rglob("*"))
    line = refused("compare", *arguments)
    for part in parts:
        assert part in line
    assert sorted(tmp_path.rglob("*")) == before


def test_a_film_that_cannot_be_leaves_nothing(results, tmp_path):
    with pytest.raises(InputError, match="show them in two videos"):
        compare_folders([results / "bump", results / "whole"], tmp_path / "out", video=True)
    assert not (tmp_path / "out").exists()


def test_results_go_into_none_of_the_folders(results, tmp_path):
    assert "--out: is one of the folders" in refused("compare", results / "bump", "--out", results / "bump")


@pytest.mark.parametrize("share", [0.0, 0.3, 0.6, 0.99])
def test_a_run_with_a_flipped_bit_is_refused(results, tmp_path, share):
    folder = shutil.copytree(results / "bump", tmp_path / "bump")
    run = folder / "runs" / "1_3.nc"
    content = bytearray(run.read_bytes())
    content[int(share * len(content))] ^= 1
    run.write_bytes(content)
    assert "runs/1_3.nc: is damaged" in refused("report", folder)
