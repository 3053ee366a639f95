"""Parts that every model is built from: linear forms, force elements along them, and the record of what they mean.

Joint coordinates are 0 in the design position, so every deflection and height is a weighted sum of joint coordinates
and road heights: a `Form`. An element acts along a form as a user actuator, on the joint if the form is one joint, else
on a fixed tendon; the road's share reaches it as an input. Parts are named after their corner: ``fl_spring``.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import mujoco
import numpy as np

from susp_mj.elements import GRAVITY, ForceElement, HydraulicDamper
from susp_mj.elements.law import ACTUATOR_HEADER, ACTUATOR_MARK, USERDATA_HEADER, numbers_of
from susp_mj.handling.block import CAR_NUMERIC, SIGNALS
from susp_mj.meaning import Input, Meaning, Output, TimeConstant, Travel
from susp_mj.names import channel_name
from susp_mj.plant import STEP, compiled

from ..complete import LoadedAxle

POINT_MASS: dict[str, Any] = {
    "ipos": [0, 0, 0],
    "iquat": [1, 0, 0, 0],
    "inertia": [1e-6, 1e-6, 1e-6],
    "explicitinertial": True,
}
"""A body that only translates within the model: its own moments of inertia play no part."""
_NO_LIMIT = 1e12
Term = tuple[str, str, float]


@dataclass(frozen=True)
class Form:
    """A length as a weighted sum of joint coordinates and road heights.

    Attributes:
        joints: joint -> weight.
        roads: station -> weight of the road height there.
    """

    joints: dict[str, float]
    roads: dict[str, float] = field(default_factory=dict)

    def __add__(self, other: Form) -> Form:
        return Form(_sum(self.joints, other.joints), _sum(self.roads, other.roads))

    def __mul__(self, factor: float) -> Form:
        return Form({k: factor * v for k, v in self.joints.items()}, {k: factor * v for k, v in self.roads.items()})

    def __sub__(self, other: Form) -> Form:
        return self + other * -1.0

    def terms(self, joint_source: str, road_source: str) -> list[Term]:
        """The form as terms of an output: positions, or rates."""
        joints = [(joint_source, joint, weight) for joint, weight in self.joints.items()]
        return [
            *joints,
            *((road_source, channel_name(station, "road_height"), weight) for station, weight in self.roads.items()),
        ]


def _sum(a: dict[str, float], b: dict[str, float]) -> dict[str, float]:
    total = {key: a.get(key, 0.0) + b.get(key, 0.0) for key in (*a, *b)}
    return {key: weight for key, weight in total.items() if weight != 0.0}


@dataclass(frozen=True)
class Partner:
    """A second actuator whose form shares in an element's deflection: ``own * its form + other * the partner's``.

    Attributes:
        name: of the actuator; it may be added later.
        own, other: weights.
    """

    name: str
    own: float
    other: float


@dataclass(frozen=True)
class _Acting:
    """What makes an actuator a force element: law, partner, factor of the force, the law's parameters."""

    law: int
    partner: Partner | None
    factor: float
    parameters: tuple[float, ...]


