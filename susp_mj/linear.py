"""Linearisation of a plant at its static equilibrium: natural frequencies, damping ratios, mode shapes, transfer
functions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import mujoco
import numpy as np

from .equilibrium import static_equilibrium
from .errors import InputError, choices
from .names import channel_name
from .plant import Plant

_STEP = 1e-5
"""Difference in position [m, rad] and velocity [m/s, rad/s]. Around a kink, as springs have it in the design position,
it reaches to both sides, whichever side the last digit of the equilibrium lies on: the slope is their mean."""


@dataclass(frozen=True)
class Mode:
    """One mode of vibration.

    Attributes:
        frequency: undamped natural frequency |lambda| / 2 pi [Hz].
        damping: damping ratio -Re(lambda)/|lambda|; 1 for a mode that does not oscillate.
        shape: joint -> complex amplitude, the largest scaled to 1.
    """

    frequency: float
    damping: float
    shape: dict[str, complex]

    @property
    def oscillates(self) -> bool:
        """Whether the mode is less than critically damped."""
        return self.damping < 1.0


@dataclass(frozen=True)
class Linear:
    """``ds/dt = A s + B0 u + B1 du/dt``, ``w = C s + D0 u + D1 du/dt`` around the static equilibrium.

    Attributes:
        A: (n, n) of the state s: positions, velocities, inner states.
        B: (2, n, inputs) for the inputs and their rates.
        C: (channels, n); D: (2, channels, inputs).
        joints: names of the freedoms; inputs, channels: names in order.
    """

    A: np.ndarray
    B: np.ndarray
    C: np.ndarray
    D: np.ndarray
    joints: tuple[str, ...]
    inputs: tuple[str, ...]
    channels: tuple[str, ...]

    def modes(self) -> list[Mode]:
        """Modes by rising frequency; of each conjugate pair the one with positive imaginary part."""
        values, vectors = np.linalg.eig(self.A)
        found = []
        for value, vector in zip(values, vectors.T, strict=True):
            if value.imag < 0 or abs(value) < 1e-6:
                continue
            shape = vector[: len(self.joints)]
            largest = shape[np.argmax(np.abs(shape))]
            if abs(largest) == 0.0:
                continue
            frequency, damping = abs(value) / (2 * np.pi), min(1.0, -value.real / abs(value))
            found.append(Mode(float(frequency), float(damping), dict(zip(self.joints, shape / largest, strict=True))))
        return sorted(found, key=lambda mode: mode.frequency)

    def transfer(self, channel: str, weights: dict[str, complex], frequency: np.ndarray) -> np.ndarray:
        """Complex amplitude of a channel per unit of a common excitation, exactly.

        Args:
            channel: e.g. ``body_acceleration``.
            weights: input -> complex weight, e.g. 1 for each road input in phase, ``exp(-i w delay)`` for a delay.
            frequency: (n,) [Hz].

        Raises:
            InputError: no such channel or input.
        """
        for name, known in ((channel, self.channels), *((each, self.inputs) for each in weights)):
            if name not in known:
                raise InputError(f"no '{name}'; {choices(known, name)}", key="transfer")
        row = self.channels.index(channel)
        drive = np.array([weights.get(name, 0.0) for name in self.inputs], complex)
        s = 2j * np.pi * np.asarray(frequency)
        identity = np.eye(len(self.A))
        return np.array(
            [
                self.C[row] @ np.linalg.solve(each * identity - self.A, (self.B[0] + each * self.B[1]) @ drive)
                + (self.D[0, row] + each * self.D[1, row]) @ drive
                for each in s
            ]
        )


def linearise(plant: Plant) -> Linear:
    """Linearise a plant at its static equilibrium by central differences through the compiled callbacks.

    Coulomb friction has no linearisation: with a mount the rod is locked at rest, without one its regularised slope is
    met. Linearise a car without friction (`Vehicle.without_friction`) for the modes that an engineer means.

    Raises:
        InputError, SimulationError: as `static_equilibrium`.
    """
    if plant.car is not None:
        raise InputError(
            f"model {plant.meaning.model} has no modes; choose an oscillation model",
            key="model",
            source=plant.meaning.source,
        )
    model = plant.model
    rest = static_equilibrium(plant)
    entries = plant.entries()
    inputs = len(plant.meaning.inputs)
    sizes = (model.nv, model.nv, model.na)
    states = sum(sizes)

    def evaluate(state: np.ndarray, value: np.ndarray, rate: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        position, velocity, inner = np.split(state, np.cumsum(sizes)[:2])
        rest.qpos[:], rest.qvel[:], rest.act[:] = position, velocity, inner
        _apply(rest, entries, value, rate)
        mujoco.mj_forward(model, rest)
        columns = {
            "qpos": rest.qpos[None],
            "qvel": rest.qvel[None],
            "qacc": rest.qacc[None],
            "actuator_force": rest.actuator_force[None],
            "input": value[None],
            "input_rate": rate[None],
        }
        outputs = np.array([values[0] for _, values in plant.outputs(columns)])
        return np.concatenate([velocity, rest.qacc, rest.act_dot]), outputs

    origin = np.concatenate([rest.qpos, np.zeros(model.nv), rest.act])
    still = np.zeros(inputs)
    columns = states + 2 * inputs
    slopes = []
    for i in range(columns):
        ends = []
        for sign in (1.0, -1.0):
            point = np.zeros(columns)
            point[i] = sign * _STEP
            state, value, rate = np.split(point, [states, states + inputs])
            ends.append(evaluate(origin + state, still + value, still + rate))
        slopes.append([(up - down) / (2 * _STEP) for up, down in zip(*ends, strict=True)])
    derivative = np.column_stack([slope for slope, _ in slopes])
    output = np.column_stack([slope for _, slope in slopes])
    a, b0, b1 = np.split(derivative, [states, states + inputs], axis=1)
    c, d0, d1 = np.split(output, [states, states + inputs], axis=1)
    return Linear(
        a,
        np.array([b0, b1]),
        c,
        np.array([d0, d1]),
        tuple(model.joint(i).name for i in range(model.njnt)),
        tuple(channel_name(place.station, place.quantity) for place in plant.meaning.inputs),
        tuple(channel_name(each.station, each.quantity) for each in plant.meaning.outputs),
    )


def _apply(data: mujoco.MjData, entries: Sequence[tuple[int, int, float]], value: np.ndarray, rate: np.ndarray) -> None:
    """Put input values where the callbacks read them, without an input block."""
    from .elements.law import USERDATA_HEADER

    data.ctrl[:] = 0.0
    data.userdata[:] = 0.0
    for place, actuator, factor in entries:
        data.ctrl[actuator] += factor * value[place]
        data.userdata[USERDATA_HEADER + actuator] += factor * rate[place]
