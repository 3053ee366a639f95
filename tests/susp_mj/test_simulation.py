"""simulate: from equilibrium, repeatable to the bit, and plain about what it cannot do."""

from __future__ import annotations

import dataclasses
from typing import ClassVar, Literal

import numpy as np
import pytest

from evaluation.numbers.ride import stop_hits
from manoeuvres import Bump, RoadStep
from susp_mj import InputError, Manoeuvre, Plant, simulate
from susp_mj.recording import Diverged
from susp_mj.units import PositiveTime
from vehicles import load_vehicle
from vehicles.mjcf import build, write

SETS = ("linear", "nonlinear", "soft_linear")
QUARTERS = ("quarter_1dof", "quarter_2dof")
SHORT = Bump(duration=0.5)


def chapter3(case="nonlinear", model="quarter_2dof", **overrides):
    return build(
        load_vehicle("chapter3", case, {key.replace("__", "."): value for key, value in overrides.items()}), model
    )


def assert_same(run, other):
    assert list(run) == list(other)
    np.testing.assert_array_equal(run.time, other.time)
    for name in run:
        np.testing.assert_array_equal(run[name], other[name], err_msg=name)


# ---- repeatable


@pytest.mark.parametrize("model", QUARTERS)
def test_repeats_are_bit_identical(model):
    plant = chapter3(model=model)
    first = simulate(plant, SHORT)
    assert_same(first, simulate(plant, SHORT))
    assert_same(first, simulate(chapter3(model=model), SHORT))


@pytest.mark.parametrize("every", [2, 5, 10])
def test_recording_less_changes_nothing(every):
    plant = chapter3()
    full, thin = simulate(plant, SHORT), simulate(plant, SHORT, record_every=every)
    assert thin.step == pytest.approx(every * 1e-3, rel=1e-12)
    assert len(thin.time) == 500 // every + 1
    for name in full:
        np.testing.assert_array_equal(thin[name], full[name][::every], err_msg=name)


def test_long_runs_are_not_cut_at_chunks():
    """Longer than the stepping loop's inner pieces: the same as one that starts the same and ends sooner."""
    plant = chapter3()
    long, short = simulate(plant, Bump(duration=5.0)), simulate(plant, Bump(duration=1.0))
    assert len(long.time) == 5001
    np.testing.assert_allclose(np.diff(long.time), 1e-3, rtol=0, atol=1e-12)
    np.testing.assert_array_equal(long["body_displacement"][:1001], short["body_displacement"])
    assert abs(long["body_velocity"][-1]) < 1e-4


def test_progress_counts_up_to_one():
    seen = []
    simulate(chapter3(), Bump(duration=5.0), progress=seen.append)
    assert seen == sorted(seen)
    assert seen[-1] == 1.0
    assert len(seen) > 1


@pytest.mark.parametrize("model", QUARTERS)
@pytest.mark.parametrize("case", SETS)
def test_a_written_model_moves_the_same(tmp_path, model, case):
    vehicle = load_vehicle("chapter3", case)
    path = write(vehicle, model, tmp_path / "model.xml")
    read, built = Plant.from_mjcf(path), build(vehicle, model)
    assert read.meaning == built.meaning
    assert_same(simulate(read, SHORT), simulate(built, SHORT))


# ---- equilibrium


@pytest.mark.parametrize("model", QUARTERS)
@pytest.mark.parametrize("case", SETS)
def test_a_run_starts_at_rest(model, case):
    run = simulate(chapter3(case, model), SHORT)
    for quantity in ("body_acceleration", "wheel_acceleration"):
        if quantity in run:
            assert abs(run[quantity][0]) < 1e-6
    before = run.time < 0.2
    assert np.abs(run["body_velocity"][before]).max() < 1e-8
    assert np.abs(run["damper_force"][before]).max() < 1e-3
    assert run["wheel_load"][0] == pytest.approx(9.81 * (523 if model == "quarter_2dof" else 483.5), rel=1e-9)
    assert run["spring_force"][0] == pytest.approx(483.5 * 9.81, rel=1e-9)


def test_a_heavier_load_sinks_to_its_own_equilibrium(vehicle_file):
    """60 kg on a spring of 25 N/mm and a tyre of 180 N/mm."""
    plants = {load: build(load_vehicle(vehicle_file), "quarter_2dof", load) for load in ("ko", "heavy")}
    runs = {load: simulate(plant, SHORT) for load, plant in plants.items()}
    assert runs["ko"]["suspension_deflection"][0] == pytest.approx(0.0, abs=1e-9)
    assert runs["ko"]["body_displacement"][0] == pytest.approx(0.0, abs=1e-9)
    extra = 60 * 9.81
    heavy = runs["heavy"]
    assert heavy["suspension_deflection"][0] == pytest.approx(extra / 25e3, rel=1e-9)
    assert heavy["wheel_displacement"][0] == pytest.approx(-extra / 180e3, rel=1e-9)
    assert heavy["body_displacement"][0] == pytest.approx(-extra / 25e3 - extra / 180e3, rel=1e-9)
    assert abs(heavy["body_acceleration"][0]) < 1e-6
    assert abs(heavy["wheel_acceleration"][0]) < 1e-6
    assert np.abs(heavy["damper_force"][heavy.time < 0.2]).max() < 1e-3
    assert heavy.meta["load"] == "heavy"


