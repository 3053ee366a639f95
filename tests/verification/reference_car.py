"""Cars of one axle, one side or four wheels in plain Python and scipy: a second set of equations, no code of the
product.

Small angles, written down from the balance of forces and moments. Body: height z of its centre of gravity, pitch (nose
down) and roll (left side up), each free or locked; a point at (x, y) from the centre of gravity has the height ``z + y
roll - x pitch``.
Wheels: massless on the road, or with mass on tyre springs; guided each for itself, or in pairs by a beam that carries
the springs at the spring base and the bar as a moment ``c t²/2`` per difference of roll angles. A lateral acceleration
acts on the body at its centre of gravity; the links pass each axle's share to the wheels at the height of the roll
centre.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import root

from .reference import Curve, G, QuarterCar, Road

FREEDOMS = {
    "quarter_1dof": "z",
    "axle_2dof": "z roll",
    "pitch_2dof": "z pitch",
    "full_3dof": "z pitch roll",
    "quarter_2dof": "z",
    "axle_4dof": "z roll",
    "full_7dof": "z pitch roll",
}
SPRUNG_WHEELS = ("quarter_2dof", "axle_4dof", "full_7dof")
BEAM = ("axle_2dof", "axle_4dof")
STILL = Road(lambda t: 0.0, lambda t: 0.0)


@dataclass(frozen=True)
class AxleData:
    """Values of one axle, each for one wheel; the spring is a function of its preload."""

    spring: Callable[[float], Curve]
    damper: tuple[Curve, Curve]
    stops: tuple[float, float, float]
    mount: float | None = None
    rod_friction: float = 0.0
    linkage_friction: float = 0.0
    bar: float = 0.0
    track: float = 1.4
    base: float = 1.4
    roll_centre: float = 0.0
    unsprung: float = 39.5
    tyre: float = 176e3


@dataclass(frozen=True)
class CarData:
    """A car with its load cases: mass, centre of gravity from the front wheel centres, moments of inertia about x and
    y."""

    wheelbase: float
    wheel_radius: float
    loads: Mapping[str, tuple[float, tuple[float, float, float], tuple[float, float]]]
    front: AxleData
    rear: AxleData

    def corner_mass(self, axle: str, load: str) -> float:
        """Moments about the other axle."""
        mass, (x, _, _), _ = self.loads[load]
        arm = -x if axle == "rear" else self.wheelbase + x
        return mass * arm / self.wheelbase / 2


@dataclass(frozen=True)
class Wheel:
    """A wheel and the leg above it; x from the front axle, y from the middle of the car."""

    station: str
    x: float
    y: float
    leg: QuarterCar
    bar: float
    roll_centre: float
    carried: float
    """Sprung mass on its axle."""
    track: float
    base: float


@dataclass(frozen=True)
class Excitation:
    """Roads by station, lateral and longitudinal acceleration."""

    roads: Mapping[str, Road]
    lateral: Road = STILL
    longitudinal: Road = STILL

    def kinks(self) -> list[float]:
        return sorted({kink for road in (*self.roads.values(), self.lateral, self.longitudinal) for kink in road.kinks})


@dataclass(frozen=True)
class History:
    """Solution on an even grid of time; one column a wheel."""

    time: np.ndarray
    heave: np.ndarray
    pitch: np.ndarray
    roll: np.ndarray
    load: np.ndarray
    travel: np.ndarray
    acceleration: np.ndarray
    pitch_acceleration: np.ndarray
    roll_acceleration: np.ndarray
    wheel_acceleration: np.ndarray


@dataclass(frozen=True)
class Car:
    """State: z, pitch, roll; their rates; heights of the wheels; their rates; rods of the dampers."""

    mass: float
    inertia: tuple[float, float]
    """About x and y."""
    centre: tuple[float, float]
    height: float
    freedoms: tuple[str, ...]
    wheels: tuple[Wheel, ...]
    sprung_wheels: bool
    beam: bool

    @classmethod
    def of(cls, data: CarData, model: str, load: str = "ko", axle: str = "rear") -> Car:
        """The model's part of a car."""
        mass, (x, y, z), (about_x, about_y) = data.loads[load]
        freedoms = tuple(FREEDOMS[model].split())
        whole_length, both_sides = "pitch" in freedoms, "roll" in freedoms
        share = (1.0 if whole_length else 2 * data.corner_mass(axle, load) / mass) * (1.0 if both_sides else 0.5)
        wheels = []
        for name in ("front", "rear") if whole_length else (axle,):
            values: AxleData = getattr(data, name)
            design = data.corner_mass(name, "ko")
            leg = QuarterCar(
                design,
                values.spring(design * G),
                values.damper,
                stops=values.stops,
                mount=values.mount,
                rod_friction=values.rod_friction,
                linkage_friction=values.linkage_friction,
                unsprung=values.unsprung,
                tyre=values.tyre if model in SPRUNG_WHEELS else None,
                tyre_static=(design + values.unsprung) * G,
            )
            for side in (1, -1) if both_sides else (0,):
                station = f"{name[0]}{'l' if side > 0 else 'r'}" if side else name if whole_length else ""
                wheels.append(
                    Wheel(
                        station,
                        -data.wheelbase if name == "rear" and whole_length else 0.0,
                        side * values.track / 2,
                        leg,
                        values.bar if side else 0.0,
                        values.roll_centre,
                        2 * data.corner_mass(name, load),
                        values.track,
                        values.base if model in BEAM else values.track,
                    )
                )
        return cls(
            mass * share,
            (about_x * share, about_y * share),
            (x if whole_length else 0.0, y if both_sides else 0.0),
            data.wheel_radius + z,
            freedoms,
            tuple(wheels),
            model in SPRUNG_WHEELS,
            model in BEAM,
        )

    def _pairs(self) -> list[tuple[int, int]]:
        return [(i, i + 1) for i, wheel in enumerate(self.wheels) if wheel.y > 0]

    def _seats(self, heights: list[float]) -> list[float]:
        """Heights of the springs' lower ends: at the wheels, or on the beam between them."""
        seats = list(heights)
        for left, right in self._pairs():
            narrow = self.wheels[left].base / self.wheels[left].track
            middle, half = (heights[left] + heights[right]) / 2, (heights[left] - heights[right]) / 2
            seats[left], seats[right] = middle + narrow * half, middle - narrow * half
        return seats

    def _arms(self) -> list[tuple[float, float]]:
        """Places of the springs from the centre of gravity."""
        sides = [0.0 if wheel.y == 0 else math.copysign(wheel.base / 2, wheel.y) for wheel in self.wheels]
        return [
            (wheel.x - self.centre[0], side - self.centre[1]) for wheel, side in zip(self.wheels, sides, strict=True)
        ]

    def _twist_of_beams(self, wheel: list[float], roll: float) -> list[float]:
        """Moment of each beam's bar on the body, at the left wheel's place."""
        twist = [0.0] * len(self.wheels)
        for left, right in self._pairs():
            bar, track = self.wheels[left].bar, self.wheels[left].track
            twist[left] = bar * track**2 / 2 * ((wheel[left] - wheel[right]) / track - roll)
        return twist

    def _bars_of_wheels(self, travel: list[float]) -> list[float]:
        """Force of the bars between wheel and body where no beam joins the wheels."""
        share = [0.0] * len(self.wheels)
        for left, right in self._pairs():
            share[left] = self.wheels[left].bar * (travel[left] - travel[right]) / 2
            share[right] = -share[left]
        return share

    def _lift_of_links(self, lateral: float) -> list[float]:
        """The links pass an axle's lateral force to the wheels at the height of the roll centre: a couple over the
        track."""
        return [
            0.0
            if wheel.y == 0
            else math.copysign(1.0, wheel.y) * wheel.carried * lateral * wheel.roll_centre / wheel.track
            for wheel in self.wheels
        ]

    def _massless(self, force: list[float], twist: list[float], lift: list[float]) -> tuple[list[float], list[float]]:
        """Loads of wheels without mass, and what they pass to the body; the road cannot pull (a beam stays on it)."""
        if not self.beam:
            load = [max(0.0, f - up) for f, up in zip(force, lift, strict=True)]
            return load, [n + up for n, up in zip(load, lift, strict=True)]
        load = list(force)
        for left, right in self._pairs():
            track, base = self.wheels[left].track, self.wheels[left].base
            half = ((force[left] - force[right]) * base / 2 + twist[left] - lift[left] * track) / track
            middle = (force[left] + force[right]) / 2
            load[left], load[right] = middle + half, middle - half
        return load, force

    def _wheel_accelerations(
        self, load: list[float], force: list[float], twist: list[float], lift: list[float]
    ) -> list[float]:
        """Of wheels with mass: each for itself, or heave and roll of the beam."""
        if not self.beam:
            return [(load[i] - force[i] + lift[i]) / wheel.leg.unsprung - G for i, wheel in enumerate(self.wheels)]
        found = [0.0] * len(self.wheels)
        for left, right in self._pairs():
            mass, track, base = self.wheels[left].leg.unsprung, self.wheels[left].track, self.wheels[left].base
            up = (load[left] + load[right] - force[left] - force[right]) / (2 * mass) - G
            moment = (
                (load[left] - load[right]) * track / 2
                - (force[left] - force[right]) * base / 2
                - twist[left]
                + lift[left] * track
            )
            turning = moment / (mass * track**2 / 2)
            found[left], found[right] = up + turning * track / 2, up - turning * track / 2
        return found

    def rates(
        self, state: np.ndarray, excitation: Excitation, t: float
    ) -> tuple[list[float], list[float], list[float]]:
        """Derivative of the state, wheel loads, deflections of the springs."""
        n = len(self.wheels)
        s = state.tolist()
        z, pitch, roll, dz, dpitch, droll = s[:6]
        roads = [excitation.roads.get(wheel.station, STILL) for wheel in self.wheels]
        ground, ground_rate = [road.height(t) for road in roads], [road.rate(t) for road in roads]
        lateral, longitudinal = excitation.lateral.height(t), excitation.longitudinal.height(t)
        wheel, wheel_rate = (s[6 : 6 + n], s[6 + n : 6 + 2 * n]) if self.sprung_wheels else (ground, ground_rate)

        arms = self._arms()
        travel = [up - (z + y * roll - x * pitch) for up, (x, y) in zip(self._seats(wheel), arms, strict=True)]
        speed = [up - (dz + y * droll - x * dpitch) for up, (x, y) in zip(self._seats(wheel_rate), arms, strict=True)]
        legs = [each.leg.corner(travel[i], speed[i], s[6 + 2 * n + i]) for i, each in enumerate(self.wheels)]
        lift = self._lift_of_links(lateral)
        twist = self._twist_of_beams(wheel, roll) if self.beam else [0.0] * n
        share = [0.0] * n if self.beam else self._bars_of_wheels(travel)
        force = [leg[0] + bar for leg, bar in zip(legs, share, strict=True)]
        if self.sprung_wheels:
            load = [each.leg.tyre_force(ground[i] - wheel[i]) for i, each in enumerate(self.wheels)]
            moving = [*wheel_rate, *self._wheel_accelerations(load, force, twist, lift)]
        else:
            load, force = self._massless(force, twist, lift)
            moving = [0.0] * (2 * n)

        above_axis = sum(self.wheels[i].carried * (self.height - self.wheels[i].roll_centre) for i, _ in self._pairs())
        up = sum(force) / self.mass - G
        nose_down = -sum(x * f for (x, _), f in zip(arms, force, strict=True)) - self.mass * self.height * longitudinal
        left_up = (
            sum(y * f for (_, y), f in zip(arms, force, strict=True)) + sum(twist) + above_axis * (lateral + G * roll)
        )
        body = {"z": up, "pitch": nose_down / self.inertia[1], "roll": left_up / self.inertia[0]}
        free = [body[name] if name in self.freedoms else 0.0 for name in ("z", "pitch", "roll")]
        return [dz, dpitch, droll, *free, *moving, *(leg[1] for leg in legs)], load, travel

    def at_rest(self, excitation: Excitation | None = None, t: float = 0.0) -> np.ndarray:
        """State in which nothing moves, the rods as far as the springs."""
        excitation = excitation or Excitation({})
        n = len(self.wheels)
        names = ("z", "pitch", "roll")
        unknown = [i for i, name in enumerate(names) if name in self.freedoms]
        rates_of = [3 + i for i in unknown]
        if self.sprung_wheels:
            unknown += range(6, 6 + n)
            rates_of += range(6 + n, 6 + 2 * n)

        def state_at(values: np.ndarray) -> np.ndarray:
            state = np.zeros(6 + 3 * n)
            state[unknown] = values
            state[6 + 2 * n :] = self.rates(state, excitation, t)[2]
            return state

        found = root(
            lambda values: np.array(self.rates(state_at(values), excitation, t)[0])[rates_of],
            np.zeros(len(unknown)),
            tol=1e-14,
        )
        state = state_at(found.x)
        left = np.array(self.rates(state, excitation, t)[0])[rates_of]
        assert np.abs(left).max() < 1e-8, left
        return state


