"""A configuration to show, and what a picture reads off its run."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from susp_mj.features import Circle, Course, Feature, features_in
from susp_mj.names import channel_name
from susp_mj.run import Run

from ..numbers.ride import CONTACT_LOST


@dataclass(frozen=True)
class Clip:
    """Label and run of one configuration."""

    label: str
    run: Run


def stations_of(run: Run) -> list[str]:
    """Stations of the wheels in the car's order; an empty name for the only wheel of a quarter car."""
    return list(run.stations("wheel_load"))


def features_of(run: Run) -> tuple[Feature, ...]:
    """What the road of a run shows; the circle that a driver is to keep, too."""
    features, radius = features_in(run.meta), run.meta.get("manoeuvre", {}).get("radius")
    followed = any(isinstance(feature, Course | Circle) for feature in features)
    if "path_deviation" in run and isinstance(radius, int | float) and not followed:
        return (*features, Circle(float(radius)))
    return features


def at(run: Run, quantity: str, time: float, default: float | None = None) -> float:
    """Value of a channel at a time [s], linear between the records; `default`, if given, where the run has no such
    channel."""
    if default is not None and quantity not in run:
        return default
    return float(np.interp(time, run.time, run[quantity]))


def wheel_height(station: str, run: Run) -> str:
    """Channel that says how high a wheel is: its own, or the road's for a massless wheel, which stands on it."""
    name = channel_name(station, "wheel_displacement")
    return name if name in run else channel_name(station, "road_height")


def speed_of(run: Run) -> float:
    """Driving speed [m/s]; 0 on a test rig."""
    speed = run.meta.get("manoeuvre", {}).get("speed")
    return float(speed) if isinstance(speed, (int, float)) else 0.0


def slope_at(run: Run, station: str, time: float) -> float:
    """Slope of the road under a wheel, rising forwards positive; 0 on a test rig."""
    road, speed = channel_name(station, "road_height"), speed_of(run)
    if speed <= 0:
        return 0.0
    return (at(run, road, time + run.step) - at(run, road, time - run.step)) / (2 * run.step * speed)


def tyre_deflection(run: Run, station: str = "") -> float:
    """How far the tyre is pressed in in the design position [m], from the slope of wheel load over deflection; 0 for a
    rigid wheel."""
    height = wheel_height(station, run)
    if not height.endswith("wheel_displacement"):
        return 0.0
    load, squeeze = run[channel_name(station, "wheel_load")], run[channel_name(station, "road_height")] - run[height]
    held = load > CONTACT_LOST
    spread = squeeze[held] - squeeze[0]
    rate = float(spread @ (load[held] - load[0])) / max(float(spread @ spread), 1e-12)
    return float(np.clip(load[0] / rate - squeeze[0], 0.0, 0.06)) if rate > 0 else 0.0
