"""Share of a car that an oscillation model moves."""

from __future__ import annotations

from dataclasses import dataclass

from susp_mj.errors import InputError

from ..complete import LoadedCar
from ..models import Topology


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
