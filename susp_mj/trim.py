"""Trim: the steady straight running from which a car that drives freely begins a manoeuvre."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np

from .elements.law import ACTUATOR_MARK
from .elements.powertrain import LONG_AGO, cruising_gear
from .equilibrium import check_deflections, rest_states, solve
from .errors import InputError, SimulationError
from .handling.block import WHEEL_STATE, car_signals_of, names_of
from .names import CORNERS
from .plant import Plant

_FORCES = 1e3  # N and N m: scale of the inner states that are forces
_SPEEDS = 10.0  # rad/s
_BRISTLE = names_of(WHEEL_STATE).index("bristle")
SETTLED = 1e-6
"""Largest acceleration that counts as none [m/s² or rad/s²]."""
CREEP = -0.05
"""Accelerator below which the car, idling in gear, creeps faster than it shall go."""
TOP_SPEED_WITHIN = 0.1
"""Accuracy of the top speed that an error names [m/s]."""


@dataclass(frozen=True)
class Blocks:
    """What the compiled code reads while a car runs; kept alive here. See `compiled.attach_input`."""

    inputs: np.ndarray
    road: np.ndarray | None = None
    driver: np.ndarray | None = None


def trimmed(plant: Plant, blocks: Blocks, speed: float) -> mujoco.MjData:
    """Data of the car running straight along x at a steady speed, its front axle at x = 0: nothing accelerates, inner
    states rest.

    Solved for: height, roll, pitch and heading of the body, travels, steering, wheel speeds, the inner states of tyres
    and engine, the controller's force, and the steering wheel angle that keeps it straight.

    Args:
        blocks: inputs, held at their first value, and road.
        speed: [m/s].

    Raises:
        InputError: the car cannot go that fast or that slowly, or cannot carry its load.
        SimulationError: no steady running found.
    """
    data, residual = _solved(plant, blocks, speed)
    if speed > 0 and plant.meaning.driving and (not residual < SETTLED or _cannot_reach(data)):
        top = _top_speed(plant, blocks, speed)
        if 0 < top < speed - TOP_SPEED_WITHIN:
            raise InputError(
                f"{speed:.4g} m/s ({3.6 * speed:.1f} km/h) is not allowed; the car goes {top:.1f} m/s "
                f"({3.6 * top:.0f} km/h) at most",
                key="speed",
            )
    if not residual < SETTLED:
        raise SimulationError(
            f"{plant.meaning.source}: load '{plant.meaning.load}' has no steady straight running at {speed:g} m/s "
            f"in model {plant.meaning.model}; check preloads, sprung mass and tyres"
        )
    if speed > 0 and plant.meaning.driving and car_signals_of(data.userdata).accelerator < CREEP:
        raise InputError(
            f"{speed:g} m/s is not allowed; idling in gear the car creeps faster, and nobody brakes", key="speed"
        )
    joints = {travel.station: plant.model.joint(f"{travel.station}_travel") for travel in plant.meaning.travels}
    check_deflections(plant, {station: float(data.qpos[int(joint.qposadr[0])]) for station, joint in joints.items()})
    return data


def _solved(plant: Plant, blocks: Blocks, speed: float) -> tuple[mujoco.MjData, float]:
    """Data at the closest found to steady running, and the largest remaining acceleration [m/s² or rad/s²]."""
    from .compiled import attach_input, install

    install(plant.laws)
    model = plant.model
    unknowns = _Unknowns(plant, speed)
    data = mujoco.MjData(model)
    attach_input(data, blocks.inputs, blocks.road, None)
    own = _own_actuators(model)

    def residual(values: np.ndarray) -> np.ndarray:
        unknowns.enter(data, values)
        rest_states(model, data, own)
        return unknowns.left(data)

    values = solve(residual, unknowns.start(), SETTLED / 1e4)
    return data, float(np.max(np.abs(residual(values))))


def _own_actuators(model: mujoco.MjModel) -> np.ndarray:
    """Force elements with an inner state, which rests where it equals the deflection."""
    return np.flatnonzero((model.actuator_actadr >= 0) & (model.actuator_user[:, 0] == ACTUATOR_MARK))


class _Unknowns:
    """Which numbers of mjData are solved for, and which accelerations and rates must vanish."""

    def __init__(self, plant: Plant, speed: float) -> None:
        model = plant.model
        self.speed, self.driving = speed, plant.meaning.driving
        joint = model.joint
        self.travels = [int(joint(f"{corner}_travel").qposadr[0]) for corner in CORNERS]
        self.steers = [int(joint(f"{corner}_steer").qposadr[0]) for corner in CORNERS[:2]]
        self.spins = [int(joint(f"{corner}_spin").dofadr[0]) for corner in CORNERS]
        cars = np.flatnonzero((model.actuator_actadr >= 0) & (model.actuator_user[:, 0] != ACTUATOR_MARK))
        names = {int(i): model.actuator(int(i)).name for i in cars}
        self.states = [
            (int(model.actuator_actadr[i]) + k, names[int(i)], k)
            for i in cars
            for k in range(int(model.actuator_actnum[i]))
            if names[int(i)] != "driver" and self.driving
        ]
        self.free = np.setdiff1d(np.arange(model.nv), [] if self.driving else self.spins)
        assert plant.car is not None
        head = plant.car.head
        self.place = np.array([head[f"design_{axis}"] for axis in "xyz"])
        self.spin = speed / float(plant.car.wheels[0].radius)
        self.gear, self.engine = _cruising(head, self.spin)

        state_scales = [_state_scale(name, k) for _, name, k in self.states]
        spins = [_SPEEDS] * 4 if self.driving else [1.0, 1.0]
        self.scales = np.array([*[1.0] * 10, *spins, *state_scales, *([1.0] if self.driving else [])])
        self.addresses = [address for address, _, _ in self.states]
        kept = [i for i, (_, name, _) in enumerate(self.states) if name != "speed_target"]
        self.rates = [self.addresses[i] for i in kept]
        self.rate_scales = np.array([state_scales[i] for i in kept])

    def start(self) -> np.ndarray:
        """First guess: level, wheels rolling."""
        sliding = float(self.speed > 0)
        states = [
            self.engine / _SPEEDS if name == "engine" else sliding if name.endswith("tyre") and k == _BRISTLE else 0.0
            for _, name, k in self.states
        ]
        spins = [self.spin / _SPEEDS] * 4 if self.driving else [0.0, 0.0]
        return np.array([*[0.0] * 10, *spins, *states, *([0.0] if self.driving else [])])

    def enter(self, data: mujoco.MjData, values: np.ndarray) -> None:
        """Put the unknowns into the data."""
        v = values * self.scales
        data.qpos[:], data.qvel[:] = 0.0, 0.0
        data.qpos[:3] = self.place
        data.qpos[2] += v[0]
        roll, pitch, yaw = v[1:4]
        if self.driving:
            data.qvel[0] = self.speed
            data.qvel[self.spins] = v[10:14]
            signals = car_signals_of(data.userdata)
            signals.trim_angle, signals.trimming = v[-1], 1.0
            signals.gear, signals.shift_began = self.gear, LONG_AGO
        else:
            data.qpos[:2] += v[10:12]
        mujoco.mju_euler2Quat(data.qpos[3:7], [roll, pitch, yaw], "XYZ")
        data.qpos[self.travels] = v[4:8]
        data.qpos[self.steers] = v[8:10]
        data.act[self.addresses] = v[14 : 14 + len(self.addresses)]

    def left(self, data: mujoco.MjData) -> np.ndarray:
        """Accelerations and rates that remain."""
        return np.concatenate([data.qacc[self.free], data.act_dot[self.rates] / self.rate_scales])


def _cruising(head: Any, spin: float) -> tuple[float, float]:
    """Gear in which one cruises, and the engine's speed there [rad/s]."""
    shaft = spin * head.final_drive
    gear = cruising_gear(head, shaft)
    return float(gear), max(shaft * head.ratios[gear - 1], head.idle_speed)


