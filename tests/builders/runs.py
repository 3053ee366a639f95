"""Made-up runs: of channels as given, and of a car that drives freely, of which everything is known in closed form."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.signal import lsim

from evaluation.compare import Comparison, Configuration
from evaluation.numbers import NUMBERS, evaluate
from susp_mj.features import as_json
from susp_mj.manoeuvre import Manoeuvre
from susp_mj.meaning import Input
from susp_mj.names import CORNERS, QUANTITIES
from susp_mj.run import Channel, Run, described

_ZERO = (
    *(
        "position_x",
        "position_y",
        "yaw_angle",
        "yaw_rate",
        "side_slip_angle",
        "rear_side_slip_angle",
        "lateral_acceleration",
    ),
    *("longitudinal_acceleration", "body_displacement", "body_acceleration", "roll_angle", "pitch_angle"),
)
STATIC = {"fl": 5500.0, "fr": 5500.0, "rl": 5000.0, "rr": 5000.0}


def run_of(time: np.ndarray, channels: Mapping[str, Any], meta: Mapping[str, Any] | None = None) -> Run:
    """A run of channels by full name (``fl_wheel_load``); a number stands for a channel that does not change."""
    return Run(time, {name: _channel(name, values, time) for name, values in channels.items()}, meta or {})


def changed(run: Run, **channels: Any) -> Run:
    """The run with other channels in place of its own, or beside them."""
    return replace(run, channels={**run.channels, **run_of(run.time, channels).channels})


def without(run: Run, *names: str) -> Run:
    """The run less some channels."""
    return replace(run, channels={name: each for name, each in run.channels.items() if name not in names})


def _channel(name: str, values: Any, time: np.ndarray) -> Channel:
    quantity = name if name in QUANTITIES else name.partition("_")[2]
    station = name.removesuffix(quantity).removesuffix("_")
    return described(quantity, np.broadcast_to(np.asarray(values, float), time.shape).copy(), station)


def driven(manoeuvre: Manoeuvre, quantity: str, time: np.ndarray) -> np.ndarray:
    """What a manoeuvre does to an input of the car."""
    found = manoeuvre.drive(Input(quantity, "", 0.0, 0.0, ()), time)
    return np.zeros_like(time) if found is None else found[0]


def made_up(
    manoeuvre: Manoeuvre, time: np.ndarray, facts: dict[str, float] | None = None, **channels: np.ndarray
) -> Run:
    """A run of a freely driving car; channels that are not given are zero, wheel loads static. Names with a station are
    per wheel."""
    values = dict.fromkeys(_ZERO, 0.0 * time)
    values |= {
        name: driven(manoeuvre, name, time) for name in ("steering_wheel_angle", "accelerator", "brake_pedal", "wind_y")
    }
    values["speed"] = np.full_like(time, manoeuvre.driving_speed())
    for corner in CORNERS:
        values[f"{corner}_wheel_load"] = np.full_like(time, STATIC[corner])
        values |= {f"{corner}_{quantity}": 0.0 * time for quantity in ("suspension_deflection", "road_height")}
        values[f"{corner}_wheel_speed"] = values["speed"] / 0.33
    values |= channels | manoeuvre.record(time)
    road = manoeuvre.road()
    meta = {
        "title": manoeuvre.kind,
        "vehicle": "made up",
        "load": "ko",
        "model": "handling",
        "car": "rig" if manoeuvre.rig == "k_and_c" else "handling",
        "manoeuvre": manoeuvre.model_dump(mode="json"),
        "character": manoeuvre.declared().plain(),
        "travel": {corner: [-0.1, 0.09] for corner in CORNERS},
        "facts": {**Bicycle().facts, **(facts or {})},
        "road": {"features": [] if road is None else as_json(road.shown)},
        "step": 1e-3,
        "versions": {"susp_mj": "0", "mujoco": "0"},
    }
    return run_of(time, values, meta)


def titled(manoeuvre: Manoeuvre) -> Run:
    """A run of a manoeuvre without channels."""
    meta = {"manoeuvre": manoeuvre.model_dump(mode="json"), "character": manoeuvre.declared().plain()}
    return Run(np.array([0.0, 1e-3]), {}, meta)


@dataclass(frozen=True)
class Bicycle:
    """Linear bicycle model with roll of second order and a lateral load transfer in proportion to the lateral
    acceleration."""

    mass: float = 2140.0
    inertia: float = 4400.0
    front: float = 1.55
    rear: float = 1.53
    front_stiffness: float = 110e3
    rear_stiffness: float = 150e3
    ratio: float = 17.0
    track: float = 1.4
    height: float = 0.58
    front_share: float = 0.62
    roll_gradient: float = 0.0125
    roll_frequency: float = 1.6
    roll_damping: float = 0.35

    @property
    def wheelbase(self) -> float:
        return self.front + self.rear

    @property
    def facts(self) -> dict[str, float]:
        return {
            "wheelbase": self.wheelbase,
            "track_front": self.track,
            "track_rear": self.track,
            "steering_ratio": self.ratio,
            "cg_x": -self.front,
            "cg_height": self.height,
            "sprung_mass": 1913.0,
            "wheel_radius_front": 0.33,
            "wheel_radius_rear": 0.33,
        }

    @property
    def understeer(self) -> float:
        """EG [rad/(m/s²)]."""
        return self.mass / self.wheelbase * (self.rear / self.front_stiffness - self.front / self.rear_stiffness)

    def matrices(self, speed: float) -> tuple[np.ndarray, np.ndarray]:
        """A and B of the states side slip and yaw rate for the angle of the front wheels."""
        cf, cr, lf, lr, m, j = self.front_stiffness, self.rear_stiffness, self.front, self.rear, self.mass, self.inertia
        a = [
            [-(cf + cr) / (m * speed), -1 - (cf * lf - cr * lr) / (m * speed**2)],
            [-(cf * lf - cr * lr) / j, -(cf * lf**2 + cr * lr**2) / (j * speed)],
        ]
        return np.array(a), np.array([[cf / (m * speed)], [cf * lf / j]])

    def transfer(self, frequency: np.ndarray, speed: float) -> dict[str, np.ndarray]:
        """Exact complex ratios per steering wheel angle."""
        a, b = self.matrices(speed)
        s = 2j * np.pi * np.asarray(frequency)
        states = np.array([np.linalg.solve(each * np.eye(2) - a, b)[:, 0] for each in s]).T / self.ratio
        slip, yaw = states
        acceleration = speed * (s * slip + yaw)
        w = 2 * np.pi * self.roll_frequency
        roll = acceleration * self.roll_gradient * w**2 / (s**2 + 2 * self.roll_damping * w * s + w**2)
        return {
            "side_slip_angle": slip,
            "yaw_rate": yaw,
            "lateral_acceleration": acceleration,
            "roll_angle": roll,
            "rear_side_slip_angle": slip - self.rear * yaw / speed,
        }

    def run(self, manoeuvre: Manoeuvre, steering: np.ndarray | None = None, **more: np.ndarray) -> Run:
        """The model under a manoeuvre's steering, exact between records of a straight line of the steering."""
        time = np.arange(round(manoeuvre.duration * 1000) + 1) * 1e-3
        speed = manoeuvre.driving_speed()
        steering = driven(manoeuvre, "steering_wheel_angle", time) if steering is None else steering
        a, b = self.matrices(speed)
        _, states, _ = lsim((a, b, np.eye(2), np.zeros((2, 1))), steering / self.ratio, time)
        slip, yaw_rate = states.T
        acceleration = speed * ((a @ states.T)[0] + b[0, 0] * steering / self.ratio + yaw_rate)
        w = 2 * np.pi * self.roll_frequency
        _, roll, _ = lsim(([self.roll_gradient * w**2], [1, 2 * self.roll_damping * w, w**2]), acceleration, time)
        yaw = np.concatenate([[0.0], np.cumsum((yaw_rate[1:] + yaw_rate[:-1]) / 2 * 1e-3)])
        velocity = speed * np.exp(1j * (yaw + slip))
        place = np.concatenate([[0.0], np.cumsum((velocity[1:] + velocity[:-1]) / 2 * 1e-3)])
        moment = self.mass * self.height * acceleration / self.track
        channels = {}
        for corner in CORNERS:
            side = -1.0 if corner.endswith("l") else 1.0
            share = self.front_share if corner.startswith("f") else 1 - self.front_share
            channels[f"{corner}_wheel_load"] = np.maximum(STATIC[corner] + side * share * moment, 0.0)
            channels[f"{corner}_suspension_deflection"] = side * self.track / 2 * roll
        channels |= dict(
            steering_wheel_angle=steering,
            side_slip_angle=slip,
            rear_side_slip_angle=slip - self.rear * yaw_rate / speed,
            yaw_rate=yaw_rate,
            yaw_angle=yaw,
            lateral_acceleration=acceleration,
            roll_angle=roll,
            pitch_angle=0.1 * np.abs(roll),
            body_displacement=0.02 * np.abs(roll),
            position_x=place.real - self.front,
            position_y=place.imag,
        )
        return made_up(manoeuvre, time, self.facts, **channels, **more)


def compared(
    *runs: Run, names: tuple[str, ...] = ("configuration 3", "configuration 4", "configuration 5")
) -> Comparison:
    """Made-up runs side by side with every number."""
    configurations = [
        Configuration(name, "made up", run, evaluate(run, tuple(NUMBERS)))
        for name, run in zip(names[: len(runs)], runs, strict=True)
    ]
    applying = [name for name in NUMBERS if any(each.numbers[name].applies for each in configurations)]
    kept = [
        Configuration(each.name, each.title, each.run, {n: each.numbers[n] for n in applying})
        for each in configurations
    ]
    return Comparison("Handling", "Made-up runs.", kept)
