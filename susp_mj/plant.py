"""Plant: a compiled model and what its inputs and channels mean.

All of it lives in the MJCF file: the forces as user actuators, the meaning as one custom text, so that a file that was
written can be read and run again.
"""

from __future__ import annotations

import ctypes
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import mujoco
import numpy as np

from .elements import AIR, BRAKE, CONTACT
from .elements.law import ACTUATOR_HEADER, ACTUATOR_MARK, FORCE, USERDATA_HEADER, Role
from .errors import InputError, SimulationError
from .files import write_text
from .handling.block import CAR_NUMERIC, SIGNALS, CarNumbers
from .handling.check import check_block, check_places
from .meaning import Meaning, Output
from .names import channel_name

META = "susp_mj"
STEP = 1e-3
"""Step of a model's file, the longest that a run chooses by itself, and spacing of its records [s]."""


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
        return cls(compiled(spec, meaning.source), meaning)

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
            _check_partners(spec, str(path))
            signals = len(SIGNALS) if any(numeric.name == CAR_NUMERIC for numeric in spec.numerics) else 0
            # actuators may have been added by hand
            spec.nuserdata = max(spec.nuserdata, USERDATA_HEADER + len(spec.actuators) + signals)
            check_block(spec, str(path))  # first: compiling runs the car once
            model = spec.compile()
            check_places(spec, model, str(path))
        except ValueError as error:
            reason = " ".join(str(error).split())
            raise InputError(f"is not a model that susp-mj built: {reason}", source=str(path)) from None
        text = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_TEXT, META)
        if text < 0:
            raise InputError(f"is not a model that susp-mj built: it has no custom text '{META}'", source=str(path))
        data = model.text_data[model.text_adr[text] : model.text_adr[text] + model.text_size[text]]
        try:
            plant = cls(model, Meaning.from_json(bytes(data).rstrip(b"\0").decode()))
        except (ValueError, KeyError, TypeError) as error:
            raise InputError(
                f"is not a model that susp-mj built: its custom text '{META}' is broken: {error!r}", source=str(path)
            ) from None
        if (
            "wheelbase" in plant.meaning.facts
            and any(model.actuator(i).name == "fl_tyre" for i in range(model.nu))
            and not signals
        ):
            raise InputError(
                f"is required; it holds the numbers of model {plant.meaning.model}", key=CAR_NUMERIC, source=str(path)
            )
        return plant

    @cached_property
    def car(self) -> CarNumbers | None:
        """Numbers of a car on tyres with slip, driving freely or on a rig; None in an oscillation model."""
        return CarNumbers.of(self.model.numeric_data)

    @cached_property
    def laws(self) -> tuple[tuple[int, Role], ...]:
        """Numbers of the laws that the model uses, each with the role in which it is called."""
        users = self.model.actuator_user
        forces = {int(user[1]) for user in users if len(user) > 1 and user[0] == ACTUATOR_MARK}
        used = [(number, FORCE) for number in sorted(forces)]
        if self.car is not None:
            used += [(number, CONTACT) for number in sorted({int(number) for number in self.car.wheels.tyre_law})]
            used += [(int(self.car.head.brake_law), BRAKE), (int(self.car.head.air_law), AIR)]
        return tuple(used)

    def index(self, source: str, name: str) -> int:
        """Position of a joint or actuator in MuJoCo's array `source`, of a signal among the car's."""
        if source == "signal":
            return SIGNALS.index(name)
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
        series = {source: np.ascontiguousarray(values.T) for source, values in columns.items()}
        results = []
        for output in self.meaning.outputs:
            values: np.ndarray | None = None
            for source, name, factor in output.terms:
                column = inputs[name] if source.startswith("input") else self.index(source, name)
                share = series[source][column] if factor == 1.0 else factor * series[source][column]
                values = share if values is None else values + share
            results.append((output, np.zeros(series["qpos"].shape[1]) if values is None else values))
        return results


def compiled(spec: mujoco.MjSpec, source: str) -> mujoco.MjModel:
    """The model of a specification; `source` is the file that an error names.

    Raises:
        InputError: MuJoCo refuses it.
    """
    try:
        return spec.compile()
    except ValueError as error:
        raise InputError(f"MuJoCo refuses the model: {' '.join(str(error).split())}", source=source) from None


def _check_partners(spec: mujoco.MjSpec, source: str) -> None:
    """Refuse a file in which an element's other half is not where its parameters say, before anything is computed with
    it."""
    users = [list(actuator.userdata) for actuator in spec.actuators]
    for i, user in enumerate(users):
        if len(user) < ACTUATOR_HEADER or user[0] != ACTUATOR_MARK:
            continue
        whole = np.isfinite(user).all() and abs(user[2]) < len(users)
        partner = i + int(user[2]) if whole else -1
        inside = 0 <= partner < len(users) and len(users[partner]) >= ACTUATOR_HEADER
        if not inside or users[partner][1] != user[1] or partner + users[partner][2] != i:
            raise InputError(
                "its partner is not where its parameters say; keep the order of the two",
                key=f"actuator '{spec.actuators[i].name}'",
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
    for name in (
        "actuator_user",
        "body_mass",
        "body_inertia",
        "body_pos",
        "body_ipos",
        "tendon_range",
        "wrap_prm",
        "tendon_actfrcrange",
        "numeric_data",
    ):
        if not np.array_equal(getattr(plant.model, name), getattr(again, name)):
            raise SimulationError(f"MuJoCo's writer lost digits of {name}; this MuJoCo is not supported")
    return write_text(path, text)


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