def remembered(plant: Plant, data: mujoco.MjData) -> dict[str, float]:
    """What the car carries from the trim into the run, by the signal's name: steering angle and gear."""
    if plant.car is None:
        return {}
    signals = car_signals_of(data.userdata)
    return {name: float(signals[name]) for name in ("trim_angle", "gear", "shift_began")}


def remind(data: mujoco.MjData, memory: dict[str, float]) -> None:
    """Give the car what it `remembered` back."""
    for name, value in memory.items():
        car_signals_of(data.userdata)[name] = value


def _state_scale(name: str, k: int) -> float:
    if name == "engine":
        return _SPEEDS
    if name == "speed_target" or (name.endswith("tyre") and k >= 3):
        return _FORCES
    return 1.0


def _cannot_reach(data: mujoco.MjData) -> bool:
    """Whether the controller asks for more than the engine gives."""
    return bool(car_signals_of(data.userdata).accelerator > 1.0)


def _top_speed(plant: Plant, blocks: Blocks, too_fast: float) -> float:
    """Largest speed with steady running below one that is too fast [m/s]."""
    low, high = 0.0, too_fast
    while high - low > TOP_SPEED_WITHIN:
        middle = (low + high) / 2
        data, residual = _solved(plant, blocks, middle)
        if residual < SETTLED and not _cannot_reach(data):
            low = middle
        else:
            high = middle
    return low
