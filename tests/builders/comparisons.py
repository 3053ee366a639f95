"""A comparison on real runs of the quarter car, for the tests of plots and report."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from evaluation.characteristics import characteristic
from evaluation.compare import Claim, Comparison, Configuration
from evaluation.numbers import Criterion, evaluate, frequency, ride
from manoeuvres import Bump
from susp_mj import simulate
from susp_mj.manoeuvre import Manoeuvre
from susp_mj.names import CORNERS, channel_name
from susp_mj.run import Run
from vehicles import load_vehicle
from vehicles.mjcf import build

from .runs import run_of

SETS = {"linear": "linear", "nonlinear": "non-linear", "soft_linear": "linear, soft"}


def compare(
    manoeuvre: Manoeuvre | None = None,
    *,
    title: str = "Quarter car over a bump",
    criteria: Mapping[str, Criterion] | None = None,
    claims: Sequence[Claim] = (),
    names: Mapping[str, str] = SETS,
) -> Comparison:
    """The three sets of chapter 3 under one manoeuvre."""
    manoeuvre = manoeuvre or Bump(duration=1.5)
    numbers = [each.name for each in (frequency if manoeuvre.road_sweep() else ride).NUMBERS]
    configurations = []
    for key, name in names.items():
        car = load_vehicle("chapter3", key)
        run = simulate(build(car, "quarter_2dof"), manoeuvre)
        curves = [characteristic("rear axle", car.axle("rear"))]
        configurations.append(Configuration(name, car.title, run, evaluate(run, numbers), curves))
    return Comparison(title, "Three suspensions.", configurations, criteria or {}, claims)


def on_four_wheels(run: Run) -> Run:
    """The same run as if a car with four wheels had recorded it; the rear comes 0.1 s later."""
    channels = {name: each.values for name, each in run.channels.items() if each.quantity.startswith("body")}
    for each in run.channels.values():
        if not each.quantity.startswith("body"):
            for corner in CORNERS:
                values = np.roll(each.values, 100 if corner.startswith("r") else 0)
                channels[channel_name(corner, each.quantity)] = values
    return run_of(run.time, channels, {**run.meta, "travel": {corner: run.meta["travel"][""] for corner in CORNERS}})
