"""Case files: one model, one manoeuvre, several configurations, criteria."""

from __future__ import annotations

from collections.abc import Container, Mapping
from pathlib import Path
from typing import Annotated, Any

from pydantic import AfterValidator, Field, model_validator

from evaluation.animation.cameras import CAMERAS
from evaluation.animation.style import LAYOUTS, QUALITIES, Style
from evaluation.numbers import NUMBERS, Criterion
from evaluation.validation import Validation
from manoeuvres import MANOEUVRES, find_manoeuvre
from susp_mj.description import Description, one_of, validate, wrong
from susp_mj.errors import InputError, choices
from susp_mj.files import file_name
from susp_mj.manoeuvre import Manoeuvre
from susp_mj.plugins import load_plugins
from susp_mj.units import Quantity, to_si
from vehicles.models import HANDLING, MODELS
from vehicles.reading import read_toml
from vehicles.vehicle import DESIGN_LOAD

FOLDER = Path(__file__).parent / "cases"


class Band(Description):
    """Allowed band of a number; a bound is a number in SI or a text with a unit."""

    min: float | str | None = None
    max: float | str | None = None

    def criterion(self, unit: str, key: str) -> Criterion:
        """The band in the SI `unit` of its number.

        Raises:
            PydanticCustomError: a bound in another unit, or bounds the wrong way round, naming what stands at `key`.
        """
        bounds = []
        for name, value in (("min", self.min), ("max", self.max)):
            try:
                bounds.append(None if value is None else to_si(value, "" if unit == "1" else unit))
            except ValueError as error:
                raise wrong(str(error), f"{key}.{name}") from None
        low, high = bounds
        if low is not None and high is not None and low > high:
            raise wrong(f"min {low:g} lies above max {high:g}", key)
        return Criterion(low, high)


def _printable(text: str) -> str:
    if not text.isprintable():
        raise wrong(f"{text!r} has characters that cannot be shown")
    return text


class Setting(Description):
    """One configuration of a case.

    Attributes:
        name: label in tables and plots.
        vehicle: shipped car or path of a TOML file, relative to the case file.
        characteristics: which of the vehicle's sets.
        load: load case, or several: each makes a configuration of its own, named after it. Without one, see
            `usual_load`.
        axle: for models of one axle.
        set: overrides by dotted path, as a vehicle file would have them.
    """

    name: Annotated[str, AfterValidator(_printable)] = Field(min_length=1, max_length=80)
    vehicle: str
    characteristics: str | None = None
    load: str | Annotated[tuple[str, ...], Field(min_length=1)] | None = None
    axle: str | None = None
    set: dict[str, Any] = Field(default_factory=dict)

    def single(self) -> list[Setting]:
        """This setting once for each of its load cases."""
        if self.load is None or isinstance(self.load, str):
            return [self]
        return [self.model_copy(update={"name": f"{self.name}, {load}", "load": load}) for load in self.load]


class Film(Description):
    """How a case's video is drawn; see `evaluation.animation.render.render_video`.

    Attributes:
        camera: one of `CAMERAS` for a car that drives freely; by default what suits the manoeuvre.
        layout: one of `LAYOUTS`.
        quality: one of `QUALITIES`; by default a draft of cars that drive freely, fine pictures of everything else.
        playback: seconds of the run per second of video.
    """

    camera: Annotated[str, one_of(CAMERAS)] | None = Style.camera
    layout: Annotated[str, one_of(LAYOUTS)] = Style.layout
    quality: Annotated[str, one_of(QUALITIES)] | None = None
    playback: Annotated[float, Quantity("", gt=0)] | None = None


