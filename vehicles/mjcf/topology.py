"""What the oscillation models are made of: one table of topologies, and the share of the car that each one moves."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from susp_mj.errors import InputError

from ..complete import LoadedCar


@dataclass(frozen=True)
class Topology:
    """What an oscillation model is made of.

    Attributes:
        title: one line.
        freedoms: of the body, of heave, pitch, roll.
        axles: how many, 1 or 2.
        sides: wheels of an axle, 1 or 2; with 1 the model is one side of the car.
        sprung_wheels: whether the wheels have mass and stand on tyre springs; else they follow the road, massless.
        rigid_axle: whether a beam joins the two wheels.
    """

    title: str
    freedoms: tuple[str, ...]
    axles: Literal[1, 2]
    sides: Literal[1, 2]
    sprung_wheels: bool
    rigid_axle: bool = False


OSCILLATION: dict[str, Topology] = {
    "quarter_1dof": Topology(
        "OM1: body heave; the massless wheel follows the road", ("heave",), 1, 1, sprung_wheels=False
    ),
    "axle_2dof": Topology(
        "OM2: body heave and roll on a massless rigid axle",
        ("heave", "roll"),
        1,
        2,
        sprung_wheels=False,
        rigid_axle=True,
    ),
    "pitch_2dof": Topology(
        "OM3: body heave and pitch, one side; massless wheels", ("heave", "pitch"), 2, 1, sprung_wheels=False
    ),
    "full_3dof": Topology(
        "OM4: body heave, pitch and roll; massless wheels", ("heave", "pitch", "roll"), 2, 2, sprung_wheels=False
    ),
    "quarter_2dof": Topology("OM5: body heave, wheel mass on a tyre spring", ("heave",), 1, 1, sprung_wheels=True),
    "axle_4dof": Topology(
        "OM6: body heave and roll on a rigid axle with mass",
        ("heave", "roll"),
        1,
        2,
        sprung_wheels=True,
        rigid_axle=True,
    ),
    "full_7dof": Topology(
        "OM7: body heave, pitch and roll, four wheel masses", ("heave", "pitch", "roll"), 2, 2, sprung_wheels=True
    ),
}


@dataclass(frozen=True)
class Mass:
    """Mass properties of a model's body: its share of the car [kg, m from the front axle, kg m²]."""

    mass: float
    x: float
    y: float
    roll_inertia: float
    pitch_inertia: float

    @classmethod
    def of(cls, car: LoadedCar, topology: Topology, model: str) -> Mass:
        """Share of the sprung body: a wheel's, an axle's, one side's, or all of it.

        Raises:
            InputError: the car is known by the masses on its wheels, and the model has more than one.
        """
        if topology.axles == 1 and topology.sides == 1:
            return cls(car.axles[0].corner_mass, 0.0, 0.0, 1.0, 1.0)
        body = car.body
        if body is None:
            raise InputError(
                f"model {model} needs sprung_mass, cg and inertia, not a corner's mass only",
                key=f"loads.{car.load}",
                source=car.vehicle.source,
            )
        if topology.axles == 1:
            mass = 2 * car.axles[0].corner_mass
            return cls(mass, 0.0, body.cg[1], body.inertia[0] * mass / body.mass, 1.0)
        share = topology.sides / 2
        y = body.cg[1] if topology.sides == 2 else 0.0
        return cls(body.mass * share, body.cg[0], y, body.inertia[0], body.inertia[1] * share)
