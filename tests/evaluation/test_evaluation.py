"""Every evaluation number on runs made by hand, whose answers are known beforehand."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from evaluation.display import band_text
from evaluation.numbers import NUMBERS, Answer, Criterion, Measure, Number, Verdict, evaluate, recorded, register
from evaluation.numbers.frequency import amplification
from manoeuvres import RoadStep, VerticalSweep
from susp_mj import InputError, simulate
from susp_mj.meaning import Input
from vehicles import load_vehicle
from vehicles.mjcf import build

from ..builders.runs import changed, run_of

STEP = 0.01
TIME = np.arange(1001) * STEP


def make(travel=(-0.1, 0.08), **signals):
    """Run of channels ``station_quantity=values`` or ``quantity=values``, the same travel at every station."""
    run = run_of(TIME, signals)
    stations = {channel.station for channel in run.channels.values()}
    return replace(run, meta={"travel": {station: list(travel) for station in stations}})


def pulse(base, *spikes):
    """Constant signal with single samples changed: (time [s], value)."""
    values = np.full(len(TIME), float(base))
    for time, value in spikes:
        values[round(time / STEP)] = value
    return values


def value_of(name, run):
    number = NUMBERS[name](run)
    assert "\n" not in number.note
    return number.value


# ---- body


def test_body_acceleration():
    run = make(body_acceleration=pulse(0.5, (2.0, 9.0), (3.0, -7.0)))
    up, down = NUMBERS["body_acceleration_max"](run), NUMBERS["body_acceleration_min"](run)
    assert (up.value, down.value) == (9.0, -7.0)
    assert up.unit == down.unit == "m/s²"
    assert "2.000 s" in up.note
    assert "3.000 s" in down.note


def test_body_acceleration_rms():
    sine = 3.0 * np.sin(2 * np.pi * TIME)
    assert value_of("body_acceleration_rms", make(body_acceleration=sine)) == pytest.approx(3 / np.sqrt(2), rel=2e-3)
    assert value_of("body_acceleration_rms", make(body_acceleration=-4.0)) == pytest.approx(4.0, rel=1e-12)


def test_body_displacement_counts_from_the_start():
    run = make(body_displacement=pulse(-0.02, (1.0, 0.03), (2.0, -0.2)))
    assert value_of("body_displacement_max", run) == pytest.approx(0.05, rel=1e-12)


@pytest.mark.parametrize("final", [0.03, -0.03])
@pytest.mark.parametrize("offset", [0.0, -0.01])
def test_overshoot(final, offset):
    """Final change 30 mm, largest excursion 39 mm: 30 % over."""
    z = np.where(TIME < 1.0, 0.0, final)
    z[120] = 1.3 * final
    assert value_of("overshoot", make(body_displacement=offset + z)) == pytest.approx(0.3, rel=1e-9)


def test_no_overshoot():
    creep = 0.03 * (1 - np.exp(-TIME))
    assert value_of("overshoot", make(body_displacement=creep)) == pytest.approx(0.0, abs=2e-3)
    assert value_of("overshoot", make(body_displacement=pulse(0.0, (1.0, 0.05)))) is None
    assert value_of("overshoot", make(body_displacement=0.0)) is None


def test_settling_time():
    """exp(-t/tau) falls to 5 % after tau ln 20, counted from the road's first movement."""
    tau = 0.8
    z = np.where(TIME < 1.0, 0.0, 0.04 * np.exp(-(TIME - 1.0) / tau))
    road = np.where(TIME <= 1.0, 0.0, 0.001)
    assert value_of("settling_time", make(body_displacement=z, road_height=road)) == pytest.approx(
        tau * np.log(20), abs=2 * STEP
    )


def test_settling_towards_a_new_height():
    tau = 0.5
    z = np.where(TIME < 2.0, 0.0, 0.03 * (1 - np.exp(-(TIME - 2.0) / tau)))
    road = np.where(TIME <= 2.0, 0.0, 0.03)
    assert value_of("settling_time", make(body_displacement=z, road_height=road)) == pytest.approx(
        tau * np.log(20), abs=2 * STEP
    )


def creeping(friction, rate=20_000.0, step=0.03):
    """A body that falls short of a step by what friction holds and creeps on, as a regularised friction law lets it."""
    held = friction / rate
    z = np.where(
        TIME < 1.0, 0.0, step - held * np.exp(-(TIME - 1.0) / 2.0) - (step - held) * np.exp(-(TIME - 1.0) / 0.1)
    )
    return make(
        body_displacement=z,
        road_height=np.where(TIME <= 1.0, 0.0, step),
        spring_force=4743.0 + rate * (np.where(TIME <= 1.0, 0.0, step) - z),
        friction_force=np.where((TIME > 1.0) & (TIME < 1.2), friction, 0.5 * friction),
    )


