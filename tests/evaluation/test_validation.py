"""Measurements on runs: filters and shifts are those of the textbook, and the band finds what it shall find."""

from __future__ import annotations

import functools

import numpy as np
import pytest
from scipy.signal import lfilter
from scipy.stats import t as student

from evaluation.validation import STANDARDS, Validation, judge
from evaluation.validation.alignment import Trace, best_shift
from evaluation.validation.filters import filter_of
from evaluation.validation.table import remarks, rows, summary
from manoeuvres import SteadyCircle
from susp_mj import InputError, simulate
from susp_mj.description import validate
from susp_mj.signals import Signal, Signals
from vehicles import load_vehicle
from vehicles.mjcf import build

from ..builders.runs import run_of

STEP = 1e-3


def settings(**fields):
    return validate(Validation, fields)


def measured(time, source="measured.csv", **columns):
    """Columns of (values, unit)."""
    return Signals({name: Signal(time, *column) for name, column in columns.items()}, source)


def j211(values, number):
    """The recursion that SAE J211-1 prints, once."""
    wd = 2 * np.pi * number * 2.0775
    wa = np.tan(wd * STEP / 2)
    a0 = wa**2 / (1 + np.sqrt(2) * wa + wa**2)
    b1, b2 = (
        -2 * (wa**2 - 1) / (1 + np.sqrt(2) * wa + wa**2),
        (-1 + np.sqrt(2) * wa - wa**2) / (1 + np.sqrt(2) * wa + wa**2),
    )
    return lfilter([a0, 2 * a0, a0], [1, -b1, -b2], values)


@pytest.mark.parametrize("number", [60, 180])
def test_a_class_is_the_recursion_of_the_standard_forwards_and_backwards(number):
    values = np.zeros(4001)
    values[2000] = 1.0
    expected = j211(j211(values, number)[::-1], number)[::-1]
    np.testing.assert_allclose(filter_of(f"CFC {number}")(values, STEP), expected, atol=1e-12)


@pytest.mark.parametrize(
    ("text", "frequency"), [("CFC 60", 100.0), ("Butterworth 2, 10 Hz", 10.0), ("Butterworth 4, 5 Hz", 5.0)]
)
def test_a_filter_has_3_db_at_its_frequency_and_no_phase(text, frequency):
    step = 1e-4
    time = np.arange(40001) * step
    for factor, gain in ((1.0, 10 ** (-3 / 20)), (0.05, 1.0)):
        sine = np.sin(2 * np.pi * factor * frequency * time)
        inside = filter_of(text)(sine, step)[10000:30001]
        np.testing.assert_allclose(inside, gain * sine[10000:30001], atol=5e-3)


@pytest.mark.parametrize(
    "text", ["CFC 61", "CFC", "Butterworth 2", "Butterworth 9, 5 Hz", "Butterworth 2, 5 m", "mean"]
)
def test_what_is_no_filter_is_refused(text):
    with pytest.raises(InputError, match=r"^filter: "):
        settings(filter=text)


def test_a_filter_that_the_samples_cannot_carry_says_how_close_they_must_be():
    with pytest.raises(InputError, match=r"CFC 1000 .* needs samples less than 0.241 ms apart; these are 1 ms"):
        filter_of("CFC 1000")(np.zeros(1000), STEP)
    with pytest.raises(InputError, match="needs more than 9 samples"):
        filter_of("CFC 60")(np.zeros(5), STEP)


def pulse(time):
    return np.exp(-(((time - 1.0) / 0.1) ** 2)) - 0.6 * np.exp(-(((time - 1.3) / 0.15) ** 2))


@pytest.mark.parametrize("shift", [-0.2345, 0.0, 0.0417, 0.31])
@pytest.mark.parametrize("spacing", [0.001, 0.007])
def test_correlation_finds_a_known_shift(shift, spacing):
    ours = np.arange(3001) * STEP
    theirs = np.arange(-0.5, 3.5, spacing)
    noise = np.random.default_rng(3).normal(0, 0.01, len(theirs))
    found = best_shift(Trace(ours, pulse(ours)), Trace(theirs, pulse(theirs + shift) + noise), 0.5)
    assert found == pytest.approx(shift, abs=3e-3)


RUN_TIME = np.arange(3001) * STEP
RUN = run_of(RUN_TIME, {"body_acceleration": 3 * pulse(RUN_TIME), "roll_angle": 0.02 * pulse(RUN_TIME)})


