"""Running a case: every configuration simulated and evaluated."""

from __future__ import annotations

from collections.abc import Callable, Container, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from evaluation.characteristics import characteristic
from evaluation.compare import Comparison, Configuration, Failure, Outcome
from evaluation.numbers import NUMBERS, evaluate
from evaluation.plots.sweeps import SWEEP_QUANTITIES
from susp_mj.batch import Progress, free_memory, side_by_side
from susp_mj.errors import InputError, SimulationError
from susp_mj.linear import Linear, linearise
from susp_mj.manoeuvre import Manoeuvre
from susp_mj.meaning import Input
from susp_mj.names import channel_name
from susp_mj.plant import STEP, Plant
from susp_mj.plugins import load_plugins
from susp_mj.recording import Diverged
from susp_mj.run import Run
from susp_mj.simulation import MOST_STEPS, simulate
from susp_mj.units import readable
from vehicles.mjcf import build
from vehicles.reading import load_vehicle
from vehicles.vehicle import Vehicle

from .blame import in_case
from .case import Case, Setting, read_manoeuvre, usual_load

Report = Callable[[str, float], None]
"""Progress: called with what is being done and the fraction done, 0 to 1."""
RECORD = 1500
"""Memory of one record of the largest model [bytes]: 125 channels, and half as much again while they are made."""


@dataclass(frozen=True)
class Job:
    """One configuration to simulate and evaluate: plain data, which any process can carry out.

    Attributes:
        setting: car, set of characteristics, overrides, one load case, axle.
        model: topology, a key of `vehicles.models.MODELS`.
        manoeuvre: table of a manoeuvre.
        numbers: names of the evaluation numbers; all if empty.
        step, record_every: as those of a `Case`.
        plugins: of a `Case`.
        path: the case file, beside which the car's file and the plugins lie.
        place: of the setting in it, for errors.
    """

    setting: Setting
    model: str
    manoeuvre: Mapping[str, Any]
    numbers: Sequence[str]
    step: float | None = None
    record_every: int | None = None
    plugins: Sequence[str] = ()
    path: Path = Path()
    place: int = 0


@dataclass(frozen=True)
class Prepared:
    """A job whose input is found good: what it runs."""

    job: Job
    vehicle: Vehicle
    manoeuvre: Manoeuvre
    plant: Plant

    @property
    def title(self) -> str:
        """What is run, one line."""
        vehicle = self.vehicle
        parts = (vehicle.title, vehicle.characteristics, f"load {self.plant.meaning.load}")
        return ", ".join(part for part in parts if part)

    @property
    def facts(self) -> dict[str, str]:
        """What is run, for the summary."""
        meaning = self.plant.meaning
        return {
            "vehicle": meaning.vehicle,
            "load": meaning.load,
            "model": meaning.model,
            "manoeuvre": self.manoeuvre.kind,
        }

    @property
    def asked(self) -> dict[str, Any]:
        """What its case asks for, in plain JSON values: set of characteristics, axle, step and overrides where it does,
        and the manoeuvre's parameters; quantities as texts with their units."""
        setting, step = self.job.setting, self.job.step
        given = {
            "characteristics": setting.characteristics,
            "axle": setting.axle,
            "step": None if step is None else readable(step, "s"),
            "set": setting.set,
        }
        return {**{key: value for key, value in given.items() if value}, "parameters": self.manoeuvre.readable()}


def run_case(
    case: Case, path: Path, progress: Report = lambda task, done: None, workers: int | None = None
) -> Comparison:
    """Simulate and evaluate every configuration of a case, side by side.

    A configuration that diverges is a `Failure` among the outcomes. Results do not depend on the number of workers.

    Args:
        path: the case file; vehicle files are looked for beside it.
        workers: at most so many configurations at a time; None takes the usable cores.

    Raises:
        InputError: naming file, key and value; what is wrong in a file ends the work under way.
    """
    jobs = jobs_of(case, path)
    _check_memory(case, path)
    outcomes = side_by_side(
        jobs,
        prepare,
        simulated,
        outcome,
        workers=workers,
        progress=lambda place, done: progress(f"simulate {jobs[place].setting.name}", done),
    )
    outcomes = _shown(outcomes, {*case.numbers, *case.criteria})
    return Comparison(case.title, case.description, outcomes, case.bands())


