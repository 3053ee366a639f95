"""The callbacks: every element's force and state at every integration stage, and the inputs before them.

An actuator is ours if its first user parameter is `ACTUATOR_MARK`; the number of its law and its partner come next,
then the law's own parameters. Deflection and speed are the transmission's length and velocity plus the input's share
(`ctrl` and `userdata`). A model of a car that drives freely is recognised by its custom numeric; what is beyond its
elements is in `car`.
"""

from __future__ import annotations

import ctypes
import threading
from collections.abc import Iterable
from typing import Any

import mujoco
from numba import carray, cfunc, from_dtype, types  # pyright: ignore[reportPrivateImportUsage]

from ..elements.law import ACTUATOR_HEADER, ACTUATOR_MARK, LAW_TABLE_SIZE, USERDATA_HEADER, Role
from ..errors import CallbackError
from .clock import start_clock, stop_clock
from .handling.car import car_forces, car_state_rates, is_car
from .laws import compile_laws, force_of, state_rate_of
from .layout import LAYOUT
from .memory import OPTIONS, bits, doubles, ints, plain
from .sources import SOURCES

MODEL = types.CPointer(from_dtype(LAYOUT.record("model")))
DATA = types.CPointer(from_dtype(LAYOUT.record("data")))


@plain
def _length(model, data, actuator):
    """Length and rate of an actuator's form, the input's share in it; `userdata` may be too short in a file edited by
    hand."""
    v = doubles(data.actuator_velocity)[actuator]
    if USERDATA_HEADER + actuator < model.nuserdata:
        v += doubles(data.userdata)[USERDATA_HEADER + actuator]
    return doubles(data.actuator_length)[actuator] + doubles(data.ctrl)[actuator], v


@plain
def _deflection(model, data, actuator, own):
    """Deflection and speed that an element sees: its own form's and its partner's, weighted."""
    x, v = _length(model, data, actuator)
    partner = actuator + int(own[2])
    if partner != actuator:
        other_x, other_v = _length(model, data, partner)
        x, v = own[3] * x + own[4] * other_x, own[3] * v + own[4] * other_v
    return x, v


@plain
def _element_force(model, data, actuator):
    stride = model.nuser_actuator
    if stride < ACTUATOR_HEADER:
        return 0.0
    user = model.actuator_user + types.uint64(8 * stride * actuator)
    own = doubles(user)
    if own[0] != ACTUATOR_MARK or not 0.0 < own[1] < LAW_TABLE_SIZE:
        return 0.0
    state_address = ints(model.actuator_actadr)[actuator]
    state = doubles(data.act)[state_address] if state_address >= 0 else 0.0
    x, v = _deflection(model, data, actuator, own)
    return -own[5] * force_of(int(own[1]), x, v, state, doubles(user + types.uint64(8 * ACTUATOR_HEADER)))


@plain
def _element_state_rate(model, data, actuator, state_address):
    user = model.actuator_user + types.uint64(8 * model.nuser_actuator * actuator)
    own = doubles(user)
    if own[0] != ACTUATOR_MARK or not 0.0 < own[1] < LAW_TABLE_SIZE:
        return 0.0
    x, v = _deflection(model, data, actuator, own)
    return state_rate_of(
        int(own[1]), x, v, doubles(data.act)[state_address], doubles(user + types.uint64(8 * ACTUATOR_HEADER))
    )


@plain
def _inputs(model, data, userdata):
    """Write the inputs' values to `ctrl` and their rates to `userdata`, at the time of this stage.

    The block (see `loop.input_block`) holds samples at half steps, which is where a Runge-Kutta stage asks.
    """
    block_address = bits(userdata[1])
    block = doubles(block_address)
    samples, spacing, inputs, entries = int(block[0]), block[1], int(block[2]), int(block[3])
    place = min(max(data.time / spacing, 0.0), samples - 1.0)
    index = min(int(place + 0.5), samples - 1)
    offset = place - index
    neighbour = index
    if abs(offset) < 1e-6:
        offset = 0.0
    else:
        neighbour = min(max(index + (1 if offset > 0.0 else -1), 0), samples - 1)
        offset = abs(offset)
    table = 4 + 3 * entries
    here, there = table + 2 * inputs * index, table + 2 * inputs * neighbour
    ctrl = doubles(data.ctrl)
    for entry in range(entries):
        actuator = int(block[5 + 3 * entry])
        ctrl[actuator] = 0.0
        if USERDATA_HEADER + actuator < model.nuserdata:
            userdata[USERDATA_HEADER + actuator] = 0.0
    for entry in range(entries):
        column, actuator, factor = 2 * int(block[4 + 3 * entry]), int(block[5 + 3 * entry]), block[6 + 3 * entry]
        value = block[here + column] + offset * (block[there + column] - block[here + column])
        rate = block[here + column + 1] + offset * (block[there + column + 1] - block[here + column + 1])
        ctrl[actuator] += factor * value
        if USERDATA_HEADER + actuator < model.nuserdata:
            userdata[USERDATA_HEADER + actuator] += factor * rate


