"""Attitude, load transfer and anti-roll bars: definitions on synthetic runs, the thesis' numbers, the words for no
bar."""

from __future__ import annotations

import math

import numpy as np
import pytest

from evaluation.numbers import NUMBERS
from manoeuvres import LateralForce, RollAngle
from susp_mj import roll, simulate
from vehicles import load_vehicle
from vehicles.mjcf import build

from ..builders.runs import run_of

TIME = np.linspace(0.0, 1.0, 101)


def test_thesis_bars_close_the_thesis_numbers():
    """1913 kg, 0.5459 m, 7 m/s², 5°, 60:40 with springs of 26 000.6 and 19 804.1 N/m: 25 286 and 14 387 N/m."""
    stiffness = roll.required_roll_stiffness(1913 * 0.5459, 7.0, math.radians(5.0), gravity=0.0)
    assert roll.bar_rate(stiffness, 0.6, 1.4, 26000.6) == pytest.approx(25286, rel=1e-4)
    assert roll.bar_rate(stiffness, 0.4, 1.4, 19804.1) == pytest.approx(14387, rel=1e-4)


@pytest.mark.parametrize(("name", "front", "rear"), [("configuration_3", 25286, 14387), ("configuration_4", 7118, 0)])
def test_bars_of_appendix_9_from_the_rig(name, front, rear):
    """The rebuilt springs on the roll rig ask for the bars that the thesis found, within 1.5 %."""
    run = simulate(build(load_vehicle("s_class", name), "full_3dof", rig="roll"), RollAngle())
    assert NUMBERS["anti_roll_bar_front"](run).value == pytest.approx(front, rel=0.015)
    assert NUMBERS["anti_roll_bar_rear"](run).value == pytest.approx(rear, rel=0.015)


def test_no_bar_is_said_in_words():
    run = simulate(
        build(load_vehicle("s_class", "configuration_4"), "full_3dof", rig="roll"), RollAngle(front_share=0.9)
    )
    number = NUMBERS["anti_roll_bar_rear"](run)
    assert number.value == 0.0
    assert "springs alone exceed the target by" in number.note


def test_the_bars_give_the_required_roll():
    """With those bars the body rolls 5° at 7 m/s², as required."""
    for name in ("configuration_3", "configuration_4"):
        run = simulate(build(load_vehicle("s_class", name), "full_3dof"), LateralForce(acceleration=7.0, duration=5.0))
        assert math.degrees(NUMBERS["roll_angle_final"](run).value) == pytest.approx(5.0, abs=0.05)
        assert NUMBERS["roll_gradient"](run).value == pytest.approx(
            NUMBERS["roll_angle_final"](run).value / 7.0, rel=1e-9
        )


def test_numbers_on_a_made_up_run():
    ramp = TIME
    channels = {
        "roll_angle": 0.01 - 0.05 * ramp,
        "pitch_angle": 0.02 * np.sin(2 * np.pi * ramp),
        "lateral_acceleration": -4.0 * ramp,
        "fl_wheel_load": 5000 + 900 * ramp,
        "fr_wheel_load": 5000 - 900 * ramp,
        "rl_wheel_load": 4000 + 300 * ramp,
        "rr_wheel_load": 4000 - 300 * ramp,
    }
    run = run_of(TIME, channels)
    assert NUMBERS["roll_angle_max"](run).value == pytest.approx(0.05)
    assert NUMBERS["roll_angle_max"](run).note.startswith("right side up")
    assert NUMBERS["roll_angle_final"](run).value == pytest.approx(-0.05)
    assert NUMBERS["roll_gradient"](run).value == pytest.approx(0.05 / 4)
    assert NUMBERS["pitch_angle_max"](run).value == pytest.approx(0.02)
    assert NUMBERS["pitch_angle_min"](run).value == pytest.approx(-0.02)
    assert NUMBERS["load_share_front"](run).value == pytest.approx(10 / 18)
    assert NUMBERS["load_transfer_front"](run).value == pytest.approx(-900)
    assert NUMBERS["load_transfer_rear"](run).value == pytest.approx(-300)
    assert NUMBERS["load_transfer_share"](run).value == pytest.approx(0.75)
    assert not NUMBERS["anti_roll_bar_front"](run).applies


def test_a_quarter_car_has_no_attitude():
    run = run_of(TIME, {"wheel_load": 5000.0})
    for number in (
        NUMBERS["roll_angle_max"],
        NUMBERS["pitch_angle_max"],
        NUMBERS["load_transfer_front"],
        NUMBERS["load_share_front"],
    ):
        found = number(run)
        assert found.value is None
        assert not found.applies
