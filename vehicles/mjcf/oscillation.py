"""Oscillation models: vertical dynamics of a body on its wheels (thesis section 4.3.1 and appendix 4).

One table of topologies and one builder: a body with some of heave, pitch and roll, on wheels that either follow the road
without mass or have mass and stand on tyre springs, guided independently or by a rigid axle.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal

import mujoco

from susp_mj.elements import GRAVITY, AntiRollBar, Element, Overturning, Rig
from susp_mj.errors import InputError, choices
from susp_mj.meaning import Meaning
from susp_mj.names import channel_name
from susp_mj.plant import Plant, write_mjcf

from ..vehicle import DESIGN_LOAD, Axle, Vehicle
from .parts import POINT_MASS, Form, ModelBuilder, Partner

_FREEDOMS = {"heave": ("slide", [0.0, 0.0, 1.0]), "pitch": ("hinge", [0.0, 1.0, 0.0]), "roll": ("hinge", [1.0, 0.0, 0.0])}
_BODY_HEIGHT = 0.65
_WHEEL_RADIUS = 0.33
_RIG_FREQUENCY = 2000.0  # rad/s; stiff against every suspension, soft enough for a step of 1 ms


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


MODELS: dict[str, Topology] = {
    "quarter_1dof": Topology("OM1: body heave; the massless wheel follows the road", ("heave",), 1, 1, sprung_wheels=False),
    "axle_2dof": Topology(
        "OM2: body heave and roll on a massless rigid axle", ("heave", "roll"), 1, 2, sprung_wheels=False, rigid_axle=True
    ),
    "pitch_2dof": Topology("OM3: body heave and pitch, one side; massless wheels", ("heave", "pitch"), 2, 1, sprung_wheels=False),
    "full_3dof": Topology("OM4: body heave, pitch and roll; massless wheels", ("heave", "pitch", "roll"), 2, 2, sprung_wheels=False),
    "quarter_2dof": Topology("OM5: body heave, wheel mass on a tyre spring", ("heave",), 1, 1, sprung_wheels=True),
    "axle_4dof": Topology(
        "OM6: body heave and roll on a rigid axle with mass", ("heave", "roll"), 1, 2, sprung_wheels=True, rigid_axle=True
    ),
    "full_7dof": Topology("OM7: body heave, pitch and roll, four wheel masses", ("heave", "pitch", "roll"), 2, 2, sprung_wheels=True),
}


@dataclass(frozen=True)
class _Corner:
    """One wheel with its suspension, in a model under construction.

    Attributes:
        station: prefix of its names.
        axle_name: ``front`` or ``rear``.
        x, y: place of the wheel from the body's centre of gravity [m].
        side: +1 left, -1 right, 0 for a one-sided model.
        axle: the vehicle's values.
        road: road height under the wheel.
        partner: station of the other wheel of the axle, if there is one.
    """

    station: str
    axle_name: str
    x: float
    y: float
    side: int
    axle: Axle
    road: Form
    partner: str | None

    def name(self, part: str) -> str:
        return channel_name(self.station, part)


def build(vehicle: Vehicle, model: str, load: str = DESIGN_LOAD, axle: str | None = None, rig: str | None = None) -> Plant:
    """Build an oscillation model of a car.

    Args:
        model: a key of `MODELS`.
        load: load case of the vehicle.
        axle: ``front`` or ``rear`` for models of one axle; None takes the rear, or the only one there is.
        rig: ``roll`` puts the car on a rig that prescribes its roll angle.

    Raises:
        InputError: unknown model, load case or axle, or a value that the model needs is missing.
    """
    return Plant.from_spec(*specification(vehicle, model, load, axle, rig))


def write(vehicle: Vehicle, model: str, path: str | Path, load: str = DESIGN_LOAD, axle: str | None = None) -> Path:
    """Write the MJCF file of the model that `build` makes, complete and with every digit."""
    return write_mjcf(*specification(vehicle, model, load, axle), path)


def specification(
    vehicle: Vehicle, model: str, load: str = DESIGN_LOAD, axle: str | None = None, rig: str | None = None
) -> tuple[mujoco.MjSpec, Meaning]:
    """The MuJoCo specification of a model and the meaning of its numbers; arguments as for `build`."""
    if model not in MODELS:
        raise InputError(f"no model '{model}'; {choices(MODELS, model)}", key="model")
    topology = MODELS[model]
    builder = ModelBuilder(f"{vehicle.name}_{model}", vehicle.source)
    only = axle or ("rear" if vehicle.rear is not None else "front")
    axles = ["front", "rear"] if topology.axles == 2 else [only]
    for name in axles:
        vehicle.axle(name)
    mass = _Mass.of(vehicle, topology, load, axles, model)
    body, position = _body(builder, topology, mass)
    corners = _corners(builder, vehicle, topology, axles, mass)
    for group in (corners[i : i + topology.sides] for i in range(0, len(corners), topology.sides)):
        _axle(builder, topology, body, position, group)
    roll_lever = _lateral(builder, vehicle, topology, load, corners, position)
    _longitudinal(builder, vehicle, topology, load, mass, position)
    _seat(builder, vehicle, mass, position)
    if rig is not None:
        _rig(builder, rig, position, mass)
    return builder.finish(
        model=model,
        vehicle=vehicle.name,
        title=vehicle.title,
        load=load,
        facts={
            "sprung_mass": mass.mass,
            "unsprung_mass": sum(corner.axle.unsprung_mass or 0.0 for corner in corners) if topology.sprung_wheels else 0.0,
            "cg_x": mass.x,
            "cg_y": mass.y,
            **({"roll_lever": roll_lever} if roll_lever is not None else {}),
            **{f"track_{name}": vehicle.axle(name).track or 0.0 for name in axles if topology.sides == 2},
        },
    )


@dataclass(frozen=True)
class _Mass:
    """Mass properties of a model's body: its share of the car [kg, m from the front axle, kg m²]."""

    mass: float
    x: float
    y: float
    roll_inertia: float
    pitch_inertia: float

    @classmethod
    def of(cls, vehicle: Vehicle, topology: Topology, load: str, axles: Sequence[str], model: str) -> _Mass:
        """Share of the sprung body: a wheel's, an axle's, one side's, or all of it."""
        case = vehicle.load(load)
        if topology.axles == 1 and topology.sides == 1:
            return cls(vehicle.corner_mass(axles[0], load), 0.0, 0.0, 1.0, 1.0)
        if case.sprung_mass is None or case.inertia is None or case.cg is None:
            raise InputError(
                f"model {model} needs sprung_mass, cg and inertia, not a corner's mass only", key=f"loads.{load}", source=vehicle.source
            )
        if topology.axles == 1:
            mass = 2 * vehicle.corner_mass(axles[0], load)
            return cls(mass, 0.0, case.cg[1], case.inertia[0] * mass / case.sprung_mass, 1.0)
        if vehicle.wheelbase is None:
            raise InputError(f"is required by model {model}", key="wheelbase", source=vehicle.source)
        share = topology.sides / 2
        y = case.cg[1] if topology.sides == 2 else 0.0
        return cls(case.sprung_mass * share, case.cg[0], y, case.inertia[0], case.inertia[1] * share)


