"""Recorded motion: the samples are met, every model finds its signals, a run driven by its own record is the same."""

from __future__ import annotations

import numpy as np
import pytest

from design.case import read_manoeuvre
from manoeuvres import Bump, RecordedMotion
from susp_mj import InputError, simulate
from susp_mj.meaning import Input
from susp_mj.signals import Signal, Signals
from vehicles import load_vehicle
from vehicles.mjcf import build
from vehicles.models import MODELS

TIME = np.linspace(0.0, 1.0, 51)
SHAPE = np.sin(np.pi * TIME) ** 2
TYRE = (("tyre", 1.0),)


def file_of(folder, time=TIME, name="motion.csv", **columns):
    names = ",".join(["time [s]", *(f"{each} [mm]" for each in columns)])
    rows = np.column_stack([time, *columns.values()])
    text = "\n".join([names, *(",".join(f"{value:.9g}" for value in row) for row in rows)])
    path = folder / name
    path.write_text(text + "\n")
    return path


def wheel(station, axle="", y=0.0):
    return Input("road_height", station, 0.0 if axle != "rear" else -3.0, y, (), axle)


def manoeuvre(folder, **fields):
    return read_manoeuvre({"kind": "recorded_motion", "duration": 1.0, "file": "motion.csv", **fields}, folder / "case")


@pytest.mark.parametrize("method", ["pchip", "cubic"])
def test_the_samples_are_met_from_beside_the_case_file(tmp_path, method):
    file_of(tmp_path, fl=10 * SHAPE)
    height, _ = manoeuvre(tmp_path, method=method).drive(wheel("fl"), TIME)
    np.testing.assert_allclose(height, 0.01 * SHAPE, atol=1e-11)


@pytest.mark.parametrize(("method", "order"), [("pchip", 1.8), ("cubic", 2.8)])
def test_the_rate_converges_with_the_samples(tmp_path, method, order):
    errors = []
    fine = np.linspace(0.05, 0.95, 1000)
    for count in (51, 101):
        time = np.linspace(0.0, 1.0, count)
        file_of(tmp_path, time, fl=10 * np.sin(np.pi * time) ** 2)
        _, rate = manoeuvre(tmp_path, method=method).drive(wheel("fl"), fine)
        errors.append(np.sqrt(np.mean((rate - 0.01 * np.pi * np.sin(2 * np.pi * fine)) ** 2)))
    assert np.log2(errors[0] / errors[1]) > order - 0.3


def test_uneven_samples_and_a_time_that_does_not_begin_at_zero(tmp_path):
    time = np.sort(np.concatenate([[0.0, 1.0], np.random.default_rng(1).uniform(0, 1, 80)]))
    file_of(tmp_path, time + 100, fl=10 * np.sin(np.pi * time) ** 2)
    height, _ = manoeuvre(tmp_path, duration=1).drive(wheel("fl"), TIME)
    np.testing.assert_allclose(height, 0.01 * SHAPE, atol=2e-4)


@pytest.mark.parametrize(
    ("columns", "station", "axle", "expected", "said"),
    [
        ({"fl": 1, "fr": 3}, "fl", "front", 1, ()),
        ({"fl": 1, "fr": 3}, "front", "front", 2, ("front follows the mean of fl and fr",)),
        ({"fl": 1, "fr": 3}, "", "front", 2, ("front follows the mean of fl and fr",)),
        ({"front": 1, "rear": 4}, "rr", "rear", 4, ("rr follows rear",)),
        ({"front": 1, "rear": 4}, "", "rear", 4, ()),
        ({"all": 5}, "rl", "rear", 5, ("rl follows all",)),
        ({"height": 6}, "rl", "rear", 6, ("rl follows height",)),
    ],
)
def test_signals_are_found_whatever_the_model(tmp_path, columns, station, axle, expected, said):
    file_of(tmp_path, **{name: size * SHAPE for name, size in columns.items()})
    chosen = manoeuvre(tmp_path)
    height, _ = chosen.drive(wheel(station, axle), np.array([0.5]))
    assert height[0] == pytest.approx(1e-3 * expected, rel=1e-3)
    assert chosen.notes([wheel(station, axle)]) == said


def test_signals_may_have_names_of_their_own(tmp_path):
    file_of(tmp_path, sensor_7=SHAPE, sensor_8=3 * SHAPE)
    chosen = manoeuvre(tmp_path, signals={"front": "sensor_8", "all": "sensor_7"})
    assert [chosen.drive(wheel(each), np.array([0.5]))[0][0] for each in ("fl", "rr")] == pytest.approx(
        [3e-3, 1e-3], rel=1e-3
    )


def test_the_height_at_the_beginning_is_taken_off_and_said(tmp_path):
    file_of(tmp_path, fl=10 * SHAPE + 4)
    chosen = manoeuvre(tmp_path)
    height, rate = chosen.drive(wheel("fl"), TIME)
    assert height[0] == 0.0 and height.max() == pytest.approx(0.01, rel=1e-2)
    assert abs(rate[0]) < 1e-3 * rate.max()
    assert chosen.notes([wheel("fl")]) == ("4 mm taken off the motion of fl, which begins there",)


def test_a_motion_that_does_not_begin_at_rest_is_refused_or_brought_in(tmp_path):
    file_of(tmp_path, fl=10 * np.sin(7 * TIME))
    with pytest.raises(InputError, match=r"begins with 0.0705 m/s, 100 % of its largest; it must begin at rest"):
        manoeuvre(tmp_path).drive(wheel("fl"), TIME)
    faded = manoeuvre(tmp_path, fade_in="0.2 s")
    fine = np.linspace(0, 0.9, 9001)
    height, rate = faded.drive(wheel("fl"), fine)
    assert height[0] == rate[0] == 0.0
    np.testing.assert_allclose(np.gradient(height, fine)[1:-1], rate[1:-1], atol=1e-4)
    np.testing.assert_allclose(height[fine > 0.2], 0.01 * np.sin(7 * fine[fine > 0.2]), atol=5e-5)


