"""The stepping loop, compiled: evaluate, record, integrate, without returning to Python in between."""

from __future__ import annotations

import ctypes
import functools
import glob
import os
from collections.abc import Sequence

import mujoco
import numpy as np
from llvmlite import binding
from numba import carray, njit, types  # pyright: ignore[reportPrivateImportUsage]

from ..elements.law import ACTUATOR_MARK, USERDATA_HEADER
from ..errors import CallbackError
from ..handling.block import signals_of
from .layout import LAYOUT
from .memory import doubles

_FUNCTIONS = ("mj_forward", "mj_RungeKutta")
DIVERGED = 1e9
"""Generalised acceleration [m/s² or rad/s²] beyond which a run counts as diverged."""


@functools.cache
def library() -> ctypes.CDLL:
    """MuJoCo's own shared library, already loaded by its bindings."""
    folder = os.path.dirname(mujoco.__file__)
    for pattern in ("libmujoco.so*", "libmujoco*.dylib", "mujoco.dll"):
        for path in glob.glob(os.path.join(folder, pattern)):
            return ctypes.CDLL(path)
    raise CallbackError(f"MuJoCo's library is not in {folder}; reinstall mujoco")


for _name in _FUNCTIONS:
    binding.add_symbol(f"susp_mj_{_name}", ctypes.cast(getattr(library(), _name), ctypes.c_void_p).value)

_mj_forward = types.ExternalFunction("susp_mj_mj_forward", types.void(types.uintp, types.uintp))
_mj_runge_kutta = types.ExternalFunction("susp_mj_mj_RungeKutta", types.void(types.uintp, types.uintp, types.intc))


@njit(cache=True, nogil=True)
def _run(model, data, steps, every, final, freedoms, acceleration, addresses, counts, out, limit):
    """Step and record; returns the rows written, or minus one minus them if an acceleration left the limit."""
    row = 0
    for step in range(steps + 1):
        if step == steps and not final:
            break
        _mj_forward(model, data)
        sound = True
        for freedom in range(freedoms):
            if not abs(doubles(acceleration)[freedom]) < limit:
                sound = False
        if step % every == 0 or not sound:
            column = 0
            for source in range(len(addresses)):
                count = counts[source]
                out[row, column : column + count] = carray(doubles(addresses[source]), count)
                column += count
            row += 1
        if not sound:
            return -1 - row
        if step < steps:
            _mj_runge_kutta(model, data, 4)
    return row


def advance(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    steps: int,
    every: int,
    fields: Sequence[str],
    out: np.ndarray,
    *,
    final: bool,
) -> tuple[int, bool]:
    """Take `steps` Runge-Kutta steps and record `fields` of the data before every `every`-th of them.

    What is recorded belongs to the recorded time exactly: forces and accelerations are evaluated there first.

    Args:
        fields: names of double arrays (or ``time``) of mjData, or ``signals``, what the compiled car writes.
        out: (rows, columns) array that takes the records.
        final: also record the state after the last step.

    Returns:
        Rows written, and whether the motion stayed finite; if not, the last row is where it left the limit.
    """
    addresses, counts = _sources(data, fields)
    rows = _run(
        model._address,
        data._address,
        steps,
        every,
        final,
        model.nv,
        np.uint64(data.qacc.__array_interface__["data"][0]),
        addresses,
        counts,
        out,
        DIVERGED,
    )
    return (rows, True) if rows >= 0 else (-1 - rows, False)


def _sources(data: mujoco.MjData, fields: Sequence[str]) -> tuple[np.ndarray, np.ndarray]:
    addresses, counts = [], []
    for name in fields:
        if name == "time":
            addresses.append(data._address + LAYOUT.data["time"])
            counts.append(1)
        else:
            values = signals_of(data.userdata) if name == "signals" else getattr(data, name)
            addresses.append(values.__array_interface__["data"][0])
            counts.append(values.size)
    return np.array(addresses, np.uint64), np.array(counts, np.int64)


def attach_input(
    data: mujoco.MjData, block: np.ndarray | None, road: np.ndarray | None = None, driver: np.ndarray | None = None
) -> None:
    """Let the control callback read inputs, road and driver; the caller keeps the blocks alive. None detaches."""
    data.userdata[:] = 0.0
    data.userdata[0] = 0.0 if block is None and road is None and driver is None else ACTUATOR_MARK
    addresses = data.userdata[1:USERDATA_HEADER].view(np.uint64)
    addresses[:] = [0 if each is None else each.ctypes.data for each in (block, road, driver)]


def input_block(samples: np.ndarray, spacing: float, entries: Sequence[tuple[int, int, float]]) -> np.ndarray:
    """Memory block from which the control callback reads the inputs.

    Args:
        samples: (number of samples, inputs, 2), value and rate of each input at multiples of `spacing`.
        spacing: time between samples [s], half an integration step.
        entries: (input, actuator, factor): the deflection of `actuator` gets `factor` times the input.
    """
    header = [float(samples.shape[0]), spacing, float(samples.shape[1]), float(len(entries))]
    return np.concatenate([header, np.array(entries, float).ravel(), np.asarray(samples, float).ravel()])