def _body(builder: ModelBuilder, topology: Topology, mass: _Mass) -> tuple[Any, dict[str, Form]]:
    """The sprung body at its centre of gravity, with its freedoms as forms.

    Its mass heaves; its moments of inertia sit on a child that pitches and rolls. Wheels are children of the part that only
    heaves, so they move vertically and every height stays the linear form that defines these models, at any angle. With
    Jzz = Jyy pitch and roll do not couple either.
    """
    place = {**POINT_MASS, "mass": mass.mass}
    body = builder.spec.worldbody.add_body(name="body", pos=[mass.x, mass.y, _BODY_HEIGHT], **place)
    position = {"heave": builder.joint(body, "heave", *_FREEDOMS["heave"])}
    shell = body
    if len(topology.freedoms) > 1:
        inertia = [mass.roll_inertia, mass.pitch_inertia, mass.pitch_inertia]
        if "pitch" not in topology.freedoms:
            inertia = [mass.roll_inertia] * 3
        shell = body.add_body(name="attitude", **{**POINT_MASS, "inertia": inertia, "mass": 1e-9 * mass.mass})
        position |= {name: builder.joint(shell, name, *_FREEDOMS[name]) for name in topology.freedoms if name != "heave"}
    length = 2.4 if topology.axles == 2 else 0.35
    width = 0.6 if topology.sides == 2 else 0.25
    builder.draw(shell, mujoco.mjtGeom.mjGEOM_BOX, [length / 2 + 0.3, width, 0.1], [0.16, 0.36, 0.6, 1])
    for name, quantity in (("heave", "body"), ("pitch", "pitch"), ("roll", "roll")):
        if name in position:
            words = ("displacement", "velocity", "acceleration") if name == "heave" else ("angle", "rate", "acceleration")
            for source, word in zip(("qpos", "qvel", "qacc"), words, strict=True):
                builder.output(f"{quantity}_{word}", "", (source, name, 1.0))
    return body, position


