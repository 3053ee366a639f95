"""Static equilibrium of a plant: where it rests under gravity before anything happens."""

from __future__ import annotations

import copy
from collections.abc import Callable, Mapping

import mujoco
import numpy as np

from .elements.law import ACTUATOR_HEADER
from .errors import InputError, SimulationError
from .plant import Plant


def static_equilibrium(plant: Plant, block: np.ndarray | None = None) -> mujoco.MjData:
    """Data at rest under gravity, the inputs at their first value: accelerations vanish, inner states carry no force.

    Args:
        block: inputs as `compiled.input_block` makes them, with zero rates.

    Raises:
        InputError: the load cannot be carried between the stops.
        SimulationError: no equilibrium found.
    """
    from .compiled import attach_input, install

    install(plant.laws)
    model = copy.copy(plant.model)
    model.tendon_actfrclimited[:] = 0  # a wheel at rest is on the road; without its limit every force has a slope
    data = mujoco.MjData(model)
    attach_input(data, block)

    states = np.flatnonzero(model.actuator_actadr >= 0)

    def residual(position: np.ndarray) -> np.ndarray:
        data.qpos[:], data.qvel[:] = position, 0.0
        rest_states(model, data, states)
        return data.qfrc_smooth / weight

    mujoco.mj_forward(model, data)
    weight = np.maximum(np.abs(data.qfrc_bias), np.abs(data.qfrc_bias).max())
    position = solve(residual, data.qpos.copy())
    if not np.max(np.abs(residual(position))) < 1e-9:
        raise SimulationError(
            f"{plant.meaning.source}: load '{plant.meaning.load}' has no static equilibrium in model "
            f"{plant.meaning.model}; "
            "check preloads and sprung mass"
        )
    _check_travel(plant, data)
    attach_input(data, None)
    return data


def solve(residual: Callable[[np.ndarray], np.ndarray], position: np.ndarray, enough: float = 0.0) -> np.ndarray:
    """Root by Newton's method with finite differences and halved steps, until no residual exceeds `enough` or rounding
    stops the progress.

    Springs are monotone but have kinks, at the design position and at the stops, where library solvers that trust their
    model of the function stall; the static load of an axle lies exactly on one whenever the payload leaves it alone.
    """
    here = residual(position)
    for _ in range(100):
        if np.max(np.abs(here)) <= enough:
            return position
        slope = np.column_stack([(residual(position + h) - here) / 1e-7 for h in 1e-7 * np.eye(len(position))])
        if not np.isfinite(slope).all():
            return position
        step = np.linalg.lstsq(slope, -here, rcond=None)[0]
        for shorter in 0.5 ** np.arange(30):
            there = residual(position + shorter * step)
            if np.linalg.norm(there) < np.linalg.norm(here):
                break
        else:
            return position
        position, here = position + shorter * step, there
    return position


def rest_states(model: mujoco.MjModel, data: mujoco.MjData, actuators: np.ndarray) -> None:
    """Forces at the current position with the inner states of these actuators at rest, i.e. equal to their element's
    deflection."""
    mujoco.mj_fwdPosition(model, data)  # lengths; the inputs in ctrl stay what they are at the first instant
    length = data.actuator_length + data.ctrl
    for actuator in actuators:
        _, _, partner, weight, other, _ = model.actuator_user[actuator][:ACTUATOR_HEADER]
        deflection = (
            length[actuator] if partner == 0 else weight * length[actuator] + other * length[actuator + int(partner)]
        )
        data.act[model.actuator_actadr[actuator]] = deflection
    mujoco.mj_forward(model, data)


def _check_travel(plant: Plant, data: mujoco.MjData) -> None:
    """Refuse an equilibrium on a stop: there the springs do not carry the car."""
    columns = {
        "qpos": data.qpos[None],
        "qvel": data.qvel[None],
        "qacc": data.qacc[None],
        "actuator_force": data.actuator_force[None],
        "input": np.zeros((1, len(plant.meaning.inputs))),
        "input_rate": np.zeros((1, len(plant.meaning.inputs))),
    }
    for output, values in plant.outputs(columns):
        if output.quantity == "wheel_load" and not values[0] > 0:
            raise InputError(
                f"the car tips over at rest: wheel {output.station or 'load'} would have to be pulled down by "
                f"{-values[0]:.0f} N",
                key=f"loads.{plant.meaning.load}",
                source=plant.meaning.source,
            )
    check_deflections(
        plant, {o.station: float(v[0]) for o, v in plant.outputs(columns) if o.quantity == "suspension_deflection"}
    )


def check_deflections(plant: Plant, deflections: Mapping[str, float]) -> None:
    """Refuse deflections [m] at rest, by station, that lie on a stop.

    Raises:
        InputError: naming the spring and the travel.
    """
    for travel in plant.meaning.travels:
        deflection = deflections[travel.station]
        if not travel.rebound < deflection < travel.compression:
            raise InputError(
                f"cannot carry load '{plant.meaning.load}': its equilibrium lies at {1000 * deflection:.1f} mm, "
                f"outside the travel from {1000 * travel.rebound:.0f} to {1000 * travel.compression:.0f} mm; change "
                "preload, rate or load",
                key=f"{travel.key}.spring",
                source=plant.meaning.source,
            )