class Case(Description):
    """A case file.

    Attributes:
        title, description: for the report.
        model: topology, a key of `vehicles.models.MODELS`.
        manoeuvre: a table with its `kind` and parameters.
        configuration: what is compared, in order.
        numbers: evaluation numbers; all that apply if empty.
        criteria: bands by number.
        step: integration step [s]; by default 1 ms or what the dampers' mounts need.
        record_every: keep every n-th step; by default one a millisecond.
        film: how a video is drawn.
        validation: how `susp-mj validate` compares measurements with it.
        plugins: Python files that bring elements, manoeuvres, numbers or cameras; relative to the case file.
    """

    title: str
    description: str = ""
    model: str
    manoeuvre: dict[str, Any]
    configuration: tuple[Setting, ...] = Field(min_length=1)
    numbers: tuple[str, ...] = ()
    criteria: dict[str, Band] = Field(default_factory=dict)
    step: Annotated[float, Quantity("s", gt=0)] | None = None
    record_every: int | None = Field(default=None, ge=1)
    film: Film = Film()
    validation: Validation = Validation()
    plugins: tuple[str, ...] = ()

    @model_validator(mode="after")
    def _known_names(self) -> Case:
        if self.model not in MODELS:
            raise wrong(f"'{self.model}' unknown; {choices(MODELS, self.model)}", "model")
        for key, names in (("numbers", self.numbers), ("criteria", tuple(self.criteria))):
            for name in names:
                if name not in NUMBERS:
                    raise wrong(f"'{name}' unknown; {choices(NUMBERS, name)}", key)
        self.bands()
        try:
            Style(self.film.camera, self.film.layout).suits(self.model == HANDLING, len(self.settings))
        except InputError as error:
            raise wrong(error.message, f"film.{error.key}") from None
        labels = [each.name for _, each in self.settings]
        for i, label in enumerate(labels):
            taken = {file_name(other).casefold(): other for other in labels[:i]}.get(file_name(label).casefold())
            if taken is not None:
                also = "" if taken == label else f" to a file system: '{taken}' is too much like it"
                raise wrong(f"'{label}' names two configurations{also}", "configuration")
        return self

    def bands(self) -> dict[str, Criterion]:
        """The criteria by number, in SI units."""
        return {name: band.criterion(NUMBERS[name].unit, f"criteria.{name}") for name, band in self.criteria.items()}

    @property
    def settings(self) -> list[tuple[int, Setting]]:
        """The configurations one by one, load cases taken apart, each with its place in the file."""
        return [(place, single) for place, each in enumerate(self.configuration) for single in each.single()]


def available_cases() -> list[str]:
    """Names of the cases that come with susp_mj."""
    return sorted(path.stem for path in FOLDER.glob("*.toml"))


def load_case(name: str | Path) -> tuple[Case, Path]:
    """Read a case, shipped or from a file; returns it and the file's path.

    Raises:
        InputError: file, key, value, and what is allowed.
    """
    path = Path(name)
    if path.suffix != ".toml":
        if str(name) not in available_cases():
            raise InputError(f"no case '{name}'; {choices(available_cases(), name)}, or give a .toml file", key="case")
        path = FOLDER / f"{name}.toml"
    tables = read_toml(path)
    load_plugins(tables.get("plugins", ()), path)
    return validate(Case, tables, source=path.name), path


def film_asked(camera: str | None, *, ghost: bool, fine: bool) -> dict[str, str]:
    """Values of a `Film` that a command line asks for."""
    asked = {"camera": camera, "layout": "ghost" if ghost else None, "quality": "fine" if fine else None}
    return {name: value for name, value in asked.items() if value is not None}


def with_film(case: Case, camera: str | None, *, ghost: bool, fine: bool) -> Case:
    """The case with its film as asked for on a command line; what is not asked for stays."""
    film = validate(Film, case.film.model_dump() | film_asked(camera, ghost=ghost, fine=fine), source="video")
    return validate(Case, dict(case) | {"film": film}, source="video")


def read_manoeuvre(table: Mapping[str, Any], path: Path = Path()) -> Manoeuvre:
    """A manoeuvre from its table in the file at `path`, beside which lies what it names.

    Raises:
        InputError: unknown kind, or a parameter that is wrong.
    """
    kind, source = table.get("kind"), path.name
    if not isinstance(kind, str):
        raise InputError(f"is required; {choices(MANOEUVRES)}", key="manoeuvre.kind", source=source)
    try:
        name = find_manoeuvre(kind)
    except InputError as error:
        raise error.within(key="manoeuvre", source=source) from None
    manoeuvre = validate(MANOEUVRES[name], {**table, "kind": name}, source=source, key="manoeuvre", folder=path.parent)
    start = getattr(manoeuvre, "start", 0.0)
    if start >= manoeuvre.duration:
        text = f"{start:g} s is not allowed; the run ends after {manoeuvre.duration:g} s"
        raise InputError(text, key="manoeuvre.start", source=source)
    return manoeuvre


def usual_load(manoeuvre: Manoeuvre | type[Manoeuvre], loads: Container[str]) -> str:
    """Load case of a car with these `loads` where none is asked for: the manoeuvre's test load if the car has it, else
    the design position."""
    return manoeuvre.test_load if manoeuvre.test_load in loads else DESIGN_LOAD
