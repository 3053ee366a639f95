"""Wheels and suspension of one axle: massless or sprung, independent or on a rigid beam."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np

from susp_mj.elements import AntiRollBar, ForceElement, HydraulicDamper
from susp_mj.names import channel_name

from ..complete import LoadedAxle
from ..models import Topology
from .parts import POINT_MASS, Form, ModelBuilder, Partner

BODY_HEIGHT = 0.65
"""Height of the drawn body above the ground [m]."""
_WHEEL_RADIUS = 0.33
_SPRUNG = "models with sprung wheels"


@dataclass(frozen=True)
class Corner:
    """One wheel with its suspension, in a model under construction.

    Attributes:
        station: prefix of its names.
        x, y: place of the wheel from the body's centre of gravity [m].
        side: +1 left, -1 right, 0 for a one-sided model.
        axle: its values.
        road: road height under the wheel.
        partner: station of the other wheel of the axle, if there is one.
    """

    station: str
    x: float
    y: float
    side: int
    axle: LoadedAxle
    road: Form
    partner: str | None

    def name(self, part: str) -> str:
        return channel_name(self.station, part)


def height_at(position: dict[str, Form], x: float, y: float) -> Form:
    """Height of a point of the body: ``heave + y roll - x pitch``."""
    height = position["heave"]
    if "roll" in position:
        height = height + position["roll"] * y
    if "pitch" in position:
        height = height - position["pitch"] * x
    return height


def add_axle(
    builder: ModelBuilder, topology: Topology, body: Any, position: dict[str, Form], corners: Sequence[Corner]
) -> None:
    """Wheels and suspension of one axle (or one side of it)."""
    if topology.rigid_axle:
        (_sprung_rigid_axle if topology.sprung_wheels else _massless_rigid_axle)(builder, body, position, corners)
        return
    for corner in corners:
        if topology.sprung_wheels:
            _sprung_wheel(builder, body, position, corner)
        else:
            _massless_wheel(builder, position, corner)


def _elements(corner: Corner) -> dict[str, ForceElement]:
    """Spring, stops, damper, linkage friction and bar of a corner, by part; the bar's rate is that at the wheel."""
    axle = corner.axle.values
    elements: dict[str, ForceElement] = {"spring": axle.spring, "stop": axle.spring.stops, "damper": axle.damper}
    if axle.friction is not None:
        elements["friction"] = axle.friction
    if corner.partner is not None and axle.anti_roll_bar is not None:
        elements["bar"] = axle.anti_roll_bar
    return elements


def add_suspension(builder: ModelBuilder, corner: Corner, deflection: Form, *, lever: float = 1.0) -> list[str]:
    """A corner's elements along a deflection; returns the actuators' names.

    Args:
        lever: distance of the springs over the track; a bar's rate is that at the wheel.
    """
    elements = _elements(corner)
    for part, element in elements.items():
        if isinstance(element, AntiRollBar):
            bar = AntiRollBar(rate=element.rate / lever**2)
            builder.force(
                corner.name(part), bar, deflection, Partner(channel_name(str(corner.partner), "bar"), 1.0, -1.0)
            )
        else:
            builder.force(corner.name(part), element, deflection)
        builder.output(f"{part}_force", corner.station, ("actuator_force", corner.name(part), -1.0))
    _travel_outputs(builder, corner, deflection)
    return [corner.name(part) for part in elements]


def note_stiffness(builder: ModelBuilder, loaded: LoadedAxle, mass: float, *, tyre: bool) -> None:
    """Time constants of an axle's rates on the mass [kg] that feels them: ``m/c`` of dampers, ``sqrt(m/k)`` of
    springs."""
    axle, where = loaded.values, loaded.name
    arctan_slope = 2 / math.pi * 201.7
    if axle.friction is not None and axle.friction.force > 0:
        force = axle.friction.force
        builder.resolve(f"{where}.friction.force", force, "N", mass / (arctan_slope * force))
    damper = axle.damper
    if damper.time_constant() is None:
        steepest = float(damper.slopes().max())
        if steepest > 0:
            builder.resolve(f"{where}.damper", steepest, "N s/m", mass / steepest)
        if isinstance(damper, HydraulicDamper) and damper.friction > 0:
            builder.resolve(f"{where}.damper.friction", damper.friction, "N", mass / (arctan_slope * damper.friction))
    stops = axle.spring.stops
    travel = np.linspace(stops.rebound, stops.compression, 101)
    stiffness = {"spring": float(np.abs(axle.spring.rate_at(travel)).max()), "spring.stops.rate": stops.rate}
    if tyre:
        stiffness["tyre"] = float((axle.tyre.evaluate(0.001) - axle.tyre.evaluate(0.0)) / 0.001) if axle.tyre else 0.0
    for part, rate in stiffness.items():
        if rate > 0:
            builder.resolve(f"{where}.{part}", rate, "N/m", math.sqrt(mass / rate), power=2.0)


def _travel_outputs(builder: ModelBuilder, corner: Corner, deflection: Form) -> None:
    """Channels of the suspension travel, and its limits."""
    builder.output("suspension_deflection", corner.station, *deflection.terms("qpos", "input"))
    builder.output("suspension_speed", corner.station, *deflection.terms("qvel", "input_rate"))
    builder.travel(corner.station, corner.axle)


