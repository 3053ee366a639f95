"""What the kept characteristics ask of the springs and dampers themselves: at the component, with coil and oil."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from evaluation.display import quantity_text
from susp_mj.components import damper_at_component, ring_area, rod_area, spring_at_component
from susp_mj.components.progressive import SHEAR_MODULUS
from susp_mj.elements import TableDamper, TableSpring
from susp_mj.files import write_text
from susp_mj.names import AXLES
from vehicles.vehicle import Vehicle

from .targets import Targets

Rows = list[tuple[str, str]]
Part = tuple[str, TableSpring | TableDamper, Iterator[tuple[str, str]]]
SPEEDS = (0.05, 0.2, 0.5, 1.0)
"""Of the component [m/s], at which oil pressures are told."""


def component_rows(car: Vehicle, targets: Targets) -> dict[str, Rows]:
    """Title of a component -> what is asked of it, label and text; empty where the car tells no motion ratios."""
    return {title: [*rows] for title, _, rows in _parts(car, targets)}


def write_components(car: Vehicle, targets: Targets, folder: Path) -> list[Path]:
    """Curves of the components as CSV with units in the header; none where the car tells no motion ratios."""
    written = []
    for title, curve, _ in _parts(car, targets):
        if isinstance(curve, TableSpring):
            header, columns = "travel [m],force [N]", (curve.deflection, curve.force)
        else:
            header, columns = "speed [m/s],force [N]", (curve.speed, curve.force)
        lines = [header, *(f"{x:.6g},{f:.6g}" for x, f in zip(*columns, strict=True))]
        written.append(write_text(folder / f"{title.replace(' ', '_')}.csv", "\n".join(lines) + "\n"))
    return written


def _parts(car: Vehicle, targets: Targets) -> Iterator[Part]:
    for name in AXLES:
        axle = car.axle(name)
        if axle.spring_ratio is not None:
            spring = spring_at_component(axle.spring, axle.spring_ratio)
            yield f"{name} spring", spring, _spring_rows(spring, float(axle.spring_ratio.at(0.0)), name, targets)
        if axle.damper_ratio is not None:
            damper = damper_at_component(axle.damper, axle.damper_ratio)
            yield f"{name} damper", damper, _damper_rows(damper, float(axle.damper_ratio.at(0.0)), name, targets)


def _spring_rows(spring: TableSpring, ratio: float, axle: str, targets: Targets) -> Iterator[tuple[str, str]]:
    """Loads, rates and travel; the active turns ``n = G d⁴/(8 D³ c)`` and the stress ``8 F D/(π d³)`` of a coil whose
    wire d and mean diameter D are given."""
    stops = spring.stops
    rates = spring.rate_at([stops.rebound / 2, 0.0, stops.compression / 2])
    most = float(spring.force_at(stops.compression))
    yield "motion ratio", f"{ratio:.3f}"
    yield "force in the design position", quantity_text(float(spring.force_at(0.0)), "N")
    rate_texts = ", ".join(quantity_text(float(rate), "N/m") for rate in rates)
    yield "rate half way in rebound, at rest, half way in compression", rate_texts
    yield "travel to the stops", f"{quantity_text(stops.rebound, 'm')}, {quantity_text(stops.compression, 'm')}"
    yield "largest force", quantity_text(most, "N")
    coil = targets.coil.get(axle)  # pyright: ignore[reportArgumentType]
    if coil is not None:
        wire, mean = coil.wire_diameter, coil.coil_diameter
        turns = [SHEAR_MODULUS * wire**4 / (8 * mean**3 * float(rate)) for rate in rates]
        stress = 8 * most * mean / (math.pi * wire**3)
        yield "active turns for these rates", ", ".join(f"{n:.1f}" for n in turns)
        yield "shear stress at the largest force, uncorrected", f"{stress / 1e6:.0f} N/mm²"


def _damper_rows(damper: TableDamper, ratio: float, axle: str, targets: Targets) -> Iterator[tuple[str, str]]:
    """Forces over speed; the pressures ``F/A`` of the oil for a piston and rod that are given."""
    yield "motion ratio", f"{ratio:.3f}"
    for speed in SPEEDS:
        forces = damper.force_at([speed, -speed])
        yield f"force at {speed:g} m/s, compression and rebound", ", ".join(quantity_text(f, "N") for f in forces)
    oil = targets.piston.get(axle)  # pyright: ignore[reportArgumentType]
    if oil is not None:
        areas = np.array([rod_area(oil.rod_diameter), ring_area(oil.piston_diameter, oil.rod_diameter)])
        for speed in SPEEDS:
            pressures = np.abs(damper.force_at([speed, -speed])) / areas
            flows = areas * speed
            yield (
                f"pressure at {speed:g} m/s, compression and rebound",
                ", ".join(f"{p / 1e5:.1f} bar at {60e3 * q:.1f} l/min" for p, q in zip(pressures, flows, strict=True)),
            )
