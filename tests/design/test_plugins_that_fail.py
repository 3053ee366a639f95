"""Mistakes in a user's own part, of every kind: one line with the place in his file, exit code 2, and no results."""

from __future__ import annotations

import re
import sys

import pytest

from design.cli import main
from evaluation.animation.cameras import CAMERAS
from evaluation.numbers import NUMBERS
from manoeuvres import MANOEUVRES
from susp_mj.character import TRAITS
from susp_mj.elements import LAWS, SPRINGS

from .test_plugins import CASE, MANOEUVRE, NUMBER, SPRING

WHOLE = SPRING + MANOEUVRE + NUMBER
FORCE = "return p[2] + p[3] * x + p[4] * x**3"
ASKED = "(deflection, speed, state, p)"
PARAMETERS = "return (self.stops.rebound, self.stops.compression, self.preload, self.rate, self.cubic)"
DRIVE = "return self.amplitude * np.sin(50 * time), self.amplitude * 50 * np.cos(50 * time)"
JERK = 'return numbers.Answer(float(np.abs(np.gradient(run["body_acceleration"], run.time)).max()))'
MEASURE = 'numbers.Measure(jerk_max, "m/s³")'
RECORD = "    def record(self, time):\n        return "
HEAD = '    needs = ("road_height",)\n'


@pytest.fixture(autouse=True)
def registries(monkeypatch):
    """What a plugin registers is forgotten afterwards."""
    for registry in (NUMBERS, MANOEUVRES, SPRINGS, LAWS, TRAITS, CAMERAS):
        for name, each in registry.items():
            monkeypatch.setitem(registry, name, each)
    kept = [(registry, set(registry)) for registry in (NUMBERS, MANOEUVRES, SPRINGS, LAWS, TRAITS, CAMERAS)]
    yield
    for registry, names in kept:
        for name in set(registry) - names:
            del registry[name]


