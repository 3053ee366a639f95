"""Random road of ISO 8608, seeded, with left-right coherence and axle delay (Zufallsstraße)."""

from __future__ import annotations

import functools
from typing import Annotated, ClassVar, Literal

import numpy as np
from pydantic import model_validator

from manoeuvres.driving import held_speed
from manoeuvres.surface import sampled
from susp_mj.character import Character
from susp_mj.description import wrong
from susp_mj.errors import InputError
from susp_mj.features import Roughness
from susp_mj.manoeuvre import Manoeuvre, ValueAndRate
from susp_mj.meaning import Input
from susp_mj.roads import ROAD_CLASSES, RandomTracks, Road
from susp_mj.units import NonNegativeLength, PositiveLength, PositiveSpeed, PositiveTime, Quantity

_LONGEST_SURFACE = 20e3  # m


class RandomRoad(Manoeuvre):
    """Two tracks of an ISO 8608 road at constant speed; the rear axle follows on the front's tracks.

    Each track has the one-sided displacement spectrum ``Gd(n) = Gd(n0) (n/n0)^-2``, n0 = 0.1 cycles/m, between the two
    wavelengths. Left and right agree at long wavelengths and lose each other towards short ones. The same seed gives
    the same road; a flat lead-in of `lead_in` metres fades into it.

    Attributes:
        road_class: A to H; the class' geometric mean roughness applies.
        speed: [m/s].
        seed: of the random phases.
        longest, shortest: wavelengths [m].
        lead_in: length over which the road fades in [m].
        track: distance of the two tracks [m] for a car that drives freely; other models have their wheels' places.

    Source: ISO 8608:2016; coherence: see `susp_mj.roads.RandomTracks`.
    """

    character: ClassVar[Character] = Character("Random road")
    german: ClassVar[str] = "zufallsstrasse"
    needs: ClassVar[tuple[str, ...]] = ("road_height",)

    kind: Literal["random_road"] = "random_road"
    duration: PositiveTime = 30.0
    road_class: str = "C"
    speed: PositiveSpeed = 80 / 3.6
    seed: int = 1
    longest: PositiveLength = 100.0
    shortest: PositiveLength = 0.1
    lead_in: NonNegativeLength = 10.0
    track: Annotated[float, Quantity("m", ge=0.1, le=10)] = 1.4

    @model_validator(mode="after")
    def _sensible(self) -> RandomRoad:
        if self.road_class not in ROAD_CLASSES:
            raise wrong(f"'{self.road_class}' is not allowed; choose {', '.join(ROAD_CLASSES)}", "road_class")
        if self.shortest >= self.longest:
            raise wrong(f"{self.shortest} m is not allowed; it must be below longest, {self.longest} m", "shortest")
        if self.seed < 0:
            raise wrong(f"{self.seed} is not allowed; it must be at least 0", "seed")
        return self

    def drive(self, place: Input, time: np.ndarray) -> ValueAndRate | None:
        if place.quantity != "road_height":
            return held_speed(place.quantity, self.speed, time)
        height, slope = self._road_tracks(float(time[-1])).at(self.speed * time + place.x, place.y)
        return height, slope * self.speed

    def road(self) -> Road:
        distance = self.speed * self.duration
        if distance > _LONGEST_SURFACE:
            raise InputError(
                f"is too long; a car that drives freely has {_LONGEST_SURFACE / 1e3:g} km",
                key="duration",
                source="manoeuvre",
            )
        tracks, half = self._road_tracks(self.duration), self.track / 2
        shown = (Roughness((0.0, distance), self.road_class),)
        return sampled(lambda x, y: tracks.at(x, y)[0], 0.0, distance + 10.0, (-half, half), shown)

    def _road_tracks(self, duration: float) -> RandomTracks:
        if self.speed * duration > 1e6 or self.longest > 1e5:
            raise InputError(
                "is too long; allowed are 1000 km of road and waves of 100 km", key="speed", source="manoeuvre"
            )
        length = self.speed * duration + self.longest
        return _tracks(self.road_class, length, self.longest, self.shortest, self.lead_in, self.seed)


@functools.lru_cache(maxsize=4)
def _tracks(road_class: str, length: float, longest: float, shortest: float, lead_in: float, seed: int) -> RandomTracks:
    """The road itself, made once for all wheels."""
    return RandomTracks(road_class, length, longest, shortest, lead_in, seed)


if __name__ == "__main__":
    from design.cli import manoeuvre_script

    manoeuvre_script("random_road")
