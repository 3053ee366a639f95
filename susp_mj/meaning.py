"""What the numbers of an MJCF file stand for: inputs, outputs, limits; kept in the file as one custom text."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field

from .names import channel_name


@dataclass(frozen=True)
class Input:
    """Something a manoeuvre can drive.

    Attributes:
        quantity: what it is, e.g. ``road_height``; a key of `names.QUANTITIES`.
        station: where, e.g. ``fl``; empty for the only wheel.
        x, y: position [m] in the vehicle frame, x measured from the front axle (rear axle negative).
        entries: (actuator, factor) pairs; the actuator's deflection gets factor times the input.
        axle: ``front`` or ``rear`` of a wheel's, also where the station does not say so.
    """

    quantity: str
    station: str
    x: float
    y: float
    entries: tuple[tuple[str, float], ...]
    axle: str = ""

    @property
    def on_tyre(self) -> bool:
        """Whether a tyre stands between the road and the wheel; without one the wheel follows the road."""
        return any(actuator == channel_name(self.station, "tyre") for actuator, _ in self.entries)


@dataclass(frozen=True)
class Output:
    """A channel as a weighted sum of what MuJoCo computes.

    Attributes:
        quantity, station: as in `Channel`.
        terms: (source, name, factor); the source is ``qpos``, ``qvel``, ``qacc`` (name: a joint), ``actuator_force``
            (an actuator), ``input`` or ``input_rate`` (the channel name of an input), ``signal`` (what the compiled car
            writes, a name in `handling.block.SIGNALS`).
    """

    quantity: str
    station: str
    terms: tuple[tuple[str, str, float], ...]


@dataclass(frozen=True)
class Travel:
    """Suspension travel of a station between its stops [m], and the file keys that an error about it should name."""

    station: str
    rebound: float
    compression: float
    key: str = ""


@dataclass(frozen=True)
class TimeConstant:
    """A time constant [s] that the step must not exceed by much, and the value in the vehicle file that causes it.

    The time constant is proportional to ``value ** (-1/power)``.
    """

    seconds: float
    value: float
    unit: str
    key: str
    power: float = 1.0


@dataclass(frozen=True)
class Meaning:
    """What the numbers of an MJCF file stand for.

    Attributes:
        model: name of the topology, e.g. ``quarter_2dof``.
        vehicle, title, source: name, title and file of the vehicle.
        load: name of the load case.
        inputs, outputs, travels, time_constants: see their classes.
        driving: whether it is a car that drives freely, to be trimmed to straight running before a run.
    """

    model: str
    vehicle: str
    title: str
    source: str
    load: str
    inputs: tuple[Input, ...]
    outputs: tuple[Output, ...]
    travels: tuple[Travel, ...] = ()
    time_constants: tuple[TimeConstant, ...] = ()
    facts: Mapping[str, float] = field(default_factory=dict)
    driving: bool = False

    def to_json(self) -> str:
        """The meaning as one line of JSON."""
        return json.dumps(self, default=vars, separators=(",", ":"))

    @classmethod
    def from_json(cls, text: str) -> Meaning:
        """Inverse of `to_json`."""
        data = json.loads(text)
        data["inputs"] = tuple(Input(**{**i, "entries": tuple(map(tuple, i["entries"]))}) for i in data["inputs"])
        data["outputs"] = tuple(Output(**{**o, "terms": tuple(map(tuple, o["terms"]))}) for o in data["outputs"])
        data["travels"] = tuple(Travel(**t) for t in data["travels"])
        data["time_constants"] = tuple(TimeConstant(**t) for t in data["time_constants"])
        return cls(**data)