def line_of(plugin, tmp_path, monkeypatch, capsys, case=CASE) -> str:
    """The one line that a run with this plugin ends with."""
    (tmp_path / "mine.py").write_text(plugin.replace("plugin_cubic_spring", tmp_path.name))
    (tmp_path / "case.toml").write_text(case)
    for name in ("SUSP_MJ_GL", "MUJOCO_GL", "MPLBACKEND"):
        monkeypatch.setenv(name, "")
    monkeypatch.setattr(sys, "argv", ["susp-mj", "run", str(tmp_path / "case.toml"), "--out", str(tmp_path / "out")])
    with pytest.raises(SystemExit) as left:
        main()
    said = capsys.readouterr().err
    assert left.value.code == 2 and said.startswith("error: ") and said.count("\n") == 1, said
    assert not (tmp_path / "out").exists()
    return said.removeprefix("error: ").strip()


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        (FORCE, "return 'a'", "in cubic_force: gives 'a', not a number"),
        (FORCE, "return None", r"in cubic_force: law '.*' does not compile \(No conversion from none to float64 .*"),
        (FORCE, "return p[2] + p[9] * x", "in cubic_force: IndexError: tuple index out of range"),
        (FORCE, "raise ValueError('no')", "in cubic_force: ValueError: no"),
        (FORCE, "return open('none')", "in cubic_force: FileNotFoundError: .*"),
        (ASKED, "(deflection, p)", "in cubic_force: a force law takes deflection, speed, state, parameters"),
        (PARAMETERS, "return None", "in CubicSpring.parameters: gives None, not a tuple of finite numbers"),
        (PARAMETERS, "return ('a', 2)", r"in CubicSpring.parameters: gives \('a', 2\), not a tuple of finite numbers"),
        (PARAMETERS, "return (1.0, float('nan'))", r"in CubicSpring.parameters: gives \(1.0, nan\), not a tuple .*"),
        (PARAMETERS, "return {}['rate']", "in CubicSpring.parameters: KeyError: 'rate'"),
        (JERK, "return 3.2", r"in jerk_max: gives 3.2 for number 'jerk_max', not an Answer\(value, note\), .*"),
        (JERK, "return None", "in jerk_max: gives None for number 'jerk_max', not an Answer.*"),
        (JERK, "return 3.2, 'at 1 s'", r"in jerk_max: gives \(3.2, 'at 1 s'\) for number 'jerk_max', not an Answer.*"),
        (
            JERK,
            "return numbers.Answer(float('nan'))",
            r"in jerk_max: gives Answer\(nan, ''\) for number .*",
        ),
        (JERK, "return numbers.Answer('a')", r"in jerk_max: gives Answer\('a', ''\) for number 'jerk_max', not an .*"),
        (
            JERK,
            "return numbers.Answer(1.0, None)",
            r"in jerk_max: gives Answer\(1.0, None\) for number .*",
        ),
        (JERK, "return 1 / 0", "in jerk_max: ZeroDivisionError: division by zero"),
        (JERK, "return run['wheel_lod']", "in jerk_max: run: no channel 'wheel_lod'; did you mean 'wheel_load'.*"),
        (JERK, "open('none')", "in jerk_max: FileNotFoundError: .*"),
        (JERK, "raise SystemExit(0)", "in jerk_max: SystemExit: 0"),
        (JERK, "return numbers.is_a(run, 'brakng')", "in jerk_max: trait 'brakng' unknown; did you mean 'braking'.*"),
        (MEASURE, MEASURE[:-1] + ", True)", "runs of number 'jerk_max' is a bool, not a Runs"),
        (MEASURE, "jerk_max", r"a function is no number; give Measure\(function, unit, runs\)"),
        (DRIVE, "return time", r"in Washboard.drive: gives array\(.*\) for road_height, not \(2001,\) values and .*"),
        (DRIVE, "return time[1:], time", r"in Washboard.drive: gives \(array.* for road_height, not \(2001,\) .*"),
        (DRIVE, "return 'ab'", "in Washboard.drive: gives 'ab' for road_height, not .*"),
        (DRIVE, "return {}['x']", "in Washboard.drive: KeyError: 'x'"),
        (HEAD, RECORD + "None\n", "in Washboard.record: gives None, not arrays .*"),
        (HEAD, RECORD + "{'lod': time}\n", "in Washboard.record: gives 'lod', not .*"),
        (HEAD, RECORD + "{'speed': 3}\n", r".*gives 3 for 'speed', not an array of .*"),
        (HEAD, "    needs = 'road_height'\n", "needs of Washboard is 'road_height', not a tuple"),
        (HEAD, "    character = None\n", "character of Washboard is None, not a Character"),
        (HEAD, "    character = Character('', ('brakng',))\n", "trait 'brakng' unknown; did you mean 'braking'.*"),
        (HEAD, "    character = Character('', ('braking'))\n", r"traits: 'braking' is not allowed; write .*"),
        (HEAD, "    character = Character(together=('sped',))\n", "together: quantity 'sped' unknown; did you mean .*"),
    ],
)
def test_a_mistake_is_one_line_with_its_place(tmp_path, monkeypatch, capsys, old, new, said):
    assert WHOLE.count(old) == 1
    plugin = "from susp_mj.character import Character\n" + WHOLE.replace(old, new)
    line = line_of(plugin, tmp_path, monkeypatch, capsys)
    found = re.fullmatch(r"(case\.toml: plugins\.0: )?(mine\.py, line \d+(: |, ))+(?P<said>.*)", line)
    assert found is not None and re.fullmatch(said, found["said"]), line


def test_a_camera_of_another_model_is_refused_before_anything_is_run(tmp_path, monkeypatch, capsys):
    plugin = WHOLE + "\nfrom evaluation.animation import cameras\n"
    plugin += "cameras.register('drone', cameras.Camera('from above', 180, 40, 9, 6, 0.5))\n"
    case = CASE.replace("[manoeuvre]", 'film = { camera = "drone" }\n[manoeuvre]')
    assert line_of(plugin, tmp_path, monkeypatch, capsys, case) == (
        "case.toml: film.camera: 'drone' is for runs of model handling; other cars are drawn from one place"
    )


def test_a_misspelt_camera_of_a_plugin_is_named_with_its_neighbour(tmp_path, monkeypatch, capsys):
    plugin = WHOLE + "\nfrom evaluation.animation import cameras\n"
    plugin += "cameras.register('drone', cameras.Camera('from above', 180, 40, 9, 6, 0.5))\n"
    case = CASE.replace("[manoeuvre]", 'film = { camera = "dron" }\n[manoeuvre]')
    line = line_of(plugin, tmp_path, monkeypatch, capsys, case)
    assert line.startswith("case.toml: film.camera: 'dron' unknown; did you mean 'drone'?")
