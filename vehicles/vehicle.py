"""Vehicle: axles with characteristics effective at the wheel, load cases, and where every value comes from."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Annotated, Literal, TypeVar

from pydantic import AfterValidator, Field, ValidationError, model_validator
from pydantic_core import PydanticCustomError

from susp_mj.components import MotionRatio
from susp_mj.description import Description, input_error, wrong
from susp_mj.elements import (
    GRAVITY,
    AntiRollBar,
    AnyAerodynamics,
    AnyBrakes,
    AnyContactTyre,
    AnyDamper,
    AnySpring,
    AnyTyre,
    Compliance,
    Kinematics,
    LinkageFriction,
    Powertrain,
    Steering,
)
from susp_mj.errors import InputError, choices
from susp_mj.units import Inertia, Length, Mass, PositiveLength

AxleName = Literal["front", "rear"]
Settled = TypeVar("Settled")
DESIGN_LOAD = "ko"
"""Name of the load case of the design position (Konstruktionslage), which every vehicle has."""


def _status(text: str) -> str:
    status, _, reason = text.partition(":")
    if status not in ("measured", "cited", "estimated") or not reason.strip():
        raise PydanticCustomError(
            "wrong", "{text}", {"text": f"'{text}' must read 'measured: …', 'cited: …' or 'estimated: …'"}
        )
    return text


Provenance = Annotated[str, AfterValidator(_status)]


class Axle(Description):
    """One axle; every value is for one wheel and effective at the wheel.

    Attributes:
        track: lateral distance of the wheel centres [m].
        spring_base: lateral distance of the springs of a rigid axle [m]; None puts them at the wheels.
        roll_centre_height: of the axle above the ground [m]; None leaves lateral forces out.
        unsprung_mass: mass [kg] that moves with one wheel.
        roll_inertia: of a rigid axle about its middle [kg m²]; None concentrates its mass in the wheels.
        anti_roll_bar: or None.
        spring, damper, tyre: see `susp_mj.elements`.
        friction: linkage friction, or None.
        kinematics, compliance: how the wheel moves over travel, steering and forces; model `handling` only.
        handling_tyre: tyre with slip; model `handling` only, the oscillation models take `tyre`. A file of it is looked
            for beside the vehicle file, then among the tyres that ship.
        wheel_inertia: of one wheel about its spin axis [kg m²], brake disc included; model `handling` only.
        spring_ratio, damper_ratio: component travel per wheel travel, for sheets of the components; the car needs
            neither.
    """

    track: PositiveLength | None = None
    spring_base: PositiveLength | None = None
    roll_centre_height: Length | None = None
    unsprung_mass: Mass | None = None
    roll_inertia: Inertia | None = None
    anti_roll_bar: AntiRollBar | None = None
    spring: AnySpring
    damper: AnyDamper
    friction: LinkageFriction | None = None
    tyre: AnyTyre | None = None
    kinematics: Kinematics | None = None
    compliance: Compliance | None = None
    handling_tyre: AnyContactTyre | None = None
    wheel_inertia: Inertia | None = None
    spring_ratio: MotionRatio | None = None
    damper_ratio: MotionRatio | None = None


@dataclass(frozen=True)
class Body:
    """The whole sprung body: mass [kg], centre of gravity [m] and moments of inertia [kg m²] as of `LoadCase`."""

    mass: float
    cg: tuple[float, float, float]
    inertia: tuple[float, float, float]


class LoadCase(Description):
    """A state of loading: the whole sprung body, or only the sprung mass on one wheel of an axle.

    Attributes:
        sprung_mass: [kg].
        cg: centre of gravity [m] from the reference point (front axle, wheel-centre height): x forward, y left, z up.
        inertia: Jxx, Jyy, Jzz [kg m²] about the centre of gravity.
        corner_mass: sprung mass [kg] on one wheel, by axle; for cars known only as a quarter.
    """

    sprung_mass: Mass | None = None
    cg: tuple[Length, Length, Length] | None = None
    inertia: tuple[Inertia, Inertia, Inertia] | None = None
    corner_mass: dict[AxleName, Mass] | None = None

    @property
    def body(self) -> Body | None:
        """The whole sprung body; None for a car that is known by the masses on its wheels."""
        if self.sprung_mass is None or self.cg is None or self.inertia is None:
            return None
        return Body(self.sprung_mass, self.cg, self.inertia)

    @model_validator(mode="after")
    def _one_form(self) -> LoadCase:
        body = (self.sprung_mass, self.cg, self.inertia)
        if self.corner_mass is None and None in body:
            raise wrong("give sprung_mass, cg and inertia together, or corner_mass")
        if self.corner_mass is not None and any(part is not None for part in body):
            raise wrong("give either corner_mass or sprung_mass, cg and inertia, not both")
        return self


class Vehicle(Description):
    """A car, one set of characteristics chosen.

    Attributes:
        name: the file's name without ending; `source` is the file itself, and says so if it is overridden.
        title: one line for reports.
        characteristics: name of the chosen set, empty if the file has none.
        wheelbase: [m], needed by models with two axles.
        wheel_radius: height of the wheel centres above the ground in the design position [m].
        driver: the driver's seat [m] from the reference point, as a load case's cg.
        front, rear: the axles; a quarter car may have one only.
        steering, powertrain, brakes, aerodynamics: of the whole car, for model `handling` only.
        loads: load cases by name; ``ko`` is the design position.
        sources: dotted path -> 'measured: …', 'cited: …' or 'estimated: …', for every value of the file.
    """

    name: str
    source: str
    title: str
    characteristics: str = ""
    wheelbase: PositiveLength | None = None
    wheel_radius: PositiveLength | None = None
    driver: tuple[Length, Length, Length] | None = None
    front: Axle | None = None
    rear: Axle | None = None
    steering: Steering | None = None
    powertrain: Powertrain | None = None
    brakes: AnyBrakes | None = None
    aerodynamics: AnyAerodynamics | None = None
    loads: dict[str, LoadCase] = Field(min_length=1)
    sources: dict[str, Provenance] = Field(default_factory=dict)

    @model_validator(mode="after")
    def _complete(self) -> Vehicle:
        if DESIGN_LOAD not in self.loads:
            raise wrong(f"the load case '{DESIGN_LOAD}' (design position) is required", "loads")
        if self.front is None and self.rear is None:
            raise wrong("at least one axle is required", "front")
        return self

    @model_validator(mode="after")
    def _kinematics_reach(self) -> Vehicle:
        for name in ("front", "rear"):
            axle: Axle | None = getattr(self, name)
            if axle is None or axle.kinematics is None:
                continue
            key = f"{name}.kinematics"
            axle.kinematics.check_covers(axle.spring.stops, key)
            if name == "rear" and axle.kinematics.steer:
                raise wrong("is not allowed; only the front wheels are steered", f"{key}.steer")
            if name == "front" and self.steering is not None:
                axle.kinematics.check_covers_steering(self.steering.largest_wheel_angle, key)
        return self

    def axle(self, name: str) -> Axle:
        """The axle, its spring and tyre carrying their design loads.

        Raises:
            InputError: the car has no such axle, or an element does not fit its design load.
        """
        axle: Axle | None = getattr(self, name) if name in ("front", "rear") else None
        if axle is None:
            there = [each for each in ("front", "rear") if getattr(self, each) is not None]
            raise InputError(f"{self.source} has no axle '{name}'; {choices(there)}", key="axle")
        corner = self.corner_mass(name, DESIGN_LOAD)
        spring = self._settled(axle.spring.at_preload, corner * GRAVITY, f"{name}.spring")
        tyre = axle.tyre
        if tyre is not None:
            tyre = self._settled(tyre.at_static_load, (corner + (axle.unsprung_mass or 0.0)) * GRAVITY, f"{name}.tyre")
        return axle.model_copy(update={"spring": spring, "tyre": tyre})

    def _settled(self, under: Callable[[float], Settled], force: float, key: str) -> Settled:
        """An element under its design load, a wrong value of it named in the vehicle's file."""
        try:
            return under(force)
        except ValidationError as error:
            raise input_error(error, source=self.source, key=key) from None

    def load(self, name: str) -> LoadCase:
        """A load case by name.

        Raises:
            InputError: no such load case.
        """
        if name not in self.loads:
            raise InputError(f"{self.source} has no load case '{name}'; {choices(self.loads, name)}", key="load")
        return self.loads[name]

    def without_friction(self) -> Vehicle:
        """The same car without linkage and damper friction, for linearisation and closed forms."""
        axles = {}
        for name in ("front", "rear"):
            axle: Axle | None = getattr(self, name)
            if axle is not None:
                update = {"friction": None, "damper": axle.damper.without_friction()}
                axles[name] = axle.model_copy(update=update)
        return self.model_copy(update=axles)

    def cg_height(self, load: str) -> float | None:
        """Height of the sprung mass' centre of gravity above the ground [m]; None if the car does not tell."""
        cg = self.load(load).cg
        return None if cg is None or self.wheel_radius is None else self.wheel_radius + cg[2]

    def corner_mass(self, axle: str, load: str) -> float:
        """Sprung mass [kg] carried by one wheel of an axle: ``m l_other / (l_front + l_rear) / 2``.

        Raises:
            InputError: the load case does not tell.
        """
        case = self.load(load)
        if case.body is not None:
            return case.body.mass * self._share(axle, case.body.cg[0], load) / 2
        if case.corner_mass is None or axle not in case.corner_mass:
            raise InputError(f"gives no mass for the {axle} axle", key=f"loads.{load}.corner_mass", source=self.source)
        return case.corner_mass[axle]

    def _share(self, axle: str, cg_x: float, load: str) -> float:
        """Part of the sprung mass that an axle carries."""
        if self.wheelbase is None:
            raise InputError(
                "is required to share the sprung mass between the axles", key="wheelbase", source=self.source
            )
        if not 0 < -cg_x < self.wheelbase:
            raise InputError(
                f"{cg_x} m is not allowed; the centre of gravity lies between the axles, from 0 to -{self.wheelbase} m",
                key=f"loads.{load}.cg.0",
                source=self.source,
            )
        rear = -cg_x / self.wheelbase
        return rear if axle == "rear" else 1 - rear
