"""Records of `handling.block` at an address, and what travels together through the compiled car."""

from __future__ import annotations

from typing import NamedTuple

from numba import types

from ...handling.block import CAR_SIGNALS, HEAD, SIGNALS, WHEEL, WHEEL_SIGNALS, WHEEL_STATE
from ..memory import doubles, plain, record

head_at = record(HEAD)
_wheel_at = record(WHEEL)
car_signals_at = record(CAR_SIGNALS)
_wheel_signals_at = record(WHEEL_SIGNALS)
wheel_state_at = record(WHEEL_STATE)
HEAD_SIZE, WHEEL_SIZE = HEAD.itemsize, WHEEL.itemsize
CAR_SIGNALS_SIZE, WHEEL_SIGNALS_SIZE, SIGNALS_SIZE = CAR_SIGNALS.itemsize, WHEEL_SIGNALS.itemsize, 8 * len(SIGNALS)


class Pose(NamedTuple):
    """Where the body is and how it moves.

    Attributes:
        rotation: nine numbers by rows, from body to inertial axes.
        origin, velocity: of its centre of gravity, inertial axes.
        turning: angular velocity, inertial axes.
    """

    rotation: tuple[float, ...]
    origin: tuple[float, float, float]
    velocity: tuple[float, float, float]
    turning: tuple[float, float, float]


class Command(NamedTuple):
    """What reaches the wheels of what the driver does.

    Attributes:
        angle, rate: of the steering wheel [rad, rad/s].
        drive: torque [N m] of a driven wheel.
        pedal: of the brake.
    """

    angle: float
    rate: float
    drive: float
    pedal: float


@plain
def wheel_at(base, i):
    """Numbers of a wheel in a car's block."""
    return _wheel_at(base + types.uint64(HEAD_SIZE + WHEEL_SIZE * i))


@plain
def signals_address(model, data):
    """Where the car writes: at the end of `userdata`."""
    return data.userdata + types.uint64(8 * model.nuserdata - SIGNALS_SIZE)


@plain
def wheel_signals_at(signals, i):
    """Signals of a wheel behind those of the car."""
    return _wheel_signals_at(signals + types.uint64(CAR_SIGNALS_SIZE + WHEEL_SIGNALS_SIZE * i))


@plain
def place_of(base, number):
    """Pointer to what lies at a place in the block."""
    return doubles(base + types.uint64(8 * int(number)))


@plain
def input_of(actuator, ctrl):
    """Value of an input by the number of its actuator; 0 where the car has none."""
    number = int(actuator)
    return ctrl[number] if number >= 0 else 0.0
