"""Which wheels a manoeuvre acts on, chosen by station or by side and axle."""

from __future__ import annotations

from collections.abc import Sequence

from susp_mj.description import wrong
from susp_mj.errors import choices
from susp_mj.meaning import Input
from susp_mj.names import AXLES, CORNERS

WORDS = ("left", "right", *AXLES, *CORNERS)


def checked(wheels: tuple[str, ...] | None) -> tuple[str, ...] | None:
    """Refuse a word that names no wheel."""
    for i, word in enumerate(wheels or ()):
        if word not in WORDS:
            raise wrong(f"'{word}' unknown; {choices(WORDS, word)}", f"wheels.{i}")
    return wheels


def is_chosen(place: Input, wheels: Sequence[str] | None) -> bool:
    """Whether a wheel is among those named; None names all, and the only wheel of a model is always meant."""
    if wheels is None or not place.station:
        return True
    axle = "front" if place.station in ("front", "fl", "fr") else "rear"
    side = "left" if place.y > 0 else "right" if place.y < 0 else ""
    return any(word in wheels for word in (place.station, axle, side))