def test_errors_over_time_are_those_of_table_6_3():
    """A measurement 5 % larger with an offset of its clock."""
    theirs = measured(RUN_TIME - 0.2, body_acceleration=(3 * 1.05 * pulse(RUN_TIME) / 9.80665, "g"))
    findings = judge(RUN, [theirs], settings())
    (shift,), (found,) = findings.shifts, findings.judgements
    assert shift.seconds == pytest.approx(0.2, abs=1e-4) and shift.correlation == pytest.approx(1.0, abs=1e-6)
    errors = found.errors
    high, low = 3 * pulse(RUN_TIME).max(), -3 * pulse(RUN_TIME).min()
    assert errors.unit == "g"
    assert errors.largest == pytest.approx(0.05 * high / 9.80665, rel=1e-2)
    assert errors.smallest == pytest.approx(0.05 * low / 9.80665, rel=1e-2)
    assert errors.of_peak == pytest.approx(100 * 0.05 / 1.05, rel=1e-2)
    assert errors.of_any == pytest.approx(100 * 0.05 / 1.05, rel=2e-2)
    assert findings.inside and found.inside


@pytest.mark.parametrize(("size", "inside"), [(1.08, True), (1.12, False)])
def test_the_band_is_offset_gain_and_along(size, inside):
    """|s - m| = (size - 1) peak at the peak; allowed are 5 % of m, and 0.1 m/s² more."""
    theirs = measured(RUN_TIME, body_acceleration=(3 * size * pulse(RUN_TIME), "m/s²"))
    one = {"channel": "body_acceleration", "tolerance": {"gain": 0.05, "offset": "0.1 m/s²"}}
    found = judge(RUN, [theirs], settings(signal=[one], shift="none")).judgements[0]
    np.testing.assert_allclose(found.half, 0.05 * 3 * size * pulse(RUN_TIME).max() + 0.1)
    assert found.inside is inside
    assert found.abscissa[found.worst] == pytest.approx(RUN_TIME[np.abs(pulse(RUN_TIME)).argmax()], abs=2e-3)
    along = {"channel": "body_acceleration", "tolerance": {"along": "10 ms"}}
    wide = judge(RUN, [theirs], settings(signal=[along], shift="none")).judgements[0]
    np.testing.assert_allclose(wide.half, 0.01 * np.abs(np.gradient(RUN["body_acceleration"], RUN_TIME)))


def test_several_measurements_have_a_confidence_interval():
    values = [(1 + each) * 3 * pulse(RUN_TIME) for each in (-0.02, 0.0, 0.02)]
    runs = [measured(RUN_TIME, f"{i}.csv", body_acceleration=(each, "m/s²")) for i, each in enumerate(values)]
    found = judge(RUN, runs, settings(shift="none")).judgements[0]
    expected = student.ppf(0.975, 2) * np.std(values, axis=0, ddof=1) / np.sqrt(3)
    np.testing.assert_allclose(found.confidence, expected, atol=1e-12)
    np.testing.assert_allclose(found.mean, 3 * pulse(RUN_TIME), atol=1e-12)


def test_columns_are_mapped_with_unit_factor_and_zero():
    theirs = measured(RUN_TIME, sensor=(-np.degrees(0.02 * pulse(RUN_TIME) + 0.01), ""))
    one = {"channel": "roll_angle", "column": "sensor", "unit": "deg", "factor": -1, "subtract": "0.01 rad"}
    found = judge(RUN, [theirs], settings(signal=[one], shift="none")).judgements[0]
    assert found.errors.rms < 1e-12


def test_tolerances_that_nobody_gave_are_said_to_be_reconstructed():
    theirs = measured(RUN_TIME, roll_angle=(0.02 * pulse(RUN_TIME), "rad"))
    for name, standard in STANDARDS.items():
        if standard.crossed:
            continue
        findings = judge(RUN, [theirs], settings(standard=name))
        said = dict(remarks(findings))
        assert said["compared by"] == standard.title and "reconstructed" in said["tolerance of roll_angle"]
    one = {"channel": "roll_angle", "tolerance": {"gain": 0.05}}
    said = dict(remarks(judge(RUN, [theirs], settings(signal=[one]))))
    assert "reconstructed" not in said["tolerance of roll_angle"]


def test_a_shift_at_the_edge_of_the_window_is_said():
    theirs = measured(RUN_TIME - 0.3, roll_angle=(0.02 * pulse(RUN_TIME), "rad"))
    (shift,) = judge(RUN, [theirs], settings(window=0.2)).shifts
    assert "edge of the window" in shift.note


@pytest.mark.parametrize(
    ("fields", "said"),
    [
        ({"signal": [{"channel": "roll_angel"}]}, "no channel 'roll_angel'; did you mean 'roll_angle'"),
        ({"signal": [{"channel": "roll_angle", "column": "rol"}]}, "measured.csv: no signal 'rol'"),
        ({"signal": [{"channel": "roll_angle", "unit": "m"}]}, "measured.csv: roll_angle: has the wrong unit 'm'"),
        (
            {"signal": [{"channel": "roll_angle", "tolerance": {"offset": "1 m"}}]},
            "validation: tolerance.offset: '1 m' has the wrong unit",
        ),
        ({"signal": [{"channel": "roll_angle"}], "shift": "10 s"}, r"validation: shift: .* do not overlap"),
        ({"filter": "CFC 1000"}, r"validation: filter: CFC 1000 .* these are 1 ms \(run\)"),
    ],
)
def test_settings_that_do_not_fit_are_one_line(fields, said):
    theirs = measured(RUN_TIME, roll_angle=(0.02 * pulse(RUN_TIME), "rad"))
    with pytest.raises(InputError, match=said):
        judge(RUN, [theirs], settings(**fields))


