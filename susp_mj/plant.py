"""Plant: a compiled model, what its inputs and channels mean, and its static equilibrium.

All of it lives in the MJCF file: the forces as user actuators, the meaning as one custom text, so that a file that was
written can be read and run again.
"""

from __future__ import annotations

import copy
import ctypes
import dataclasses
import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import mujoco
import numpy as np

from .elements.law import ACTUATOR_HEADER, ACTUATOR_MARK, USERDATA_HEADER
from .errors import InputError, SimulationError
from .names import channel_name

META = "susp_mj"


@dataclass(frozen=True)
class Input:
    """Something a manoeuvre can drive.

    Attributes:
        quantity: what it is, e.g. ``road_height``; a key of `names.QUANTITIES`.
        station: where, e.g. ``fl``; empty for the only wheel.
        x, y: position [m] in the vehicle frame, x measured from the front axle (rear axle negative).
        entries: (actuator, factor) pairs; the actuator's deflection gets factor times the input.
    """

    quantity: str
    station: str
    x: float
    y: float
    entries: tuple[tuple[str, float], ...]


@dataclass(frozen=True)
class Output:
    """A channel as a weighted sum of what MuJoCo computes.

    Attributes:
        quantity, station: as in `Channel`.
        terms: (source, name, factor); the source is ``qpos``, ``qvel``, ``qacc`` (name: a joint), ``actuator_force``
            (an actuator), ``input`` or ``input_rate`` (the channel name of an input).
    """

    quantity: str
    station: str
    terms: tuple[tuple[str, str, float], ...]


@dataclass(frozen=True)
class Travel:
    """Suspension travel of a station between its stops [m], and the file keys that an error about it should name."""

    station: str
    rebound: float
    compression: float
    key: str = ""


@dataclass(frozen=True)
class TimeConstant:
    """An inner state's fastest time constant [s] and the value in the vehicle file that causes it."""

    seconds: float
    value: float
    unit: str
    key: str


@dataclass(frozen=True)
class Meaning:
    """What the numbers of an MJCF file stand for.

    Attributes:
        model: name of the topology, e.g. ``quarter_2dof``.
        vehicle, title, source: name, title and file of the vehicle.
        load: name of the load case.
        inputs, outputs, travels, time_constants: see their classes.
    """

    model: str
    vehicle: str
    title: str
    source: str
    load: str
    inputs: tuple[Input, ...]
    outputs: tuple[Output, ...]
    travels: tuple[Travel, ...] = ()
    time_constants: tuple[TimeConstant, ...] = ()
    facts: Mapping[str, float] = field(default_factory=dict)

    def to_json(self) -> str:
        """The meaning as one line of JSON."""
        return json.dumps(dataclasses.asdict(self), separators=(",", ":"))

    @classmethod
    def from_json(cls, text: str) -> Meaning:
        """Inverse of `to_json`."""
        data = json.loads(text)
        data["inputs"] = tuple(Input(**{**i, "entries": tuple(map(tuple, i["entries"]))}) for i in data["inputs"])
        data["outputs"] = tuple(Output(**{**o, "terms": tuple(map(tuple, o["terms"]))}) for o in data["outputs"])
        data["travels"] = tuple(Travel(**t) for t in data["travels"])
        data["time_constants"] = tuple(TimeConstant(**t) for t in data["time_constants"])
        return cls(**data)