def test_channels_are_consistent():
    """Newton's law for both masses, and kinematics, out of the recorded channels."""
    run = simulate(chapter3("linear"), Bump(duration=1.0))
    force = sum(run[name] for name in ("spring_force", "stop_force", "damper_force", "friction_force"))
    np.testing.assert_allclose(483.5 * (run["body_acceleration"] + 9.81), force, rtol=0, atol=1e-7)
    np.testing.assert_allclose(39.5 * (run["wheel_acceleration"] + 9.81), run["wheel_load"] - force, rtol=0, atol=1e-7)
    np.testing.assert_allclose(
        run["suspension_deflection"], run["wheel_displacement"] - run["body_displacement"], rtol=0, atol=1e-12
    )
    expected = np.maximum(0.0, 523 * 9.81 + 176e3 * (run["road_height"] - run["wheel_displacement"]))
    np.testing.assert_allclose(run["wheel_load"], expected, rtol=0, atol=1e-7)
    speed = np.gradient(run["suspension_deflection"], run.step)
    np.testing.assert_allclose(run["suspension_speed"][1:-1], speed[1:-1], rtol=0, atol=5e-3)


@pytest.mark.parametrize("damping", [1500, 3000, 6000])
def test_a_jump_of_a_rigid_wheel_passes_through_the_mount(damping):
    """Without rise time the mount takes it all: the peak is ``k1 h / m`` and the spring's share, whatever the
    damper."""
    plant = chapter3("linear", "quarter_1dof", rear__damper__rates=[damping])
    run = simulate(plant, RoadStep(height=0.01, rise_time=0.0, start=0.1, duration=0.2), step=2e-5)
    spring = 4743 / 9.81 * (2 * np.pi * 1.2) ** 2
    assert run["body_acceleration"].max() == pytest.approx((400e3 + spring) * 0.01 / 483.5, rel=2e-3)


def test_a_massless_wheel_off_the_road_carries_nothing():
    """A road that falls away leaves the massless wheel on its rebound stop: no force is left, and the hit is
    counted."""
    plant = chapter3("linear", "quarter_1dof")
    run = simulate(plant, RoadStep(height=-0.15, duration=2.0))
    beyond = run["suspension_deflection"] < -0.1
    assert beyond.sum() > 10
    off = run["wheel_load"] == 0.0
    assert off[run["suspension_deflection"] < -0.101].all()
    for part in ("spring", "stop", "damper", "friction"):
        assert not run[f"{part}_force"][off].any()
    assert stop_hits(run).value == np.sum(beyond[1:] & ~beyond[:-1])


@pytest.mark.parametrize(
    "change", [{"rear__friction__force": 3000}, {"rear__tyre__rate": 1e6}, {"rear__spring__stops__rate": 5e8}]
)
def test_the_step_follows_the_stiffest_element(change):
    """Friction, tyre and stops of any stiffness: the step that is taken gives what a much finer one gives."""
    plant = chapter3("nonlinear", **change)
    own, fine = (
        simulate(plant, Bump(duration=0.6, height=0.12)),
        simulate(plant, Bump(duration=0.6, height=0.12), step=2e-5, record_every=50),
    )
    scale = np.ptp(fine["body_acceleration"])
    assert np.sqrt(np.mean((own["body_acceleration"] - fine["body_acceleration"]) ** 2)) < 0.01 * scale


# ---- what cannot be done


@pytest.mark.parametrize("step", [0.0, -1e-3, float("nan"), float("inf")])
def test_impossible_steps(step):
    with pytest.raises(InputError, match="positive"):
        simulate(chapter3(), SHORT, step=step)


def test_impossible_recording():
    with pytest.raises(InputError, match="record_every 0"):
        simulate(chapter3(), SHORT, record_every=0)


def test_divergence_is_reported_with_time_and_channel():
    """A stop far too stiff for the step: the motion leaves all bounds, and one line says when and where.

    The check of the step, which refuses such a stop by name, is taken out of the way first.
    """
    plant = chapter3("linear", rear__spring__stops__rate=1e12, rear__spring__stops__compression=0.02)
    with pytest.raises(InputError, match=r"rear\.spring\.stops\.rate: 1e\+12 N/m is too stiff for a step of 1 ms"):
        simulate(plant, SHORT)
    plant = dataclasses.replace(plant, meaning=dataclasses.replace(plant.meaning, time_constants=()))
    with pytest.raises(Diverged) as caught:
        simulate(plant, SHORT)
    text = str(caught.value)
    assert "\n" not in text
    moment = float(text.split("t = ")[1].split(" s", maxsplit=1)[0])
    assert 0.2 < moment < 0.5
    assert "acceleration" in text
    assert "chapter3" in text
    assert "m/s²" in text
    until = caught.value.run
    assert until.time[-1] == pytest.approx(moment, abs=1e-4)
    assert np.array_equal(until["road_height"], simulate(chapter3("linear"), SHORT)["road_height"][: len(until.time)])


