"""Table of roll and wheel lift of several configurations side by side, as text."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from susp_mj.run import Run

from .compare import Comparison
from .display import quantity_text
from .numbers import NUMBERS
from .numbers.runs import drives, is_a
from .numbers.wheel_lift import lifts

ROWS = {
    "lateral_acceleration_max": "largest lateral acceleration",
    "roll_angle_at_4": "roll at 4 m/s²",
    "roll_angle_at_7": "roll at 7 m/s²",
    "suspension_roll_at_4": "of the suspension, at 4 m/s²",
    "suspension_roll_at_7": "of the suspension, at 7 m/s²",
    "roll_angle_max": "largest roll",
    "inner_wheel_load_front": "least load of the inner front wheel",
    "inner_wheel_load_rear": "least load of the inner rear wheel",
    "travel_left_rebound_front": "rebound travel left, front",
    "travel_left_rebound_rear": "rebound travel left, rear",
}
"""Number -> words of the rows above the one that says what lifts."""
LIFTING = "wheels that lift"
_TURNS = 4.0


@dataclass(frozen=True)
class TurningTable:
    """A column of texts for each configuration.

    Attributes:
        names: of the configurations.
        rows: word of the row, then a text for each configuration.
    """

    names: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]


def turning_table(comparison: Comparison) -> TurningTable | None:
    """Roll, inner wheel loads, travel left and which wheel lifts, by configuration.

    None unless every configuration drives freely and one of them turns with at least 4 m/s², without braking straight
    on.
    """
    runs = [each.run for each in comparison.configurations]
    if not all(drives(run) for run in runs) or not any(_turns(run) for run in runs):
        return None
    rows = []
    for name, words in ROWS.items():
        found = [NUMBERS[name](run) for run in runs]
        if any(each.applies for each in found):
            rows.append((words, *(quantity_text(each.value, each.unit) for each in found)))
    rows.append((LIFTING, *(lifting(run) for run in runs)))
    return TurningTable(tuple(each.name for each in comparison.configurations), tuple(rows))


def _turns(run: Run) -> bool:
    """Whether a car turns hard, without braking or accelerating straight on."""
    straight = is_a(run, "braking", "acceleration") and not is_a(run, "turn")
    return not straight and float(np.abs(run["lateral_acceleration"]).max()) >= _TURNS


def lifting(run: Run) -> str:
    """Which wheels lift, when, at which lateral acceleration and for how long, in words."""
    found = lifts(run)
    if not found:
        return "none"
    return "; ".join(
        f"{each.station} at {each.time:.2f} s, {each.acceleration:.1f} m/s², for {each.lasts:.2f} s" for each in found
    )