@dataclass(frozen=True)
class Plant:
    """A model ready to run.

    Attributes:
        model: the compiled MuJoCo model.
        meaning: its inputs, outputs and limits.
    """

    model: mujoco.MjModel
    meaning: Meaning

    @classmethod
    def from_spec(cls, spec: mujoco.MjSpec, meaning: Meaning) -> Plant:
        """Compile a specification and write the meaning into it."""
        spec.add_text(name=META, data=meaning.to_json())
        return cls(spec.compile(), meaning)

    @classmethod
    def from_mjcf(cls, path: str | Path) -> Plant:
        """Read a file that `write_mjcf` wrote.

        Raises:
            InputError: no such file, not MJCF, or not a model of susp_mj.
        """
        if not Path(path).is_file():
            raise InputError("no such file", source=str(path))
        try:
            spec = mujoco.MjSpec.from_file(str(path))
            spec.nuserdata = max(spec.nuserdata, USERDATA_HEADER + len(spec.actuators))  # actuators may have been added by hand
            model = spec.compile()
        except ValueError as error:
            reason = " ".join(str(error).split())
            raise InputError(f"is not a model that susp-mj built: {reason}", source=str(path)) from None
        text = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_TEXT, META)
        if text < 0:
            raise InputError(f"is not a model that susp-mj built: it has no custom text '{META}'", source=str(path))
        _check_partners(model, str(path))
        data = model.text_data[model.text_adr[text] : model.text_adr[text] + model.text_size[text]]
        return cls(model, Meaning.from_json(bytes(data).rstrip(b"\0").decode()))

    @cached_property
    def laws(self) -> tuple[int, ...]:
        """Numbers of the force laws that the model uses."""
        return tuple(sorted({int(user[1]) for user in self.model.actuator_user if len(user) > 1 and user[0] == ACTUATOR_MARK}))

    def index(self, source: str, name: str) -> int:
        """Position of a joint or actuator in MuJoCo's array `source`."""
        if source == "actuator_force":
            return self.model.actuator(name).id
        joint = self.model.joint(name)
        return int(joint.qposadr[0]) if source == "qpos" else int(joint.dofadr[0])

    def entries(self) -> list[tuple[int, int, float]]:
        """(input, actuator, factor) as the control callback wants them."""
        return [
            (i, self.model.actuator(actuator).id, factor)
            for i, place in enumerate(self.meaning.inputs)
            for actuator, factor in place.entries
        ]

    def outputs(self, columns: Mapping[str, np.ndarray]) -> list[tuple[Output, np.ndarray]]:
        """Evaluate every output from recorded arrays.

        Args:
            columns: (rows, n) by source name; ``input`` and ``input_rate`` have one column per input.
        """
        inputs = {channel_name(place.station, place.quantity): i for i, place in enumerate(self.meaning.inputs)}
        results = []
        for output in self.meaning.outputs:
            values = np.zeros(len(columns["qpos"]))
            for source, name, factor in output.terms:
                column = inputs[name] if source.startswith("input") else self.index(source, name)
                values += factor * columns[source][:, column]
            results.append((output, values))
        return results


def _check_partners(model: mujoco.MjModel, source: str) -> None:
    """Refuse a file in which an element's other half is not where its parameters say."""
    for i, user in enumerate(model.actuator_user):
        if len(user) >= ACTUATOR_HEADER and user[0] == ACTUATOR_MARK and user[2] != 0.0:
            partner = i + int(user[2])
            inside = 0 <= partner < model.nu
            if not inside or model.actuator_user[partner][1] != user[1] or partner + int(model.actuator_user[partner][2]) != i:
                raise InputError(
                    f"its partner is not {int(user[2])} actuators further on; keep the order of the two",
                    key=f"actuator '{model.actuator(i).name}'",
                    source=source,
                )


