"""Case files: one model, one manoeuvre, several configurations, criteria; run to a folder with summary, plots and
report."""

from __future__ import annotations

import shutil
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import AfterValidator, Field, model_validator

from evaluation import NUMBERS, Criterion, Number
from evaluation.characteristics import characteristic
from evaluation.compare import Claim, Comparison, Configuration, evaluate
from evaluation.plots import SWEEP_QUANTITIES
from manoeuvres import MANOEUVRES, VerticalSweep, find_manoeuvre
from susp_mj.description import Description, validate, wrong
from susp_mj.errors import InputError, SuspMjError, choices
from susp_mj.linear import Linear, linearise
from susp_mj.manoeuvre import Manoeuvre
from susp_mj.meaning import Input
from susp_mj.names import AXLES
from susp_mj.plant import Plant
from susp_mj.run import Run
from susp_mj.simulation import simulate
from susp_mj.units import Quantity, to_si
from vehicles.mjcf import HANDLING, MODELS, build
from vehicles.vehicle import DESIGN_LOAD, Vehicle, load_vehicle, read_toml

FOLDER = Path(__file__).parent / "cases"
Report = Callable[[str, float], None]
"""Progress: called with what is being done and the fraction done, 0 to 1."""


class Band(Description):
    """Allowed band of a number; a bound is a number in SI or a text with a unit."""

    min: float | str | None = None
    max: float | str | None = None


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
        load: load case, or several: each makes a configuration of its own, named after it.
        axle: for models of one axle.
        set: overrides by dotted path, as a vehicle file would have them.
    """

    name: Annotated[str, AfterValidator(_printable)] = Field(min_length=1, max_length=80)
    vehicle: str
    characteristics: str | None = None
    load: str | Annotated[tuple[str, ...], Field(min_length=1)] = DESIGN_LOAD
    axle: str | None = None
    set: dict[str, Any] = Field(default_factory=dict)

    def single(self) -> list[Setting]:
        """This setting once for each of its load cases."""
        if isinstance(self.load, str):
            return [self]
        return [self.model_copy(update={"name": f"{self.name}, {load}", "load": load}) for load in self.load]


class Film(Description):
    """How a case's video is drawn; see `evaluation.animation.render_video`.

    Attributes:
        camera: ``chase``, ``front`` or ``side`` of a car that drives freely; by default what suits the manoeuvre.
        layout: ``side_by_side``, or ``ghost``: cars that drive freely in one scene, the second translucent.
        quality: ``draft`` or ``fine``; by default a draft of cars that drive freely, fine pictures of everything else.
        playback: seconds of the run per second of video.
    """

    camera: Literal["chase", "front", "side"] | None = None
    layout: Literal["side_by_side", "ghost"] = "side_by_side"
    quality: Literal["draft", "fine"] | None = None
    playback: Annotated[float, Quantity("", gt=0)] | None = None


class Case(Description):
    """A case file.

    Attributes:
        title, description: for the report.
        model: topology, a key of `vehicles.mjcf.MODELS`.
        manoeuvre: a table with its `kind` and parameters.
        configuration: what is compared, in order.
        numbers: evaluation numbers; all that apply if empty.
        criteria: bands by number.
        step: integration step [s]; by default 1 ms or what the dampers' mounts need.
        record_every: keep every n-th step; by default one a millisecond.
        film: how a video is drawn.
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

    @model_validator(mode="after")
    def _known_names(self) -> Case:
        if self.model not in MODELS:
            raise wrong(f"'{self.model}' unknown; {choices(MODELS, self.model)}", "model")
        for key, names in (("numbers", self.numbers), ("criteria", tuple(self.criteria))):
            for name in names:
                if name not in NUMBERS:
                    raise wrong(f"'{name}' unknown; {choices(NUMBERS, name)}", key)
        labels = [each.name for _, each in self.settings]
        for i, label in enumerate(labels):
            taken = {file_name(other).casefold(): other for other in labels[:i]}.get(file_name(label).casefold())
            if taken is not None:
                also = "" if taken == label else f" to a file system: '{taken}' is too much like it"
                raise wrong(f"'{label}' names two configurations{also}", "configuration")
        return self

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
    return validate(Case, read_toml(path), source=path.name), path


def with_film(case: Case, camera: str | None, *, ghost: bool, fine: bool) -> Case:
    """The case with its film as asked for on a command line; what is not asked for stays."""
    asked = {"camera": camera, "layout": "ghost" if ghost else None, "quality": "fine" if fine else None}
    film = validate(
        Film,
        case.film.model_dump() | {name: value for name, value in asked.items() if value is not None},
        source="video",
    )
    return case.model_copy(update={"film": film})


