"""A car in one load case, settled once: what every model is built from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from susp_mj.elements import (
    GRAVITY,
    Aerodynamics,
    Brakes,
    Compliance,
    ContactTyre,
    Kinematics,
    Powertrain,
    Steering,
)
from susp_mj.errors import InputError
from susp_mj.names import AXLES

from .vehicle import DESIGN_LOAD, Axle, Body, Vehicle

HANDLING_AXLE = ("track", "unsprung_mass", "wheel_inertia", "kinematics", "compliance", "handling_tyre")
HANDLING_CAR = ("steering", "powertrain", "brakes", "aerodynamics")
"""What model `handling` needs of each axle and of the car, beyond what the oscillation models need."""
RADIUS_AGREES, ROLL_CENTRE_AGREES = 0.1, 0.05
"""How far wheel radius [share] and roll centre [m] as told may be from what tyre and kinematics say."""
_SOFTEST = 0.5  # largest static deflection of a tyre, as a share of its radius


@dataclass(frozen=True)
class LoadedAxle:
    """One axle of a car in one load case.

    Attributes:
        name: ``front`` or ``rear``.
        source: the vehicle file.
        values: as the file has them, spring and tyre carrying their design loads.
        track: [m]; 0 if the file does not tell.
        unsprung_mass: [kg] of one wheel; 0 if the file does not tell.
        corner_mass: sprung mass [kg] on one wheel.
        static_load: force [N] of one wheel on the road in the design position.
    """

    name: str
    source: str
    values: Axle
    track: float
    unsprung_mass: float
    corner_mass: float
    static_load: float

    @classmethod
    def of(cls, vehicle: Vehicle, name: str, load: str) -> LoadedAxle:
        """The axle of a vehicle.

        Raises:
            InputError: no such axle or load case, an element does not fit its load, or the load is not told.
        """
        values, unsprung = vehicle.axle(name), getattr(vehicle, name).unsprung_mass or 0.0
        corner, design = (vehicle.corner_mass(name, each) for each in (load, DESIGN_LOAD))
        static_load = (design + unsprung) * GRAVITY
        return LoadedAxle(name, vehicle.source, values, values.track or 0.0, unsprung, corner, static_load)

    def required(self, key: str, by: str) -> Any:
        """A value that some models cannot do without.

        Raises:
            InputError: the file does not give it.
        """
        value = getattr(self.values, key)
        if value is None:
            raise InputError(f"is required by {by}", key=f"{self.name}.{key}", source=self.source)
        return value


@dataclass(frozen=True)
class LoadedCar:
    """A car in one load case, as far as its file tells; every oscillation model is built from one.

    Attributes:
        vehicle: the car as the file has it.
        load: name of the load case.
        axles: those of the model, front before rear.
        wheelbase: [m]; 0 for a quarter car.
        body: the sprung body; None for a car that is known by the masses on its wheels.
        cg_height: of the body's centre of gravity above the ground [m]; None if the car does not tell.
    """

    vehicle: Vehicle
    load: str
    axles: tuple[LoadedAxle, ...]
    wheelbase: float
    body: Body | None
    cg_height: float | None

    @classmethod
    def of(cls, vehicle: Vehicle, load: str, axles: tuple[str, ...]) -> LoadedCar:
        """A vehicle with some of its axles; errors as for `LoadedAxle.of`."""
        loaded = tuple(LoadedAxle.of(vehicle, name, load) for name in axles)
        return cls(vehicle, load, loaded, vehicle.wheelbase or 0.0, vehicle.load(load).body, vehicle.cg_height(load))


@dataclass(frozen=True)
class CompleteAxle(LoadedAxle):
    """One axle with everything that model `handling` needs.

    Attributes:
        wheel_inertia, kinematics, compliance, handling_tyre: as of `Axle`, none of them missing.
    """

    wheel_inertia: float
    kinematics: Kinematics
    compliance: Compliance
    handling_tyre: ContactTyre

    @classmethod
    def of(cls, vehicle: Vehicle, name: str, load: str) -> CompleteAxle:
        """The axle of a complete vehicle; errors as for `LoadedAxle.of`, or the car presses its tyre in too far."""
        loaded = vars(LoadedAxle.of(vehicle, name, load))
        axle = cls(**loaded, **{key: getattr(loaded["values"], key) for key in HANDLING_AXLE if key not in loaded})
        axle._check_tyre()
        axle._check_agreement(vehicle.wheel_radius)
        return axle

    @property
    def tyre_deflection(self) -> float:
        """Of the tyre with slip in the design position [m]."""
        return self.static_load / self.handling_tyre.vertical_stiffness

    @property
    def hub_height(self) -> float:
        """Of the wheel centres above the ground in the design position [m]."""
        return self.handling_tyre.radius - self.tyre_deflection

    def _check_tyre(self) -> None:
        tyre = self.handling_tyre
        if self.tyre_deflection > _SOFTEST * tyre.radius:
            raise InputError(
                f"{tyre.vertical_stiffness:g} N/m is not allowed; {self.static_load:.0f} N would press the tyre in by "
                f"{1000 * self.tyre_deflection:.0f} mm, more than half its radius of {1000 * tyre.radius:.0f} mm",
                key=f"{self.name}.handling_tyre.vertical_stiffness",
                source=self.source,
            )

    def _check_agreement(self, wheel_radius: float | None) -> None:
        """Refuse an axle whose oscillation models are of another car: they read wheel radius and roll centre as told,
        this model takes them from tyre and kinematics."""
        if wheel_radius is not None and abs(wheel_radius / self.hub_height - 1.0) > RADIUS_AGREES:
            raise InputError(
                f"{wheel_radius:g} m is not allowed; on its tyre the {self.name} wheel's centre is "
                f"{self.hub_height:.3f} m above the ground",
                key="wheel_radius",
                source=self.source,
            )
        told, found = self.values.roll_centre_height, self.kinematics.roll_centre_height(self.track)
        if told is not None and abs(told - found) > ROLL_CENTRE_AGREES:
            raise InputError(
                f"{told:g} m is not allowed; the kinematics put the roll centre at {found:.3f} m",
                key=f"{self.name}.roll_centre_height",
                source=self.source,
            )


@dataclass(frozen=True)
class CompleteCar:
    """A car in one load case with everything that model `handling` needs.

    Attributes:
        vehicle, load, wheelbase, body: as of `LoadedCar`, none of them missing.
        front, rear: the axles.
        steering, powertrain, brakes, aerodynamics: of the whole car.
    """

    vehicle: Vehicle
    load: str
    body: Body
    front: CompleteAxle
    rear: CompleteAxle
    wheelbase: float
    steering: Steering
    powertrain: Powertrain
    brakes: Brakes
    aerodynamics: Aerodynamics

    @classmethod
    def of(cls, vehicle: Vehicle, load: str) -> CompleteCar:
        """A vehicle in a load case.

        Raises:
            InputError: naming everything that is missing; no such load case; or the car would sink into the ground.
        """
        missing = handling_needs(vehicle)
        body = None if missing else vehicle.load(load).body
        if body is None:
            raise InputError(
                f"model 'handling' needs what this car does not give: {', '.join(missing)}", source=vehicle.source
            )
        front, rear = (CompleteAxle.of(vehicle, name, load) for name in AXLES)
        given = {key: getattr(vehicle, key) for key in ("wheelbase", *HANDLING_CAR)}
        car = cls(vehicle, load, body, front, rear, **given)
        if car.cg_height <= 0:
            raise InputError(
                f"{body.cg[2]:g} m is not allowed; the centre of gravity would lie {-car.cg_height:.2f} m below the "
                "ground",
                key=f"loads.{load}.cg.2",
                source=vehicle.source,
            )
        return car

    @property
    def axles(self) -> tuple[CompleteAxle, CompleteAxle]:
        """Front and rear."""
        return self.front, self.rear

    @property
    def cg_height(self) -> float:
        """Of the body's centre of gravity above the ground in the design position [m]: its z from the line that joins
        the hubs."""
        behind_front = -self.body.cg[0] / self.wheelbase
        return self.front.hub_height + behind_front * (self.rear.hub_height - self.front.hub_height) + self.body.cg[2]

    @property
    def unsprung_mass(self) -> float:
        """Of all four wheels [kg]."""
        return 2 * (self.front.unsprung_mass + self.rear.unsprung_mass)


def handling_needs(vehicle: Vehicle) -> list[str]:
    """Dotted paths of what model `handling` still needs, in the order of the file; empty for a complete car.

    A compliance may be an empty table (a rigid suspension), but must be there.
    """
    missing = [key for key in ("wheelbase", "wheel_radius") if getattr(vehicle, key) is None]
    missing += [f"loads.{name}.sprung_mass" for name, case in vehicle.loads.items() if case.sprung_mass is None]
    for name in AXLES:
        axle: Axle | None = getattr(vehicle, name)
        missing += [name] if axle is None else [f"{name}.{key}" for key in HANDLING_AXLE if getattr(axle, key) is None]
    return missing + [key for key in HANDLING_CAR if getattr(vehicle, key) is None]