def test_a_mount_too_stiff_for_the_step():
    """600 N s/m x 2/3 in compression over the mount's rate is the time constant; RK4 bears steps up to 2.785 times
    it."""
    slowest = 600 * 2 / 3
    plant = chapter3("nonlinear", rear__damper__mount__rate=2e6)
    with pytest.raises(InputError) as caught:
        simulate(plant, SHORT, step=1e-3)
    error = caught.value
    assert error.key == "rear.damper.mount.rate"
    assert error.source == "chapter3.toml with overrides"
    assert "2e+06 N/m" in str(error)
    allowed = float(str(error).split("at most ")[1].split(" N/m")[0])
    assert allowed == pytest.approx(2.785 * slowest / 1e-3, rel=5e-3)
    fits = chapter3("nonlinear", rear__damper__mount__rate=0.99 * allowed)
    assert np.isfinite(simulate(fits, SHORT, step=1e-3)["body_acceleration"]).all()
    assert np.abs(simulate(plant, SHORT, step=0.4e-3)["body_acceleration"]).max() < 20


def test_the_step_follows_the_stiffest_mount():
    """Without a given step none exceeds a time constant, and the records stay a millisecond apart."""
    plant = chapter3("nonlinear", rear__damper__mount__rate=2e6)
    run = simulate(plant, SHORT)
    assert run.meta["step"] == pytest.approx(0.2e-3)
    assert run.step == pytest.approx(1e-3)
    hopeless = chapter3("nonlinear", rear__damper__mount__rate=4e9)
    with pytest.raises(InputError, match=r"4e\+09 N/m is too stiff for a step of 1 ms"):
        simulate(hopeless, SHORT)


@pytest.mark.parametrize("preload", [500.0, 20000.0])
def test_a_preload_that_cannot_carry_the_load(preload):
    for model in QUARTERS:
        with pytest.raises(InputError, match="cannot carry load 'ko'") as caught:
            simulate(chapter3("linear", model, rear__spring__preload=preload), SHORT)
        assert caught.value.key == "rear.spring"
        assert caught.value.source == "chapter3.toml with overrides"


class Elsewhere(Manoeuvre):
    """Drives what a quarter car does not have."""

    needs: ClassVar[tuple[str, ...]] = ("steering_wheel_angle",)
    kind: Literal["elsewhere"] = "elsewhere"
    duration: PositiveTime = 1.0

    def drive(self, place, time):
        return None


class Broken(Manoeuvre):
    """A road with a hole that is not a number."""

    needs: ClassVar[tuple[str, ...]] = ("road_height",)
    kind: Literal["broken"] = "broken"
    duration: PositiveTime = 0.1

    def drive(self, place, time):
        return np.where(time > 0.05, np.nan, 0.0), np.zeros_like(time)


def test_a_manoeuvre_that_does_not_fit():
    with pytest.raises(InputError, match="no input 'steering_wheel_angle'"):
        simulate(chapter3(), Elsewhere())


def test_an_input_that_is_not_finite():
    with pytest.raises(InputError, match="broken gives an input that is not finite"):
        simulate(chapter3(), Broken())


def test_the_run_says_what_was_run():
    meta = simulate(chapter3("linear"), SHORT, step=5e-4).meta
    assert (meta["vehicle"], meta["model"], meta["load"], meta["step"]) == ("chapter3", "quarter_2dof", "ko", 5e-4)
    assert meta["manoeuvre"]["kind"] == "bump"
    assert meta["manoeuvre"]["height"] == 0.08
    assert meta["travel"] == {"": [-0.1, 0.1]}


def test_reading_something_else(tmp_path):
    with pytest.raises(InputError, match="no such file"):
        Plant.from_mjcf(tmp_path / "none.xml")
    (tmp_path / "other.xml").write_text("<mujoco><worldbody/></mujoco>")
    with pytest.raises(InputError, match="not a model that susp-mj built"):
        Plant.from_mjcf(tmp_path / "other.xml")
    (tmp_path / "text.xml").write_text("hello")
    with pytest.raises(InputError, match="not a model that susp-mj built") as caught:
        Plant.from_mjcf(tmp_path / "text.xml")
    assert "\n" not in str(caught.value)


def test_an_unwritable_place_for_a_model(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="cannot be written"):
        write(load_vehicle("chapter3", "linear"), "quarter_2dof", tmp_path / "file" / "model.xml")