def read_manoeuvre(table: dict[str, Any], source: str = "") -> Manoeuvre:
    """A manoeuvre from its table.

    Raises:
        InputError: unknown kind, or a parameter that is wrong.
    """
    kind = table.get("kind")
    if not isinstance(kind, str):
        raise InputError(f"is required; {choices(MANOEUVRES)}", key="manoeuvre.kind", source=source)
    try:
        name = find_manoeuvre(kind)
    except InputError as error:
        raise error.within(key="manoeuvre", source=source) from None
    manoeuvre = validate(MANOEUVRES[name], {**table, "kind": name}, source=source, key="manoeuvre")
    start = getattr(manoeuvre, "start", 0.0)
    if start >= manoeuvre.duration:
        text = f"{start:g} s is not allowed; the run ends after {manoeuvre.duration:g} s"
        raise InputError(text, key="manoeuvre.start", source=source)
    return manoeuvre


def run_case(case: Case, path: Path, progress: Report = lambda task, done: None) -> Comparison:
    """Simulate and evaluate every configuration of a case.

    Args:
        path: the case file; vehicle files are looked for beside it.

    Raises:
        InputError: naming file, key and value.
        SimulationError: a run diverged or has no equilibrium.
    """
    manoeuvre = read_manoeuvre(case.manoeuvre, path.name)
    prepared = [_prepare(case, manoeuvre, setting, path, place) for place, setting in case.settings]
    names = tuple(dict.fromkeys((*case.numbers, *case.criteria))) if case.numbers else tuple(NUMBERS)
    configurations = []
    for i, ((_, setting), (vehicle, plant)) in enumerate(zip(case.settings, prepared, strict=True)):

        def report(done: float, i: int = i, label: str = setting.name) -> None:
            progress(f"simulate {label}", (i + done) / len(prepared))

        try:
            run = simulate(plant, manoeuvre, step=case.step, record_every=case.record_every, progress=report)
        except InputError as error:
            raise _of_manoeuvre(error, manoeuvre).within(source=path.name) from None
        configurations.append(_outcome(case, setting, vehicle, manoeuvre, run, evaluate(run, names)))
    wanted = {*case.numbers, *case.criteria}
    shown = [name for name in names if name in wanted or any(each.numbers[name].applies for each in configurations)]
    configurations = [replace(each, numbers={name: each.numbers[name] for name in shown}) for each in configurations]
    return Comparison(case.title, case.description, configurations, _criteria(case, configurations, path.name))


def _of_manoeuvre(error: InputError, manoeuvre: Manoeuvre) -> InputError:
    """An error of a run, its key the one in the case file where a parameter of the manoeuvre is to blame."""
    if error.source == "manoeuvre" or (not error.source and error.key in type(manoeuvre).model_fields):
        return InputError(error.message, key=".".join(part for part in ("manoeuvre", error.key) if part))
    return error


def _outcome(
    case: Case, setting: Setting, vehicle: Vehicle, manoeuvre: Manoeuvre, run: Run, numbers: dict[str, Number]
) -> Configuration:
    """A run with what a report shows beside it: characteristics, modes, exact amplifications."""
    title = ", ".join(part for part in (vehicle.title, vehicle.characteristics, f"load {setting.load}") if part)
    if case.model == HANDLING:
        curves = [characteristic(f"{name} axle", vehicle.axle(name)) for name in AXLES]
        return Configuration(setting.name, title, run, numbers, curves)
    plant = build(vehicle.without_friction(), case.model, str(setting.load), setting.axle)
    axles = dict.fromkeys(travel.key for travel in plant.meaning.travels)
    curves = [characteristic(f"{name} axle", vehicle.axle(name)) for name in axles]
    linear = linearise(plant)
    transfer = exact_transfer(linear, manoeuvre, plant.meaning.inputs) if isinstance(manoeuvre, VerticalSweep) else {}
    return Configuration(setting.name, title, run, numbers, curves, linear.modes(), transfer)


