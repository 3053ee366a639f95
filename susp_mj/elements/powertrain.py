"""Power train: engine map, coupling, gearbox and final drive to an open differential."""

from __future__ import annotations

import math
from typing import Annotated, Any, Literal

from pydantic import Field, model_validator

from ..description import Description, wrong
from ..units import AngularSpeed, Inertia, Moment, Quantity, Time
from .tables import check_length

CRUISE_ABOVE, CRUISE_DOWN = 2.8, 1.2
"""A car that begins to run cruises in the highest gear in which the engine turns so many times faster than idling, and
with the accelerator released it shifts down below the second."""
LIMITER_WIDTH = 0.03
"""The limiter takes the torque away while the engine's speed exceeds the map's last by this share."""
SHIFT_OPEN, MATCHING_TIME = 0.6, 0.05
"""Share of a shift for which the drive is open, and the time [s] in which the engine is brought to the speed of the new
gear."""
SHORTEST_SHIFT = 1e-3
"""Time [s] from one shift to the next at least."""
LONG_AGO = -1e3


def cruising_gear(car: Any, shaft_speed: float) -> int:
    """Highest gear in which the engine, at a speed of the shaft [rad/s], turns `CRUISE_ABOVE` times as fast as idle."""
    gear = int(car.gears)
    while gear > 1 and shaft_speed * car.ratios[gear - 1] < CRUISE_ABOVE * car.idle_speed:
        gear -= 1
    return gear


def shifted_gear(car: Any, signals: Any, time: float, shaft_speed: float, accelerator: float) -> int:
    """Gear at a speed of the propeller shaft [rad/s]; remembers gear and the beginning of a shift. The first call
    chooses a gear to cruise in.

    The speed is that of wheels which roll: neither a locked wheel nor a spinning one shifts the box. The accelerator is
    that of the manoeuvre: released, as under braking or with the speed controller in charge, the gear is held as long
    as the engine can turn in it; floored, `shift_down` holds; between, the threshold lies between.

    Args:
        car: with `gears`, `ratios`, `idle_speed`, `shift_up`, `shift_down` and `shift_time`.
        signals: with `gear`, `shift_began` and `trimming`.
    """
    count, gear = int(car.gears), int(signals.gear)
    if gear < 1 or gear > count:
        gear = cruising_gear(car, shaft_speed)
        signals.shift_began = LONG_AGO
    elif signals.trimming == 0.0 and time - signals.shift_began > max(car.shift_time, SHORTEST_SHIFT):
        engine_side = shaft_speed * car.ratios[gear - 1]
        least = CRUISE_DOWN * car.idle_speed
        below = least + min(max(accelerator, 0.0), 1.0) * max(car.shift_down - least, 0.0)
        if engine_side > car.shift_up and gear < count:
            gear += 1
            signals.shift_began = time
        elif engine_side < below and gear > 1:
            gear -= 1
            signals.shift_began = time
    signals.gear = gear
    return gear


def engine_torque(car: Any, speed: float, pedal: float, full: float, drag: float) -> float:
    """Torque of the engine [N m] with limiter and idle governor.

    Args:
        car: with `engine_limit`, `idle_speed`, `idle_gain` and `idle_torque`.
        speed: of the engine [rad/s].
        pedal: accelerator.
        full, drag: torque at full and at no accelerator [N m].
    """
    limiter = 1.0 - min(max((speed / car.engine_limit - 1.0) / LIMITER_WIDTH, 0.0), 1.0)
    idle = min(max(car.idle_gain * (car.idle_speed - speed), 0.0), car.idle_torque)
    return drag + limiter * pedal * (full - drag) + idle


def passed_torque(car: Any, signals: Any, time: float, engine_speed: float, input_speed: float, torque: float) -> float:
    """Torque [N m] that the coupling passes on; writes the rate of the engine's speed.

    A converter at standstill, locked up by a viscous clutch once the shaft turns faster than idling; a shift opens
    both, and until they close again the engine is brought to the shaft's speed.

    Args:
        car: with `idle_speed`, `shift_time`, `converter`, `coupling`, `coupling_limit` and `engine_inertia`.
        signals: with `shift_began`; `engine_rate` is written.
        engine_speed, input_speed: before and behind the coupling [rad/s].
        torque: of the engine [N m].
    """
    lock = min(max(2.0 * input_speed / car.idle_speed - 1.6, 0.0), 1.0)
    since = (time - signals.shift_began) / max(car.shift_time, SHORTEST_SHIFT)
    closed = min(max((since - SHIFT_OPEN) / (1.0 - SHIFT_OPEN), 0.0), 1.0)
    slip = engine_speed - input_speed
    passed = closed * (car.converter * max(engine_speed, 0.0) + lock * car.coupling) * slip
    passed = min(max(passed, -car.coupling_limit), car.coupling_limit)
    matched = (max(input_speed, car.idle_speed) - engine_speed) / MATCHING_TIME
    signals.engine_rate = closed * (torque - passed) / car.engine_inertia + (1.0 - closed) * matched
    return passed


def _rpm(speed: float) -> str:
    """A speed [rad/s] as an error text has it."""
    return f"{speed * 30 / math.pi:.5g} 1/min"