def solve(
    car: Car,
    excitation: Excitation,
    duration: float,
    *,
    spacing: float = 1e-3,
    method: str = "LSODA",
    rtol: float = 1e-8,
) -> History:
    """Integrate from rest, restarting at every kink of the excitation."""
    time = np.arange(round(duration / spacing) + 1) * spacing
    state = car.at_rest()
    states = np.empty((len(time), len(state)))
    edges = [0.0, *(kink for kink in excitation.kinks() if 0 < kink < time[-1]), time[-1]]
    for begin, end in pairwise(edges):
        inside = (time >= begin) & (time < end) if end < time[-1] else time >= begin
        points = time[inside]
        solution = solve_ivp(
            lambda t, s: car.rates(s, excitation, t)[0],
            (begin, end),
            state,
            method=method,
            t_eval=points if len(points) and points[-1] == end else np.append(points, end),
            rtol=rtol,
            atol=rtol / 100,
            max_step=4e-3,
        )
        assert solution.success, solution.message
        states[inside] = solution.y.T[: len(points)]
        state = solution.y[:, -1]
    found = [car.rates(s, excitation, t) for t, s in zip(time, states, strict=True)]
    return History(
        time,
        states[:, 0],
        states[:, 1],
        states[:, 2],
        np.array([load for _, load, _ in found]),
        np.array([travel for _, _, travel in found]),
        *(np.array([rates[i] for rates, _, _ in found]) for i in (3, 4, 5)),
        np.array([rates[6 + len(car.wheels) : 6 + 2 * len(car.wheels)] for rates, _, _ in found]),
    )
