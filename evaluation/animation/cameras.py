"""From where a car that drives freely can be seen: another camera is another entry of `CAMERAS`."""

from __future__ import annotations

from dataclasses import dataclass


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
    """

    shows: str
    bearing: float
    drop: float
    wide: float
    tall: float
    height: float
    ahead: float = 0.0


CAMERAS: dict[str, Camera] = {
    "chase": Camera("from behind", bearing=165.0, drop=11.0, wide=4.9, tall=3.7, height=0.8, ahead=0.3),
    "front": Camera("from ahead on the inside of the bend", bearing=27.0, drop=6.5, wide=5.6, tall=3.3, height=1.0),
    "side": Camera("from beside", bearing=90.0, drop=4.5, wide=7.2, tall=3.5, height=1.0),
}


def offered() -> str:
    """Every camera with what it shows: ``chase (from behind), ...``."""
    return ", ".join(f"{name} ({camera.shows})" for name, camera in CAMERAS.items())