def test_friction_that_creeps_does_not_settle_late():
    """What creeps within the force that friction holds has settled: once the quick part is over, not seconds later."""
    run = creeping(150.0)
    assert value_of("settling_time", run) == pytest.approx(0.3, abs=0.15)
    assert "friction holds it" in NUMBERS["settling_time"](run).note
    without = replace(run, channels={name: each for name, each in run.channels.items() if name != "friction_force"})
    assert value_of("settling_time", without) > 2.0


def test_friction_that_holds_the_whole_step_settles_at_once():
    run = creeping(150.0, step=0.006)
    assert value_of("settling_time", run) == 0.0
    assert NUMBERS["settling_time"](run).note == "friction holds the body"


def test_the_better_damped_car_settles_earlier():
    """Rear axle of the saloon, full, over 50 mm: 4000 N s/m settle before 1500 N s/m, and friction does not matter."""
    times = [
        NUMBERS["settling_time"](
            simulate(build(load_vehicle("s_class", name), "quarter_1dof", "full", "rear"), RoadStep(height=0.05))
        ).value
        for name in ("configuration_3_step_1", "configuration_3")
    ]
    assert times[1] < times[0] < 1.0


def test_not_settled():
    endless = 0.02 * np.sin(2 * np.pi * TIME) * (TIME > 1)
    road = np.where(TIME <= 1.0, 0.0, 0.001)
    number = NUMBERS["settling_time"](make(body_displacement=endless, road_height=road))
    assert number.value is None
    assert "not settled" in number.note
    assert value_of("settling_time", make(body_displacement=0.0, road_height=0.0)) is None


# ---- wheel load


def test_wheel_load_names_the_worst_wheel():
    run = make(
        fl_wheel_load=pulse(4000, (2.0, 3000)),
        rr_wheel_load=pulse(3500, (4.0, 1200), (5.0, 6100)),
        fr_wheel_load=pulse(4000, (1.0, 6000)),
    )
    least, most = NUMBERS["wheel_load_min"](run), NUMBERS["wheel_load_max"](run)
    assert (least.value, most.value) == (1200.0, 6100.0)
    assert "rr" in least.note
    assert "4.000 s" in least.note
    assert "rr" in most.note
    assert least.unit == "N"


def test_wheel_load_rms_is_of_the_dynamic_share():
    swing = 4000 + 500 * np.sin(2 * np.pi * TIME)
    run = make(fl_wheel_load=swing, fr_wheel_load=4000.0)
    number = NUMBERS["wheel_load_rms"](run)
    assert number.value == pytest.approx(500 / np.sqrt(2), rel=2e-3)
    assert number.note == "fl"


def test_contact_loss():
    load = np.where((TIME >= 2.0) & (TIME < 2.5), 0.0, 3000.0)
    again = np.where(((TIME >= 1.0) & (TIME < 1.1)) | ((TIME >= 3.0) & (TIME < 3.1)), 0.0, 3000.0)
    run = make(rl_wheel_load=load, rr_wheel_load=again)
    longest, first = NUMBERS["contact_loss_time"](run), NUMBERS["contact_loss_instant"](run)
    assert longest.value == pytest.approx(0.5, abs=1.5 * STEP)
    assert longest.note == "rl"
    assert first.value == pytest.approx(1.0, abs=STEP)
    assert first.note == "rr"


def test_contact_kept():
    run = make(wheel_load=pulse(3000, (1.0, 0.5)))
    assert value_of("contact_loss_time", run) == 0.0
    assert value_of("contact_loss_instant", run) is None


# ---- travel and stops


def test_travel():
    run = make(
        fl_suspension_deflection=pulse(0.01, (1.0, 0.06), (2.0, -0.03)),
        rl_suspension_deflection=pulse(0.0, (3.0, -0.07)),
    )
    assert value_of("travel_compression", run) == 0.06
    assert value_of("travel_rebound", run) == -0.07
    assert value_of("travel_left_compression", run) == pytest.approx(0.02, rel=1e-9)
    assert value_of("travel_left_rebound", run) == pytest.approx(0.03, rel=1e-9)
    assert NUMBERS["travel_left_rebound"](run).note.startswith("rl")


