"""Compile laws to machine code, once, and keep their addresses in a table that the callbacks look into.

The table is reached through a linker symbol, so that code from the disk cache finds the table of this process.
"""

from __future__ import annotations

import functools
from collections.abc import Iterable
from typing import Any

import numpy as np
from llvmlite import binding
from numba import cfunc, types
from numba.extending import register_jitable

from ..elements import LAWS
from ..elements.law import LAW_TABLE_SIZE, Law, ScalarLaw, helpers
from ..errors import CallbackError

LAW_SIGNATURE = types.float64(types.float64, types.float64, types.float64, types.CPointer(types.float64))

FORCE_TABLE = np.zeros(LAW_TABLE_SIZE, np.uint64)
STATE_TABLE = np.zeros(LAW_TABLE_SIZE, np.uint64)
binding.add_symbol("susp_mj_force_table", FORCE_TABLE.ctypes.data)
binding.add_symbol("susp_mj_state_table", STATE_TABLE.ctypes.data)


def compile_laws(numbers: Iterable[int]) -> None:
    """Compile the laws with these numbers, unless they are in the tables already.

    Raises:
        CallbackError: no law has that number, or numba cannot compile one.
    """
    for number in numbers:
        if number not in LAWS:
            raise CallbackError(f"the model uses force law {number}, which is not known; register its element first")
        if FORCE_TABLE[number] == 0:
            law = LAWS[number]
            if law.state_rate is not None:
                STATE_TABLE[number] = _compiled(law, law.state_rate).address
            FORCE_TABLE[number] = _compiled(law, law.force).address


@functools.cache
def _compiled(law: Law, function: ScalarLaw) -> Any:
    """The compiled function; the cache keeps it alive as long as its address is in use.

    Only the package's own laws are kept on disk: code there is bound to the module's name, and a user's file has another
    name as a script than imported.
    """
    for helper in helpers(function).values():
        register_jitable(helper)
    try:
        compiled = cfunc(LAW_SIGNATURE, cache=function.__module__.startswith("susp_mj."))(function)
    except Exception as error:
        reason = str(error).strip().splitlines()[0]
        raise CallbackError(f"law '{law.name}' does not compile ({reason}); use math and plain arithmetic only") from error
    return compiled