def test_no_column_that_is_called_like_a_channel():
    with pytest.raises(InputError, match=r"no column is called like a channel of the run \(there are x\)"):
        judge(RUN, [measured(RUN_TIME, x=(RUN_TIME, "m"))], settings())


@pytest.mark.parametrize(
    "fields",
    [
        {"standard": "iso_1"},
        {"standard": "iso_22140", "over": {"channel": "lateral_acceleration"}},
        {"shift": "far"},
        {"confidence": 1.0},
        {"signal": [{"channel": "x", "tolerance": {"gain": 2}}]},
    ],
)
def test_settings_that_mean_nothing(fields):
    with pytest.raises(InputError):
        settings(**fields)


CIRCLE = {
    "filter": "Butterworth 2, 5 Hz",
    "over": {"channel": "lateral_acceleration", "column": "ay"},
    "signal": [{"channel": "roll_angle", "column": "roll", "tolerance": {"offset": "0.02 deg", "gain": 0.01}}],
}
"""1 % of the roll angle: what a good measurement resolves, and a third of what 10 % of this bar do."""


@functools.cache
def circle(share):
    """A steady circle with the front bar at a share of its rate."""
    rate = load_vehicle("s_class", "configuration_3").front.anti_roll_bar.rate
    car = load_vehicle("s_class", "configuration_3", {"front.anti_roll_bar.rate": share * rate})
    return simulate(build(car, "handling", "ko"), SteadyCircle(duration=50, increase=0.13))


def driven(share, seed, source="driven.csv"):
    """What sensors at 50 Hz would have written of it."""
    run, random = circle(share), np.random.default_rng(seed)
    time = run.time[::20]
    across = run["lateral_acceleration"][::20] / 9.80665 + random.normal(0, 0.005, len(time))
    roll = np.degrees(run["roll_angle"][::20]) + random.normal(0, 0.05, len(time))
    return measured(time + random.uniform(-2, 2), source, ay=(across, "g"), roll=(roll, "deg"))


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("count", [1, 3])
def test_the_same_car_with_noise_is_inside_and_one_with_a_softer_bar_outside(seed, count):
    for share, inside in ((1.0, True), (0.9, False)):
        tests = [driven(share, 10 * seed + i, f"{i}.csv") for i in range(count)]
        findings = judge(circle(1.0), tests, settings(**CIRCLE))
        (found,) = findings.judgements
        assert findings.inside is inside
        assert len(found.abscissa) >= 5 and found.measured.shape == (count, len(found.abscissa))
        (row,) = rows(findings)
        assert row.cells[-1] == ("inside" if inside else "OUTSIDE")
        assert summary(findings)["channels"][0]["inside"] is inside


def test_points_may_be_given_and_must_be_reached():
    found = judge(circle(1.0), [driven(1.0, 1)], settings(**CIRCLE, at=["2 m/s²", 4], within="0.3 m/s²")).judgements[0]
    np.testing.assert_allclose(found.abscissa, [2.0, 4.0])
    with pytest.raises(InputError, match=r"validation: at: run has too few values within 0\.3 of 12"):
        judge(circle(1.0), [driven(1.0, 1)], settings(**CIRCLE, at=[12], within="0.3 m/s²"))
    with pytest.raises(InputError, match="within: is needed where there is one point only"):
        judge(circle(1.0), [driven(1.0, 1)], settings(**CIRCLE, at=[4]))


def test_the_value_at_a_point_is_that_of_a_straight_line():
    time = np.linspace(0, 10, 1001)
    run = run_of(time, {"lateral_acceleration": 0.8 * time, "roll_angle": 0.01 * time})
    theirs = measured(time, ay=(0.8 * time, "m/s²"), roll=(np.degrees(0.011 * time), "deg"))
    fields = {**CIRCLE, "filter": "", "at": [2, 4]}
    found = judge(run, [theirs], settings(**fields)).judgements[0]
    np.testing.assert_allclose(found.simulated, [0.025, 0.05])
    np.testing.assert_allclose(found.mean, [0.0275, 0.055])
    assert found.errors.of_peak == pytest.approx(100 / 11)


def test_a_hole_in_the_measured_time_is_said():
    time = RUN_TIME[(RUN_TIME < 1.5) | (RUN_TIME > 1.7)]
    theirs = measured(time, roll_angle=(0.02 * pulse(time), "rad"))
    said = dict(remarks(judge(RUN, [theirs], settings(shift="none"))))
    assert said["attention"] == "measured.csv: nothing was measured for 0.202 s after 1.499 s"
    assert said["compared"] == "0.000 s to 3.000 s of the run, 3001 values"
