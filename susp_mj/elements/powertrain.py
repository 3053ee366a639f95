"""Power train: engine map, coupling, gearbox and final drive to an open differential."""

from __future__ import annotations

import math
from typing import Annotated, Literal

from pydantic import Field, model_validator

from ..description import Description, wrong
from ..units import AngularSpeed, Inertia, Moment, Quantity, Time
from .tables import check_length


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