def _massless_wheel(builder: ModelBuilder, position: dict[str, Form], corner: Corner) -> None:
    """A massless wheel that follows the road; the road cannot pull, so the corner's total force is at least 0."""
    deflection = corner.road - height_at(position, corner.x, corner.y)
    actuators = add_suspension(builder, corner, deflection)
    builder.push_only(deflection)
    builder.output("wheel_load", corner.station, *(("actuator_force", name, -1.0) for name in actuators))


def _sprung_wheel(builder: ModelBuilder, body: Any, position: dict[str, Form], corner: Corner) -> None:
    """A wheel with mass, child of the heaving body on joint ``travel``, on a tyre that cannot pull."""
    mass = corner.axle.required("unsprung_mass", _SPRUNG)
    wheel = body.add_body(name=corner.name("wheel"), pos=[corner.x, corner.y, 0], mass=mass, **POINT_MASS)
    travel = builder.joint(wheel, corner.name("travel"), "slide", [0, 0, 1])
    _draw_wheel(builder, wheel, [0, 0])
    height = position["heave"] + travel
    add_suspension(builder, corner, height - height_at(position, corner.x, corner.y))
    _tyre(builder, corner, height)


def _massless_rigid_axle(
    builder: ModelBuilder, _body: Any, position: dict[str, Form], corners: Sequence[Corner]
) -> None:
    """A massless beam whose ends follow the road; the road cannot pull, so each wheel's share of the springs is at
    least 0.

    A spring seat at a share ``lever`` of the half track moves with ``(1 + lever)/2`` of its own wheel and ``(1 -
    lever)/2`` of the other, and loads them in the same shares. So each element acts along both wheels' deflections.
    """
    left, right = corners
    near, far = (1 + lever_of(left.axle)) / 2, (1 - lever_of(left.axle)) / 2
    deflections = {corner.station: corner.road - height_at(position, corner.x, corner.y) for corner in corners}
    loads: dict[str, list[str]] = {corner.station: [] for corner in corners}
    for corner, other in ((left, right), (right, left)):
        own, across = deflections[corner.station], deflections[other.station]
        for part, element in _elements(corner).items():
            name, beyond = corner.name(part), corner.name(f"{part}_across")
            if part == "bar":
                builder.force(name, element, own, Partner(other.name("bar"), 1.0, -1.0))
                beyond = ""
            elif far == 0.0:
                builder.force(name, element, own)
                beyond = ""
            else:
                builder.force(name, element, own, Partner(beyond, near, far), near)
                builder.force(beyond, element, across, Partner(name, far, near), far)
                loads[other.station].append(beyond)
            loads[corner.station].append(name)
            builder.output(
                f"{part}_force", corner.station, *(("actuator_force", each, -1.0) for each in (name, beyond) if each)
            )
        _travel_outputs(builder, corner, own * near + across * far)
    for corner in corners:
        builder.push_only(deflections[corner.station])
        builder.output(
            "wheel_load", corner.station, *(("actuator_force", name, -1.0) for name in loads[corner.station])
        )


def _sprung_rigid_axle(builder: ModelBuilder, body: Any, position: dict[str, Form], corners: Sequence[Corner]) -> None:
    """A beam with mass, child of the heaving body with heave and roll of its own, on two tyres that cannot pull."""
    left, right = corners
    axle, half_track = left.axle, (left.y - right.y) / 2
    lever, offset = lever_of(axle), (left.y + right.y) / 2
    mass = 2 * axle.required("unsprung_mass", _SPRUNG)
    inertia = mass * half_track**2 if axle.values.roll_inertia is None else axle.values.roll_inertia
    place = {**POINT_MASS, "inertia": [inertia] * 3}
    beam = body.add_body(name=f"{axle.name}_axle", pos=[left.x, offset, 0], mass=mass, **place)
    heave = builder.joint(beam, f"{axle.name}_axle_heave", "slide", [0, 0, 1])
    roll = builder.joint(beam, f"{axle.name}_axle_roll", "hinge", [1, 0, 0])
    for corner in corners:
        _draw_wheel(builder, beam, [0, corner.y - offset])
        arm = corner.y - offset
        middle = position["heave"] + heave
        seat = height_at(position, corner.x, offset + lever * arm)
        add_suspension(builder, corner, middle + roll * (lever * arm) - seat, lever=lever)
        _tyre(builder, corner, middle + roll * arm)


def _tyre(builder: ModelBuilder, corner: Corner, height: Form) -> None:
    """Tyre spring between road and wheel centre, and the wheel's channels."""
    builder.force(corner.name("tyre"), corner.axle.required("tyre", _SPRUNG), corner.road - height)
    builder.output("wheel_displacement", corner.station, *height.terms("qpos", "input"))
    builder.output("wheel_acceleration", corner.station, *height.terms("qacc", "input"))
    builder.output("wheel_load", corner.station, ("actuator_force", corner.name("tyre"), -1.0))


def _draw_wheel(builder: ModelBuilder, body: Any, place: list[float]) -> None:
    shape, turned = mujoco.mjtGeom.mjGEOM_CYLINDER, [0.7071067811865476, 0.7071067811865476, 0, 0]
    drop = _WHEEL_RADIUS - BODY_HEIGHT
    builder.draw(body, shape, [_WHEEL_RADIUS, 0.11, 0], [0.1, 0.1, 0.1, 1], pos=[*place, drop], quat=turned)


def lever_of(axle: LoadedAxle) -> float:
    """Spring base over track of a rigid axle."""
    return 1.0 if axle.values.spring_base is None else axle.values.spring_base / axle.track