def _callbacks(sources: int) -> tuple[Any, Any, Any]:
    """Force, state rate and control; `sources` is part of them, so that the disk cache never gives outdated code of
    another file."""

    def force(model_pointer, data_pointer, actuator):
        if sources == 0:
            return 0.0
        return _element_force(carray(model_pointer, 1)[0], carray(data_pointer, 1)[0], actuator)

    def state_rate(model_pointer, data_pointer, actuator):
        model, data = carray(model_pointer, 1)[0], carray(data_pointer, 1)[0]
        state_address = ints(model.actuator_actadr)[actuator]
        if model.nuser_actuator < ACTUATOR_HEADER or state_address < 0 or sources == 0:
            return 0.0
        first = doubles(model.actuator_user + types.uint64(8 * model.nuser_actuator * actuator))[0]
        if is_car(model) and first != ACTUATOR_MARK:
            return car_state_rates(model, data, actuator)
        return _element_state_rate(model, data, actuator, state_address)

    def control(model_pointer, data_pointer):
        model, data = carray(model_pointer, 1)[0], carray(data_pointer, 1)[0]
        if model.nuserdata < USERDATA_HEADER or sources == 0:
            return
        userdata = doubles(data.userdata)
        running = userdata[0] == ACTUATOR_MARK
        if running and bits(userdata[1]) != types.uint64(0):
            _inputs(model, data, userdata)
        if is_car(model):
            nothing = types.uint64(0)
            road, driver = (bits(userdata[2]), bits(userdata[3])) if running else (nothing, nothing)
            car_forces(model, data, road, driver)

    of_actuator = types.float64(MODEL, DATA, types.intc)
    signatures = ((force, of_actuator), (state_rate, of_actuator), (control, types.void(MODEL, DATA)))
    compiled = [cfunc(signature, cache=True, **OPTIONS)(function) for function, signature in signatures]
    return compiled[0], compiled[1], compiled[2]


_force, _state_rate, _control = _callbacks(SOURCES)

_SLOTS = {
    "act_bias": (mujoco.get_mjcb_act_bias, mujoco.set_mjcb_act_bias, _force),
    "act_dyn": (mujoco.get_mjcb_act_dyn, mujoco.set_mjcb_act_dyn, _state_rate),
    "control": (mujoco.get_mjcb_control, mujoco.set_mjcb_control, _control),
}


_installing = threading.Lock()


def install(laws: Iterable[tuple[int, Role]] | None = None) -> None:
    """Put the compiled callbacks into MuJoCo; calling it again changes nothing.

    MuJoCo has one set of callbacks per process. Models that are not ours pass through them unchanged. MuJoCo's own
    timing stops, see `clock`.

    Args:
        laws: numbers and roles of the laws that will be used; None compiles every registered one.

    Raises:
        CallbackError: another program has installed a callback of its own.
    """
    with _installing:
        compile_laws(laws)
        for name, (get, put, compiled) in _SLOTS.items():
            present = get()
            if present is not None and not _is_ours(present, compiled):
                raise CallbackError(f"mjcb_{name} is taken by another program; call mujoco.set_mjcb_{name}(None) first")
            if present is None:
                put(compiled.ctypes)
        stop_clock()


def uninstall() -> None:
    """Take our callbacks out of MuJoCo and start its clock again; foreign callbacks stay."""
    for get, put, compiled in _SLOTS.values():
        if _is_ours(get(), compiled):
            put(None)
    start_clock()


def installed() -> bool:
    """Whether all of our callbacks are in place."""
    return all(_is_ours(get(), compiled) for get, _, compiled in _SLOTS.values())


def _is_ours(present: Any, compiled: Any) -> bool:
    if present is None:
        return False
    try:
        return ctypes.cast(present, ctypes.c_void_p).value == compiled.address
    except (ctypes.ArgumentError, TypeError):
        return False
