"""How a video is drawn: from where, how the configurations share the frame, and how fine."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass

from susp_mj.errors import InputError, choices

from .cameras import CAMERAS
from .clip import Clip
from .kinds import kind_of

LAYOUTS = {
    "side_by_side": "a scene for each configuration",
    "ghost": "one scene, all but the first configuration translucent",
}
QUALITIES = {
    "draft": "coarse shapes and jagged edges, twice as fast",
    "fine": "fine shapes and smooth edges",
}
MOST_GHOSTS = 2
"""Configurations that one scene can show."""


@dataclass(frozen=True)
class Style:
    """How a video is drawn.

    Attributes:
        camera: one of `CAMERAS`; None chooses what suits the manoeuvre.
        layout: one of `LAYOUTS`.
        quality: one of `QUALITIES`.

    Raises:
        InputError: an unknown name.
    """

    camera: str | None = None
    layout: str = "side_by_side"
    quality: str = "fine"

    def __post_init__(self) -> None:
        offered: dict[str, tuple[str | None, Collection[str]]] = {
            "camera": (self.camera, CAMERAS),
            "layout": (self.layout, LAYOUTS),
            "quality": (self.quality, QUALITIES),
        }
        for key, (name, names) in offered.items():
            if name is not None and name not in names:
                raise _refused(key, f"'{name}' unknown; {choices(names, name)}")

    @property
    def ghost(self) -> bool:
        """Whether all configurations stand in one scene."""
        return self.layout == "ghost"

    @property
    def fine(self) -> bool:
        """Whether shapes are fine and edges smoothed."""
        return self.quality == "fine"

    @property
    def samples(self) -> int:
        """Samples of every pixel, 0 for one."""
        return 4 if self.fine else 0

    def check(self, clips: Sequence[Clip]) -> None:
        """Whether these clips can be drawn so.

        Raises:
            InputError: something that only runs of a car that drives freely can have.
        """
        self.suits(kind_of(clips).free, len(clips))

    def suits(self, free: bool, configurations: int) -> None:
        """Whether so many cars, that drive freely or not, can be drawn so.

        Raises:
            InputError: as `check`.
        """
        if not free:
            if self.camera is not None:
                raise _refused(
                    "camera", f"'{self.camera}' is for runs of model handling; other cars are drawn from one place"
                )
            if self.ghost:
                raise _refused(
                    "layout", f"'{self.layout}' is for runs of model handling; other cars stand side by side"
                )
        if self.ghost and configurations > MOST_GHOSTS:
            raise _refused("layout", f"'{self.layout}' shows up to {MOST_GHOSTS} configurations, not {configurations}")


def _refused(key: str, message: str) -> InputError:
    return InputError(message, key=key, source="video")


@dataclass(frozen=True)
class Shot:
    """What one scene shows.

    Attributes:
        clips: the configurations in it, the first one solid.
        colours: theirs, ``#rrggbb``.
        size: (width, height) of the picture [px].
        style: see `Style`.
        leader: the video's first configuration, after which cameras are chosen.
        highest_load: of all wheels of all configurations of the video [N].
    """

    clips: tuple[Clip, ...]
    colours: tuple[str, ...]
    size: tuple[int, int]
    style: Style
    leader: Clip
    highest_load: float
