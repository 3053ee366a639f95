"""From where a car that drives freely can be seen: another camera is another entry of `CAMERAS`, or registered."""

from __future__ import annotations

import math
from dataclasses import dataclass
from numbers import Real

from susp_mj.errors import InputError


@dataclass(frozen=True)
class Camera:
    """A place about the car, which turns with its course, but does not roll, pitch or heave with the body.

    Attributes:
        shows: from where, for a list of choices.
        bearing: direction from the car to the camera, from straight ahead, to the inside of the bend [deg].
        drop: how far the camera looks down [deg].
        wide, tall: of what must fit into the picture [m].
        height: of the point looked at above the road [m].
        ahead: of the point looked at before the middle of the car [m].

    Raises:
        InputError: naming the value and what is allowed.
    """

    shows: str
    bearing: float
    drop: float
    wide: float
    tall: float
    height: float
    ahead: float = 0.0

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            if name != "shows" and not (isinstance(value, Real) and math.isfinite(value)):
                raise InputError(f"{value!r} is not allowed; it must be a finite number", key=name, source="camera")
        for name in ("wide", "tall"):
            value = getattr(self, name)
            if value <= 0:
                raise InputError(f"{value:g} m is not allowed; it must be greater than 0", key=name, source="camera")


CAMERAS: dict[str, Camera] = {
    "chase": Camera("from behind", bearing=165.0, drop=11.0, wide=4.9, tall=3.7, height=0.8, ahead=0.3),
    "front": Camera("from ahead on the inside of the bend", bearing=27.0, drop=6.5, wide=5.6, tall=3.3, height=1.0),
    "side": Camera("from beside", bearing=90.0, drop=4.5, wide=7.2, tall=3.5, height=1.0),
}


def register(name: str, camera: Camera) -> None:
    """Add a camera of your own; from then on case files and command lines may name it.

    Raises:
        InputError: it is no `Camera`, or the name is taken.
    """
    if not isinstance(camera, Camera):
        raise InputError(f"camera '{name}' is a {type(camera).__name__}, not a Camera")
    if CAMERAS.get(name, camera) != camera:
        raise InputError(f"camera '{name}' is taken")
    CAMERAS[name] = camera


def offered() -> str:
    """Every camera with what it shows: ``chase (from behind), ...``."""
    return ", ".join(f"{name} ({camera.shows})" for name, camera in CAMERAS.items())
