"""Targets files: what a suspension shall do, what is given, and which steps hold it against a candidate."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import AfterValidator, Field, model_validator
from pydantic_core import PydanticCustomError

from evaluation.display import quantity_text
from evaluation.numbers import NUMBERS
from susp_mj.description import Description, one_of, validate, wrong
from susp_mj.elements.dampers import ratio_of
from susp_mj.errors import InputError, choices
from susp_mj.files import file_name
from susp_mj.names import AXLES
from susp_mj.plugins import load_plugins
from susp_mj.units import Damping, Length, NaturalFrequency, NonNegativeForce, PositiveLength, Quantity
from vehicles.mjcf import MODELS
from vehicles.reading import read_toml
from vehicles.vehicle import DESIGN_LOAD

from ..case import Band
from .knobs import KNOBS, REPAIRS, ratio_text

FOLDER = Path(__file__).parent.parent / "cycles"
STEPS = ("characteristics", "load range", "frequencies", "damping", "steps", "bars", "roll")
"""Steps that hold the characteristics against the targets, as findings name them; the checks follow."""
Axle = Literal["front", "rear"]
Share = Annotated[float, Quantity("", ge=0, le=1)]
PositiveAcceleration = Annotated[float, Quantity("m/s²", gt=0)]
PositiveAngle = Annotated[float, Quantity("rad", gt=0)]


def _ratio(text: str) -> str:
    try:
        return ratio_text(ratio_of(text))
    except ValueError as error:
        raise wrong(str(error)) from None


Ratio = Annotated[str, AfterValidator(_ratio)]


class Limits(Description):
    """Band of a plain number; None is open."""

    min: Annotated[float, Quantity("")] | None = None
    max: Annotated[float, Quantity("")] | None = None

    @model_validator(mode="after")
    def _in_order(self) -> Limits:
        if self.min is None and self.max is None:
            raise wrong("give 'min', 'max' or both")
        if self.min is not None and self.max is not None and self.min > self.max:
            raise wrong(f"min {self.min:g} lies above max {self.max:g}")
        return self


class Ride(Description):
    """Targets of the springs.

    Attributes:
        frequency: natural frequency [Hz] of the body on each axle in compression, in the design position.
        rebound_force: least force [N] that a spring keeps at its rebound stop.
        flat_ride: frequency of the rear axle over that of the front axle, in the design position.
        frequency_spread: largest frequency over all loads less the smallest, over that of the design position.
    """

    frequency: dict[Axle, NaturalFrequency] = Field(default_factory=dict)
    rebound_force: NonNegativeForce = 150.0
    flat_ride: Limits | None = None
    frequency_spread: Limits | None = None


class Dampers(Description):
    """Targets of the dampers, and how they are laid out.

    Attributes:
        ratio: damping ratio of the body on each axle at every load, ``D/(2 sqrt(k m))``.
        start: average damper rate up to the first zone limit [N s/m] with which a car from targets begins.
        most: largest rate [N s/m] that a repair may ask for.
        compression_to_rebound: e.g. "1:2".
        above: rate beyond the first zone limit, as a share of that below.
        above_least: but at least so much [N s/m].
    """

    ratio: Limits = Limits(min=0.2, max=0.6)
    start: Damping = 1500.0
    most: Damping = 4000.0
    compression_to_rebound: Ratio = "1:2"
    above: Share = 0.3
    above_least: Damping = 900.0


class Travel(Description):
    """Targets of the suspension travel.

    Attributes:
        steps: heights of road [m] over which no stop is hit, at every load on either axle.
        reserve: travel [m] that is left to the compression stop when a step has lifted the wheel.
        overshoot: largest overshoot of the body on a step; not asked if left out.
    """

    steps: tuple[Length, ...] = (0.01, 0.03, 0.05, 0.07)
    reserve: Annotated[float, Quantity("m", ge=0)] = 0.0
    overshoot: Share | None = None


class Roll(Description):
    """Targets of the roll.

    Attributes:
        angle: of the body against the wheels [rad] at `lateral_acceleration` [m/s²].
        front_share: of the front axle in the roll stiffness.
        tolerance: of the roll angle that comes out [rad].
        bar_share: share of the bars in the roll stiffness of an axle.
        transfer_over_weight: front axle's share of the lateral load transfer less its share of the weight.
        load: load case.
    """

    angle: PositiveAngle
    lateral_acceleration: PositiveAcceleration
    front_share: Annotated[float, Quantity("", gt=0, lt=1)]
    tolerance: PositiveAngle = 0.0044
    bar_share: Limits = Limits(max=0.75)
    transfer_over_weight: Limits | None = None
    load: str = DESIGN_LOAD


class Check(Description):
    """A manoeuvre whose numbers are held against bands.

    Attributes:
        name: in tables and files.
        manoeuvre: a table with its `kind` and parameters.
        model: topology.
        loads: load cases; all of the targets if left out.
        axles: for models of one axle.
        criteria: bands by number.
        repair: what a miss asks for, one of `REPAIRS`; without one the candidate is discarded for good.
        step: integration step [s].
    """

    name: str = Field(min_length=1, max_length=60)
    manoeuvre: dict[str, Any]
    model: str = "handling"
    loads: tuple[str, ...] | None = None
    axles: tuple[Axle, ...] | None = None
    criteria: dict[str, Band] = Field(min_length=1)
    repair: Annotated[str, one_of(REPAIRS)] | None = None
    step: Annotated[float, Quantity("s", gt=0)] | None = None

    @model_validator(mode="after")
    def _known(self) -> Check:
        if self.model not in MODELS:
            raise wrong(f"'{self.model}' unknown; {choices(MODELS, self.model)}", "model")
        for name, band in self.criteria.items():
            if name not in NUMBERS:
                raise wrong(f"'{name}' unknown; {choices(NUMBERS, name)}", "criteria")
            if band.min is None and band.max is None:
                raise wrong("give 'min', 'max' or both", f"criteria.{name}")
            band.criterion(NUMBERS[name].unit, f"criteria.{name}")
        return self


class Response(Description):
    """What is shown over the compression to rebound ratio of the dampers.

    Attributes:
        title: one phrase.
        manoeuvre, model, load, axles: as of a `Check`; of several axles the worse one counts.
        number: evaluation number.
    """

    title: str
    manoeuvre: dict[str, Any]
    number: Annotated[str, one_of(NUMBERS)]
    model: str = "handling"
    load: str = DESIGN_LOAD
    axles: tuple[Axle, ...] | None = None

    @model_validator(mode="after")
    def _known(self) -> Response:
        if self.model not in MODELS:
            raise wrong(f"'{self.model}' unknown; {choices(MODELS, self.model)}", "model")
        return self


class TradeOffs(Description):
    """Responses of the kept candidate over its dampers' compression to rebound ratio."""

    ratios: tuple[Ratio, ...] = ("1:2", "1:1", "2:1")
    response: tuple[Response, ...] = ()