def test_a_run_longer_than_the_recording_is_refused_or_holds(tmp_path):
    file_of(tmp_path, fl=10 * np.sin(np.pi / 2 * TIME) ** 2)
    with pytest.raises(InputError, match=r"2 s is too long; the recording ends at 1.2 s of the run"):
        manoeuvre(tmp_path, duration=2, start=0.2).drive(wheel("fl"), TIME)
    held = manoeuvre(tmp_path, duration=2, start=0.2, at_end="hold")
    height, rate = held.drive(wheel("fl"), np.array([0.1, 1.5, 2.0]))
    np.testing.assert_allclose(height, [0.0, 0.01, 0.01])
    np.testing.assert_allclose(rate, 0.0)
    assert held.notes([wheel("fl")]) == ("the recording ends at 1.2 s of the run and is held",)


def test_a_part_of_a_recording_is_said(tmp_path):
    file_of(tmp_path, fl=10 * SHAPE)
    part = manoeuvre(tmp_path, skip=0.5, duration=0.3)
    assert part.notes([wheel("fl")])[-1] == "0.5 to 0.8 s of the recording"
    height, _ = part.drive(wheel("fl"), np.array([0.3]))
    assert height[0] == pytest.approx(0.01 * (np.sin(0.8 * np.pi) ** 2 - 1), abs=1e-6)
    with pytest.raises(InputError, match="1 s is not allowed; the recording lasts 1 s"):
        manoeuvre(tmp_path, skip=1).drive(wheel("fl"), TIME)


def test_signals_that_begin_at_different_times_stay_beside_each_other(tmp_path, monkeypatch):
    shared = np.linspace(0.0, 2.0, 201)
    pulse = 0.01 * np.exp(-(((shared - 1.0) / 0.15) ** 2))
    own = {"fl": Signal(shared, pulse, "m"), "fr": Signal(shared[30:-20], pulse[30:-20], "m")}
    monkeypatch.setattr("manoeuvres.recorded_motion.read_signals", lambda path: Signals(own, path.name))
    file_of(tmp_path, fl=SHAPE)
    chosen = manoeuvre(tmp_path, duration=1.5)
    left, right = (chosen.drive(wheel(each), np.array([0.7]))[0] for each in ("fl", "fr"))
    np.testing.assert_allclose([left, right], 0.01, rtol=1e-6)
    with pytest.raises(InputError, match=r"1\.6 s is too long; the recording ends at 1\.5 s"):
        manoeuvre(tmp_path, duration=1.6).drive(wheel("fl"), TIME)


@pytest.mark.parametrize(
    ("fields", "said"),
    [
        ({"file": "gone.csv"}, "manoeuvre.file: no file 'gone.csv' beside the case file"),
        ({"signals": {"left": "fl"}}, "manoeuvre.signals.left: unknown; "),
        ({"signals": {"fl": "fll"}}, "no signal 'fll'; did you mean 'fl'"),
        ({"method": "linear"}, "manoeuvre.method"),
        ({"at_end": "stop"}, "manoeuvre.at_end"),
    ],
)
def test_mistakes_in_a_case_file(tmp_path, fields, said):
    file_of(tmp_path, fl=SHAPE)
    with pytest.raises(InputError, match=said):
        manoeuvre(tmp_path, **fields)


def test_a_wheel_without_a_signal_and_a_signal_without_a_length(tmp_path):
    file_of(tmp_path, fl=SHAPE, fr=SHAPE)
    with pytest.raises(InputError, match=r"motion.csv: no signal for rl; call one fl, fr"):
        manoeuvre(tmp_path).drive(wheel("rl", "rear"), TIME)
    (tmp_path / "motion.csv").write_text("time [s],fl [N]\n0,0\n1,1\n")
    with pytest.raises(InputError, match="fl: has the wrong unit 'N'"):
        manoeuvre(tmp_path).drive(wheel("fl"), TIME)


def test_a_model_driven_by_the_road_of_its_own_run_repeats_it(tmp_path):
    plant = build(load_vehicle("s_class", "configuration_4"), "full_7dof")
    first = simulate(plant, Bump(duration=1.0, height=0.02, length=4.0))
    first.save(tmp_path / "run.nc")
    again = simulate(plant, manoeuvre(tmp_path, file="run.nc", duration=1.0, method="cubic"))
    for name in ("body_acceleration", "fl_wheel_load", "pitch_angle"):
        np.testing.assert_allclose(again[name], first[name], atol=2e-3 * np.ptp(first[name]))


def test_wheels_without_tyres_follow_the_wheel_centres_of_a_run_and_its_road_those_with(tmp_path):
    plant = build(load_vehicle("s_class", "configuration_4"), "full_7dof")
    simulate(plant, Bump(duration=1.0, height=0.02, length=4.0)).save(tmp_path / "run.nc")
    chosen = manoeuvre(tmp_path, file="run.nc")
    massless, sprung = wheel("fl", "front"), Input("road_height", "fl", 0.0, 0.7, (("fl_tyre", 1.0),), "front")
    assert "fl follows fl_wheel_displacement" in chosen.notes([massless])
    assert "fl follows fl_road_height" in chosen.notes([sprung])


@pytest.mark.parametrize("model", MODELS)
def test_every_model_is_driven_by_what_ships(model):
    run = simulate(build(load_vehicle("s_class", "configuration_4"), model), RecordedMotion(duration=0.8))
    assert 0.5 < np.abs(run["body_acceleration"]).max() < 6
    assert isinstance(run.meta["notes"], list)
