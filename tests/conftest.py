"""Shared settings of the tests: reproducible examples, the vehicle data that several files use."""

from __future__ import annotations

import hypothesis
import pytest

from .builders.cars import QUARTER_CAR_FILE

hypothesis.settings.register_profile("physics", deadline=None, derandomize=True, max_examples=40, database=None)
hypothesis.settings.load_profile("physics")


@pytest.fixture
def vehicle_file(tmp_path):
    """Path of a complete vehicle file that a test may change."""
    path = tmp_path / "car.toml"
    path.write_text(QUARTER_CAR_FILE)
    return path