def _corners(builder: ModelBuilder, vehicle: Vehicle, topology: Topology, axles: Sequence[str], mass: _Mass) -> list[_Corner]:
    """The model's wheels, axle by axle, left before right."""
    corners = []
    for axle_name in axles:
        axle = vehicle.axle(axle_name)
        x = 0.0 if axle_name == "front" or topology.axles == 1 else -(vehicle.wheelbase or 0.0)
        if topology.sides == 1:
            sides: dict[str, int] = {axle_name if topology.axles == 2 else "": 0}
        else:
            sides = {f"{axle_name[0]}l": 1, f"{axle_name[0]}r": -1}
        half_track = _required(vehicle, axle_name, "track") / 2 if topology.sides == 2 else 0.0
        for station, side in sides.items():
            y = side * half_track
            road = builder.wheel_station(station, x, y)
            partner = next((other for other in sides if other != station), None)
            corners.append(_Corner(station, axle_name, x - mass.x, y - mass.y, side, axle, road, partner))
    return corners


def _height(position: dict[str, Form], x: float, y: float) -> Form:
    """Height of a point of the body: ``heave + y roll - x pitch``."""
    height = position["heave"]
    if "roll" in position:
        height = height + position["roll"] * y
    if "pitch" in position:
        height = height - position["pitch"] * x
    return height


def _axle(builder: ModelBuilder, topology: Topology, body: Any, position: dict[str, Form], corners: Sequence[_Corner]) -> None:
    """Wheels and suspension of one axle (or one side of it)."""
    if topology.rigid_axle:
        (_sprung_rigid_axle if topology.sprung_wheels else _massless_rigid_axle)(builder, body, position, corners)
        return
    for corner in corners:
        if topology.sprung_wheels:
            _sprung_wheel(builder, body, position, corner)
        else:
            _massless_wheel(builder, position, corner)


def _elements(corner: _Corner) -> dict[str, Element]:
    """Spring, stops, damper, linkage friction and bar of a corner, by part; the bar's rate is that at the wheel."""
    axle = corner.axle
    elements: dict[str, Element] = {"spring": axle.spring, "stop": axle.spring.stops, "damper": axle.damper}
    if axle.friction is not None:
        elements["friction"] = axle.friction
    if corner.partner is not None and axle.anti_roll_bar is not None:
        elements["bar"] = axle.anti_roll_bar
    return elements


def _suspension(builder: ModelBuilder, corner: _Corner, deflection: Form, *, lever: float = 1.0) -> list[str]:
    """A corner's elements along a deflection; returns the actuators' names.

    Args:
        lever: distance of the springs over the track; a bar's rate is that at the wheel.
    """
    elements = _elements(corner)
    for part, element in elements.items():
        if isinstance(element, AntiRollBar):
            bar = AntiRollBar(rate=element.rate / lever**2)
            builder.force(corner.name(part), bar, deflection, Partner(channel_name(str(corner.partner), "bar"), 1.0, -1.0))
        else:
            builder.force(corner.name(part), element, deflection)
        builder.output(f"{part}_force", corner.station, ("actuator_force", corner.name(part), -1.0))
    _travel_outputs(builder, corner, deflection)
    return [corner.name(part) for part in elements]


def _travel_outputs(builder: ModelBuilder, corner: _Corner, deflection: Form) -> None:
    """Channels of the suspension travel, and its limits."""
    builder.output("suspension_deflection", corner.station, *deflection.terms("qpos", "input"))
    builder.output("suspension_speed", corner.station, *deflection.terms("qvel", "input_rate"))
    builder.travel(corner.station, corner.axle, corner.axle_name)


def _massless_wheel(builder: ModelBuilder, position: dict[str, Form], corner: _Corner) -> None:
    """A massless wheel that follows the road; the road cannot pull, so the corner's total force is at least 0."""
    deflection = corner.road - _height(position, corner.x, corner.y)
    actuators = _suspension(builder, corner, deflection)
    builder.push_only(deflection)
    builder.output("wheel_load", corner.station, *(("actuator_force", name, -1.0) for name in actuators))