def test_travel_left_is_negative_in_the_stop():
    run = make(suspension_deflection=pulse(0.0, (1.0, 0.085), (2.0, -0.11)))
    assert value_of("travel_left_compression", run) == pytest.approx(-0.005, rel=1e-9)
    assert value_of("travel_left_rebound", run) == pytest.approx(-0.01, rel=1e-9)


def test_stop_hits():
    """A hit is a new touch: one that lasts counts once, both directions and all wheels together."""
    force, deflection = np.zeros((2, len(TIME)))
    for begin, end, sign in ((1.0, 1.2, 1), (2.0, 2.01, 1), (3.0, 3.5, -1)):
        inside = slice(round(begin / STEP), round(end / STEP))
        force[inside] = 100.0 * sign
        deflection[inside] = 0.081 if sign > 0 else -0.101
    other, other_deflection = pulse(0.0, (5.0, 50.0)), pulse(0.0, (5.0, 0.0805))
    run = make(
        fl_stop_force=force,
        fl_suspension_deflection=deflection,
        rr_stop_force=other,
        rr_suspension_deflection=other_deflection,
    )
    assert value_of("stop_hits", run) == 4.0
    still = make(stop_force=0.0, suspension_deflection=0.0)
    assert value_of("stop_hits", still) == 0.0


def test_a_run_that_begins_on_the_stop():
    run = make(stop_force=np.where(TIME < 1.0, 10.0, 0.0), suspension_deflection=np.where(TIME < 1.0, 0.081, 0.0))
    assert value_of("stop_hits", run) == 1.0


# ---- frequency


def sweep_run(transfer, noise=None, **fields):
    """Run whose body follows the road through a linear filter, exactly: filtered in the frequency domain."""
    sweep = VerticalSweep(**{"duration": 60.0, "start_frequency": 0.3, "end_frequency": 20.0, **fields})
    time = np.arange(round(sweep.duration * 1000) + 1) * 1e-3
    road, _ = sweep.drive(Input("road_height", "", 0.0, 0.0, ()), time)
    padded = 4 * len(time)
    frequency = np.fft.rfftfreq(padded, 1e-3)
    response = np.fft.irfft(np.fft.rfft(road, padded) * transfer(frequency), padded)[: len(time)]
    if noise is not None:
        response = response + noise(time)
    channels = {"road_height": road, "body_displacement": response, **sweep.record(time)}
    return run_of(time, channels, {"travel": {}})


def resonator(frequency, eigenfrequency=1.2, damping=0.3):
    """Transfer function of a mass on a spring and a damper that the road drives."""
    s = 1j * frequency / eigenfrequency
    return (1 + 2 * damping * s) / (1 + 2 * damping * s + s**2)


def amplification_error(**fields):
    """Frequencies [Hz] and relative error of the complex amplification, on the default sweep."""
    found = amplification(sweep_run(resonator, **fields), "body_displacement")
    assert found.frequency[0] < 0.55
    assert found.frequency[-1] > 18.0
    return found.frequency, np.abs(found.ratio / resonator(found.frequency) - 1)


@pytest.mark.parametrize("constant_speed", [True, False])
def test_amplification_above_resonance_is_the_transfer_function(constant_speed):
    frequency, error = amplification_error(constant_speed=constant_speed)
    assert error[frequency > 3.0].max() < 0.02


@pytest.mark.parametrize("constant_speed", [True, False])
def test_amplification_at_resonance_is_the_transfer_function(constant_speed):
    """A body of 1.2 Hz with 30 % of critical damping, which is what a car is: the sweep may not be too fast for it."""
    frequency, error = amplification_error(constant_speed=constant_speed)
    assert error[frequency < 3.0].max() < 0.03


def test_amplification_of_a_gain_is_exact():
    found = amplification(sweep_run(lambda f: np.full_like(f, -2.5)), "body_displacement")
    np.testing.assert_allclose(found.ratio, -2.5, rtol=0, atol=1e-9)


def test_amplification_ignores_harmonics_and_offsets():
    """Only the first harmonic counts: an offset of the channel and its own third harmonic leave no trace."""

    def disturbance(time):
        sweep = VerticalSweep(duration=60.0)
        phase = sweep.record(time)["excitation_phase"]
        return 0.02 + 0.0005 * np.cos(3 * phase)

    clean = amplification(sweep_run(resonator, constant_speed=False), "body_displacement")
    dirty = amplification(sweep_run(resonator, disturbance, constant_speed=False), "body_displacement")
    assert np.abs(dirty.ratio - clean.ratio).max() < 0.005


