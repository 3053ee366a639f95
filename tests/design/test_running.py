"""Running a case: configurations side by side, and those whose run does not come to its end."""

from __future__ import annotations

import json
import pickle

import numpy as np
import pytest
from typer.testing import CliRunner

from design.case import load_case
from design.cli import app
from design.results import carry_out
from design.running import jobs_of, outcome, prepare, run_case, simulated
from susp_mj import InputError, Run

STEP = """
title = "a tall car beside a low one"
model = "handling"
numbers = ["lateral_acceleration_max"]
[manoeuvre]
kind = "step_steer"
angle = "120 deg"
speed = "120 km/h"
duration = "2 s"
[criteria]
lateral_acceleration_max = { min = 1.0 }
[[configuration]]
name = "tall"
vehicle = "s_class"
characteristics = "configuration_4"
load = "ko"
set = { "loads.ko.cg" = [-1.5572, 0.0, 1.4] }
"""
LOW = """
[[configuration]]
name = "low"
vehicle = "s_class"
characteristics = "configuration_4"
load = "ko"
"""


@pytest.fixture
def tall_and_low(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(STEP + LOW)
    return load_case(path)


def test_results_do_not_depend_on_the_number_of_workers():
    one, *others = (run_case(*load_case("om1_step_loads"), workers=workers) for workers in (1, 2, 3))
    for other in others:
        assert other.summary() == one.summary()
        for mine, its in zip(one.configurations, other.configurations, strict=True):
            assert mine.run.meta == its.run.meta
            assert list(mine.run.channels) == list(its.run.channels)
            assert all(np.array_equal(mine.run[name], its.run[name]) for name in mine.run.channels)


def test_a_job_is_plain_data():
    for job in jobs_of(*load_case("om4_step")):
        there = outcome(simulated(prepare(pickle.loads(pickle.dumps(job)))))
        here = outcome(simulated(prepare(job)))
        assert there.name == here.name == job.setting.name
        assert np.array_equal(there.run["roll_angle"], here.run["roll_angle"])
        back = pickle.loads(pickle.dumps(there))
        assert back.numbers == here.numbers


def test_a_mistake_in_the_last_configuration_is_found(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(STEP + LOW.replace("ko", "heavy"))
    with pytest.raises(InputError, match="has no load case 'heavy'"):
        run_case(*load_case(path))


def test_a_configuration_that_falls_over_is_an_outcome_and_the_others_are_kept(tmp_path, tall_and_low):
    comparison = carry_out(*tall_and_low, tmp_path / "out")
    tall, low = comparison.outcomes
    assert comparison.failures == [tall]
    assert comparison.configurations == [low]
    assert not comparison.passed
    assert "the car fell over at t = " in tall.reason
    assert "\n" not in tall.reason
    first, second = json.loads((tmp_path / "out" / "summary.json").read_text())["configurations"]
    assert first["failed"] == tall.reason
    assert first["vehicle"] == second["vehicle"] == "s_class"
    assert "failed" not in second
    assert second["criteria"]["lateral_acceleration_max"]["passed"]
    report = (tmp_path / "out" / "report.html").read_text()
    assert "tall has no run." in report
    assert "the car fell over at t = " in report
    until = Run.load(tmp_path / "out" / "runs" / "tall.nc")
    assert until.time[-1] < 2.0 <= Run.load(tmp_path / "out" / "runs" / "low.nc").time[-1] + 1e-9
    assert list((tmp_path / "out" / "plots").glob("*.svg"))


def test_the_command_line_says_which_configuration_has_no_run(tmp_path, tall_and_low):
    done = CliRunner().invoke(app, ["run", str(tall_and_low[1]), "--out", str(tmp_path / "out"), "--workers", "2"])
    assert done.exit_code == 1
    assert "tall: no run, s_class, handling, step_steer: the car fell over at t = " in done.output
    assert "low: meets all criteria" in done.output


def test_results_without_any_run(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(STEP)
    out = tmp_path / "out"
    done = CliRunner().invoke(app, ["run", str(path), "--out", str(out)])
    assert done.exit_code == 1
    assert "tall: no run, " in done.output
    assert json.loads((out / "summary.json").read_text())["passed"] is False
    assert "tall has no run." in (out / "report.html").read_text()
    assert not (out / "plots").exists()


def test_records_that_memory_does_not_hold_are_refused(tmp_path, monkeypatch):
    path = tmp_path / "mine.toml"
    path.write_text(STEP + LOW)
    monkeypatch.setattr("design.running.free_memory", lambda: 3e6)
    with pytest.raises(InputError, match=r"mine\.toml: record_every: 2 runs of 2 s .* take 0\.006 GB; free"):
        run_case(*load_case(path))
    path.write_text("record_every = 3\n" + STEP + LOW)
    monkeypatch.setattr("design.running.prepare", lambda job: pytest.fail("goes on"))
    with pytest.raises(pytest.fail.Exception, match="goes on"):
        run_case(*load_case(path))
