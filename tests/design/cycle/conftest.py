"""Targets files of these tests."""

from __future__ import annotations

from pathlib import Path

import pytest

from design.cycle.candidate import Layout
from design.cycle.ledger import Ledger
from design.cycle.targets import load_targets

TARGETS = """
title = "targets of the tests"
vehicle = "s_class"
characteristics = "configuration_4"
loads = ["empty", "ko", "full"]
[ride]
frequency = { front = "1.2 Hz", rear = "1.1 Hz" }
[travel]
steps = ["30 mm", "70 mm"]
[roll]
angle = "5 deg"
lateral_acceleration = "7 m/s²"
front_share = 0.6
"""
"""Of stage 1 alone: they are met by the second candidate."""


class Bench:
    """A targets file, opened, with a ledger beside it."""

    def __init__(self, folder: Path, text: str) -> None:
        self.path = folder / "targets.toml"
        self.path.write_text(text, encoding="utf-8")
        targets, path = load_targets(self.path)
        self.layout = Layout.open(targets, path)
        self.ledger = Ledger(folder / "runs.jsonl", path, workers=2)


@pytest.fixture
def bench(tmp_path):
    """Opens targets files."""

    def of(text: str = TARGETS) -> Bench:
        return Bench(tmp_path, text)

    return of
