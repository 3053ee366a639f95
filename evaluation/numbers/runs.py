"""Kinds of runs that questions are for, and what is known of a run: its manoeuvre's parameters, facts of its car."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from susp_mj.run import Run

from .number import Runs

RIG = "suspension_rig"


def kind(run: Run) -> str:
    """Name of the run's manoeuvre."""
    return str(run.meta.get("manoeuvre", {}).get("kind", ""))


def parameter(run: Run, name: str, default: Any = None) -> Any:
    """A parameter of the run's manoeuvre."""
    return run.meta.get("manoeuvre", {}).get(name, default)


def facts(run: Run) -> Mapping[str, float]:
    """Facts of the car: lengths, masses, ratios in SI."""
    return run.meta.get("facts", {})


def drives(run: Run) -> bool:
    """Whether the car of this run drives freely; an oscillation model or a car on a rig does not."""
    return "yaw_rate" in run and "speed" in run and kind(run) != RIG


def on_rig(run: Run) -> bool:
    """Whether the car stands on the kinematics rig, which holds its body."""
    return kind(run) == RIG


DRIVES = Runs(drives, "the car does not drive freely")
NOT_ON_RIG = Runs(lambda run: not on_rig(run), "the rig holds the body")


def recorded(*names: str) -> Runs:
    """Runs that have channels of these names, or of these quantities at any station."""
    return Runs(
        lambda run: all(name in run or run.stations(name) for name in names), f"the run has no {' or '.join(names)}"
    )


def known(*names: str) -> Runs:
    """Runs of cars of which these facts are known."""
    return Runs(lambda run: all(name in facts(run) for name in names), f"{' or '.join(names)} of the car is unknown")
