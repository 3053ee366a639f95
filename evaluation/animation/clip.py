"""A configuration to show, and what a picture reads off its run."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from susp_mj.errors import InputError
from susp_mj.features import Circle, Course, Feature, features_in
from susp_mj.names import CORNERS, channel_name
from susp_mj.run import Run

from ..numbers.ride import CONTACT_LOST

_BODY = ("body_displacement", "body_acceleration")
_WHEEL = ("suspension_deflection", "wheel_load", "road_height")
_FREE = (
    "position_x",
    "position_y",
    "yaw_angle",
    "pitch_angle",
    "roll_angle",
    "body_displacement",
    "speed",
    "lateral_acceleration",
    "steering_wheel_angle",
)
FREE_FACTS = ("cg_x", "cg_height", "wheelbase", "track_front", "track_rear", "wheel_radius_front", "wheel_radius_rear")
"""Facts of a run without which a car that drives freely cannot be drawn."""
_FREE_WHEEL = ("wheel_load", "suspension_deflection")

Kind = Literal["quarter", "oscillation", "handling"]
"""One wheel; a car over a road that passes underneath; a car that drives freely."""


@dataclass(frozen=True)
class Clip:
    """Label and run of one configuration."""

    label: str
    run: Run


def kind_of(clips: Sequence[Clip]) -> Kind:
    """Whether runs show one wheel each, cars over a road that passes underneath, or cars that drive freely.

    Raises:
        InputError: a run lacks channels that the picture needs, or the runs are of several kinds.
    """
    kinds: list[Kind] = [_kind(clip) for clip in clips]
    for clip, kind in zip(clips, kinds, strict=True):
        if kind != kinds[0]:
            pair: dict[str, str] = {kinds[0]: clips[0].label, kind: clip.label}
            if "handling" in pair:
                free = pair.pop("handling")
                text = f"'{free}' drives freely and '{next(iter(pair.values()))}' does not"
            else:
                text = f"'{pair['quarter']}' has one wheel and '{pair['oscillation']}' several"
            raise InputError(f"{text}; show them in two videos", source="video")
    return kinds[0]


def _kind(clip: Clip) -> Kind:
    """Kind of one run, all channels that its picture needs being there."""
    run = clip.run
    model = run.meta.get("model", "the run")
    if model == "handling" or "position_x" in run:
        missing = [name for name in needed_when_free(run) if name not in run]
        if missing:
            raise InputError(f"'{clip.label}': {model} has no channel {missing[0]}, which a video of it needs")
        facts = run.meta.get("facts", {})
        unknown = [name for name in FREE_FACTS if not isinstance(facts.get(name), (int, float))]
        if unknown:
            raise InputError(
                f"'{clip.label}': the run does not say its {unknown[0]}, which a video of it needs among its facts"
            )
        return "handling"
    needed = [*_BODY, *(channel_name(station, quantity) for station in stations_of(run) or [""] for quantity in _WHEEL)]
    missing = [name for name in needed if name not in run]
    if missing:
        raise InputError(
            f"'{clip.label}': only runs of oscillation and handling models can be shown; {model} has no channel "
            f"{missing[0]}"
        )
    return "quarter" if stations_of(run) == [""] else "oscillation"


def needed_when_free(run: Run) -> list[str]:
    """Channels that the picture of a car that drives freely needs."""
    wheels = [channel_name(station, quantity) for station in stations_of(run) or CORNERS for quantity in _FREE_WHEEL]
    return [*_FREE, *wheels]


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
