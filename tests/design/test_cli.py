"""The command line as a user meets it: exit codes, one-line errors, files left behind."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from typer.testing import CliRunner

from design.cli import app
from evaluation.animation import video
from manoeuvres import MANOEUVRES, find_manoeuvre
from susp_mj import InputError

ROOT = Path(__file__).parents[2]


def call(*arguments: str, cwd: Path | None = None, **environment: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "design.cli", *arguments]
    return subprocess.run(
        command, capture_output=True, text=True, cwd=cwd, env={**os.environ, **environment}, timeout=300, check=False
    )


def script(name: str, *arguments: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, str(ROOT / "manoeuvres" / f"{name}.py"), *arguments]
    return subprocess.run(command, capture_output=True, text=True, cwd=cwd, timeout=300, check=False)


def test_list_names_everything_registered():
    from evaluation.numbers import NUMBERS
    from susp_mj.elements import DAMPERS, SPRINGS
    from vehicles import available_vehicles
    from vehicles.mjcf import MODELS

    result = call("list")
    assert result.returncode == 0
    for name in (*NUMBERS, *MANOEUVRES, *SPRINGS, *DAMPERS, *available_vehicles(), *MODELS):
        assert name in result.stdout
    assert "[m/s²]" in result.stdout


def test_run_prints_a_table_without_colour_codes_when_piped(tmp_path):
    result = call("run", "chapter3", "--out", str(tmp_path / "out"))
    assert result.returncode == 0
    assert "11.24 m/s²" in result.stdout
    assert "\x1b" not in result.stdout + result.stderr
    assert (tmp_path / "out" / "report.html").is_file()


def test_strict_turns_failed_criteria_into_exit_code_1(tmp_path):
    assert call("run", "chapter3", "--strict", "--out", str(tmp_path / "out")).returncode == 1


WITHOUT_SIMULATING = """\
import sys
from design.cli import main
try:
    main()
finally:
    assert not {"mujoco", "numba", "matplotlib", "scipy"} & set(sys.modules)