def _check_memory(case: Case, path: Path) -> None:
    """Refuse records that memory does not hold: those of every configuration are kept until the results are written."""
    duration, runs = read_manoeuvre(case.manoeuvre, path).duration, len(case.settings)
    spacing = (case.step or STEP) * (case.record_every or 1)
    needed, free = runs * duration / spacing * RECORD, free_memory()
    if needed > free and duration / spacing <= MOST_STEPS:  # a longer one is refused by itself
        raise InputError(
            f"{runs} runs of {duration:g} s with a record every {1000 * spacing:g} ms take {needed / 1e9:.3g} GB; "
            f"free are {free / 1e9:.3g} GB; a record every {1000 * spacing * needed / free:.3g} ms would do",
            key="record_every",
            source=path.name,
        )


def jobs_of(case: Case, path: Path) -> list[Job]:
    """A case taken apart: one job for each configuration and load case."""
    names = tuple(dict.fromkeys((*case.numbers, *case.criteria))) if case.numbers else ()
    return [
        Job(
            setting,
            case.model,
            case.manoeuvre,
            names,
            case.step,
            case.record_every,
            plugins=case.plugins,
            path=path,
            place=place,
        )
        for place, setting in case.settings
    ]


def prepare(job: Job) -> Prepared:
    """Read and build what a job runs.

    Raises:
        InputError: naming file, key and value.
    """
    try:
        return _built(job)
    except InputError as error:
        raise _in_case(error, job) from None


def _built(job: Job) -> Prepared:
    setting, name = job.setting, job.setting.vehicle
    load_plugins(job.plugins, job.path)
    manoeuvre = read_manoeuvre(job.manoeuvre, job.path)
    vehicle = load_vehicle(
        job.path.parent / name if name.endswith(".toml") else name, setting.characteristics, setting.set
    )
    load = str(setting.load or usual_load(manoeuvre, vehicle.loads))
    return Prepared(job, vehicle, manoeuvre, build(vehicle, job.model, load, setting.axle, manoeuvre.rig))


def simulated(prepared: Prepared, progress: Progress = lambda done: None) -> tuple[Prepared, Run | SimulationError]:
    """The run of what was prepared, or why there is none to the end.

    Raises:
        InputError: the manoeuvre does not fit the car, or the step is too long.
    """
    job, manoeuvre = prepared.job, prepared.manoeuvre
    try:
        run = simulate(prepared.plant, manoeuvre, step=job.step, record_every=job.record_every, progress=progress)
    except Diverged as error:
        error.run = _noted(error.run, prepared)
        return prepared, error
    except SimulationError as error:
        return prepared, error
    except InputError as error:
        raise _in_case(_of_manoeuvre(error, manoeuvre).within(source=job.path.name), job) from None
    return prepared, _noted(run, prepared)


def _noted(run: Run, prepared: Prepared) -> Run:
    """The run with what was asked for, so that it says by itself what it is."""
    return replace(run, meta={**run.meta, "asked": prepared.asked})


def _in_case(error: InputError, job: Job) -> InputError:
    """The error of a job as its case file sees it."""

    def attempt(overrides: Mapping[str, Any]) -> InputError | None:
        return _refusal(replace(job, setting=job.setting.model_copy(update={"set": overrides})))

    return in_case(error, job.setting.set, attempt, key=f"configuration.{job.place}", source=job.path.name)


class _Begun(Exception):
    """Raised when a run has begun whose result nobody needs."""


