"""A configuration to show, and what a picture reads off its run."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from susp_mj.run import Run

from ..ride import CONTACT_LOST


@dataclass(frozen=True)
class Clip:
    """Label and run of one configuration."""

    label: str
    run: Run


def at(run: Run, quantity: str, time: float) -> float:
    """Value of a channel at a time [s], linear between the records."""
    return float(np.interp(time, run.time, run[quantity]))


def speed_of(run: Run) -> float:
    """Driving speed [m/s]; 0 on a test rig."""
    return float(run.meta.get("manoeuvre", {}).get("speed", 0.0))


def tyre_deflection(run: Run) -> float:
    """How far the tyre is pressed in by the static load [m], from the slope of wheel load over deflection; 0 for a rigid wheel."""
    if "wheel_displacement" not in run:
        return 0.0
    load, squeeze = run["wheel_load"], run["road_height"] - run["wheel_displacement"]
    held = load > CONTACT_LOST
    spread = squeeze[held] - squeeze[0]
    rate = float(spread @ (load[held] - load[0])) / max(float(spread @ spread), 1e-12)
    return float(np.clip(load[0] / rate, 0.0, 0.05)) if rate > 0 else 0.0