def write_mjcf(spec: mujoco.MjSpec, meaning: Meaning, path: str | Path) -> Path:
    """Write the model as one self-contained MJCF file with every digit, and check that it reads back the same.

    Raises:
        InputError: the place cannot be written.
    """
    plant = Plant.from_spec(spec, meaning)
    text = _full_precision_xml(spec)
    again = mujoco.MjModel.from_xml_string(text)
    for name in ("actuator_user", "body_mass", "body_inertia", "body_pos", "body_ipos", "tendon_range", "wrap_prm", "tendon_actfrcrange"):
        if not np.array_equal(getattr(plant.model, name), getattr(again, name)):
            raise SimulationError(f"MuJoCo's writer lost digits of {name}; this MuJoCo is not supported")
    path = Path(path)
    unfinished = path.with_name(path.name + ".part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        unfinished.write_text(text)
        unfinished.replace(path)
    except OSError as error:
        raise InputError(f"cannot be written: {error.strerror}", source=str(path)) from None
    return path


def _full_precision_xml(spec: mujoco.MjSpec) -> str:
    """MJCF text with 17 significant digits; MuJoCo's default of 6 would change the motion."""
    from .compiled.loop import library

    set_precision = library()._mjPRIVATE__set_xml_precision
    get_precision = library()._mjPRIVATE__get_xml_precision
    set_precision.argtypes, get_precision.restype = [ctypes.c_int], ctypes.c_int
    before = get_precision()
    set_precision(17)
    try:
        return spec.to_xml()
    finally:
        set_precision(before)


def static_equilibrium(plant: Plant, block: np.ndarray | None = None) -> mujoco.MjData:
    """Data at rest under gravity, the inputs at their first value: accelerations vanish, inner states carry no force.

    Args:
        block: inputs as `compiled.input_block` makes them, with zero rates.

    Raises:
        InputError: the load cannot be carried between the stops.
        SimulationError: no equilibrium found.
    """
    from .compiled import attach_input, install

    install(plant.laws)
    model = copy.copy(plant.model)
    model.tendon_actfrclimited[:] = 0  # a wheel at rest is on the road; without its limit every force has a slope
    data = mujoco.MjData(model)
    attach_input(data, block)

    def residual(position: np.ndarray) -> np.ndarray:
        data.qpos[:] = position
        _rest_states(model, data)
        return data.qfrc_smooth / weight

    mujoco.mj_forward(model, data)
    weight = np.maximum(np.abs(data.qfrc_bias), np.abs(data.qfrc_bias).max())
    position = _newton(residual, data.qpos.copy())
    if not np.max(np.abs(residual(position))) < 1e-9:
        raise SimulationError(
            f"{plant.meaning.source}: load '{plant.meaning.load}' has no static equilibrium in model {plant.meaning.model}; "
            "check preloads and sprung mass"
        )
    _check_travel(plant, data)
    attach_input(data, None)
    return data


def _newton(residual: Callable[[np.ndarray], np.ndarray], position: np.ndarray) -> np.ndarray:
    """Root by Newton's method with central differences and halved steps, until rounding stops the progress.

    Springs are monotone but have kinks, at the design position and at the stops, where library solvers that trust their
    model of the function stall; the static load of an axle lies exactly on one whenever the payload leaves it alone.
    """
    here = residual(position)
    for _ in range(100):
        slope = np.column_stack([(residual(position + h) - residual(position - h)) / 2e-7 for h in 1e-7 * np.eye(len(position))])
        step = np.linalg.lstsq(slope, -here, rcond=None)[0]
        for shorter in 0.5 ** np.arange(30):
            there = residual(position + shorter * step)
            if np.linalg.norm(there) < np.linalg.norm(here):
                break
        else:
            return position
        position, here = position + shorter * step, there
    return position


def _rest_states(model: mujoco.MjModel, data: mujoco.MjData) -> None:
    """Forces at the current position with every inner state at rest, i.e. equal to its element's deflection."""
    data.qvel[:] = 0.0
    mujoco.mj_forward(model, data)
    length = data.actuator_length + data.ctrl
    for actuator in np.flatnonzero(model.actuator_actadr >= 0):
        _, _, partner, weight, other, _ = model.actuator_user[actuator][:ACTUATOR_HEADER]
        deflection = length[actuator] if partner == 0 else weight * length[actuator] + other * length[actuator + int(partner)]
        data.act[model.actuator_actadr[actuator]] = deflection
    mujoco.mj_forward(model, data)


def _check_travel(plant: Plant, data: mujoco.MjData) -> None:
    """Refuse an equilibrium on a stop: there the springs do not carry the car."""
    columns = {
        "qpos": data.qpos[None],
        "qvel": data.qvel[None],
        "qacc": data.qacc[None],
        "actuator_force": data.actuator_force[None],
        "input": np.zeros((1, len(plant.meaning.inputs))),
        "input_rate": np.zeros((1, len(plant.meaning.inputs))),
    }
    deflections = {o.station: float(v[0]) for o, v in plant.outputs(columns) if o.quantity == "suspension_deflection"}
    for travel in plant.meaning.travels:
        deflection = deflections[travel.station]
        if not travel.rebound < deflection < travel.compression:
            raise InputError(
                f"cannot carry load '{plant.meaning.load}': its equilibrium lies at {1000 * deflection:.1f} mm, outside the travel "
                f"from {1000 * travel.rebound:.0f} to {1000 * travel.compression:.0f} mm; change preload, rate or load",
                key=f"{travel.key}.spring",
                source=plant.meaning.source,
            )
