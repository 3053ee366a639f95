"""Parts that every model is built from: force elements, corners, and the record of what their numbers mean.

Joint coordinates are 0 in the design position. A body's vertical position at a place is a weighted sum of its joints
(`Heights`); a sprung wheel is a child of the body whose joint ``travel`` is the suspension deflection, a massless wheel
follows the road. The forces of a corner are user actuators named after it (``spring``, ``stop``, ``damper``,
``friction``, ``tyre``), with the station as prefix where there is more than one: ``fl_spring``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import mujoco

from susp_mj.elements import GRAVITY, Damper, Element, Tyre
from susp_mj.elements.law import ACTUATOR_MARK, USERDATA_HEADER
from susp_mj.errors import InputError
from susp_mj.names import channel_name
from susp_mj.plant import Input, Meaning, Output, TimeConstant, Travel
from susp_mj.simulation import STEP

from ..vehicle import Axle

Heights = dict[str, float]
"""Joint -> weight: the vertical position of a place as a weighted sum of joint coordinates."""

POINT_MASS: dict[str, Any] = {"ipos": [0, 0, 0], "iquat": [1, 0, 0, 0], "inertia": [1, 1, 1], "explicitinertial": True}
"""A body that only translates: its moments of inertia are never used."""
_WHEEL_RADIUS = 0.33
_NO_LIMIT = 1e12


@dataclass(frozen=True)
class Corner:
    """One wheel with its suspension.

    Attributes:
        station: prefix of its names, empty for the only wheel.
        axle_name: ``front`` or ``rear``.
        x, y: place of the wheel [m], x from the front axle.
        axle: the vehicle's values for it.
        heights: vertical position of the body above the wheel.
    """

    station: str
    axle_name: str
    x: float
    y: float
    axle: Axle
    heights: Heights

    def name(self, part: str) -> str:
        """Name of one of the corner's parts."""
        return channel_name(self.station, part)


