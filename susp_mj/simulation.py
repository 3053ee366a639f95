"""simulate: a plant and a manoeuvre in, a Run out."""

from __future__ import annotations

import copy
import dataclasses
import functools
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from importlib.metadata import version

import mujoco
import numpy as np

from .chassis import free_motion
from .elements.car import HEAD, SIGNALS
from .equilibrium import static_equilibrium
from .errors import InputError, SimulationError
from .manoeuvre import Manoeuvre
from .names import channel_name
from .plant import Plant
from .roads import Road
from .run import Channel, Run, described
from .trim import Blocks, remembered, remind, trimmed

STEP = 1e-3
"""Longest integration step chosen by itself, and spacing of its records [s]."""
FINEST = 20
"""Into how many steps a millisecond is cut at most without being asked."""
COARSER = 2.0
"""A car on tyres with slip is integrated with steps so many times its shortest time constant: that belongs to a damper
in its mount, whose lag the mass of a wheel hides (1 ms and 0.125 ms differ by less than 0.05 % of the range in every
channel looked at)."""
MOST_STEPS = 10_000_000
"""Longest run, in steps; its records fit into the memory of a workstation."""
STABLE = 2.785
"""Runge-Kutta 4 is stable on the negative real axis up to step / time constant = 2.785."""

_FIELDS = ("qpos", "qvel", "qacc", "actuator_force")
_TANGENTS = [i for i, name in enumerate(SIGNALS) if name.endswith("slip_angle")]
_FALLING = 1.0  # rad
_CHUNK = 2000
_BLOCK = 128

Progress = Callable[[float], None]