class Coil(Description):
    """A helical spring of which wire and mean coil diameter [m] are given."""

    wire_diameter: PositiveLength
    coil_diameter: PositiveLength


class Piston(Description):
    """A damper of which the diameters of piston and rod [m] are given."""

    piston_diameter: PositiveLength
    rod_diameter: PositiveLength

    @model_validator(mode="after")
    def _fits(self) -> Piston:
        if self.rod_diameter >= self.piston_diameter:
            raise wrong(f"{self.rod_diameter:g} m is not allowed; it must be below the piston's", "rod_diameter")
        return self


class ByHand(Description):
    """A candidate that the user sets up.

    Attributes:
        name: in tables and files.
        characteristics: set of the vehicle file that it begins with; that of the targets if left out.
        start: "car" takes that set as it is, "targets" lays springs and dampers out from the targets.
        parent: an earlier candidate that it begins with instead.
        change: knob -> value.
        because: why, one phrase.
        repair: whether what it misses is repaired in further candidates.
        bars: whether the bars are laid out anew for it.
        through: step of the characteristics up to which it goes on although it misses an earlier one.
    """

    name: str | None = Field(default=None, min_length=1, max_length=40)
    characteristics: str | None = None
    start: Literal["car", "targets"] | None = None
    parent: str | None = None
    change: dict[str, Any] = Field(default_factory=dict)
    because: str = "set by hand"
    repair: bool = True
    bars: bool = True
    through: Annotated[str, one_of(STEPS)] | None = None

    @model_validator(mode="after")
    def _known_knobs(self) -> ByHand:
        read_knobs(self.change, "change")
        return self


