"""Compile laws to machine code, once, and keep their addresses in a table that the callbacks look into.

The table is reached through a linker symbol, so that code from the disk cache finds the table of this process.
"""

from __future__ import annotations

import functools
from collections.abc import Iterable
from typing import Any

import numpy as np
from llvmlite import binding, ir
from numba import cfunc, types
from numba.extending import register_jitable

from ..elements import LAWS
from ..elements.law import LAW_TABLE_SIZE, helpers
from ..elements.tyres.contact import CONTACT_LAWS
from ..errors import CallbackError
from .memory import OPTIONS, intrinsic

LAW_SIGNATURE = types.float64(types.float64, types.float64, types.float64, types.CPointer(types.float64))

CONTACT_SIGNATURE = types.void(*[types.float64] * 7, types.CPointer(types.float64), types.CPointer(types.float64))

FORCE_TABLE = np.zeros(LAW_TABLE_SIZE, np.uint64)
STATE_TABLE = np.zeros(LAW_TABLE_SIZE, np.uint64)
CONTACT_TABLE = np.zeros(LAW_TABLE_SIZE, np.uint64)
binding.add_symbol("susp_mj_force_table", FORCE_TABLE.ctypes.data)
binding.add_symbol("susp_mj_state_table", STATE_TABLE.ctypes.data)
binding.add_symbol("susp_mj_contact_table", CONTACT_TABLE.ctypes.data)


def _address_in(builder: Any, symbol: str, number: Any) -> Any:
    """Code that reads one entry of a table of addresses."""
    word = ir.IntType(64)
    table = builder.module.globals.get(symbol)
    if table is None:
        table = ir.GlobalVariable(builder.module, ir.ArrayType(word, LAW_TABLE_SIZE), symbol)
        table.linkage = "external"
    return builder.load(builder.gep(table, [ir.Constant(word, 0), number]))


def law_call(symbol: str) -> Any:
    """Intrinsic ``call(number, x, v, y, parameters)`` through a table of addresses; 0 where the table is empty."""

    @intrinsic
    def call(context, number, x, v, y, parameters):
        signature = types.float64(
            types.intp, types.float64, types.float64, types.float64, types.CPointer(types.float64)
        )

        def generate(target, builder, signature, arguments):
            word, double = ir.IntType(64), ir.DoubleType()
            address = _address_in(builder, symbol, arguments[0])
            result = builder.alloca(double)
            builder.store(ir.Constant(double, 0.0), result)
            with builder.if_then(builder.icmp_unsigned("!=", address, ir.Constant(word, 0))):
                kind = ir.FunctionType(double, [double, double, double, double.as_pointer()])
                law = builder.inttoptr(address, kind.as_pointer())
                builder.store(builder.call(law, arguments[1:]), result)
            return builder.load(result)

        return signature, generate

    return call


@intrinsic
def contact_call(context, number, kappa, tan_alpha, camber, load, rolling, lateral, friction, parameters, out):
    """Call a contact law by its number; does nothing where the table is empty."""
    pointer = types.CPointer(types.float64)
    signature = types.void(types.intp, *[types.float64] * 7, pointer, pointer)

    def generate(target, builder, signature, arguments):
        double = ir.DoubleType()
        address = _address_in(builder, "susp_mj_contact_table", arguments[0])
        with builder.if_then(builder.icmp_unsigned("!=", address, ir.Constant(ir.IntType(64), 0))):
            kind = ir.FunctionType(ir.VoidType(), [*[double] * 7, double.as_pointer(), double.as_pointer()])
            builder.call(builder.inttoptr(address, kind.as_pointer()), arguments[1:])
        return target.get_dummy_value()

    return signature, generate


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
                STATE_TABLE[number] = _compiled(law.name, law.state_rate, LAW_SIGNATURE).address
            FORCE_TABLE[number] = _compiled(law.name, law.force, LAW_SIGNATURE).address


def compile_contacts(numbers: Iterable[int]) -> None:
    """Compile the contact laws with these numbers, unless they are in the table already.

    Raises:
        CallbackError: no contact law has that number, or numba cannot compile one.
    """
    for number in numbers:
        if number not in CONTACT_LAWS:
            raise CallbackError(f"the model uses contact law {number}, which is not known; register its tyre first")
        if CONTACT_TABLE[number] == 0:
            law = CONTACT_LAWS[number]
            CONTACT_TABLE[number] = _compiled(law.name, law.contact, CONTACT_SIGNATURE).address


@functools.cache
def _compiled(name: str, function: Any, signature: Any) -> Any:
    """The compiled function; the cache keeps it alive as long as its address is in use.

    Only the package's own laws are kept on disk: code there is bound to the module's name, and a user's file has
    another name as a script than imported.
    """
    for helper in helpers(function).values():
        register_jitable(**OPTIONS)(helper)
    try:
        compiled = cfunc(signature, **OPTIONS, cache=function.__module__.startswith("susp_mj."))(function)
    except Exception as error:
        reason = str(error).strip().splitlines()[0]
        raise CallbackError(f"law '{name}' does not compile ({reason}); use math and plain arithmetic only") from error
    return compiled
