"""simulate: a plant and a manoeuvre in, a Run out."""

from __future__ import annotations

import copy
import dataclasses
from collections.abc import Callable

import mujoco
import numpy as np

from .equilibrium import static_equilibrium
from .errors import InputError
from .handling.block import SIGNALS
from .inputs import road_and_driver, sample_inputs
from .manoeuvre import Manoeuvre
from .plant import STEP, Plant
from .recording import FIELDS, Diverged, as_run
from .run import Run
from .trim import Blocks, remembered, remind, trimmed

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

_CHUNK = 2000

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
        SimulationError: there is no equilibrium to begin from.
        Diverged: the motion left all bounds; the text names time and channel, its `run` is the run up to there.
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
    _check_length(manoeuvre, step, record_every)

    steps = max(round(manoeuvre.duration / step / record_every), 1) * record_every
    road, driver = road_and_driver(manoeuvre) if plant.car is not None else (None, None)
    install((*plant.laws, *(() if driver is None else [(driver.law.number, driver.role)])))
    samples = sample_inputs(plant, manoeuvre, np.arange(2 * steps + 1) * (step / 2), road)
    surface = manoeuvre.surface(road) if plant.car is not None else None
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

    fields = (*FIELDS, "signals") if plant.car is not None else FIELDS
    width = sum(getattr(data, name).size for name in FIELDS) + (len(SIGNALS) if plant.car is not None else 0)
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
    run = as_run(
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
        raise Diverged(run, step)
    return run


def _at_start(plant: Plant, manoeuvre: Manoeuvre, samples: np.ndarray, step: float, blocks: Blocks) -> mujoco.MjData:
    """Data in the state from which the run begins: static equilibrium, or steady straight running."""
    from .compiled import input_block

    at_rest = samples[:1].copy()
    at_rest[..., 1] = 0.0
    block = input_block(at_rest, step / 2, plant.entries())
    if plant.car is None:
        return static_equilibrium(plant, block)
    return trimmed(
        plant, dataclasses.replace(blocks, inputs=block), manoeuvre.driving_speed() if plant.meaning.driving else 0.0
    )


def fine_enough(plant: Plant) -> int:
    """Into how many steps a millisecond must be cut so that no step exceeds a time constant of the plant."""
    fastest = min((constant.seconds for constant in plant.meaning.time_constants), default=STEP)
    if plant.car is not None:
        fastest *= COARSER
    if fastest < STEP / FINEST:
        return 1  # no step of ours resolves it; the check of the step says so by name
    return max(1, int(np.ceil(STEP / fastest - 1e-9)))


def _check_length(manoeuvre: Manoeuvre, step: float, record_every: int) -> None:
    """Refuse a run that memory does not hold, or one without a second record."""
    if manoeuvre.duration / step > MOST_STEPS:
        raise InputError(
            f"{manoeuvre.duration:g} s is too long for a step of {1000 * step:g} ms; "
            f"allowed are {MOST_STEPS:.0e} steps, {MOST_STEPS * step:g} s",
            key="duration",
            source="manoeuvre",
        )
    if record_every * step > manoeuvre.duration:
        steps = int(manoeuvre.duration / step)
        raise InputError(
            f"{record_every} is not allowed; a run of {manoeuvre.duration:g} s has {steps} steps",
            key="record_every",
            source="simulate",
        )


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