def simulate(
    plant: Plant,
    manoeuvre: Manoeuvre,
    *,
    step: float | None = None,
    record_every: int | None = None,
    progress: Progress | None = None,
) -> Run:
    """Run a manoeuvre on a plant from static equilibrium, with classical Runge-Kutta of fourth order.

    Inputs are sampled at half steps, where the Runge-Kutta stages ask for them, so a smooth input keeps the order.
    Records are evaluated at the recorded time, not taken from the last stage. Identical arguments give bit-identical
    results.

    Args:
        plant: from `vehicles.mjcf.build` or `Plant.from_mjcf`.
        manoeuvre: from `manoeuvres`, or your own.
        step: integration step [s]; None takes 1 ms, or the largest whole fraction of it that no time constant of a
            damper and its mount falls below.
        record_every: keep every n-th step; None keeps one a millisecond, or every step if the step is given.
        progress: called with the fraction done, about every 2000 steps.

    Raises:
        InputError: the manoeuvre does not fit the plant, the step is too long for an element, or the load cannot be
            carried.
        SimulationError: the motion diverged; the text names time and channel.
    """
    from .compiled import advance, attach_input, input_block, install

    meaning = plant.meaning
    if step is None:
        parts = fine_enough(plant)
        step, record_every = STEP / parts, parts if record_every is None else record_every
    record_every = 1 if record_every is None else record_every
    if not (np.isfinite(step) and step > 0) or record_every < 1:
        raise InputError(
            f"step {step} s and record_every {record_every} are not allowed; both must be positive", source="simulate"
        )
    manoeuvre.check(meaning.inputs, meaning.model)
    _check_step(plant, step)
    install(plant.laws, plant.contacts)

    if manoeuvre.duration / step > MOST_STEPS:
        raise InputError(
            f"{manoeuvre.duration:g} s is too long for a step of {1000 * step:g} ms; allowed are {MOST_STEPS:.0e} "
            "steps, "
            f"{MOST_STEPS * step:g} s",
            key="duration",
            source="manoeuvre",
        )
    if record_every * step > manoeuvre.duration:
        raise InputError(
            f"{record_every} is not allowed; a run of {manoeuvre.duration:g} s has {int(manoeuvre.duration / step)} "
            "steps",
            key="record_every",
            source="simulate",
        )
    steps = max(round(manoeuvre.duration / step / record_every), 1) * record_every
    road, driver = (manoeuvre.road(), manoeuvre.driver()) if plant.contacts else (None, None)
    samples = sample_inputs(plant, manoeuvre, np.arange(2 * steps + 1) * (step / 2), road)
    surface = manoeuvre.surface(road) if plant.contacts else None
    blocks = Blocks(
        input_block(samples, step / 2, plant.entries()),
        None if surface is None else surface.block(),
        None if driver is None or not meaning.driving else driver.block(),
    )
    data = _at_start(plant, manoeuvre, samples, step, blocks)

    model = plant.model
    if model.opt.timestep != step:
        model = copy.copy(model)
        model.opt.timestep = step
    data.time = 0.0
    memory = remembered(plant, data)
    attach_input(data, blocks.inputs, blocks.road, blocks.driver)
    remind(data, memory)

    fields = (*_FIELDS, "signals") if plant.contacts else _FIELDS
    width = sum(getattr(data, name).size for name in _FIELDS) + (len(SIGNALS) if plant.contacts else 0)
    records = np.empty((steps // record_every + 1, width))
    rows, done, sound = 0, 0, True
    chunk = max(_CHUNK // record_every, 1) * record_every
    while sound and done < steps:
        count = min(chunk, steps - done)
        done += count
        new, sound = advance(model, data, count, record_every, fields, records[rows:], final=done == steps)
        rows += new
        if progress is not None:
            progress(done / steps)
    time = np.arange(rows) * (step * record_every)
    run = _as_run(
        plant,
        manoeuvre,
        time,
        records[:rows],
        samples[:: 2 * record_every][:rows],
        step,
        road,
        steered=driver is not None,
    )
    if not sound or any(warning.number for warning in data.warning):
        raise SimulationError(_diverged(run, step))
    return run


def _at_start(plant: Plant, manoeuvre: Manoeuvre, samples: np.ndarray, step: float, blocks: Blocks) -> mujoco.MjData:
    """Data in the state from which the run begins: static equilibrium, or steady straight running."""
    from .compiled import input_block

    at_rest = samples[:1].copy()
    at_rest[..., 1] = 0.0
    block = input_block(at_rest, step / 2, plant.entries())
    if not plant.contacts:
        return static_equilibrium(plant, block)
    return trimmed(
        plant, dataclasses.replace(blocks, inputs=block), manoeuvre.driving_speed() if plant.meaning.driving else 0.0
    )


def simulate_many(
    jobs: Sequence[tuple[Plant, Manoeuvre]],
    *,
    step: float | None = None,
    record_every: int | None = None,
    workers: int | None = None,
) -> list[Run]:
    """Run several simulations side by side on threads; the results are those of `simulate`, in the order given.

    The stepping loop holds no Python lock, so threads run in parallel.
    """
    from .compiled import install

    for plant, _ in jobs:
        install(plant.laws, plant.contacts)
    with ThreadPoolExecutor(workers) as pool:
        return list(pool.map(lambda job: simulate(*job, step=step, record_every=record_every), jobs))


def fine_enough(plant: Plant) -> int:
    """Into how many steps a millisecond must be cut so that no step exceeds a time constant of the plant."""
    fastest = min((constant.seconds for constant in plant.meaning.time_constants), default=STEP)
    if plant.contacts:
        fastest *= COARSER
    if fastest < STEP / FINEST:
        return 1  # no step of ours resolves it; the check of the step says so by name
    return max(1, int(np.ceil(STEP / fastest - 1e-9)))


def sample_inputs(plant: Plant, manoeuvre: Manoeuvre, time: np.ndarray, road: Road | None = None) -> np.ndarray:
    """(samples, inputs, 2) values and rates of every input of the plant; a car that drives meets its `road` itself."""
    samples = np.zeros((len(time), len(plant.meaning.inputs), 2))
    over_ground = plant.meaning.driving and road is not None
    for i, place in enumerate(plant.meaning.inputs):
        if over_ground and place.quantity == "road_height":
            continue
        driven = manoeuvre.drive(place, time)
        if driven is None and plant.meaning.driving:
            driven = _holding(place.quantity, manoeuvre, time)
        if driven is not None:
            samples[:, i, 0], samples[:, i, 1] = driven
    if not np.isfinite(samples).all():
        raise InputError(f"manoeuvre {manoeuvre.kind} gives an input that is not finite", source="manoeuvre")
    if plant.contacts:
        _check_steering(plant, manoeuvre, samples)
    return samples


def _check_steering(plant: Plant, manoeuvre: Manoeuvre, samples: np.ndarray) -> None:
    """Refuse a steering wheel that is turned further than it goes: the car would hold it at its limit and the run be
    another one."""
    limit = float(plant.model.numeric_data[HEAD.index("steering_limit")])
    for i, place in enumerate(plant.meaning.inputs):
        largest = float(np.abs(samples[:, i, 0]).max())
        if place.quantity == "steering_wheel_angle" and largest > limit * (1 + 1e-9):
            raise InputError(
                f"{manoeuvre.kind} turns the steering wheel by {largest:.4g} rad ({np.degrees(largest):.4g} deg); "
                "it goes "
                f"{limit:.4g} rad ({np.degrees(limit):.4g} deg) to either side (steering.limit of "
                f"{plant.meaning.source})",
                source="manoeuvre",
            )


def _holding(quantity: str, manoeuvre: Manoeuvre, time: np.ndarray) -> tuple[np.ndarray, np.ndarray] | None:
    """A car keeps the speed of its manoeuvre, or stands braked, unless the manoeuvre says otherwise."""
    value = {"speed_target": manoeuvre.driving_speed(), "speed_control": 1.0}.get(quantity)
    return None if value is None else (np.full(len(time), value), np.zeros(len(time)))


def _check_step(plant: Plant, step: float) -> None:
    for constant in plant.meaning.time_constants:
        if step > STABLE * constant.seconds:
            raise InputError(
                f"{constant.value:g} {constant.unit} is too stiff for a step of {1000 * step:g} ms "
                f"(time constant {1000 * constant.seconds:.3g} ms); "
                f"allowed is at most {constant.value * (STABLE * constant.seconds / step) ** constant.power:.3g} "
                f"{constant.unit}, "
                f"or a step of at most {1000 * STABLE * constant.seconds:.3g} ms",
                key=constant.key,
                source=plant.meaning.source,
            )


def _as_run(
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
    meaning, model = plant.meaning, plant.model
    by_column = np.empty(records.shape[::-1])
    for row in range(0, len(records), _BLOCK):  # a transpose that stays in the cache
        by_column[:, row : row + _BLOCK] = records[row : row + _BLOCK].T
    records = by_column.T
    ends = np.cumsum([model.nq, model.nv, model.nv, model.nu])
    columns = dict(zip(_FIELDS, np.split(records[:, : ends[-1]], ends[:-1], axis=1), strict=True))
    columns |= {"input": inputs[..., 0], "input_rate": inputs[..., 1]}
    channels: dict[str, Channel] = {}
    if plant.contacts:
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
    for quantity, values in manoeuvre.record(time).items():
        channels[quantity] = described(quantity, values)
    meta = {
        "title": f"{meaning.title}: {manoeuvre.kind} on {meaning.model}",
        "vehicle": meaning.vehicle,
        "load": meaning.load,
        "model": meaning.model,
        "manoeuvre": manoeuvre.model_dump(mode="json"),
        "travel": {t.station: [t.rebound, t.compression] for t in meaning.travels},
        "facts": dict(meaning.facts),
        "places": {place.station: [place.x, place.y] for place in meaning.inputs if place.quantity == "road_height"},
        "step": step,
        "integrator": "RK4",
        "versions": dict(_versions()),
        **({} if road is None else {"road": {"features": [dict(feature) for feature in road.features]}}),
    }
    return Run(time, channels, meta)


@functools.cache
def _versions() -> Mapping[str, str]:
    """Versions of what computes; looked up once."""
    return {"susp_mj": version("susp_mj"), "mujoco": mujoco.__version__}


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
