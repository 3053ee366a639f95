"""MuJoCo's own stopwatch: its Python bindings install one, which costs a tenth of a step of a small model. Ours runs
without."""

from __future__ import annotations

import ctypes

import mujoco

from .loop import library

_slot = ctypes.c_void_p.in_dll(library(), "mjcb_time")
_bindings_clock = _slot.value


def stop_clock() -> None:
    """Let MuJoCo not time itself (`mjData.timer` stays 0), unless a program has set a clock of its own."""
    if mujoco.get_mjcb_time() is None and _slot.value == _bindings_clock:
        _slot.value = None


def start_clock() -> None:
    """Give MuJoCo the clock back that its bindings had installed."""
    if _slot.value is None:
        _slot.value = _bindings_clock
