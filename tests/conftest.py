"""Shared settings of the tests: reproducible examples, the vehicle data that several files use."""

from __future__ import annotations

import hypothesis
import pytest

hypothesis.settings.register_profile("physics", deadline=None, derandomize=True, max_examples=40, database=None)
hypothesis.settings.load_profile("physics")

VEHICLE = """\
title = "Car of the tests"
[loads.ko]
corner_mass = { rear = 400.0 }
[loads.heavy]
corner_mass = { rear = "460 kg" }
[rear]
unsprung_mass = 40.0
friction = { force = 120.0 }
tyre = { kind = "spring", rate = "180 N/mm" }
[rear.spring]
kind = "linear"
rate = "25 N/mm"
stops = { rebound = "-90 mm", compression = "80 mm", rate = 2e6 }
[rear.damper]
kind = "zoned"
rates = [2400.0, 800.0]
limits = [0.15]
ratio = "1:2"
friction = 30.0
mount = { rate = 350000.0 }
[sources]
"loads" = "estimated: a test"
"rear" = "estimated: a test"
"""


@pytest.fixture
def vehicle_file(tmp_path):
    """Path of a complete vehicle file that a test may change."""
    path = tmp_path / "car.toml"
    path.write_text(VEHICLE)
    return path
