"""Speed controller of a car that drives freely: the accelerator that a manoeuvre leaves to it."""

from __future__ import annotations

from typing import Any

HOLD_PEDAL = 0.3
"""Brake pedal with which the controller holds the car where its target is zero."""
PARKED, CREEPING = 0.01, 0.5
"""Target [m/s] below which the car shall stand, and speed [m/s] below which the brake then holds it."""
WIND_UP = 1.2
"""Accelerator beyond which, and as far below zero, the integral waits."""


def controlled_pedal(
    car: Any,
    signals: Any,
    demanded: float,
    target: float,
    weight: float,
    speed: float,
    integral: float,
    radius: float,
    reduction: float,
    full: float,
    drag: float,
) -> float:
    """Accelerator: the manoeuvre's, and on it the controller's ``weight (T - drag)/(full - drag)``.

    The force ``F = gain (target - speed) + integral`` [N] asks the engine for ``T = F radius/reduction`` [N m]. Its
    integral grows by ``control_integral (target - speed)`` unless the engine is at an end of what it can give. While
    the car is trimmed the pedal knows no limits, and the speed it has is the target.

    Args:
        car: with `control_gain`, `control_integral`.
        signals: with `trimming`; `control_force`, `control_rate` and `brake_pedal` are written.
        demanded: accelerator of the manoeuvre, 0 to 1.
        target, weight: speed [m/s] to hold, and the share with which the controller acts.
        speed: [m/s].
        integral: inner state [N].
        radius, reduction: of the driven wheels [m], and their torque per torque of the engine.
        full, drag: torque of the engine at full and at no accelerator [N m].
    """
    trimming = signals.trimming != 0.0
    pedal = demanded
    if trimming:
        target, weight, pedal = speed, 1.0, 0.0
    if weight > 0.0:
        error = target - speed
        force = car.control_gain * error + integral
        wanted = (force * radius / reduction - drag) / (full - drag)
        pedal += weight * (min(max(wanted, 0.0), 1.0) if not trimming else wanted)
        winding = (wanted > WIND_UP and error > 0.0) or (wanted < 1.0 - WIND_UP and error < 0.0)
        signals.control_force = force
        if not winding:
            signals.control_rate = weight * car.control_integral * error
        if target < PARKED and abs(speed) < CREEPING:
            signals.brake_pedal = max(signals.brake_pedal, weight * HOLD_PEDAL)
            signals.control_rate = 0.0
            pedal = 0.0 if trimming else demanded
    return pedal if trimming else min(max(pedal, 0.0), 1.0)