"""
REFUSED = """\
title = "wrong"
model = "handling"
manoeuvre = { kind = "zuziehen" }
[[configuration]]
name = "car"
vehicle = "s_class"
[criteria]
lateral_acceleration_max = { max = "8 m/s²" }
"""


@pytest.mark.parametrize(
    ("old", "new", "parts"),
    [
        ('"8 m/s²"', '"8 mm"', ["criteria.lateral_acceleration_max.max: '8 mm'", "m/s²"]),
        ("acceleration_max", "aceleration_max", ["criteria: 'lateral_aceleration_max'", "did you mean"]),
        ('"handling"', '"handlin"', ["model: 'handlin' unknown", "did you mean 'handling'"]),
        ("vehicle =", "vehicel =", ["configuration.0.vehicel: unknown key", "did you mean 'vehicle'"]),
        ('"wrong"', '"wrong', ["is not TOML"]),
    ],
)
def test_a_wrong_case_is_refused_at_once(tmp_path, old, new, parts):
    """Before anything is loaded that a simulation needs, let alone simulated."""
    case = tmp_path / "wrong.toml"
    assert old in REFUSED
    case.write_text(REFUSED.replace(old, new), encoding="utf-8")
    command = [sys.executable, "-c", WITHOUT_SIMULATING, "run", str(case), "--out", str(tmp_path / "out")]
    result = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    assert result.returncode == 2
    (line,) = result.stderr.splitlines()
    for part in ("wrong.toml: ", *parts):
        assert part in line
    assert not (tmp_path / "out").exists()


def test_strict_passes_when_criteria_are_met(tmp_path):
    case = tmp_path / "soft.toml"
    case.write_text(
        'title = "soft"\nmodel = "quarter_2dof"\nmanoeuvre = { kind = "bump", duration = 1 }\n'
        '[[configuration]]\nname = "soft"\nvehicle = "chapter3"\ncharacteristics = "soft_linear"\n'
        "[criteria]\nbody_acceleration_max = { max = 9 }\n"
    )
    assert call("run", str(case), "--strict", "--out", str(tmp_path / "out")).returncode == 0


@pytest.mark.parametrize(
    ("arguments", "parts"),
    [
        (("run", "no_such.toml"), ["no_such.toml: no such file"]),
        (("show", "s_klass"), ["did you mean 's_class'"]),
        (("build", "chapter3", "-m", "quarter"), ["model: no model 'quarter'", "quarter_2dof"]),
        (
            ("build", "s_class", "-m", "quarter_2dof", "--load", "heavy"),
            ["load: s_class.toml has no load case", "empty"],
        ),
        (
            ("build", "s_class", "-m", "quarter_2dof", "--axle", "middle"),
            ["axle: s_class.toml has no axle", "front, rear"],
        ),
    ],
)
def test_bad_input_is_one_line_and_exit_code_2(tmp_path, arguments, parts):
    result = call(*arguments, cwd=tmp_path)
    assert result.returncode == 2
    assert len(result.stderr.strip().splitlines()) == 1
    assert "Traceback" not in result.stderr
    for part in parts:
        assert part in result.stderr
    assert list(tmp_path.iterdir()) == []


def test_an_unwritable_folder_is_bad_input(tmp_path):
    (tmp_path / "file").write_text("")
    result = call("run", "chapter3", "--out", str(tmp_path / "file" / "out"))
    assert result.returncode == 2
    assert "cannot be written" in result.stderr


def test_demo_reproduces_chapter_3(tmp_path):
    result = call("demo", "--no-video", "--out", str(tmp_path / "demo"))
    assert result.returncode == 0, result.stderr
    assert result.stdout.count("agrees") == 9
    assert "FAILS" not in result.stdout
    summary = json.loads((tmp_path / "demo" / "summary.json").read_text())
    assert [claim["holds"] for claim in summary["claims"]] == [True] * 9


@pytest.fixture
def no_gl(monkeypatch):
    """A machine on which nothing draws."""
    video.gl_backend.cache_clear()
    monkeypatch.setattr(video, "_draws", lambda backend: False)
    yield
    video.gl_backend.cache_clear()


def test_demo_goes_on_without_egl_and_says_what_to_install(tmp_path, no_gl):
    result = CliRunner().invoke(app, ["demo", "--out", str(tmp_path / "demo")])
    assert result.exit_code == 0, result.output
    assert "no video" in result.output
    assert "libegl1" in result.output
    assert (tmp_path / "demo" / "report.html").is_file()
    assert not (tmp_path / "demo" / "video.mp4").exists()


def test_run_with_video_is_refused_without_egl(tmp_path, no_gl):
    result = CliRunner().invoke(app, ["run", "chapter3", "--video", "--out", str(tmp_path / "out")])
    assert isinstance(result.exception, InputError)
    assert "libegl1" in str(result.exception)
    assert not (tmp_path / "out").exists()


def test_doctor_names_the_fix_for_missing_egl(no_gl):
    result = CliRunner().invoke(app, ["doctor"])
    assert result.exit_code == 1
    assert "libegl1" in result.output


def test_a_gl_setting_that_does_not_work_does_not_stop_a_simulation(tmp_path):
    result = call("run", "chapter3", "--out", str(tmp_path / "out"), MUJOCO_GL="no_such_backend")
    assert result.returncode == 0, result.stderr


def test_new_makes_a_car_that_can_be_shown_built_and_driven(tmp_path):
    assert call("new", "mine", cwd=tmp_path).returncode == 0
    again = call("new", "mine", cwd=tmp_path)
    assert again.returncode == 2
    assert "mine.toml: exists already" in again.stderr
    shown = call("show", "mine.toml", "--out", "sheet.html", cwd=tmp_path)
    assert shown.returncode == 0, shown.stderr
    assert "26.00 kN/m" in shown.stdout
    assert (tmp_path / "sheet.html").is_file()
    assert call("build", "mine.toml", "-m", "quarter_2dof", cwd=tmp_path).returncode == 0
    assert (tmp_path / "mine_quarter_2dof.xml").is_file()
    driven = script(
        "bump", "--vehicle", "mine.toml", "--load", "ko", "full", "--axle", "front", "--out", "o", cwd=tmp_path
    )
    assert driven.returncode == 0, driven.stderr
    assert len(json.loads((tmp_path / "o" / "summary.json").read_text())["configurations"]) == 2


@pytest.mark.parametrize(
    "name", sorted(path.stem for path in (ROOT / "manoeuvres").glob("*.py") if "__main__" in path.read_text())
)
def test_a_manoeuvre_is_a_script(tmp_path, name):
    sets = ("configuration_3", "configuration_4")
    model = MANOEUVRES[find_manoeuvre("step" if name == "road_step" else name)].default_model
    options = () if model == "handling" else ("-m", "full_3dof")
    length = (
        "8 s" if name in ("braking_in_turn", "swept_steer", "lenksweep", "suspension_rig", "steady_circle") else "2 s"
    )
    result = script(
        name, "--vehicle", "s_class", *options, "-c", sets[0], "-c", sets[1], "--duration", length, cwd=tmp_path
    )
    assert result.returncode == 0, result.stderr
    (summary,) = tmp_path.rglob("summary.json")
    assert [each["configuration"] for each in json.loads(summary.read_text())["configurations"]] == list(sets)


def test_a_manoeuvre_script_refuses_bad_parameters_in_one_line(tmp_path):
    result = script("bump", "--height", "8 kg", cwd=tmp_path)
    assert result.returncode == 2
    assert len(result.stderr.strip().splitlines()) == 1
    assert "error: --height: '8 kg'" in result.stderr


def test_doctor_reports_each_need():
    result = call("doctor")
    for name in ("MuJoCo", "compiled callbacks", "offscreen rendering", "ffmpeg"):
        assert name in result.stdout
    assert result.returncode == 0, result.stdout