class Targets(Description):
    """A targets file.

    Attributes:
        title, description: for the verdict.
        vehicle: shipped car or path of a TOML file, relative to the targets file.
        characteristics: set of the vehicle file that gives what is not laid out: stops, mounts, friction.
        start: "targets" proposes springs and dampers, "car" begins with those of the set.
        set: overrides of the vehicle by dotted path.
        loads: load cases.
        ride, dampers, travel, roll: what is asked of the characteristics; a roll that is left out is not laid out.
        check: manoeuvres, in their order.
        trade_off: what is shown beside the verdict.
        coil, piston: of springs and dampers at the component, by axle, to tell turns and oil pressures of.
        hold: knobs that no repair may change, with their values or as they come out.
        candidate: candidates set up by hand, tried in their order; without any, the first one is laid out.
        most: largest number of candidates.
        plugins: as of a case file.
    """

    title: str
    description: str = ""
    vehicle: str
    characteristics: str | None = None
    start: Literal["car", "targets"] = "targets"
    set: dict[str, Any] = Field(default_factory=dict)
    loads: tuple[str, ...] = Field(default=(DESIGN_LOAD,), min_length=1)
    ride: Ride = Ride()
    dampers: Dampers = Dampers()
    travel: Travel = Travel()
    roll: Roll | None = None
    check: tuple[Check, ...] = ()
    trade_off: TradeOffs = TradeOffs()
    coil: dict[Axle, Coil] = Field(default_factory=dict)
    piston: dict[Axle, Piston] = Field(default_factory=dict)
    hold: dict[str, Any] = Field(default_factory=dict)
    candidate: tuple[ByHand, ...] = ()
    most: int = Field(default=30, ge=1, le=1000)
    plugins: tuple[str, ...] = ()

    @model_validator(mode="after")
    def _consistent(self) -> Targets:
        read_knobs(self.hold, "hold")
        if self.start == "targets" and set(self.ride.frequency) != set(AXLES):
            raise wrong("give front and rear, or start = 'car'", "ride.frequency")
        taken = {"ride", *STEPS, *(f"step of {quantity_text(height, 'm')}" for height in self.travel.steps)}
        _different([each.name for each in self.check], taken, "check")
        _different([each.name for each in self.candidate if each.name], set(), "candidate")
        return self


def _different(names: Sequence[str], taken: set[str], key: str) -> None:
    """Refuse names that a file system or a table would take for each other."""
    seen = {file_name(name).casefold(): name for name in taken}
    for i, name in enumerate(names):
        alike = seen.get(file_name(name).casefold())
        if alike is not None:
            raise wrong(
                f"'{name}' is taken" + ("" if alike == name else f"; it is too much like '{alike}'"), f"{key}.{i}.name"
            )
        seen[file_name(name).casefold()] = name


def read_knobs(table: Mapping[str, Any], key: str) -> dict[str, float | str]:
    """Knobs and their values in SI, from a table as a file has it; True leaves a held knob as it comes out.

    Raises:
        PydanticCustomError: an unknown knob, or a value of another unit, naming what stands at `key`.
    """
    values: dict[str, float | str] = {}
    for name, value in table.items():
        if name not in KNOBS:
            raise wrong(f"unknown knob; {choices(KNOBS, name)}", f"{key}.{name}")
        knob = KNOBS[name]
        if value is True and key == "hold":
            continue
        try:
            values[name] = knob.read(value)
        except ValueError as error:
            raise wrong(str(error), f"{key}.{name}") from None
    return values


def knobs_from_texts(texts: Sequence[str]) -> dict[str, float | str]:
    """Knobs as a command line gives them, ``front.rebound_rate=32 N/mm``.

    Raises:
        InputError: no such knob, or not its unit.
    """
    table = {}
    for text in texts:
        name, equals, value = text.partition("=")
        if not equals:
            raise InputError(f"'{text}' is not allowed; write it like front.rebound_rate='32 N/mm'", key="--change")
        table[name.strip()] = value.strip()
    try:
        return read_knobs(table, "--change")
    except PydanticCustomError as error:
        raise InputError(str(error.context["text"] if error.context else error), key="--change") from None


def load_targets(name: str | Path) -> tuple[Targets, Path]:
    """Read a targets file, shipped or from a path; returns it and the file's path.

    Raises:
        InputError: file, key, value, and what is allowed.
    """
    path = Path(name)
    if path.suffix != ".toml":
        known = available_cycles()
        if str(name) not in known:
            raise InputError(f"no cycle '{name}'; {choices(known, name)}, or give a .toml file", key="targets")
        path = FOLDER / f"{name}.toml"
    tables = read_toml(path)
    load_plugins(tables.get("plugins", ()), path)
    return validate(Targets, tables, source=path.name), path


def available_cycles() -> list[str]:
    """Names of the targets files that come with susp_mj."""
    return sorted(path.stem for path in FOLDER.glob("*.toml"))
