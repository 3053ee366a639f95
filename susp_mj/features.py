"""What lies or stands on a road, blows across it or is to be driven on it: what pictures, plots and numbers of a run go
by.

A run keeps them as plain JSON values, `as_json`, and `features_in` reads them back.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, fields
from typing import Any

Span = tuple[float, float]
"""From and to [m], in the inertial frame."""


@dataclass(frozen=True)
class Bump:
    """A cosine bump.

    Attributes:
        x: where it lies along the road [m].
        height: [m]; negative is a dip.
        y: where it lies across the road [m]; None is the whole width.
    """

    x: Span
    height: float
    y: Span | None = None


@dataclass(frozen=True)
class Roughness:
    """A random road of ISO 8608.

    Attributes:
        x: where it lies along the road [m].
        road_class: A to H.
    """

    x: Span
    road_class: str


@dataclass(frozen=True)
class CrossSlope:
    """A road that leans.

    Attributes:
        x: where it comes to lean; it leans from there on [m].
        slope: rise per metre to the left.
    """

    x: Span
    slope: float


@dataclass(frozen=True)
class Patch:
    """Rectangle of the road with a friction of its own, as a factor on what the tyre was measured with.

    Attributes:
        x, y: where it lies [m].
        friction: factor, 1 for the dry road of the tyre's measurement.
    """

    x: Span
    y: Span
    friction: float


@dataclass(frozen=True)
class Gust:
    """A zone of wind from the side.

    Attributes:
        x: where it lies along the road [m].
        wind: speed [m/s], positive to the left: it blows from the right.
    """

    x: Span
    wind: float


@dataclass(frozen=True)
class Lane:
    """A lane between cones.

    Attributes:
        x, y: its limits [m].
    """

    x: Span
    y: Span

    @property
    def centre(self) -> float:
        """Lateral position of its middle [m]."""
        return (self.y[0] + self.y[1]) / 2


@dataclass(frozen=True)
class Cones:
    """Cones, and the lanes that they bound.

    Attributes:
        points: (x, y) of their centres [m].
        radius: of a cone's base [m].
        lanes: in the order in which they are driven.
    """

    points: tuple[tuple[float, float], ...]
    radius: float
    lanes: tuple[Lane, ...] = ()


@dataclass(frozen=True)
class Course:
    """Path that a driver is to follow, as a table.

    Attributes:
        x, y: places on it [m].
    """

    x: tuple[float, ...]
    y: tuple[float, ...]


@dataclass(frozen=True)
class Circle:
    """Circle that a driver is to follow; it begins at x = 0, tangent to the x axis.

    Attributes:
        radius: [m], positive to the left.
    """

    radius: float


Feature = Bump | Roughness | CrossSlope | Patch | Gust | Cones | Course | Circle
FEATURES: dict[str, type[Feature]] = {
    "bump": Bump,
    "random": Roughness,
    "cross_slope": CrossSlope,
    "patch": Patch,
    "gust": Gust,
    "cones": Cones,
    "path": Course,
    "circle": Circle,
}
"""Kind in the file of a run -> feature."""


def as_json(features: Iterable[Feature]) -> list[dict[str, Any]]:
    """Features as plain JSON values, each with its `kind`."""
    kinds = {feature: kind for kind, feature in FEATURES.items()}
    return [{"kind": kinds[type(feature)], **_listed(asdict(feature))} for feature in features]


def features_in(meta: Mapping[str, Any]) -> tuple[Feature, ...]:
    """Features of the road that a run's `meta` tells of; what this version does not know is left out."""
    written = (meta.get("road") or {}).get("features", ())
    return tuple(_feature(each) for each in written if each.get("kind") in FEATURES)


def _feature(written: Mapping[str, Any]) -> Feature:
    """One feature; runs written before there were circles have them as a path with a radius."""
    kind = "circle" if "radius" in written and written["kind"] == "path" else written["kind"]
    feature = FEATURES[kind]
    values = {each.name: _frozen(written[each.name]) for each in fields(feature) if each.name in written}
    if "lanes" in values:
        values["lanes"] = tuple(Lane(_frozen(lane["x"]), _frozen(lane["y"])) for lane in written["lanes"])
    return feature(**values)


def _listed(value: Any) -> Any:
    """Tuples as lists, all the way down."""
    if isinstance(value, dict):
        return {key: _listed(each) for key, each in value.items()}
    return [_listed(each) for each in value] if isinstance(value, tuple | list) else value


def _frozen(value: Any) -> Any:
    """Lists as tuples, all the way down."""
    return tuple(_frozen(each) for each in value) if isinstance(value, list | tuple) else value