def _refusal(job: Job) -> InputError | None:
    """Why a job does not begin to run; None if it does."""

    def begun(done: float) -> None:
        raise _Begun

    try:
        prepared = _built(job)
        simulate(prepared.plant, prepared.manoeuvre, step=job.step, record_every=job.record_every, progress=begun)
    except InputError as error:
        return error
    except (_Begun, SimulationError):
        return None
    return None


def outcome(of: tuple[Prepared, Run | SimulationError]) -> Outcome:
    """What a run means, with what a report shows beside it; or why there is none."""
    prepared, run = of
    try:
        if isinstance(run, SimulationError):
            raise run
        return _configuration(prepared, run)
    except SimulationError as error:
        until = error.run if isinstance(error, Diverged) else None
        name, title, reason = prepared.job.setting.name, prepared.title, str(error)
        return Failure(name, title, prepared.facts, reason, until, prepared.asked)


def _configuration(prepared: Prepared, run: Run) -> Configuration:
    """A run with its numbers, characteristics, modes and exact amplifications."""
    job, vehicle = prepared.job, prepared.vehicle
    what = (job.setting.name, prepared.title, run, evaluate(run, job.numbers or tuple(NUMBERS)))
    axles = dict.fromkeys(travel.key for travel in prepared.plant.meaning.travels)
    curves = [characteristic(f"{name} axle", vehicle.axle(name)) for name in axles]
    if prepared.plant.car is not None:
        return Configuration(*what, curves)
    plant = build(vehicle.without_friction(), job.model, prepared.plant.meaning.load, job.setting.axle)
    linear = linearise(plant)
    transfer = exact_transfer(linear, prepared.manoeuvre, plant.meaning.inputs)
    return Configuration(*what, curves, linear.modes(), transfer)


def _shown(outcomes: Sequence[Outcome], wanted: Container[str]) -> list[Outcome]:
    """The outcomes without the numbers that apply to none of them, unless they are wanted by name."""
    applying = {
        name
        for each in outcomes
        if isinstance(each, Configuration)
        for name, number in each.numbers.items()
        if number.applies or name in wanted
    }
    return [
        replace(each, numbers={name: number for name, number in each.numbers.items() if name in applying})
        if isinstance(each, Configuration)
        else each
        for each in outcomes
    ]


def _of_manoeuvre(error: InputError, manoeuvre: Manoeuvre) -> InputError:
    """An error of a run, its key the one in the case file where a parameter of the manoeuvre is to blame."""
    if error.source == "manoeuvre" or (not error.source and error.key in type(manoeuvre).model_fields):
        return InputError(error.message, key=".".join(part for part in ("manoeuvre", error.key) if part))
    return error


def exact_transfer(
    linear: Linear, manoeuvre: Manoeuvre, inputs: Sequence[Input]
) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Exact amplifications beside those of a sweep, of every channel that the report draws over frequency; empty unless
    the manoeuvre sweeps the road.

    As for the sweep, a channel of a wheel is related to that wheel's road, one of the body to the first wheel's.
    """
    swept = manoeuvre.road_sweep()
    if swept is None:
        return {}
    frequency = np.geomspace(*swept, 200)
    roads = {place.station: place for place in inputs if place.quantity == "road_height"}
    first = next(iter(roads.values()))
    result = {}
    for channel in linear.channels:
        if channel.endswith(SWEEP_QUANTITIES):
            own = roads.get(channel.split("_", 1)[0], first)
            ratios = [
                linear.transfer(channel, _weights(manoeuvre, roads, each), np.array([each]))[0]
                / manoeuvre.weight(own, each)
                for each in frequency
            ]
            result[channel] = (frequency, np.array(ratios))
    return result


def _weights(manoeuvre: Manoeuvre, roads: Mapping[str, Input], frequency: float) -> dict[str, complex]:
    """Complex amplitude of every wheel's road, by its channel's name."""
    return {
        channel_name(station, place.quantity): manoeuvre.weight(place, frequency) for station, place in roads.items()
    }
