"""The quarter car in plain Python and scipy: a second set of equations, tight tolerances, no code of the product.

Deflection x = wheel - body (massless wheel: road - body), positive in compression. The rod deflection y of the damper
is a state: the mount carries ``k1 (x - y)``, and the rod moves only as fast as the damper's inverse characteristic
tells.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

G = 9.81
Curve = Callable[[float], float]


def constant_rate_spring(preload: float, rate: float) -> Curve:
    return lambda x: preload + rate * x


def linear_spring(preload: float, frequency: float) -> Curve:
    return constant_rate_spring(preload, preload / G * (2 * math.pi * frequency) ** 2)


def constant_frequency_spring(preload: float, frequency: float) -> Curve:
    """dF/dx = F w²/g."""
    return lambda x: preload * math.exp((2 * math.pi * frequency) ** 2 * x / G)


def progressive_spring(
    preload: float,
    frequency: float,
    *,
    lower: tuple[float, float],
    upper: tuple[float, float],
    onset: float,
    exponent: float,
) -> Curve:
    """Straight to `lower` (x, F) in rebound, constant frequency to `onset`, then bent up to pass through `upper`."""
    base = constant_frequency_spring(preload, frequency)
    missing = upper[1] - base(upper[0])

    def force(x: float) -> float:
        if x <= 0:
            return preload + (preload - lower[1]) / (0 - lower[0]) * x
        if x <= onset:
            return base(x)
        return base(x) + missing * ((x - onset) / (upper[0] - onset)) ** exponent

    return force


def zoned_damper(
    rates: list[float], limits: list[float], compression: float = 1.0, rebound: float = 1.0
) -> tuple[Curve, Curve]:
    """Characteristic F(v) and its inverse v(F)."""
    share = {1: 2 * compression / (compression + rebound), -1: 2 * rebound / (compression + rebound)}
    edges = [0.0, *limits, math.inf]

    def force(v: float) -> float:
        side, speed, total = (1 if v > 0 else -1), abs(v), 0.0
        for zone, rate in enumerate(rates):
            inside = min(speed, edges[zone + 1]) - edges[zone]
            if inside > 0:
                total += share[side] * rate * inside
        return side * total

    def speed(wanted: float) -> float:
        side, left, v = (1 if wanted > 0 else -1), abs(wanted), 0.0
        for zone, rate in enumerate(rates):
            slope, width = share[side] * rate, edges[zone + 1] - edges[zone]
            if left <= slope * width:
                return side * (v + left / slope)
            v, left = v + width, left - slope * width
        raise AssertionError

    return force, speed


@dataclass(frozen=True)
class QuarterCar:
    """One corner; all in SI. A tyre rate of None stands for a rigid massless wheel that follows the road."""

    sprung: float
    spring: Curve
    damper: tuple[Curve, Curve]
    stops: tuple[float, float, float] = (-0.1, 0.1, 1e7)
    mount: float | None = 400e3
    rod_friction: float = 25.0
    linkage_friction: float = 150.0
    unsprung: float = 39.5
    tyre: float | None = 176e3
    tyre_static: float | None = None
    bilateral: bool = False

    def supporting_force(self, x: float) -> float:
        """Spring held at its value at the stop, plus the stop."""
        low, high, rate = self.stops
        inside = low if x < low else high if x > high else x
        return self.spring(inside) + rate * (x - inside)

    def rod(self, x: float, v: float, y: float) -> tuple[float, float]:
        """Damper force and rod speed."""
        if self.mount is None:
            return self.damper[0](v) + self.rod_friction * 2 / math.pi * math.atan(201.7 * v), v
        force = self.mount * (x - y)
        if abs(force) <= self.rod_friction:
            return force, 0.0
        return force, self.damper[1](math.copysign(abs(force) - self.rod_friction, force))

    def corner(self, x: float, v: float, y: float) -> tuple[float, float]:
        """Total force between wheel and body, and rod speed."""
        damper, rod_speed = self.rod(x, v, y)
        return self.supporting_force(x) + damper + self.linkage_friction * 2 / math.pi * math.atan(201.7 * v), rod_speed

    def tyre_force(self, deflection: float) -> float:
        assert self.tyre is not None
        static = self.tyre_static if self.tyre_static is not None else (self.sprung + self.unsprung) * G
        force = static + self.tyre * deflection
        return force if self.bilateral else max(0.0, force)

    def rates(self, state: np.ndarray, height: float, rate: float) -> tuple[list[float], float]:
        """Time derivative of (z_body, v_body, z_wheel, v_wheel, y) and the wheel load."""
        body, body_speed, wheel, wheel_speed, rod = state
        if self.tyre is None:
            force, rod_speed = self.corner(height - body, rate - body_speed, rod)
            force = max(0.0, force)
            return [body_speed, force / self.sprung - G, rate, 0.0, rod_speed], force
        force, rod_speed = self.corner(wheel - body, wheel_speed - body_speed, rod)
        load = self.tyre_force(height - wheel)
        return [body_speed, force / self.sprung - G, wheel_speed, (load - force) / self.unsprung - G, rod_speed], load

    def at_rest(self) -> list[float]:
        """Equilibrium on a flat road at height 0."""
        x = brentq(lambda each: self.supporting_force(each) - self.sprung * G, -1.0, 1.0, xtol=1e-15)
        wheel = 0.0
        if self.tyre is not None:
            load = (self.sprung + self.unsprung) * G
            wheel = -brentq(lambda d: self.tyre_force(d) - load, -0.5, 0.5, xtol=1e-15)
        return [wheel - x, 0.0, wheel, 0.0, x]


@dataclass(frozen=True)
class Road:
    """Height and rate over time [s]; `kinks` are the instants at which a derivative jumps."""

    height: Callable[[float], float]
    rate: Callable[[float], float]
    kinks: tuple[float, ...] = ()


def bump_road(height: float, length: float, speed: float, start: float) -> Road:
    period = length / speed

    def z(t: float) -> float:
        return height / 2 * (1 - math.cos(2 * math.pi * (t - start) / period)) if start < t < start + period else 0.0

    def dz(t: float) -> float:
        return (
            math.pi * height / period * math.sin(2 * math.pi * (t - start) / period)
            if start < t < start + period
            else 0.0
        )

    return Road(z, dz, (start, start + period))


def step_road(height: float, start: float, rise: float) -> Road:
    def z(t: float) -> float:
        share = min(max((t - start) / rise, 0.0), 1.0)
        return height * math.sin(math.pi / 2 * share) ** 2

    def dz(t: float) -> float:
        return height * math.pi / 2 / rise * math.sin(math.pi * (t - start) / rise) if start < t < start + rise else 0.0

    return Road(z, dz, (start, start + rise))


@dataclass(frozen=True)
class Motion:
    """Solution on an even grid of time."""

    time: np.ndarray
    body: np.ndarray
    acceleration: np.ndarray
    travel: np.ndarray
    load: np.ndarray
    state: np.ndarray


def solve(
    car: QuarterCar, road: Road, duration: float, *, spacing: float = 1e-3, method: str = "LSODA", rtol: float = 1e-9
) -> Motion:
    """Integrate from rest, restarting at every kink of the road."""
    time = np.arange(round(duration / spacing) + 1) * spacing
    states = np.empty((len(time), 5))
    state = np.array(car.at_rest())
    edges = [0.0, *(k for k in road.kinks if 0 < k < duration), time[-1]]
    for begin, end in pairwise(edges):
        inside = (time >= begin) & (time < end) if end < time[-1] else time >= begin
        points = time[inside]
        solution = solve_ivp(
            lambda t, s: car.rates(s, road.height(t), road.rate(t))[0],
            (begin, end),
            state,
            method=method,
            t_eval=points if points[-1] == end else np.append(points, end),
            rtol=rtol,
            atol=rtol / 100,
            max_step=2e-3,
        )
        assert solution.success, solution.message
        states[inside] = solution.y.T[: len(points)]
        state = solution.y[:, -1]
    found = [car.rates(s, road.height(t), road.rate(t)) for t, s in zip(time, states, strict=True)]
    heights = np.array([road.height(t) for t in time])
    wheel = heights if car.tyre is None else states[:, 2]
    return Motion(
        time,
        states[:, 0],
        np.array([rates[1] for rates, _ in found]),
        wheel - states[:, 0],
        np.array([load for _, load in found]),
        states,
    )
