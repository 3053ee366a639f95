"""A user's own spring, manoeuvre and number by one line of a case file, a vehicle file or a command line."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from design.case import load_case
from design.running import jobs_of

ROOT = Path(__file__).parents[2]

SPRING = """
from typing import ClassVar, Literal

from susp_mj.elements import Law, Spring, register
from susp_mj.units import Stiffness


def cubic_force(deflection, speed, state, p):
    x = min(max(deflection, p[0]), p[1])
    return p[2] + p[3] * x + p[4] * x**3


class CubicSpring(Spring):
    '''``F = F0 + k x + k3 x³``.'''

    law: ClassVar[Law] = Law("plugin_cubic_spring", cubic_force)
    kind: Literal["cubic"] = "cubic"
    rate: Stiffness
    cubic: float

    def parameters(self):
        return (self.stops.rebound, self.stops.compression, self.preload, self.rate, self.cubic)


register(CubicSpring)
"""
MANOEUVRE = """
from typing import Literal

import numpy as np

import manoeuvres
from susp_mj import Manoeuvre


class Washboard(Manoeuvre):
    '''A sine of the road height.'''

    needs = ("road_height",)
    kind: Literal["washboard"] = "washboard"
    duration: float = 1.0
    amplitude: float = 0.005

    def drive(self, place, time):
        if place.quantity != "road_height":
            return None
        return self.amplitude * np.sin(50 * time), self.amplitude * 50 * np.cos(50 * time)


manoeuvres.register(Washboard)
"""
NUMBER = """
import numpy as np

from evaluation import numbers


def jerk_max(run):
    '''Largest rate of the body acceleration [m/s³].'''
    return numbers.Answer(float(np.abs(np.gradient(run["body_acceleration"], run.time)).max()))


numbers.register(numbers.Measure(jerk_max, "m/s³"))
"""
CASE = """
title = "plugins"
model = "quarter_2dof"
plugins = ["mine.py"]
[manoeuvre]
kind = "washboard"
[criteria]
jerk_max = { min = 0.0 }
[[configuration]]
name = "cubic"
vehicle = "chapter3"
characteristics = "linear"
[configuration.set."rear.spring"]
kind = "cubic"
rate = "20 N/mm"
cubic = 2e6
stops = { rebound = "-0.1 m", compression = "0.1 m" }
[[configuration]]
name = "as it is"
vehicle = "chapter3"
characteristics = "linear"
"""


def call(*arguments: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "design.cli", *arguments]
    path = os.pathsep.join(filter(None, [str(ROOT), os.environ.get("PYTHONPATH", "")]))
    return subprocess.run(
        command,
        capture_output=True,
        text=True,
        cwd=cwd,
        env={**os.environ, "PYTHONPATH": path},
        timeout=300,
        check=False,
    )


@pytest.mark.parametrize("workers", [(), ("--workers", "2")])
def test_one_line_of_a_case_file_brings_a_spring_a_manoeuvre_and_a_number(tmp_path, workers):
    (tmp_path / "mine.py").write_text(SPRING + MANOEUVRE + NUMBER)
    (tmp_path / "case.toml").write_text(CASE)
    done = call("run", "case.toml", "--out", "out", *workers, cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    summary = json.loads((tmp_path / "out" / "summary.json").read_text())
    cubic, steel = summary["configurations"]
    assert cubic["manoeuvre"] == "washboard"
    assert cubic["numbers"]["jerk_max"]["unit"] == "m/s³"
    assert cubic["numbers"]["jerk_max"]["value"] != steel["numbers"]["jerk_max"]["value"]
    assert "Largest rate of the body acceleration" in (tmp_path / "out" / "report.html").read_text()


def test_a_job_brings_its_plugins_into_another_process(tmp_path):
    (tmp_path / "mine.py").write_text(SPRING + MANOEUVRE + NUMBER)
    (tmp_path / "case.toml").write_text(CASE)
    program = """
import multiprocessing
import sys
from pathlib import Path

def carry_out(job):
    from design.running import outcome, prepare, simulated
    return outcome(simulated(prepare(job)))

if __name__ == "__main__":
    from design.case import load_case
    from design.running import jobs_of, run_case
    case = load_case(Path(sys.argv[1]))
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        there = pool.map(carry_out, jobs_of(*case))
    here = run_case(*case).outcomes
    for mine, its in zip(here, there, strict=True):
        assert mine.numbers["jerk_max"] == its.numbers["jerk_max"]
        assert (mine.run["wheel_load"] == its.run["wheel_load"]).all()
"""
    (tmp_path / "program.py").write_text(program)
    done = subprocess.run(
        [sys.executable, "program.py", "case.toml"],
        capture_output=True,
        text=True,
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
        timeout=300,
        check=False,
    )
    assert done.returncode == 0, done.stderr


def test_a_vehicle_file_brings_its_own_spring(tmp_path):
    import vehicles

    text = (Path(vehicles.__file__).parent / "chapter3.toml").read_text()
    (tmp_path / "springs.py").write_text(SPRING)
    (tmp_path / "car.toml").write_text('plugins = ["springs.py"]\n' + text)
    (tmp_path / "case.toml").write_text(
        CASE.replace('plugins = ["mine.py"]\n', "")
        .replace('kind = "washboard"', 'kind = "bump"')
        .replace("jerk_max", "body_acceleration_max")
        .replace('"chapter3"', '"car.toml"')
    )
    done = call("run", "case.toml", "--out", "out", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    shown = call("show", "car.toml", cwd=tmp_path)
    assert shown.returncode == 0, shown.stderr


def test_a_command_line_brings_a_manoeuvre(tmp_path):
    (tmp_path / "mine.py").write_text(MANOEUVRE)
    done = call(
        "drive", "washboard", "--plugin", "mine.py", "-c", "linear", "--amplitude", "4 mm", "--out", "out", cwd=tmp_path
    )
    assert done.returncode == 2
    assert done.stderr.count("\n") == 1
    done = call(
        "drive",
        "washboard",
        "--plugin",
        "mine.py",
        "-c",
        "linear",
        "--amplitude",
        "0.004",
        "--out",
        "out",
        cwd=tmp_path,
    )
    assert done.returncode == 0, done.stderr
    assert json.loads((tmp_path / "out" / "summary.json").read_text())["configurations"][0]["manoeuvre"] == "washboard"


def test_a_plugin_that_fails_is_bad_input(tmp_path):
    (tmp_path / "mine.py").write_text("\nraise ValueError('no')\n")
    (tmp_path / "case.toml").write_text(CASE)
    done = call("run", "case.toml", "--out", "out", cwd=tmp_path)
    assert done.returncode == 2
    assert done.stderr == "error: case.toml: plugins.0: mine.py, line 2: ValueError: no\n"
    assert not (tmp_path / "out").exists()


def test_jobs_name_their_plugins(tmp_path):
    (tmp_path / "mine.py").write_text("")
    (tmp_path / "case.toml").write_text(CASE.replace("jerk_max = { min = 0.0 }", ""))
    jobs = jobs_of(*load_case(tmp_path / "case.toml"))
    assert [job.plugins for job in jobs] == [("mine.py",), ("mine.py",)]
