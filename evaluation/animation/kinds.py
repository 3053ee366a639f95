"""What runs show: one wheel, cars over a road that passes underneath, or cars that drive freely."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from susp_mj.errors import InputError
from susp_mj.names import CORNERS, channel_name
from susp_mj.run import Run

from ..numbers.runs import on_tyres
from .clip import Clip, stations_of

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
_FREE_FACTS = ("cg_x", "cg_height", "wheelbase", "track_front", "track_rear", "wheel_radius_front", "wheel_radius_rear")
"""Facts of a run without which a car that drives freely cannot be drawn."""
_FREE_WHEEL = ("wheel_load", "suspension_deflection")


@dataclass(frozen=True)
class Kind:
    """A kind of car on film.

    Attributes:
        name: of the folder with its scene and its texts.
        told: what tells it from the others.
        free: whether it drives over ground of its own: a camera follows it, a ghost can stand in its scene, and the
            whole run is shown.
        quality: in which a film is drawn whose case does not say.
    """

    name: str
    told: str
    free: bool = False
    quality: str = "fine"


QUARTER = Kind("quarter", "has one wheel")
OSCILLATION = Kind("oscillation", "has several wheels")
HANDLING = Kind("handling", "drives freely", free=True, quality="draft")


def drives_freely(run: Run) -> bool:
    """Whether a run is of a car with a place on the ground, not one over a road that passes underneath."""
    return on_tyres(run) or "position_x" in run


def kind_of(clips: Sequence[Clip]) -> Kind:
    """The kind that all of the runs are of.

    Raises:
        InputError: a run lacks channels that the picture needs, or the runs are of several kinds.
    """
    kinds = [_kind(clip) for clip in clips]
    for clip, kind in zip(clips, kinds, strict=True):
        if kind != kinds[0]:
            text = f"'{clips[0].label}' {kinds[0].told} and '{clip.label}' {kind.told}; show them in two videos"
            raise InputError(text, source="video")
    return kinds[0]


def _kind(clip: Clip) -> Kind:
    """Kind of one run, all channels and facts that its picture needs being there."""
    run, model = clip.run, clip.run.meta.get("model", "the run")
    free = drives_freely(run)
    missing = next((name for name in (_needed_when_free(run) if free else _needed(run)) if name not in run), None)
    if missing is not None:
        text = f"has no channel {missing}"
        raise InputError(
            f"'{clip.label}': {model} {text}, which a video of it needs"
            if free
            else f"'{clip.label}': only runs of oscillation and handling models can be shown; {model} {text}"
        )
    if free:
        _check_facts(clip)
        return HANDLING
    return QUARTER if stations_of(run) == [""] else OSCILLATION


def _check_facts(clip: Clip) -> None:
    facts = clip.run.meta.get("facts", {})
    for name in _FREE_FACTS:
        if not isinstance(facts.get(name), int | float):
            raise InputError(
                f"'{clip.label}': the run does not say its {name}, which a video of it needs among its facts"
            )


def _needed(run: Run) -> list[str]:
    wheels = stations_of(run) or [""]
    return [*_BODY, *(channel_name(station, quantity) for station in wheels for quantity in _WHEEL)]


def _needed_when_free(run: Run) -> list[str]:
    wheels = stations_of(run) or CORNERS
    return [*_FREE, *(channel_name(station, quantity) for station in wheels for quantity in _FREE_WHEEL)]
