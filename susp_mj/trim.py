"""Trim: the steady straight running from which a car that drives freely begins a manoeuvre."""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np

from .elements.car import CRUISE_ABOVE, HEAD, SIGNALS, WHEEL, signals_of
from .elements.law import ACTUATOR_MARK
from .equilibrium import check_deflections, rest_states, solve
from .errors import InputError, SimulationError
from .names import CORNERS
from .plant import Plant

_FORCES = 1e3  # N and N m: scale of the inner states that are forces
_SPEEDS = 10.0  # rad/s
_BRISTLE = 2  # which inner state of a wheel is the brake's
_TRIM_ANGLE, _TRIMMING, _GEAR, _SHIFT_BEGAN = (
    SIGNALS.index(name) for name in ("trim_angle", "trimming", "gear", "shift_began")
)
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
    if speed > 0 and plant.meaning.driving and signals_of(data.userdata)[SIGNALS.index("accelerator")] < CREEP:
        raise InputError(
            f"{speed:g} m/s is not allowed; idling in gear the car creeps faster, and nobody brakes", key="speed"
        )
    joints = {travel.station: plant.model.joint(f"{travel.station}_travel") for travel in plant.meaning.travels}
    check_deflections(plant, {station: float(data.qpos[int(joint.qposadr[0])]) for station, joint in joints.items()})
    return data


def _solved(plant: Plant, blocks: Blocks, speed: float) -> tuple[mujoco.MjData, float]:
    """Data at the closest found to steady running, and the largest remaining acceleration [m/s² or rad/s²]."""
    from .compiled import attach_input, install

    install(plant.laws, plant.contacts)
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
        head = dict(zip(HEAD, model.numeric_data[: len(HEAD)], strict=True))
        self.place = np.array([head[f"design_{axis}"] for axis in "xyz"])
        radius = float(model.numeric_data[len(HEAD) + WHEEL.index("radius")])
        self.spin = speed / radius
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
            signals = signals_of(data.userdata)
            signals[_TRIM_ANGLE], signals[_TRIMMING] = v[-1], 1.0
            signals[_GEAR], signals[_SHIFT_BEGAN] = self.gear, -1e3
        else:
            data.qpos[:2] += v[10:12]
        mujoco.mju_euler2Quat(data.qpos[3:7], [roll, pitch, yaw], "XYZ")
        data.qpos[self.travels] = v[4:8]
        data.qpos[self.steers] = v[8:10]
        data.act[self.addresses] = v[14 : 14 + len(self.addresses)]

    def left(self, data: mujoco.MjData) -> np.ndarray:
        """Accelerations and rates that remain."""
        return np.concatenate([data.qacc[self.free], data.act_dot[self.rates] / self.rate_scales])


def _cruising(head: dict[str, float], spin: float) -> tuple[float, float]:
    """Gear in which one cruises, and the engine's speed there [rad/s]; the compiled car chooses by the same rule."""
    gear = int(head["gears"])
    while gear > 1 and spin * head["final_drive"] * head[f"gear_{gear}"] < CRUISE_ABOVE * head["idle_speed"]:
        gear -= 1
    return float(gear), max(spin * head["final_drive"] * head[f"gear_{max(gear, 1)}"], head["idle_speed"])


def remembered(plant: Plant, data: mujoco.MjData) -> dict[int, float]:
    """What the car carries from the trim into the run, by its place among the signals: steering angle and gear."""
    if not plant.contacts:
        return {}
    signals = signals_of(data.userdata)
    return {place: float(signals[place]) for place in (_TRIM_ANGLE, _GEAR, _SHIFT_BEGAN)}


def remind(data: mujoco.MjData, memory: dict[int, float]) -> None:
    """Give the car what it `remembered` back."""
    for place, value in memory.items():
        signals_of(data.userdata)[place] = value


def _state_scale(name: str, k: int) -> float:
    if name == "engine":
        return _SPEEDS
    if name == "speed_target" or (name.endswith("tyre") and k >= 3):
        return _FORCES
    return 1.0


def _cannot_reach(data: mujoco.MjData) -> bool:
    """Whether the controller asks for more than the engine gives."""
    return bool(signals_of(data.userdata)[SIGNALS.index("accelerator")] > 1.0)


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