class Powertrain(Description):
    """Engine, viscous coupling, gearbox with shifts by engine speed, final drive, open differential on one axle.

    The engine gives ``T = drag + a (full - drag)`` at accelerator a = 0..1, both interpolated over its speed. Through
    the coupling passes ``coupling (w_engine - i w_wheels)`` with ``i = gear ratio * final_drive`` and w_wheels the mean
    speed of the driven wheels, of which each gets ``efficiency i / 2`` times the torque (power flowing to the engine is
    divided by the efficiency).

    Shifts: up when the engine runs faster than `shift_up`, down when slower than `shift_down`. So that the box does not
    hunt, the speed after a shift down, ``shift_down * gear / next gear``, must stay below `shift_up` for every pair of
    gears (the same condition keeps the speed after a shift up above `shift_down`).

    Attributes:
        driven: axle that is driven.
        speed: engine speeds [rad/s], (n,) strictly increasing, 0 at least.
        full_torque: torque [N m] at full accelerator, (n,).
        drag_torque: torque [N m] at no accelerator, (n,), 0 or below and below the full torque.
        inertia: of engine and coupling about the crankshaft [kg m²].
        idle_speed: [rad/s], held by the idle governor; within the speeds.
        coupling: viscous rate of the start-up coupling or converter [N m s/rad].
        gears: ratios engine/propeller shaft, strictly decreasing from the first gear.
        final_drive: ratio propeller shaft/wheels.
        efficiency: from the coupling to the wheels, above 0 to 1.
        shift_up, shift_down: [rad/s], idle_speed <= shift_down < shift_up <= highest speed of the map.
        shift_time: duration of a shift [s], torque interrupted.
    """

    driven: Literal["rear", "front"]
    speed: tuple[Annotated[float, Quantity("rad/s", ge=0)], ...] = Field(max_length=200)
    full_torque: tuple[Moment, ...] = Field(max_length=200)
    drag_torque: tuple[Annotated[float, Quantity("N m", le=0)], ...] = Field(max_length=200)
    inertia: Inertia
    idle_speed: Annotated[float, Quantity("rad/s", gt=0)]
    coupling: Annotated[float, Quantity("N m s/rad", gt=0)]
    gears: tuple[Annotated[float, Quantity("", gt=0)], ...] = Field(max_length=20)
    final_drive: Annotated[float, Quantity("", gt=0)]
    efficiency: Annotated[float, Quantity("", gt=0, le=1)]
    shift_up: AngularSpeed
    shift_down: AngularSpeed
    shift_time: Time

    @model_validator(mode="after")
    def _engine_map(self) -> Powertrain:
        if len(self.speed) < 2:
            raise wrong(f"{list(self.speed)} is not allowed; give two speeds at least", "speed")
        for i in range(1, len(self.speed)):
            if self.speed[i] <= self.speed[i - 1]:
                raise wrong(
                    f"{_rpm(self.speed[i])} follows {_rpm(self.speed[i - 1])}; the torque map must increase "
                    "strictly in speed",
                    f"speed.{i}",
                )
        check_length(self.full_torque, "full_torque", self.speed, "speed")
        check_length(self.drag_torque, "drag_torque", self.speed, "speed")
        for i, (full, drag) in enumerate(zip(self.full_torque, self.drag_torque, strict=True)):
            if full <= drag:
                raise wrong(
                    f"{full:g} N m is not allowed; it must be above the drag torque of {drag:g} N m", f"full_torque.{i}"
                )
        if not self.speed[0] <= self.idle_speed < self.speed[-1]:
            raise wrong(
                f"{_rpm(self.idle_speed)} is not allowed; the torque map reaches from {_rpm(self.speed[0])} to "
                f"{_rpm(self.speed[-1])}",
                "idle_speed",
            )
        return self

    @model_validator(mode="after")
    def _shifts(self) -> Powertrain:
        if not self.gears:
            raise wrong("[] is not allowed; give one ratio at least", "gears")
        for i in range(1, len(self.gears)):
            if self.gears[i] >= self.gears[i - 1]:
                raise wrong(
                    f"{self.gears[i]:g} follows {self.gears[i - 1]:g}; the ratios must decrease strictly", f"gears.{i}"
                )
        if not self.shift_up <= self.speed[-1]:
            raise wrong(
                f"{_rpm(self.shift_up)} is not allowed; the torque map ends at {_rpm(self.speed[-1])}", "shift_up"
            )
        if not self.idle_speed <= self.shift_down < self.shift_up:
            raise wrong(
                f"{_rpm(self.shift_down)} is not allowed; it must be at least idle_speed, {_rpm(self.idle_speed)}, "
                f"and below shift_up, {_rpm(self.shift_up)}",
                "shift_down",
            )
        for lower, higher in zip(self.gears, self.gears[1:], strict=False):
            after = self.shift_down * lower / higher
            if after >= self.shift_up:
                raise wrong(
                    f"{_rpm(self.shift_down)} is not allowed; the shift from ratio {higher:g} to {lower:g} ends at "
                    f"{_rpm(after)}, which must be below shift_up, {_rpm(self.shift_up)}, or the gearbox hunts",
                    "shift_down",
                )
        return self
