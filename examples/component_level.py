"""From the wheel to the parts and back: which spring and which damper make the characteristics of a car?

Run it with ``python examples/component_level.py [SHEET.html]``. The quarter car of chapter 3 gets motion ratios; they
tell what its spring and its damper themselves have to do. Then a helical spring of two pitches and a damper of bleed,
orifice and blow-off valves are laid out for that, brought back to the wheel and driven over the bump.
"""

from __future__ import annotations

import sys

from evaluation.characteristics import characteristic
from evaluation.pages.sheet import write_sheet
from manoeuvres import Bump
from susp_mj import simulate
from susp_mj.components import (
    BlowOff,
    Laminar,
    Orifice,
    Parallel,
    Series,
    damper_at_wheel,
    helical_spring,
    hydraulic_damper,
    ring_area,
    rod_area,
    spring_at_component,
    spring_at_wheel,
)
from vehicles import load_vehicle
from vehicles.mjcf import build

RATIOS = {
    "rear.spring_ratio": {"travel": ["-100 mm", "0 mm", "100 mm"], "ratio": [0.66, 0.70, 0.76]},
    "rear.damper_ratio": 0.85,
}


def parts(axle):
    """The spring and the damper that are laid out, at the component."""
    asked = spring_at_component(axle.spring, axle.spring_ratio)
    spring = helical_spring(
        wire_diameter="15.5 mm",
        coil_diameter="120 mm",
        turns=[2.5, 5.3],
        pitch=["36.5 mm", "55 mm"],
        preload=float(asked.force_at(0.0)),
        stops=asked.stops,
    )

    def valve(radius, opening_pressure, full_pressure, area):
        """Eight fine channels behind a wide hole, which a preloaded valve relieves."""
        channels = Parallel(*[Laminar(length="30 mm", radius=radius)] * 8)
        return Parallel(Series(Orifice(area="15 mm^2"), channels), BlowOff(opening_pressure, full_pressure, area))

    damper = hydraulic_damper(
        compression=valve("0.28 mm", "12.5 bar", "40 bar", "11 mm^2"),
        rebound=valve("0.30 mm", "15 bar", "45 bar", "16 mm^2"),
        compression_area=rod_area("22 mm"),
        rebound_area=ring_area("36 mm", "22 mm"),
        friction=axle.damper.friction,
        mount=axle.damper.mount.rate,
    )
    return spring, damper


def main(sheet=""):
    """Print what the parts are asked for and what the car does with them; write a sheet if a path is given."""
    car = load_vehicle("chapter3", "nonlinear", RATIOS)
    axle = car.axle("rear")
    asked, (spring, damper) = spring_at_component(axle.spring, axle.spring_ratio), parts(axle)
    for name, each in (("asked", asked), ("laid out", spring)):
        rates = each.rate_at([each.stops.rebound / 2, 0.0, each.stops.compression / 2]) / 1000
        print(
            f"spring {name:8}: {float(each.force_at(0.0)):5.0f} N at rest, {rates[0]:4.1f} {rates[1]:4.1f} "
            f"{rates[2]:4.1f} N/mm"
        )

    at_wheel = {
        "spring": spring_at_wheel(spring, axle.spring_ratio),
        "damper": damper_at_wheel(damper, axle.damper_ratio),
    }
    made = car.model_copy(update={"rear": car.rear.model_copy(update=at_wheel)})
    for name, each in (("asked", car), ("laid out", made)):
        run = simulate(build(each, "quarter_2dof"), Bump())
        acceleration, travel = run["body_acceleration"], run["suspension_deflection"]
        print(f"car {name:8}: acceleration {acceleration.max():5.2f} m/s², travel {1000 * travel.max():5.1f} mm")
    if sheet:
        sets = {
            name: [characteristic("rear axle", each.axle("rear"))]
            for name, each in (("asked", car), ("laid out", made))
        }
        print(write_sheet("Spring and damper of chapter 3", sets, sheet))


if __name__ == "__main__":
    main(*sys.argv[1:2])
