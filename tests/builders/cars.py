"""Made-up cars of which every number is known: a quarter car, cars of linear springs and dampers, and a car that drives
freely. Numbers are in SI."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from susp_mj.elements import GRAVITY
from vehicles import Vehicle, VehicleFile

from ..verification.reference import G, QuarterCar, constant_rate_spring, zoned_damper
from ..verification.reference_car import AxleData, CarData

QUARTER_CAR_FILE = """\
title = "Car of the tests"
[loads.ko]
corner_mass = { rear = 400.0 }
[loads.heavy]
corner_mass = { rear = "460 kg" }
[rear]
unsprung_mass = 40.0
friction = { force = 120.0 }
tyre = { kind = "spring", rate = "180 N/mm" }
[rear.spring]
kind = "linear"
rate = "25 N/mm"
stops = { rebound = "-90 mm", compression = "80 mm", rate = 2e6 }
[rear.damper]
kind = "zoned"
rates = [2400.0, 800.0]
limits = [0.15]
ratio = "1:2"
friction = 30.0
mount = { rate = 350000.0 }
[sources]
"loads" = "estimated: a test"
"rear" = "estimated: a test"
"""
"""The text of a complete vehicle file, units and sources included."""


def car_of(tables: Mapping[str, Any], overrides: Mapping[str, Any] | None = None) -> Vehicle:
    """The car that a vehicle file of these tables describes."""
    return VehicleFile(Path("made_up.toml"), tables, sets={}, default="").vehicle(overrides=overrides)


# ---- linear cars

STOPS = (-0.2, 0.2, 1e6)
"""Places and rate of the stops of a linear car, which it never reaches."""
STOPS_OF_FILE = dict(zip(("rebound", "compression", "rate"), STOPS, strict=True))


@dataclass(frozen=True, kw_only=True)
class LinearAxle:
    """Linear springs, dampers and tyres without mount and friction; rates for one wheel."""

    rate: float
    damping: float
    unsprung: float = 39.5
    tyre: float = 176e3
    bar: float = 0.0
    track: float | None = None
    spring_base: float | None = None
    roll_centre: float | None = None

    def tables(self) -> dict[str, Any]:
        """As a vehicle file has it."""
        bar = {"anti_roll_bar": {"rate": self.bar}} if self.bar else {}
        return bar | {
            "track": self.track,
            "spring_base": self.spring_base,
            "roll_centre_height": self.roll_centre,
            "unsprung_mass": self.unsprung,
            "tyre": {"kind": "spring", "rate": self.tyre},
            "spring": {"kind": "linear", "rate": self.rate, "stops": STOPS_OF_FILE},
            "damper": {"kind": "zoned", "rates": [self.damping]},
        }

    def reference(self) -> AxleData:
        """As the reference has it."""
        assert self.track is not None
        return AxleData(
            lambda preload: constant_rate_spring(preload, self.rate),
            zoned_damper([self.damping], []),
            STOPS,
            bar=self.bar,
            track=self.track,
            base=self.spring_base or self.track,
            roll_centre=self.roll_centre or 0.0,
            unsprung=self.unsprung,
            tyre=self.tyre,
        )


@dataclass(frozen=True, kw_only=True)
class LinearCar:
    """Two linear axles under a body; load case -> mass, centre of gravity, moments of inertia."""

    wheelbase: float
    wheel_radius: float
    loads: Mapping[str, tuple[float, tuple[float, float, float], tuple[float, float, float]]]
    front: LinearAxle
    rear: LinearAxle

    def vehicle(self, overrides: Mapping[str, Any] | None = None) -> Vehicle:
        """The car as a vehicle file would describe it."""
        keys = ("sprung_mass", "cg", "inertia")
        tables = {
            "title": "Linear car of the tests",
            "wheelbase": self.wheelbase,
            "wheel_radius": self.wheel_radius,
            "loads": {name: dict(zip(keys, load, strict=True)) for name, load in self.loads.items()},
            "front": self.front.tables(),
            "rear": self.rear.tables(),
        }
        return car_of(tables, overrides)

    def reference(self) -> CarData:
        """The same car for the reference, which has no yaw."""
        loads = {name: (mass, cg, inertia[:2]) for name, (mass, cg, inertia) in self.loads.items()}
        return CarData(self.wheelbase, self.wheel_radius, loads, self.front.reference(), self.rear.reference())


LINEAR_CAR = LinearCar(
    wheelbase=2.9,
    wheel_radius=0.31,
    loads={
        "ko": (1500.0, (-1.30, 0.0, 0.27), (620.0, 2500.0, 2900.0)),
        "empty": (1310.0, (-1.22, 0.0, 0.25), (600.0, 2350.0, 2700.0)),
        "full": (1790.0, (-1.49, 0.0, 0.29), (640.0, 2900.0, 3300.0)),
        "one_sided": (1600.0, (-1.38, 0.1, 0.28), (630.0, 2600.0, 3000.0)),
    },
    front=LinearAxle(
        rate=24e3, damping=1900.0, unsprung=42.0, tyre=190e3, bar=9000.0, track=1.52, spring_base=1.30, roll_centre=0.06
    ),
    rear=LinearAxle(
        rate=21e3, damping=2100.0, unsprung=47.0, tyre=205e3, bar=4000.0, track=1.47, spring_base=1.05, roll_centre=0.13
    ),
)
"""Nothing about it is the same front and rear, so that nothing can be mixed up."""


@dataclass(frozen=True)
class LinearQuarterCar:
    """Body and wheel on linear elements; a body of 1.2 Hz on a rigid wheel unless told otherwise."""

    sprung: float = 483.5
    unsprung: float = 39.5
    rate: float = 27486.45347285782
    damping: float = 1200.0
    tyre: float = 176e3

    def vehicle(self, overrides: Mapping[str, Any] | None = None) -> Vehicle:
        """The car as a vehicle file would describe it."""
        axle = LinearAxle(rate=self.rate, damping=self.damping, unsprung=self.unsprung, tyre=self.tyre)
        loads = {"ko": {"corner_mass": {"rear": self.sprung}}}
        return car_of({"title": "Linear quarter car of the tests", "loads": loads, "rear": axle.tables()}, overrides)

    def reference(self) -> QuarterCar:
        """The same car for the reference."""
        return QuarterCar(
            self.sprung,
            constant_rate_spring(self.sprung * G, self.rate),
            zoned_damper([self.damping], []),
            STOPS,
            mount=None,
            rod_friction=0.0,
            linkage_friction=0.0,
            unsprung=self.unsprung,
            tyre=self.tyre,
        )


# ---- a car that drives freely


@dataclass(frozen=True)
class PlainCar:
    """A car that drives freely with nothing but what closed forms have: linear tyres and springs, no kinematics but a
    path. Masses are those of the whole car, not of its body; pairs are front and rear."""

    mass: float = 2090.0
    yaw_inertia: float = 4700.0
    front: float = 1.5572
    rear: float = 1.5238
    height: float = 0.6
    unsprung: float = 20.0
    track: float = 1.4
    cornering: tuple[float, float] = (120000.0, 160000.0)
    wheel_rate: tuple[float, float] = (40000.0, 40000.0)
    damping: tuple[float, float] = (4000.0, 4000.0)
    roll_centre: tuple[float, float] = (0.0, 0.0)
    tyre_rate: float = 250000.0
    rolling_resistance: float = 0.0
    drag: float = 0.0
    ratio: float = 16.0
    wheel_inertia: float = 1.0
    load_dependent: bool = False
    overrides: Mapping[str, Any] = field(default_factory=dict)

    RADIUS = 0.32

    @property
    def wheelbase(self) -> float:
        """Distance of the axles."""
        return self.front + self.rear

    def vehicle(self) -> Vehicle:
        """The car as a vehicle file would describe it."""
        tables = {
            "title": "plain car",
            "wheelbase": self.wheelbase,
            "wheel_radius": self.RADIUS,
            "loads": {"ko": self._body()},
            "front": self._axle(0, self.rear),
            "rear": self._axle(1, self.front),
            "steering": self._steering(),
            "powertrain": POWERTRAIN,
            "brakes": {"torque": 8000.0, "front_share": 0.6},
            "aerodynamics": AERODYNAMICS | {"drag": self.drag},
        }
        return car_of(tables, self.overrides)

    def _body(self) -> dict[str, Any]:
        """What the wheels leave of the whole car."""
        wheels = 4 * self.unsprung
        mass = self.mass - wheels
        behind = (self.mass * self.front - wheels / 2 * self.wheelbase) / mass
        arms = [self.front**2, self.front**2, self.rear**2, self.rear**2]
        of_wheels = sum(self.unsprung * (arm + (self.track / 2) ** 2) for arm in arms) + 4 * 0.55 * self.wheel_inertia
        of_wheels += 2 * max(1.0 - 0.55 * self.wheel_inertia, 0.05)
        return {
            "sprung_mass": mass,
            "cg": [-behind, 0.0, (self.mass * self.height - wheels * self.RADIUS) / mass - self.RADIUS],
            "inertia": [900.0, 3800.0, self.yaw_inertia - of_wheels - mass * (behind - self.front) ** 2],
        }

    def _axle(self, i: int, other: float) -> dict[str, Any]:
        """An axle; `other` is how far the other one is from the centre of gravity."""
        slope = 2 * self.roll_centre[i] / self.track
        stops = {"rebound": -0.2, "compression": 0.2, "rate": 1e5}
        return {
            "track": self.track,
            "unsprung_mass": self.unsprung,
            "wheel_inertia": self.wheel_inertia,
            "spring": {"kind": "linear", "rate": self.wheel_rate[i], "stops": stops},
            "damper": {"kind": "zoned", "rates": [self.damping[i]]},
            "kinematics": {"travel": [-0.2, 0.0, 0.2], "lateral": [-0.2 * slope, 0.0, 0.2 * slope]},
            "compliance": {},
            "handling_tyre": self._tyre(self.cornering[i] / 2, self.mass * GRAVITY * other / self.wheelbase / 2),
        }

    def _tyre(self, cornering: float, load: float) -> dict[str, Any]:
        return {
            "kind": "linear",
            "radius": self.RADIUS + load / self.tyre_rate,
            "vertical_stiffness": self.tyre_rate,
            "vertical_damping": 100.0,
            "nominal_load": load,
            "load_dependent": self.load_dependent,
            "cornering_stiffness": cornering,
            "longitudinal_stiffness": 100000.0,
            "rolling_resistance": self.rolling_resistance,
            "longitudinal_relaxation": 0.3,
            "lateral_relaxation": 0.05,
        }

    def _steering(self) -> dict[str, Any]:
        return {
            "ratio": self.ratio,
            "stiffness": 100000.0,
            "damping": 300.0,
            "knuckle_inertia": 1.0,
            "trail": 0.0,
            "scrub": 0.0,
            "ackermann": 0.0,
            "limit": 10.0,
        }


AERODYNAMICS = {"area": 2.0, "lift_front": 0.0, "lift_rear": 0.0, "side": 0.0, "yaw": 0.0}
POWERTRAIN = {
    "driven": "rear",
    "speed": [50.0, 300.0, 600.0],
    "full_torque": [300.0, 400.0, 300.0],
    "drag_torque": [-20.0, -30.0, -50.0],
    "inertia": 0.3,
    "idle_speed": 70.0,
    "coupling": 20.0,
    "gears": [3.0, 1.5, 1.0],
    "final_drive": 3.0,
    "efficiency": 1.0,
    "shift_up": 550.0,
    "shift_down": 120.0,
    "shift_time": 0.2,
}
