"""From what the stepping loop recorded to a Run: channels, what was run, and one line for a run that diverged."""

from __future__ import annotations

import functools
from collections.abc import Mapping
from importlib.metadata import version
from typing import Any

import mujoco
import numpy as np

from .character import Car
from .errors import SimulationError, choices, short, wrong_answer
from .features import as_json
from .handling.block import SIGNALS
from .handling.motion import free_motion
from .manoeuvre import Manoeuvre
from .names import QUANTITIES, channel_name
from .plant import Plant
from .roads import Road
from .run import Channel, Run, described

FIELDS = ("qpos", "qvel", "qacc", "actuator_force")
"""Arrays of mjData that are recorded, in this order; a car that drives freely adds its signals."""
_TANGENTS = [i for i, name in enumerate(SIGNALS) if name.endswith("slip_angle")]
_FALLING = 1.0  # rad
_BLOCK = 128


def as_run(
    plant: Plant,
    manoeuvre: Manoeuvre,
    time: np.ndarray,
    records: np.ndarray,
    inputs: np.ndarray,
    step: float,
    road: Road | None,
    *,
    steered: bool,
) -> Run:
    """The run that the stepping loop recorded.

    Args:
        time: (n,) of the records [s].
        records: (n, columns) of `FIELDS`, then the signals of a car that drives freely.
        inputs: (n, inputs, 2) values and rates.
        step: of the integration [s].
        road: that the car drove on, if it drives freely and the manoeuvre has one.
        steered: whether a driver steered.
    """
    channels = _channels(plant, records, inputs, steered=steered)
    channels |= _signals(manoeuvre, time)
    return Run(time, channels, _meta(plant, manoeuvre, step, road))


def _channels(plant: Plant, records: np.ndarray, inputs: np.ndarray, *, steered: bool) -> dict[str, Channel]:
    """Every channel by its full name: the body's motion, outputs, then inputs that are no output themselves."""
    meaning, model = plant.meaning, plant.model
    by_column = np.empty(records.shape[::-1])
    for row in range(0, len(records), _BLOCK):  # a transpose that stays in the cache
        by_column[:, row : row + _BLOCK] = records[row : row + _BLOCK].T
    records = by_column.T
    ends = np.cumsum([model.nq, model.nv, model.nv, model.nu])
    columns = dict(zip(FIELDS, np.split(records[:, : ends[-1]], ends[:-1], axis=1), strict=True))
    columns |= {"input": inputs[..., 0], "input_rate": inputs[..., 1]}
    channels: dict[str, Channel] = {}
    if plant.car is not None:
        columns["signal"] = records[:, -len(SIGNALS) :]
        columns["signal"][:, _TANGENTS] = np.arctan(columns["signal"][:, _TANGENTS])
        motion = free_motion(columns["qpos"], columns["qvel"], columns["qacc"], meaning.facts)
        channels |= {quantity: described(quantity, values) for quantity, values in motion.items()}
    for output, values in plant.outputs(columns):
        if output.quantity == "path_deviation" and not steered:
            continue
        channels[channel_name(output.station, output.quantity)] = described(output.quantity, values, output.station)
    for i, place in enumerate(meaning.inputs):
        name = channel_name(place.station, place.quantity)
        if name not in channels:  # what acts in the end may be more than the input
            channels[name] = described(place.quantity, inputs[:, i, 0].copy(), place.station)
    return channels


def _signals(manoeuvre: Manoeuvre, time: np.ndarray) -> dict[str, Channel]:
    """Channels of what the manoeuvre itself keeps with the run."""
    given: Any = manoeuvre.record(time)
    if not isinstance(given, Mapping):
        raise wrong_answer(manoeuvre.record, short(given), "arrays by quantity")
    for quantity, values in given.items():
        if quantity not in QUANTITIES:
            raise wrong_answer(manoeuvre.record, f"'{quantity}'", f"a known quantity; {choices(QUANTITIES, quantity)}")
        if not isinstance(values, np.ndarray) or values.shape != time.shape:
            raise wrong_answer(manoeuvre.record, f"{short(values)} for '{quantity}'", f"an array of {time.shape}")
    return {quantity: described(quantity, values) for quantity, values in given.items()}


def _meta(plant: Plant, manoeuvre: Manoeuvre, step: float, road: Road | None) -> dict[str, Any]:
    """What was run, in plain JSON values."""
    meaning = plant.meaning
    return {
        "title": f"{meaning.title}: {manoeuvre.kind} on {meaning.model}",
        "vehicle": meaning.vehicle,
        "load": meaning.load,
        "model": meaning.model,
        "car": _car(plant),
        "manoeuvre": manoeuvre.model_dump(mode="json"),
        "character": manoeuvre.declared().plain(),
        "travel": {t.station: [t.rebound, t.compression] for t in meaning.travels},
        "facts": dict(meaning.facts),
        "places": {place.station: [place.x, place.y] for place in meaning.inputs if place.quantity == "road_height"},
        "axles": {place.station: place.axle for place in meaning.inputs if place.quantity == "road_height"},
        "notes": _notes(plant, manoeuvre),
        "step": step,
        "integrator": "RK4",
        "versions": dict(versions()),
        **({} if road is None else {"road": {"features": as_json(road.shown)}}),
    }


def _notes(plant: Plant, manoeuvre: Manoeuvre) -> list[str]:
    """What the manoeuvre says beyond its parameters."""
    given: Any = manoeuvre.notes(plant.meaning.inputs)
    if not isinstance(given, (list, tuple)) or not all(isinstance(each, str) for each in given):
        raise wrong_answer(manoeuvre.notes, short(given), "a tuple of texts")
    return list(given)


def _car(plant: Plant) -> Car:
    """What a plant is a model of."""
    if plant.car is None:
        return "oscillation"
    return "handling" if plant.meaning.driving else "rig"


@functools.cache
def versions() -> Mapping[str, str]:
    """Versions of what computes; looked up once."""
    return {"susp_mj": version("susp_mj"), "mujoco": mujoco.__version__}


class Diverged(SimulationError):
    """The motion left all bounds: one line that names when, and in which channel.

    Attributes:
        run: the records up to there; its last one holds what is out of bounds.
    """

    def __init__(self, run: Run, step: float) -> None:
        self.run = run
        super().__init__(_diverged(run, step))


def _diverged(run: Run, step: float) -> str:
    """One line that names when the motion left all bounds, and in which channel."""
    last = {name: channel.values[-1] for name, channel in run.channels.items()}
    broken = [name for name, value in last.items() if not np.isfinite(value)]
    accelerations = [name for name in last if name.endswith("acceleration")] or list(last)
    who = f"{run.meta['vehicle']}, {run.meta['model']}, {run.meta['manoeuvre']['kind']}"
    if "yaw_angle" in run and len(run.time) > 1:
        roll, pitch = run["roll_angle"][-2], run["pitch_angle"][-2]
        if max(abs(roll), abs(pitch)) > _FALLING:
            name, angle = ("roll", roll) if abs(roll) >= abs(pitch) else ("pitch", pitch)
            return f"{who}: the car fell over at t = {run.time[-1]:.3f} s, its {name} angle {np.degrees(angle):.0f}°"
    name = broken[0] if broken else max(accelerations, key=lambda each: abs(last[each]))
    return (
        f"{who}: diverged at t = {run.time[-1]:.4f} s, "
        f"{name} = {last[name]:.3g} {run.channels[name].unit}; the step of {1000 * step:g} ms is too long for the "
        "stiffest element"
    )
