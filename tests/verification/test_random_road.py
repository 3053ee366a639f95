"""The random road has the spectrum, coherence and delay it claims, and a linear quarter car answers it as white
noise."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import coherence, welch

from manoeuvres import RandomRoad
from susp_mj import simulate
from susp_mj.meaning import Input
from susp_mj.roads import ROAD_CLASSES, RandomTracks
from vehicles.mjcf import build

from ..builders.cars import LinearQuarterCar

TABLE = {"A": 16e-6, "B": 64e-6, "C": 256e-6, "D": 1024e-6, "E": 4096e-6, "F": 16384e-6, "G": 65536e-6, "H": 262144e-6}
"""ISO 8608: geometric mean of Gd(n0) [m³], n0 = 0.1 cycles/m."""
PER_NOISE = {"acceleration": 1155.9847603127964, "travel": 0.2179166666666771, "load": 653761384.0521232}
"""Variance per white-noise strength W of the quarter car with c = 1200 N s/m: Lyapunov equation."""


def test_road_classes_are_those_of_the_standard():
    assert pytest.approx(TABLE, rel=1e-12) == ROAD_CLASSES


def test_spectrum():
    """One-sided displacement spectrum within 3 % over two decades, averaged over third octaves."""
    tracks = RandomTracks("C", 20_000.0, 200.0, 0.2, 0.0, seed=3)
    spacing = 0.05
    height, _ = tracks.at(np.arange(0.0, 20_000.0, spacing), 0.7)
    number, density = welch(height, 1 / spacing, nperseg=2**14, detrend="linear")
    for centre in np.geomspace(0.05, 3.0, 12):
        inside = (number > centre / 1.12) & (number < centre * 1.12)
        expected = TABLE["C"] * (number[inside] / 0.1) ** -2.0
        assert density[inside].mean() == pytest.approx(expected.mean(), rel=0.15)
    inside = (number > 0.05) & (number < 3.0)
    assert np.mean(density[inside] / (TABLE["C"] * (number[inside] / 0.1) ** -2.0)) == pytest.approx(1.0, rel=0.03)


def test_band_rms():
    """sqrt(Gd(n0) n0² (1/n1 - 1/n2)) for class C between 20 m and 0.1 m: 7.14 mm."""
    tracks = RandomTracks("C", 20_000.0, 20.0, 0.1, 0.0, seed=1)
    height, _ = tracks.at(np.arange(0.0, 20_000.0, 0.05), 0.0)
    assert height.std() == pytest.approx(0.007138, rel=0.02)


def test_left_and_right_agree_at_long_waves_only():
    tracks = RandomTracks("C", 40_000.0, 100.0, 0.2, 0.0, seed=5)
    distance = np.arange(0.0, 40_000.0, 0.1)
    left, right = (tracks.at(distance, y)[0] for y in (0.7, -0.7))
    number, found = coherence(left, right, 10.0, nperseg=2**12)
    for wave in (0.02, 0.1, 0.5, 2.0):
        near = np.abs(number - wave) < 0.15 * wave
        assert found[near].mean() == pytest.approx(tracks.shared(np.array([wave]), 0.7)[0] ** 2, abs=0.06)
    assert tracks.shared(np.array([0.01]), 0.7)[0] > 0.98
    assert tracks.shared(np.array([5.0]), 0.7)[0] < 0.1


def test_rear_follows_front_and_seed_makes_the_road():
    road = RandomRoad(speed=20.0, duration=5.0, seed=7)
    time = np.arange(5001) * 1e-3
    front, _ = road.drive(Input("road_height", "fl", 0.0, 0.7, ()), time)
    rear, _ = road.drive(Input("road_height", "rl", -3.0, 0.7, ()), time)
    np.testing.assert_allclose(rear[150:], front[:-150], atol=1e-12)
    assert not rear[:150].any()
    again, _ = RandomRoad(speed=20.0, duration=5.0, seed=7).drive(Input("road_height", "fl", 0.0, 0.7, ()), time)
    other, _ = RandomRoad(speed=20.0, duration=5.0, seed=8).drive(Input("road_height", "fl", 0.0, 0.7, ()), time)
    np.testing.assert_array_equal(front, again)
    assert np.abs(front - other).max() > 1e-3


def test_white_noise_variances_of_the_quarter_car():
    """Variances on a long random road within 3 % of the closed form; W = 2 pi² n0² Gd(n0) v."""
    plant = build(LinearQuarterCar().vehicle(), "quarter_2dof")
    speed = 20.0
    noise = 2 * np.pi**2 * 0.1**2 * TABLE["C"] * speed
    runs = [
        simulate(
            plant,
            RandomRoad(road_class="C", speed=speed, duration=800.0, longest=500.0, shortest=0.1, seed=seed),
            record_every=4,
        )
        for seed in (1, 2)
    ]
    begin = runs[0].time > 20.0
    found = {
        "acceleration": np.mean([run["body_acceleration"][begin].var() for run in runs]),
        "travel": np.mean([run["suspension_deflection"][begin].var() for run in runs]),
        "load": np.mean([run["wheel_load"][begin].var() for run in runs]),
    }
    for name, variance in found.items():
        assert variance / noise == pytest.approx(PER_NOISE[name], rel=0.03), name
