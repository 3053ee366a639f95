"""The car that drives freely against equations of motion written down a second time (`reference_handling`)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from susp_mj.run import Run
from susp_mj.simulation import simulate
from vehicles.mjcf import HANDLING, build
from vehicles.reading import load_vehicle

from ..builders.manoeuvres import Driven
from .reference_handling import WHEELS, ReferenceCar, recorded_gears

BODY = ("yaw_rate", "lateral_acceleration", "longitudinal_acceleration", "speed", "side_slip_angle", "roll_angle",
    "pitch_angle",
        "body_displacement", "engine_speed")  # fmt: skip
WHEEL = ("wheel_load", "suspension_deflection", "slip_angle", "slip_ratio", "longitudinal_force", "lateral_force",
    "aligning_moment",
         "wheel_speed")  # fmt: skip
CARS = {"s_class": ("configuration_4", 1.10), "bmw_320i": (None, 1.10)}
"""Characteristics, and the angle of the steering wheel [rad] that gives about 5 m/s² at 20 m/s."""
WITHIN = 2.5e-3
"""Largest difference of a channel over its range. The car looks its toe and camber up in rows of 5° of steering, with
straight lines between them, and leaves out what little work the tyre's moments do on their change with steering: both
tell where the tables are bent."""


@dataclass(frozen=True)
class Case:
    """The same manoeuvre twice."""

    run: Run
    reference: dict[str, np.ndarray]

    def worst(self, names: tuple[str, ...]) -> dict[str, float]:
        """Largest difference of each channel as a share of its range."""
        return {
            name: float(np.abs(self.run[name] - self.reference[name]).max() / np.ptp(self.run[name])) for name in names
        }


def _both(car: str, speed: float, duration: float, **inputs: list[tuple[float, float]]) -> Case:
    vehicle = load_vehicle(car, CARS[car][0])
    run = simulate(build(vehicle, HANDLING), Driven(duration=duration, speed=speed, inputs=inputs))
    reference = ReferenceCar(vehicle)
    assert vehicle.powertrain is not None
    reference.gear = recorded_gears(run.time, run["gear"], vehicle.powertrain.gears)
    controlled = {"speed_target": [(0.0, speed)], "speed_control": [(0.0, 1.0)]}
    return Case(run, reference.drive_along(speed, duration, {**controlled, **inputs}))


@pytest.fixture(scope="module", params=CARS)
def step_steer(request) -> Case:
    angle = CARS[request.param][1]
    return _both(request.param, 20.0, 2.0, steering_wheel_angle=[(0.2, 0.0), (0.35, angle)])


@pytest.fixture(scope="module", params=CARS)
def braking_in_turn(request) -> Case:
    angle = CARS[request.param][1]
    return _both(
        request.param,
        20.0,
        2.2,
        steering_wheel_angle=[(0.2, 0.0), (0.5, 0.8 * angle)],
        brake_pedal=[(1.0, 0.0), (1.2, 0.22)],
        speed_control=[(0.0, 1.0), (1.0, 1.0), (1.001, 0.0)],
    )


def _every_wheels(quantities: tuple[str, ...]) -> tuple[str, ...]:
    return tuple(f"{wheel}_{quantity}" for quantity in quantities for wheel in WHEELS)


def test_step_steer(step_steer):
    """Every channel over two seconds, as a share of its range."""
    assert 4.5 < step_steer.run["lateral_acceleration"].max() < 7.0
    off = {name: share for name, share in step_steer.worst((*BODY, *_every_wheels(WHEEL))).items() if share > WITHIN}
    assert not off


def test_braking_in_a_turn(braking_in_turn):
    """Every channel over two seconds, as a share of its range; the tyres slip both ways at once, and the gearbox shifts
    down."""
    run = braking_in_turn.run
    assert run["lateral_acceleration"].max() > 4.0
    assert run["longitudinal_acceleration"].min() < -3.0
    off = {
        name: share for name, share in braking_in_turn.worst((*BODY, *_every_wheels(WHEEL))).items() if share > WITHIN
    }
    assert not off


def test_steady_running_before_it(step_steer):
    """The reference finds its own steady straight running, at the same wheel loads, travels, slips and engine speed."""
    for name in (*BODY, *_every_wheels(WHEEL)):
        run, reference = step_steer.run[name][0], step_steer.reference[name][0]
        assert reference == pytest.approx(run, rel=1e-4, abs=1e-6), name