def _sprung_wheel(builder: ModelBuilder, body: Any, position: dict[str, Form], corner: _Corner) -> None:
    """A wheel with mass, child of the heaving body on joint ``travel``, on a tyre that cannot pull."""
    mass = _of_axle(builder, corner, "unsprung_mass")
    wheel = body.add_body(name=corner.name("wheel"), pos=[corner.x, corner.y, 0], mass=mass, **POINT_MASS)
    travel = builder.joint(wheel, corner.name("travel"), "slide", [0, 0, 1])
    _draw_wheel(builder, wheel, [0, 0])
    height = position["heave"] + travel
    _suspension(builder, corner, height - _height(position, corner.x, corner.y))
    _tyre(builder, corner, height)


def _massless_rigid_axle(builder: ModelBuilder, _body: Any, position: dict[str, Form], corners: Sequence[_Corner]) -> None:
    """A massless beam whose ends follow the road; the road cannot pull, so each wheel's share of the springs is at least 0.

    A spring seat at a share ``lever`` of the half track moves with ``(1 + lever)/2`` of its own wheel and ``(1 - lever)/2`` of
    the other, and loads them in the same shares. So each element acts along both wheels' deflections.
    """
    left, right = corners
    near, far = (1 + _lever(left.axle)) / 2, (1 - _lever(left.axle)) / 2
    deflections = {corner.station: corner.road - _height(position, corner.x, corner.y) for corner in corners}
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
            builder.output(f"{part}_force", corner.station, *(("actuator_force", each, -1.0) for each in (name, beyond) if each))
        _travel_outputs(builder, corner, own * near + across * far)
    for corner in corners:
        builder.push_only(deflections[corner.station])
        builder.output("wheel_load", corner.station, *(("actuator_force", name, -1.0) for name in loads[corner.station]))


def _sprung_rigid_axle(builder: ModelBuilder, body: Any, position: dict[str, Form], corners: Sequence[_Corner]) -> None:
    """A beam with mass, child of the heaving body with heave and roll of its own, on two tyres that cannot pull."""
    left, right = corners
    axle, half_track = left.axle, (left.y - right.y) / 2
    lever, offset = _lever(axle), (left.y + right.y) / 2
    mass = 2 * _of_axle(builder, left, "unsprung_mass")
    inertia = axle.roll_inertia if axle.roll_inertia is not None else mass * half_track**2
    place = {**POINT_MASS, "inertia": [inertia] * 3}
    beam = body.add_body(name=f"{left.axle_name}_axle", pos=[left.x, offset, 0], mass=mass, **place)
    heave = builder.joint(beam, f"{left.axle_name}_axle_heave", "slide", [0, 0, 1])
    roll = builder.joint(beam, f"{left.axle_name}_axle_roll", "hinge", [1, 0, 0])
    for corner in corners:
        _draw_wheel(builder, beam, [0, corner.y - offset])
        arm = corner.y - offset
        middle = position["heave"] + heave
        seat = _height(position, corner.x, offset + lever * arm)
        _suspension(builder, corner, middle + roll * (lever * arm) - seat, lever=lever)
        _tyre(builder, corner, middle + roll * arm)


def _tyre(builder: ModelBuilder, corner: _Corner, height: Form) -> None:
    """Tyre spring between road and wheel centre, and the wheel's channels."""
    builder.force(corner.name("tyre"), _of_axle(builder, corner, "tyre"), corner.road - height)
    builder.output("wheel_displacement", corner.station, *height.terms("qpos", "input"))
    builder.output("wheel_acceleration", corner.station, *height.terms("qacc", "input"))
    builder.output("wheel_load", corner.station, ("actuator_force", corner.name("tyre"), -1.0))


def _draw_wheel(builder: ModelBuilder, body: Any, place: list[float]) -> None:
    shape, turned = mujoco.mjtGeom.mjGEOM_CYLINDER, [0.7071067811865476, 0.7071067811865476, 0, 0]
    drop = _WHEEL_RADIUS - _BODY_HEIGHT
    builder.draw(body, shape, [_WHEEL_RADIUS, 0.11, 0], [0.1, 0.1, 0.1, 1], pos=[*place, drop], quat=turned)