def test_resonance_numbers():
    run = sweep_run(resonator)
    grid = np.linspace(0.5, 3, 100001)
    peak = np.abs(resonator(grid))
    assert value_of("body_amplification", run) == pytest.approx(peak.max(), rel=0.01)
    assert value_of("body_resonance", run) == pytest.approx(grid[np.argmax(peak)], rel=0.03)


def test_each_frequency_number_reads_its_own_quantity():
    run = sweep_run(resonator)
    gains = {"body_acceleration": -7.0, "suspension_deflection": 1.5, "wheel_load": 2e5}
    road = run["road_height"]
    run = changed(run, **{quantity: gain * road for quantity, gain in gains.items()})
    assert value_of("body_acceleration_amplification", run) == pytest.approx(7.0, rel=1e-6)
    assert value_of("suspension_amplification", run) == pytest.approx(1.5, rel=1e-6)
    assert value_of("wheel_load_amplification", run) == pytest.approx(2e5, rel=1e-6)


def test_frequency_numbers_need_a_sweep():
    number = NUMBERS["body_resonance"](make(body_displacement=0.0, road_height=0.0))
    assert number.value is None
    assert number.note


# ---- criteria and choice


@pytest.mark.parametrize(
    ("low", "high", "value", "passed"),
    [
        (None, None, 1.0, True),
        (1.0, None, 1.0, True),
        (1.0, None, 0.999, False),
        (None, 2.0, 2.0, True),
        (None, 2.0, 2.001, False),
        (1.0, 2.0, 1.5, True),
        (None, None, None, False),
        (1.0, 2.0, None, False),
        (1.0, 2.0, float("nan"), False),
    ],
)
def test_criterion(low, high, value, passed):
    assert Criterion(low, high).passed(value) == passed
    verdict = Verdict(Number(value, "m"), Criterion(low, high))
    assert verdict.passed == passed
    assert verdict.plain() == {"value": value, "unit": "m", "min": low, "max": high, "passed": passed}


@pytest.mark.parametrize(
    ("low", "high", "words"),
    [
        (None, None, "any value"),
        (0.001, None, "at least 1.0 mm"),
        (None, 0.003, "at most 3.0 mm"),
        (-0.001, 0.003, "−1.0 to 3.0 mm"),
    ],
)
def test_band_in_words(low, high, words):
    assert band_text(low, high, "m") == Verdict(Number(None, "m"), Criterion(low, high)).band == words


def test_numbers_by_name():
    run = make(body_acceleration=pulse(0.0, (1.0, 2.0)))
    found = evaluate(run, ["body_acceleration_max", "body_acceleration_min"])
    assert list(found) == ["body_acceleration_max", "body_acceleration_min"]
    assert found["body_acceleration_max"].value == 2.0
    with pytest.raises(InputError, match="did you mean 'body_acceleration_max'"):
        evaluate(run, ["body_acceleration_mx"])


def test_a_run_without_the_channel_is_an_answer_or_an_error_in_words():
    """Not every model records everything: no value, or an error of ours, but never a crash."""
    run = make(excitation_frequency=1.0)
    crashed = []
    for name, number in NUMBERS.items():
        try:
            assert number(run).value in (None, 0.0)
        except InputError as error:
            assert "no channel" in str(error)
        except (ValueError, KeyError, IndexError, StopIteration) as error:
            crashed.append(f"{name}: {error!r}")
    assert not crashed, crashed


def test_a_number_of_one_s_own_is_registered_once():
    def loudest(run):
        """Largest speed of anything [m/s]."""
        return Answer(3.0, "somewhere")

    measure = Measure(loudest, "m/s", recorded("body_acceleration"))
    register(measure)
    try:
        assert evaluate(make(body_acceleration=0.0), ["loudest"]) == {"loudest": Number(3.0, "m/s", "somewhere")}
        without = NUMBERS["loudest"](make(wheel_load=0.0))
        assert without == Number(None, "m/s", "the run has no body_acceleration", applies=False)
        with pytest.raises(InputError, match="'loudest' is taken"):
            register(measure)
    finally:
        del NUMBERS["loudest"]


def test_runs_of_two_kinds():
    lifted, loaded = recorded("body_displacement"), recorded("wheel_load")
    run = make(body_displacement=0.0)
    assert run in lifted and run not in loaded and run not in lifted & loaded
    assert make(body_displacement=0.0, fl_wheel_load=1.0) in loaded & lifted
    assert (loaded & lifted).refuse(make(body_acceleration=0.0)) == "the run has no wheel_load"


@pytest.mark.parametrize("name", NUMBERS)
def test_every_number_is_documented(name):
    assert NUMBERS[name].name == name
    assert NUMBERS[name].description
