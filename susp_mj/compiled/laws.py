"""Compile laws to machine code, once, and keep their addresses in tables that the callbacks look into.

A table for each role is reached through a linker symbol, so that code from the disk cache finds the tables of this
process, and a law is never called in another role than its own.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
from llvmlite import binding, ir
from numba import cfunc, types
from numba.core import cgutils

from ..elements import AIR, BRAKE, CONTACT, DRIVER, FORCE, LAWS, Role
from ..elements.law import LAW_TABLE_SIZE, helpers
from ..errors import CallbackError, place_of
from .memory import OPTIONS, intrinsic, usable

STATE_RATE = "state_rate"
"""Table of the second functions of force laws with memory."""
TABLES = {
    name: np.zeros(LAW_TABLE_SIZE, np.uint64)
    for name in (FORCE.name, STATE_RATE, CONTACT.name, BRAKE.name, AIR.name, DRIVER.name)
}
for _name, _table in TABLES.items():
    binding.add_symbol(f"susp_mj_{_name}_table", _table.ctypes.data)

_PARAMETERS = types.CPointer(types.float64)


def compiled_signature(role: Role) -> Any:
    """Signature of a law's compiled function: the law returns its one answer, or writes them."""
    asked = [types.float64] * len(role.asked)
    if not role.answers:
        return types.float64(*asked, _PARAMETERS)
    return types.void(*asked, _PARAMETERS, _PARAMETERS)


def _address_in(builder: Any, table: str, number: Any) -> Any:
    """Code that reads one entry of a table of addresses."""
    word, symbol = ir.IntType(64), f"susp_mj_{table}_table"
    found = builder.module.globals.get(symbol)
    if found is None:
        found = ir.GlobalVariable(builder.module, ir.ArrayType(word, LAW_TABLE_SIZE), symbol)
        found.linkage = "external"
    return builder.load(builder.gep(found, [ir.Constant(word, 0), number]))


def _call(role: Role, table: str | None = None) -> tuple[Any, Callable[..., Any]]:
    """Typing and code of a call ``law(number, *asked, parameters)``: its answer, or a tuple of them; 0 where the table
    is empty."""
    count = len(role.answers)
    result = types.UniTuple(types.float64, count) if count else types.float64
    signature = result(types.intp, *[types.float64] * len(role.asked), _PARAMETERS)

    def generate(target, builder, signature, arguments):
        double, pointer = ir.DoubleType(), ir.DoubleType().as_pointer()
        answers = cgutils.alloca_once(builder, double, size=max(count, 1))
        for i in range(max(count, 1)):
            builder.store(ir.Constant(double, 0.0), builder.gep(answers, [ir.Constant(ir.IntType(32), i)]))
        address = _address_in(builder, table or role.name, arguments[0])
        with builder.if_then(builder.icmp_unsigned("!=", address, ir.Constant(ir.IntType(64), 0))):
            asked = [double] * len(role.asked)
            if count:
                law = builder.inttoptr(address, ir.FunctionType(ir.VoidType(), [*asked, pointer, pointer]).as_pointer())
                builder.call(law, [*arguments[1:], answers])
            else:
                law = builder.inttoptr(address, ir.FunctionType(double, [*asked, pointer]).as_pointer())
                builder.store(builder.call(law, arguments[1:]), answers)
        if not count:
            return builder.load(answers)
        values = [builder.load(builder.gep(answers, [ir.Constant(ir.IntType(32), i)])) for i in range(count)]
        return target.make_tuple(builder, signature.return_type, values)

    return signature, generate


@intrinsic
def force_of(context, number, deflection, speed, state, parameters):
    """Force of an element."""
    return _call(FORCE)


@intrinsic
def state_rate_of(context, number, deflection, speed, state, parameters):
    """Rate of an element's inner state."""
    return _call(FORCE, STATE_RATE)


@intrinsic
def contact_of(context, number, kappa, tan_alpha, camber, load, rolling, lateral, friction, parameters):
    """Forces, moments, relaxation lengths and rolling radius of a tyre."""
    return _call(CONTACT)


@intrinsic
def brake_of(context, number, pedal, bristle, spin, front, parameters):
    """Torque of a brake and the rate of its inner state."""
    return _call(BRAKE)


@intrinsic
def air_of(context, number, along, across, wheelbase, parameters):
    """Force and moment of the air."""
    return _call(AIR)


@intrinsic
def driver_of(context, number, x, y, heading, speed, angle, ratio, wheelbase, limit, parameters):
    """Rate of the driver's steering wheel, and the car's deviation from his path."""
    return _call(DRIVER)


def compile_laws(used: Iterable[tuple[int, Role]] | None = None) -> None:
    """Compile laws, unless they are in the tables already.

    Args:
        used: numbers and the roles in which they are called; None compiles every registered law.

    Raises:
        CallbackError: no law of that role has that number, or numba cannot compile one.
    """
    for number, role in [(number, law.role) for number, law in LAWS.items()] if used is None else used:
        law = LAWS.get(number)
        if law is None:
            raise CallbackError(
                f"the model uses {role.name} law {number}, which is not known; register its element first"
            )
        if law.role != role:
            raise CallbackError(f"the model uses law '{law.name}' as a {role.name} law; it is a {law.role.name} law")
        if TABLES[role.name][number] == 0:
            signature = compiled_signature(role)
            if law.state_rate is not None:
                TABLES[STATE_RATE][number] = _compiled(law.name, law.state_rate, signature).address
            TABLES[role.name][number] = _compiled(law.name, law.function, signature).address


@functools.cache
def _compiled(name: str, function: Any, signature: Any) -> Any:
    """The compiled function; the cache keeps it alive as long as its address is in use.

    Only the package's own laws are kept on disk: code there is bound to the module's name, and a user's file has
    another name as a script than imported.
    """
    for helper in helpers(function).values():
        usable(helper)
    try:
        compiled = cfunc(signature, **OPTIONS, cache=function.__module__.startswith("susp_mj."))(function)
    except Exception as error:
        lines = [line for line in str(error).splitlines() if line.strip() and not line.startswith("Failed in")]
        text = f"law '{name}' does not compile ({lines[0].strip()}); use math and plain arithmetic only"
        raise CallbackError(f"{place_of(function)}: {text}") from error
    return compiled
