"""Where fields lie inside MuJoCo's mjModel and mjData, found by looking and checked on a second model.

The structs are read through numpy record dtypes with explicit offsets. The dtypes are part of the callbacks' types, so
the compiler's disk cache holds separate code for separate layouts, and the MuJoCo version is a field name in them.
"""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np

from ..errors import CallbackError

MODEL_POINTERS = ("actuator_user", "actuator_actadr", "numeric_data")
MODEL_SIZES = ("nuser_actuator", "nuserdata", "nnumeric")
DATA_POINTERS = (
    "ctrl", "act", "act_dot", "actuator_length", "actuator_velocity", "userdata", "qvel", "qfrc_applied", "xpos",
    "xmat",
)  # fmt: skip
DATA_SCALARS = ("time",)


@dataclass(frozen=True)
class Layout:
    """Byte offsets of the fields that the callbacks use."""

    model: dict[str, int]
    data: dict[str, int]

    def record(self, struct: str) -> np.dtype:
        """Record dtype of ``"model"`` or ``"data"``, the MuJoCo version among its field names."""
        offsets: dict[str, int] = getattr(self, struct)
        formats = [
            np.int32 if name in MODEL_SIZES else np.float64 if name in DATA_SCALARS else np.uint64 for name in offsets
        ]
        version = f"mujoco_{mujoco.__version__}".replace(".", "_")
        return np.dtype(
            {
                "names": [*offsets, version],
                "offsets": [*offsets.values(), 0],
                "formats": [*formats, np.uint8],
                "itemsize": 2**20,
            }
        )


def _probe(actuators: int, user: int, userdata: int, numerics: int) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """A tiny model whose sizes are the given ones."""
    spec = mujoco.MjSpec()
    spec.nuser_actuator, spec.nuserdata = user, userdata
    for i in range(numerics):
        spec.add_numeric(name=f"n{i}", data=[float(i)] * 2)
    body = spec.worldbody.add_body(mass=1, inertia=[1, 1, 1], explicitinertial=True)
    for i in range(actuators):
        body.add_joint(name=f"j{i}", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=np.eye(3)[i % 3])
        actuator = spec.add_actuator(name=f"a{i}", target=f"j{i}", trntype=mujoco.mjtTrn.mjTRN_JOINT)
        actuator.dyntype = mujoco.mjtDyn.mjDYN_INTEGRATOR
        actuator.userdata = [float(i)] * user
    model = spec.compile()
    return model, mujoco.MjData(model)


def _words(struct: Any, kind: Any, count: int) -> np.ndarray:
    """The first `count` words of the struct's memory."""
    return np.frombuffer((kind * count).from_address(struct._address), dtype=kind)


def _find(structs: Sequence[Any], name: str, kind: Any) -> int:
    """Offset at which every one of `structs` holds its own value of field `name`.

    The window grows until the field is in it, so that no more memory than needed is looked at. Pointers to empty arrays
    share the address of the next array that is not empty; ours is not, so it is the last of adjacent equal ones.
    """
    width = ctypes.sizeof(kind)
    for count in (256, 1024, 4096, 16384, 20480, 24576):
        places = [
            set(np.flatnonzero(_words(struct, kind, count) == _expected(struct, name)) * width) for struct in structs
        ]
        common = sorted(set.intersection(*places))
        if common and common[-1] - common[0] == (len(common) - 1) * width:
            return int(common[-1])
    raise CallbackError(
        f"MuJoCo {mujoco.__version__}: cannot find {type(structs[0]).__name__}.{name} in memory; install mujoco 4.0"
    )


def _expected(struct: Any, name: str) -> float:
    value = getattr(struct, name)
    return value.__array_interface__["data"][0] if isinstance(value, np.ndarray) else value


def _kind(name: str) -> Any:
    return ctypes.c_int32 if name in MODEL_SIZES else ctypes.c_double if name in DATA_SCALARS else ctypes.c_uint64


def find_layout() -> Layout:
    """Find the offsets: a pointer by the address numpy reports, a size or the time by a value that nothing else has.

    Raises:
        CallbackError: a field is not found at exactly one place.
    """
    probes = [_probe(2, 4441, 77, 37), _probe(3, 5557, 91, 53)]
    for number, (_, data) in enumerate(probes):
        data.time = 123.456 + number
    models, datas = zip(*probes, strict=True)
    return Layout(
        model={name: _find(models, name, _kind(name)) for name in MODEL_SIZES + MODEL_POINTERS},
        data={name: _find(datas, name, _kind(name)) for name in DATA_SCALARS + DATA_POINTERS},
    )


def check_layout(layout: Layout) -> None:
    """Read every field of a third model through `layout` and compare with what the bindings say.

    Raises:
        CallbackError: naming the first field that differs.
    """
    model, data = _probe(4, 9, 13, 5)
    data.time = 7.25
    for struct, offsets in ((model, layout.model), (data, layout.data)):
        for name, offset in offsets.items():
            kind = _kind(name)
            seen = kind.from_address(struct._address + offset).value if offset % 4 == 0 else None
            # An array is never empty here, so a following word that is equal shows that `offset` is that of an empty
            # one before it.
            aliased = kind is ctypes.c_uint64 and kind.from_address(struct._address + offset + 8).value == seen
            if aliased or seen != _expected(struct, name):
                raise CallbackError(
                    f"MuJoCo {mujoco.__version__}: {type(struct).__name__}.{name} is not at byte {offset}; install "
                    "mujoco 4.0"
                )


LAYOUT = find_layout()
check_layout(LAYOUT)