class ModelBuilder:
    """A MuJoCo specification in the making, with inputs, outputs and limits collected beside it."""

    def __init__(self, name: str, source: str) -> None:
        self.source = source
        self.spec = mujoco.MjSpec()
        self.spec.modelname = name
        option = self.spec.option
        option.timestep, option.integrator, option.gravity = STEP, mujoco.mjtIntegrator.mjINT_RK4, [0, 0, -GRAVITY]
        option.disableflags = mujoco.mjtDisableBit.mjDSBL_CONTACT | mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
        self.places: dict[str, tuple[float, float, str]] = {}
        self.outputs: list[Output] = []
        self.travels: list[Travel] = []
        self.time_constants: list[TimeConstant] = []
        self._actuators: list[Any] = []
        self._targets: dict[tuple[tuple[str, float], ...], str] = {}
        self._entries: dict[tuple[str, str], list[tuple[str, float]]] = {}
        self._car: Callable[[mujoco.MjModel], np.ndarray] | None = None

    def joint(self, body: Any, name: str, kind: str, axis: list[float]) -> Form:
        """Give a body a freedom, ``slide`` or ``hinge``; returns it as a form."""
        joint = mujoco.mjtJoint.mjJNT_SLIDE if kind == "slide" else mujoco.mjtJoint.mjJNT_HINGE
        body.add_joint(name=name, type=joint, axis=axis)
        return Form({name: 1.0})

    def draw(self, body: Any, shape: Any, size: list[float], colour: list[float], **place: Any) -> None:
        """A massless, contactless shape, so that the file shows a car in any MuJoCo viewer."""
        body.add_geom(type=shape, size=size, rgba=colour, mass=0.0, contype=0, conaffinity=0, **place)

    def wheel_station(self, station: str, x: float, y: float, axle: str) -> Form:
        """Declare a wheel of an axle at a place [m], x from the front axle; returns the road height under it."""
        self.places[station] = (x, y, axle)
        self._entries.setdefault(("road_height", station), [])
        return Form({}, {station: 1.0})

    def force(
        self, name: str, element: ForceElement, form: Form, partner: Partner | None = None, factor: float = 1.0
    ) -> None:
        """Let an element act along a form: a positive force opposes the form's growth.

        Args:
            partner: where the element's deflection is not the form alone.
            factor: of the force.
        """
        law = element.active_law
        actuator = self._actuator(name, form)
        actuator.biastype, actuator.gainprm[0] = mujoco.mjtBias.mjBIAS_USER, 0.0
        if law.state_rate is not None:
            actuator.dyntype, actuator.actdim = mujoco.mjtDyn.mjDYN_USER, 1
        self._actuators[-1] = (name, actuator, _Acting(law.number, partner, factor, numbers_of(element)))
        for station, weight in form.roads.items():
            self._entries[("road_height", station)].append((name, weight))

    def motor(self, name: str, form: Form, quantity: str, factor: float) -> None:
        """Let an input act as a force along a form: ``factor`` times its value, positive with the form's growth."""
        actuator = self._actuator(name, form)
        actuator.gainprm[0] = 1.0
        self.drive(quantity, name, factor)

    def drive(self, quantity: str, actuator: str, factor: float, station: str = "") -> None:
        """Add an input's share to an actuator's deflection, to a motor's force, or to a control of the car."""
        self._entries.setdefault((quantity, station), []).append((actuator, factor))

    def control(self, name: str, joint: str, states: int = 0) -> None:
        """An actuator without force of its own: its `ctrl` is an input of the car, its `act` are inner states of the
        car."""
        actuator = self.spec.add_actuator(name=name, target=joint, trntype=mujoco.mjtTrn.mjTRN_JOINT)
        actuator.gainprm[0] = 0.0
        if states:
            actuator.dyntype, actuator.actdim = mujoco.mjtDyn.mjDYN_USER, states
        self._actuators.append((name, actuator, None))

    def car(self, block: Callable[[mujoco.MjModel], np.ndarray]) -> None:
        """This is a car that drives freely; `block` gives its numbers once the model is compiled."""
        self._car = block

    def motor_on(self, name: str, other: str, quantity: str, factor: float) -> None:
        """A motor along the same form as another actuator."""
        target = next(actuator for each, actuator, *_ in self._actuators if each == other)
        actuator = self.spec.add_actuator(name=name, target=target.target, trntype=target.trntype)
        actuator.gainprm[0] = 1.0
        self._actuators.append((name, actuator, None))
        self.drive(quantity, name, factor)

    def _actuator(self, name: str, form: Form) -> Any:
        joint = next(iter(form.joints)) if list(form.joints.values()) == [1.0] else None
        kind = mujoco.mjtTrn.mjTRN_TENDON if joint is None else mujoco.mjtTrn.mjTRN_JOINT
        actuator = self.spec.add_actuator(name=name, target=joint or self._tendon(name, form), trntype=kind)
        self._actuators.append((name, actuator, None))
        return actuator

    def _tendon(self, name: str, form: Form) -> str:
        """Name of the fixed tendon as long as the form's joint part; elements along one form share it."""
        key = tuple(sorted(form.joints.items()))
        if key not in self._targets:
            self._targets[key] = f"{name}_length"
            tendon = self.spec.add_tendon(name=self._targets[key])
            for joint, weight in form.joints.items():
                tendon.wrap_joint(joint, weight)
        return self._targets[key]

    def push_only(self, form: Form) -> None:
        """The elements along this form cannot pull in sum: a wheel that follows the road may leave it."""
        tendon = self.spec.tendon(self._targets[tuple(sorted(form.joints.items()))])
        tendon.actfrclimited, tendon.actfrcrange = mujoco.mjtLimited.mjLIMITED_TRUE, [-_NO_LIMIT, 0.0]

    def output(self, quantity: str, station: str, *terms: Term) -> None:
        """Declare a channel."""
        self.outputs.append(Output(quantity, station, terms))

    def add_terms(self, quantity: str, station: str, *terms: Term) -> None:
        """Extend a declared channel."""
        for i, output in enumerate(self.outputs):
            if (output.quantity, output.station) == (quantity, station):
                self.outputs[i] = Output(quantity, station, (*output.terms, *terms))

    def travel(self, station: str, axle: LoadedAxle) -> None:
        """Declare the travel of a station's suspension and the time constants of its spring and damper."""
        stops = axle.values.spring.stops
        self.travels.append(Travel(station, stops.rebound, stops.compression, axle.name))
        for part in ("spring", "damper"):
            self._note_time_constant(getattr(axle.values, part), f"{axle.name}.{part}")

    def resolve(self, key: str, value: float, unit: str, seconds: float, power: float = 1.0) -> None:
        """Remember a time constant that the step must resolve: a rate acting on a mass, or a stiffness (power 2)."""
        constant = TimeConstant(seconds, value, unit, key, power)
        if constant not in self.time_constants:
            self.time_constants.append(constant)

    def _note_time_constant(self, element: ForceElement, key: str) -> None:
        """Remember the time constant of an element's inner state, which limits the step."""
        seconds = element.time_constant()
        if seconds is None:
            return
        if isinstance(element, HydraulicDamper) and element.mount is not None:
            self.resolve(f"{key}.mount.rate", element.mount.rate, "N/m", seconds)
        else:
            self.resolve(key, 1.0 / seconds, "1/s", seconds)

    def finish(self, **meaning: Any) -> tuple[mujoco.MjSpec, Meaning]:
        """Write the user parameters and state what the numbers mean."""
        order = [name for name, *_ in self._actuators]
        longest = 0
        for index, (_, actuator, acting) in enumerate(self._actuators):
            if acting is not None:
                partner = acting.partner
                place = (
                    [0.0, 1.0, 0.0]
                    if partner is None
                    else [float(order.index(partner.name) - index), partner.own, partner.other]
                )
                actuator.userdata = [ACTUATOR_MARK, float(acting.law), *place, acting.factor, *acting.parameters]
                longest = max(longest, len(acting.parameters))
        self.spec.nuser_actuator = ACTUATOR_HEADER + longest
        self.spec.nuserdata = USERDATA_HEADER + len(order)
        if self._car is not None:
            self.spec.nuserdata += len(SIGNALS)
            self.spec.add_numeric(name=CAR_NUMERIC, data=self._car(compiled(self.spec, self.source)))
        inputs = [
            Input(quantity, station, x, y, tuple(entries), axle)
            for (quantity, station), entries in self._entries.items()
            for x, y, axle in [self.places.get(station, (0.0, 0.0, ""))]
        ]
        return self.spec, Meaning(
            source=self.source,
            inputs=tuple(inputs),
            outputs=tuple(self.outputs),
            travels=tuple(self.travels),
            time_constants=tuple(self.time_constants),
            **meaning,
        )
