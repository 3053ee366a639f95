"""Notes: what stands beside plots, which laws a report used, what its signs and words mean, how its runs were made."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from ..numbers.runs import on_tyres
from ..plots.channels import STATIONS
from ..plots.steering import STEERED

if TYPE_CHECKING:
    from ..compare import Comparison

PLOT_NOTES = {
    **dict.fromkeys(
        ("body_displacement_amplification", "body_acceleration_amplification", "suspension_deflection_amplification"),
        "solid: read from the sweep; dotted: linearised, friction left out",
    ),
    "wheel_load_amplification": "solid: read from the sweep; dotted: linearised, friction left out",
    "pitch_angle": "positive nose down",
    "roll_angle": "positive left side up",
    "wheel_load": "at zero the wheel leaves the road; lost contact is shaded",
    "suspension_deflection": "positive in compression, from the design position",
    "suspension_speed": "positive in compression",
    "element_forces": "at the wheel, positive in compression; a massless wheel off the road shows none",
    "seat_acceleration": "at the driver's seat, positive upwards",
    "body_acceleration": "positive upwards",
    "body_displacement": "positive upwards, from the design position",
    "wheel_lift_handling": (
        "up to the largest lateral acceleration; a ring marks a wheel that leaves the road, with the acceleration there"
    ),
    "self_steering_handling": "positive into the turn; dotted: the angle of slip-free rolling on the same circle",
    "wheel_travel_handling": (
        "up to the largest lateral acceleration; positive in compression, from the design position"
    ),
    "course_handling": (
        "way of the centre of gravity; thin: the corners of the car between cones, its front wheels on slippery ground"
    ),
    "kinematics_handling": "of the left wheel, or the mean of both",
    "over_time_handling": "positive to the left, roll left side up, pitch nose down",
    **dict.fromkeys(
        (f"{quantity}_over_frequency_handling" for quantity in STEERED),
        "per steering wheel angle; the coherence is 1 where the car answers linearly",
    ),
    "spring_force_characteristic": "the dot is the preload in the design position; dashed lines are the stops",
    "spring_rate_characteristic": "between the stops",
    "natural_frequency_characteristic": "of the mass that the spring carries",
    "damper_force_characteristic": "hydraulic force, without mount and friction",
    "component_spring_force_characteristic": "over its own travel between the stops; the dot is the design position",
    "component_damper_force_characteristic": "over its own speed, the wheel in the design position",
    "tyre_longitudinal_force_characteristic": (
        "at 0.5, 1, 1.5 and 2 times the wheel load in the design position; positive driven"
    ),
    "tyre_lateral_force_characteristic": "at the same loads; a tyre that drifts to the left is pushed to the right",
    "tyre_aligning_moment_characteristic": "at the same loads; positive to the left",
    "tyre_combined_slip_characteristic": (
        "lines of one slip angle at the wheel load in the design position; dotted: the friction ellipse"
    ),
}
GLOSSARY = (
    ("body motion", "vertical, positive upwards; zero is the design position"),
    ("suspension deflection", "positive in compression (bump), zero in the design position; negative is rebound"),
    (
        "spring, damper, friction force",
        "effective at the wheel, positive when it pushes wheel and body apart or resists compression",
    ),
    ("wheel load", "vertical force of the road on the tyre; zero means that the wheel has left the road"),
    ("KO", "design position (Konstruktionslage), in which the spring carries its preload F₀"),
    ("dashed line", "in a plot: lies on the line of an earlier configuration"),
    ("1:2", "compression to rebound ratio of a damper: rebound has twice the rate"),
)
_SETTINGS: tuple[str, ...] = ("manoeuvre", "beyond it", "masses", "integration", "versions")


def elements_used(comparison: Comparison) -> list[dict[str, Any]]:
    """Each law that the suspensions follow, once, springs first."""
    notes = {
        (note.role, note.kind): note
        for each in comparison.configurations
        for c in each.characteristics
        for note in c.elements
        if note.role != ("tyre" if on_tyres(each.run) else "handling_tyre")
    }
    order = list(dict.fromkeys(role for role, _ in notes))
    return [
        {"role": note.role, "kind": note.kind, "lines": _paragraphs(note.text)}
        for note in sorted(notes.values(), key=lambda note: order.index(note.role))
    ]


def _paragraphs(doc: str) -> list[str]:
    """Opening paragraphs of an element's docstring, up to its attributes."""
    text = re.split(r"\n\s*(?:Attributes|Args|Raises):", doc)[0].replace("`", "")
    return [" ".join(each.split()) for each in text.split("\n\n") if each.strip()]


def station_words(comparison: Comparison) -> Iterator[tuple[str, str]]:
    """Stations that the runs have channels of, with their names."""
    used = dict.fromkeys(c.station for each in comparison.configurations for c in each.run.channels.values())
    for station in used:
        if station in STATIONS:
            yield station, STATIONS[station]


def settings(comparison: Comparison) -> Iterator[tuple[str, str]]:
    """Manoeuvre, step, integrator and versions of the runs; where they differ, each with its configurations."""
    names_of: dict[tuple[str, str], list[str]] = {}
    for each in comparison.configurations:
        for word, text in _run_settings(each.run.meta):
            names_of.setdefault((word, text), []).append(each.name)
    for (word, text), names in sorted(names_of.items(), key=lambda item: _SETTINGS.index(item[0][0])):
        everywhere = len(names) == len(comparison.configurations)
        yield word, text if everywhere else f"{text} ({', '.join(names)})"


def _run_settings(meta: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    yield "manoeuvre", _manoeuvre(meta)
    if meta.get("notes"):
        yield "beyond it", "; ".join(meta["notes"])
    if meta.get("facts"):
        masses = {key.replace("_", " "): value for key, value in meta["facts"].items() if "mass" in key}
        yield "masses", ", ".join(f"{name} {_plain_text(value)} kg" for name, value in masses.items())
    if "step" in meta:
        yield "integration", f"{meta.get('integrator', '')}, step {1e3 * meta['step']:g} ms".lstrip(", ")
    if meta.get("versions"):
        yield "versions", ", ".join(f"{package} {version}" for package, version in meta["versions"].items())


def _manoeuvre(meta: Mapping[str, Any]) -> str:
    """Kind and parameters of the manoeuvre, each with its unit where the case was kept."""
    parameters = dict(meta.get("manoeuvre", {}))
    kind, asked = parameters.pop("kind", ""), meta.get("asked", {}).get("parameters")
    if asked is not None:
        return ", ".join([kind, *(f"{key} {text}" for key, text in asked.items())])
    return f"{kind}, SI units: " + ", ".join(f"{key} {_plain_text(value)}" for key, value in parameters.items())


def overrides(asked: Mapping[str, Any]) -> str:
    """What a configuration sets otherwise than its car's file, on one line."""
    return ", ".join(f"{key} = {value}" for key, value in asked.get("set", {}).items())


def _plain_text(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)
