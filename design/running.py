"""Running a case: every configuration simulated and evaluated."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from evaluation.characteristics import characteristic
from evaluation.compare import Comparison, Configuration
from evaluation.numbers import NUMBERS, Criterion, Number, evaluate
from evaluation.plots.sweeps import SWEEP_QUANTITIES
from manoeuvres import VerticalSweep
from susp_mj.errors import InputError
from susp_mj.linear import Linear, linearise
from susp_mj.manoeuvre import Manoeuvre
from susp_mj.meaning import Input
from susp_mj.names import AXLES
from susp_mj.plant import Plant
from susp_mj.run import Run
from susp_mj.simulation import simulate
from susp_mj.units import to_si
from vehicles.mjcf import HANDLING, build
from vehicles.reading import load_vehicle
from vehicles.vehicle import Vehicle

from .case import Case, Setting, read_manoeuvre

Report = Callable[[str, float], None]
"""Progress: called with what is being done and the fraction done, 0 to 1."""


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
