"""A force element of your own: a hydropneumatic spring, without touching the package.

Run it with ``python examples/hydropneumatic.py``: the quarter car of chapter 3 over its bump, on steel and on gas.

Four things make an element: a law (a plain function), a description (a class with its fields), `parameters()` that
turns the fields into the law's numbers, and `register`. From then on ``kind = "hydropneumatic"`` works in vehicle
files and overrides, in plots and reports, and the law runs compiled inside MuJoCo.
"""

from __future__ import annotations

import math
from typing import Annotated, ClassVar, Literal

from pydantic import model_validator

from manoeuvres import Bump
from susp_mj import simulate
from susp_mj.description import wrong
from susp_mj.elements import GRAVITY, Law, Spring, register
from susp_mj.units import Frequency, Quantity
from vehicles import load_vehicle
from vehicles.mjcf import build


def gas_force(deflection, speed, state, p):
    """``F0 (1 - x/x0)^-n``; p = rebound stop, compression stop, F0, x0, n."""
    x = min(max(deflection, p[0]), p[1])
    return p[2] * (1.0 - x / p[3]) ** -p[4]


class HydropneumaticSpring(Spring):
    """A gas volume behind a piston: ``F = F0 (V0/(V0 - A x))^n``.

    V0 [m³] is the volume in the design position, A [m²] the piston's area, n the polytropic exponent (1: isothermal,
    slow; 1.4: adiabatic, fast). The rate at rest is ``k(0) = n F0 A/V0``, and it shall give the mass that F0 carries
    the natural frequency f: ``k(0) = (F0/g) (2 pi f)²``. So only the stroke ``x0 = V0/A = n g/(2 pi f)²`` that would
    use up the gas matters, and ``F = F0 (1 - x/x0)^-n``. It does not depend on the preload.

    Attributes:
        frequency: natural frequency f [Hz] at the preload.
        exponent: polytropic exponent n, from 1 to 1.67.

    Source: thesis, outlook (hydropneumatic suspension); the polytropic change of state of an ideal gas.
    """

    law: ClassVar[Law] = Law("example_hydropneumatic_spring", gas_force)

    kind: Literal["hydropneumatic"] = "hydropneumatic"
    frequency: Frequency
    exponent: Annotated[float, Quantity("", ge=1, le=1.67)] = 1.3

    @property
    def stroke(self) -> float:
        """x0 [m]: the deflection at which the gas volume is used up."""
        return self.exponent * GRAVITY / (2 * math.pi * self.frequency) ** 2

    @model_validator(mode="after")
    def _gas_is_left(self) -> HydropneumaticSpring:
        if self.stops.compression >= self.stroke:
            raise wrong(
                f"{self.stops.compression} m is not allowed; the gas volume is used up at {self.stroke:.4f} m, "
                "stop earlier, raise the exponent or lower the frequency",
                "stops.compression",
            )
        return self

    def parameters(self) -> tuple[float, ...]:
        return (self.stops.rebound, self.stops.compression, self._known_preload(), self.stroke, self.exponent)


ON_GAS = {
    "rear.spring": {
        "kind": "hydropneumatic",
        "frequency": "1.2 Hz",
        "exponent": 1.3,
        "preload": "4743 N",
        "stops": {"rebound": "-100 mm", "compression": "100 mm"},
    }
}


def main():
    """Print what the bump does to the car on steel and on gas."""
    register(HydropneumaticSpring)
    for name, overrides in (("steel", None), ("gas", ON_GAS)):
        vehicle = load_vehicle("chapter3", "linear", overrides)
        run = simulate(build(vehicle, "quarter_2dof"), Bump())
        acceleration, travel, load = (
            run[channel] for channel in ("body_acceleration", "suspension_deflection", "wheel_load")
        )
        print(
            f"{name:5}: acceleration {acceleration.max():6.2f} and {acceleration.min():6.2f} m/s², "
            f"travel {1000 * travel.max():5.1f} and {1000 * travel.min():5.1f} mm, least wheel load {load.min():4.0f} N"
        )


if __name__ == "__main__":
    main()