def exact_transfer(
    linear: Linear, sweep: VerticalSweep, inputs: Sequence[Input]
) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Exact amplifications beside those of a sweep, of every channel that the report draws over frequency.

    As for the sweep, a channel of a wheel is related to that wheel's road, one of the body to the first wheel's.
    """
    frequency = np.geomspace(sweep.start_frequency, sweep.end_frequency, 200)
    roads = {place.station: place for place in inputs if place.quantity == "road_height"}
    first = next(iter(roads.values()))
    result = {}
    for channel in linear.channels:
        if channel.endswith(SWEEP_QUANTITIES):
            own = roads.get(channel.split("_", 1)[0], first)
            ratios = [
                linear.transfer(channel, sweep.weights(inputs, each), np.array([each]))[0] / sweep.weight(own, each)
                for each in frequency
            ]
            result[channel] = (frequency, np.array(ratios))
    return result


def _prepare(case: Case, manoeuvre: Manoeuvre, setting: Setting, path: Path, index: int) -> tuple[Vehicle, Plant]:
    """Vehicle and plant of one configuration, errors naming its place in the case file."""
    name = setting.vehicle
    try:
        vehicle = load_vehicle(
            path.parent / name if name.endswith(".toml") else name, setting.characteristics, setting.set
        )
        return vehicle, build(vehicle, case.model, str(setting.load), setting.axle, manoeuvre.rig)
    except InputError as error:
        if error.source:
            raise
        raise error.within(key=f"configuration.{index}", source=path.name) from None


def _criteria(case: Case, configurations: Sequence[Configuration], source: str) -> dict[str, Criterion]:
    criteria = {}
    for name, band in case.criteria.items():
        unit = NUMBERS[name](configurations[0].run).unit
        bounds: list[float | None] = []
        for key in ("min", "max"):
            value = getattr(band, key)
            try:
                bounds.append(None if value is None else to_si(value, "" if unit == "1" else unit))
            except ValueError as error:
                raise InputError(str(error), key=f"criteria.{name}.{key}", source=source) from None
        if bounds[0] is not None and bounds[1] is not None and bounds[0] > bounds[1]:
            raise InputError(f"min {bounds[0]:g} lies above max {bounds[1]:g}", key=f"criteria.{name}", source=source)
        criteria[name] = Criterion(bounds[0], bounds[1])
    return criteria


def carry_out(
    case: Case,
    path: Path,
    out: Path,
    *,
    video: bool = False,
    claims: Callable[[Comparison], Sequence[Claim]] | None = None,
    progress: Report = lambda task, done: None,
) -> Comparison:
    """Run a case and leave ``summary.json``, ``runs/*.nc``, ``plots/*.svg``, ``report.html`` and a video in `out`.

    The folder receives everything at once at the end; after an error it is as it was. Only a video that fails leaves
    the other results there, and its error is raised after them.

    Args:
        claims: published statements to hold against the results.

    Raises:
        InputError, SimulationError: as `run_case`; or `out` cannot be written.
    """
    started = time.perf_counter()
    no_video: SuspMjError | None = None
    with staged(out) as stage:
        comparison = run_case(case, path, progress)
        if claims is not None:
            comparison = replace(comparison, claims=tuple(claims(comparison)))
        simulated = time.perf_counter() - started
        if video:
            try:
                comparison = replace(comparison, videos=(_make_video(case, comparison, stage, progress),))
            except SuspMjError as error:
                no_video = error
        _write_results(comparison, stage, {"simulate_s": round(simulated, 3)}, progress)
    if no_video is not None:
        raise no_video
    return comparison


def _make_video(case: Case, comparison: Comparison, stage: Path, progress: Report) -> str:
    from evaluation.animation import Clip, render_video

    film = case.film.model_dump()
    film["quality"] = film["quality"] or ("draft" if case.model == HANDLING else "fine")
    clips = [Clip(each.name, each.run) for each in comparison.configurations]
    return render_video(clips, stage / "video.mp4", **film, progress=lambda done: progress("render video", done)).name


def _write_results(comparison: Comparison, stage: Path, timings: dict[str, float], progress: Report) -> None:
    from evaluation.plots import draw, save_plots
    from evaluation.report import write_report, write_summary

    started = time.perf_counter()
    progress("write results", 0.0)
    for each in comparison.configurations:
        each.run.save(stage / "runs" / f"{file_name(each.name)}.nc")
    progress("write results", 0.2)
    plots = draw(comparison)
    progress("write results", 0.8)
    save_plots(comparison, stage / "plots", plots)
    write_report(comparison, stage / "report.html", plots=plots)
    versions = comparison.configurations[0].run.meta["versions"]
    timings = {**timings, "report_s": round(time.perf_counter() - started, 3)}
    write_summary(comparison, stage / "summary.json", {"versions": versions, "timings": timings})
    progress("write results", 1.0)


def file_name(label: str) -> str:
    """A label as a file name: letters, digits, dot, dash and underscore stay."""
    return "".join(letter if letter.isalnum() or letter in "._-" else "_" for letter in label)


@contextmanager
def staged(out: Path) -> Iterator[Path]:
    """A folder to write into; on success its contents replace earlier results in `out`, on any error nothing of it
    remains.

    Raises:
        InputError: `out` cannot be written.
    """
    created: list[Path] = []
    stage: Path | None = None
    try:
        try:
            created = [folder for folder in (out, *out.parents) if not folder.exists()]
            out.mkdir(parents=True, exist_ok=True)
            stage = Path(tempfile.mkdtemp(prefix=".unfinished-", dir=out))
        except OSError as error:
            raise InputError(f"cannot be written: {error.strerror}", source=str(out)) from None
        yield stage
        _clear(out)
        for item in sorted(stage.rglob("*")):
            if item.is_file():
                target = out / item.relative_to(stage)
                target.parent.mkdir(parents=True, exist_ok=True)
                item.replace(target)
        created = []
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror or error}", source=str(out)) from None
    finally:
        if stage is not None:
            shutil.rmtree(stage, ignore_errors=True)
        for folder in created:
            if folder.is_dir() and not any(folder.iterdir()):
                folder.rmdir()


def _clear(out: Path) -> None:
    """Take the results of an earlier run away, and nothing else."""
    if (out / "summary.json").is_file():
        for pattern in ("summary.json", "report.html", "video.mp4", "runs/*.nc", "plots/*.svg"):
            for file in out.glob(pattern):
                file.unlink()