class ModelBuilder:
    """A MuJoCo specification in the making, with inputs, outputs and limits collected beside it."""

    def __init__(self, name: str, source: str) -> None:
        self.source = source
        self.spec = mujoco.MjSpec()
        self.spec.modelname = name
        option = self.spec.option
        option.timestep, option.integrator, option.gravity = STEP, mujoco.mjtIntegrator.mjINT_RK4, [0, 0, -GRAVITY]
        option.disableflags = mujoco.mjtDisableBit.mjDSBL_CONTACT | mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
        self.inputs: list[Input] = []
        self.outputs: list[Output] = []
        self.travels: list[Travel] = []
        self.time_constants: list[TimeConstant] = []
        self._parameters: list[tuple[float, ...]] = []

    def slide(self, body: Any, name: str) -> None:
        """Give a body a vertical freedom."""
        body.add_joint(name=name, type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[0, 0, 1])

    def draw(self, body: Any, shape: mujoco.mjtGeom, size: list[float], colour: list[float], **place: Any) -> None:
        """A massless, contactless shape, so that the file shows a car in any MuJoCo viewer."""
        body.add_geom(type=shape, size=size, rgba=colour, mass=0.0, contype=0, conaffinity=0, **place)

    def tendon(self, name: str, heights: Heights) -> Any:
        """A fixed tendon as long as the weighted sum of joints."""
        tendon = self.spec.add_tendon(name=name)
        for joint, weight in heights.items():
            tendon.wrap_joint(joint, weight)
        return tendon

    def force(self, name: str, element: Element, *, joint: str = "", tendon: str = "") -> None:
        """Let an element act along a joint or a tendon, as a user actuator with its law and parameters."""
        law, parameters = element.active_law, element.parameters()
        actuator = self.spec.add_actuator(
            name=name,
            target=joint or tendon,
            trntype=mujoco.mjtTrn.mjTRN_JOINT if joint else mujoco.mjtTrn.mjTRN_TENDON,
            biastype=mujoco.mjtBias.mjBIAS_USER,
        )
        actuator.gainprm[0] = 0.0
        if law.state_rate is not None:
            actuator.dyntype, actuator.actdim = mujoco.mjtDyn.mjDYN_USER, 1
        actuator.userdata = [ACTUATOR_MARK, float(law.number), *parameters]
        self._parameters.append(parameters)

    def output(self, quantity: str, station: str, *terms: tuple[str, str, float]) -> None:
        """Declare a channel."""
        self.outputs.append(Output(quantity, station, terms))

    def suspension(self, corner: Corner, *, joint: str = "", tendon: str = "") -> list[str]:
        """Spring, stops, damper and linkage friction of a corner; returns the names of their actuators."""
        axle = corner.axle
        elements: dict[str, Element] = {"spring": axle.spring, "stop": axle.spring.stops, "damper": axle.damper}
        if axle.friction is not None:
            elements["friction"] = axle.friction
        for part, element in elements.items():
            self.force(corner.name(part), element, joint=joint, tendon=tendon)
            self.output(f"{part}_force", corner.station, ("actuator_force", corner.name(part), -1.0))
        stops = axle.spring.stops
        self.travels.append(Travel(corner.station, stops.rebound, stops.compression, corner.axle_name))
        self._note_time_constant(axle.damper, corner.axle_name)
        return [corner.name(part) for part in elements]

    def _note_time_constant(self, damper: Damper, axle_name: str) -> None:
        seconds = damper.time_constant()
        if seconds is not None and damper.mount is not None:
            constant = TimeConstant(seconds, damper.mount.rate, "N/m", f"{axle_name}.damper.mount.rate")
            if constant not in self.time_constants:
                self.time_constants.append(constant)

    def rigid_wheel(self, corner: Corner) -> None:
        """A massless wheel that follows the road: deflection = road - body. The road cannot pull, so the total >= 0."""
        length = self.tendon(corner.name("travel"), {joint: -weight for joint, weight in corner.heights.items()})
        length.actfrclimited, length.actfrcrange = mujoco.mjtLimited.mjLIMITED_TRUE, [-_NO_LIMIT, 0.0]
        actuators = self.suspension(corner, tendon=corner.name("travel"))
        self.inputs.append(Input("road_height", corner.station, corner.x, corner.y, tuple((name, 1.0) for name in actuators)))
        body = tuple(corner.heights.items())
        self.output(
            "suspension_deflection", corner.station, ("input", corner.station, 1.0), *(("qpos", joint, -weight) for joint, weight in body)
        )
        self.output(
            "suspension_speed", corner.station, ("input_rate", corner.station, 1.0), *(("qvel", joint, -weight) for joint, weight in body)
        )
        self.output("wheel_load", corner.station, *(("actuator_force", name, -1.0) for name in actuators))

    def sprung_wheel(self, body: Any, corner: Corner, place: list[float]) -> None:
        """A wheel with mass, child of the body on joint ``travel``, on a tyre that cannot pull.

        Raises:
            InputError: the axle gives no unsprung mass or no tyre.
        """
        travel = corner.name("travel")
        wheel = body.add_body(name=corner.name("wheel"), pos=place, mass=self._required(corner, "unsprung_mass"), **POINT_MASS)
        self.slide(wheel, travel)
        self.draw(wheel, mujoco.mjtGeom.mjGEOM_CYLINDER, [_WHEEL_RADIUS, 0.11, 0], [0.1, 0.1, 0.1, 1], euler=[1.5707963267948966, 0, 0])
        self.suspension(corner, joint=travel)
        tyre: Tyre = self._required(corner, "tyre")
        height = {**corner.heights, travel: 1.0}
        self.tendon(corner.name("tyre_deflection"), {joint: -weight for joint, weight in height.items()})
        self.force(corner.name("tyre"), tyre, tendon=corner.name("tyre_deflection"))
        self.inputs.append(Input("road_height", corner.station, corner.x, corner.y, ((corner.name("tyre"), 1.0),)))
        self.output("suspension_deflection", corner.station, ("qpos", travel, 1.0))
        self.output("suspension_speed", corner.station, ("qvel", travel, 1.0))
        self.output("wheel_displacement", corner.station, *(("qpos", joint, weight) for joint, weight in height.items()))
        self.output("wheel_acceleration", corner.station, *(("qacc", joint, weight) for joint, weight in height.items()))
        self.output("wheel_load", corner.station, ("actuator_force", corner.name("tyre"), -1.0))

    def _required(self, corner: Corner, key: str) -> Any:
        value = getattr(corner.axle, key)
        if value is None:
            raise InputError("is required by models with sprung wheels", key=f"{corner.axle_name}.{key}", source=self.source)
        return value

    def finish(self, **meaning: Any) -> tuple[mujoco.MjSpec, Meaning]:
        """Size the user arrays and state what the numbers mean."""
        self.spec.nuser_actuator = 2 + max(len(parameters) for parameters in self._parameters)
        self.spec.nuserdata = USERDATA_HEADER + len(self._parameters)
        return self.spec, Meaning(
            source=self.source,
            inputs=tuple(self.inputs),
            outputs=tuple(self.outputs),
            travels=tuple(self.travels),
            time_constants=tuple(self.time_constants),
            **meaning,
        )