def _lateral(
    builder: ModelBuilder, vehicle: Vehicle, topology: Topology, load: str, corners: Sequence[_Corner], position: dict[str, Form]
) -> float | None:
    """Lateral acceleration a_y of the sprung mass (positive in a left turn), and gravity on the rolling body.

    The inertial force ``-m a_y`` at the centre of gravity rolls the body about the ground with ``m a_y h_cg``. The links
    carry ``V = m_axle a_y z_rc / t`` between body and wheel, up on the left wheel and down on the right, which leaves the
    body ``m a_y h`` about the roll axis, h = h_cg - z_rc. Returns m h [kg m].
    """
    centre = vehicle.cg_height(load)
    if "roll" not in position or centre is None or any(corner.axle.roll_centre_height is None for corner in corners):
        return None
    lever = moment = 0.0
    for corner in corners:
        height = corner.axle.roll_centre_height or 0.0
        mass = 2 * vehicle.corner_mass(corner.axle_name, load)
        lever += mass / 2 * (centre - height)
        moment += mass / 2 * (centre if not topology.sprung_wheels else centre - height)
        lift = corner.side * mass * height / (corner.axle.track or 1.0)
        if lift == 0.0:
            continue
        if topology.sprung_wheels:  # on the wheel only; its reaction is in the body's moment
            builder.motor_on(corner.name("link"), corner.name("tyre"), "lateral_acceleration", -lift)
        else:  # between wheel and body, so that the road's push includes it
            builder.motor_on(corner.name("link"), corner.name("spring"), "lateral_acceleration", lift)
            builder.add_terms("wheel_load", corner.station, ("actuator_force", corner.name("link"), -1.0))
    builder.force("overturning", Overturning(moment=lever * GRAVITY), position["roll"])
    builder.motor("roll_moment", position["roll"], "lateral_acceleration", moment)
    return lever


def _longitudinal(builder: ModelBuilder, vehicle: Vehicle, topology: Topology, load: str, mass: _Mass, position: dict[str, Form]) -> None:
    """Longitudinal acceleration a_x of the sprung mass (positive forward): pitch moment ``- m a_x h`` over the ground.

    The axles transmit it without anti-dive or anti-squat; those belong to a model with wheel paths.
    """
    height = vehicle.cg_height(load)
    if "pitch" in position and topology.axles == 2 and height is not None:
        builder.motor("pitch_moment", position["pitch"], "longitudinal_acceleration", -mass.mass * height)


def _seat(builder: ModelBuilder, vehicle: Vehicle, mass: _Mass, position: dict[str, Form]) -> None:
    """Vertical acceleration at the driver's seat, in models of the whole body."""
    if vehicle.driver is not None and "pitch" in position and "roll" in position:
        point = _height(position, vehicle.driver[0] - mass.x, vehicle.driver[1] - mass.y)
        builder.output("seat_acceleration", "", *point.terms("qacc", "input"))


def _rig(builder: ModelBuilder, rig: str, position: dict[str, Form], mass: _Mass) -> None:
    """A servo on the body's roll whose target is an input."""
    if rig != "roll" or "roll" not in position:
        raise InputError(f"no rig '{rig}' for this model; the rig 'roll' needs a model with roll", key="rig")
    stiffness = mass.roll_inertia * _RIG_FREQUENCY**2
    builder.force("roll_rig", Rig(stiffness=stiffness, damping=1.4 * mass.roll_inertia * _RIG_FREQUENCY), position["roll"])
    builder.drive("roll_target", "roll_rig", -1.0)
    builder.output("rig_moment", "", ("actuator_force", "roll_rig", 1.0))


def _lever(axle: Axle) -> float:
    """Spring base over track of a rigid axle."""
    return (axle.spring_base or axle.track or 1.0) / (axle.track or 1.0)


def _required(vehicle: Vehicle, axle_name: str, key: str) -> float:
    value = getattr(vehicle.axle(axle_name), key)
    if value is None:
        raise InputError("is required by models with two sides", key=f"{axle_name}.{key}", source=vehicle.source)
    return value


def _of_axle(builder: ModelBuilder, corner: _Corner, key: str) -> Any:
    value = getattr(corner.axle, key)
    if value is None:
        raise InputError("is required by models with sprung wheels", key=f"{corner.axle_name}.{key}", source=builder.source)
    return value
