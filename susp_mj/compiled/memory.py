"""Raw memory for compiled code: an address as a pointer, a double as its bits."""

from __future__ import annotations

from typing import Any

import numpy as np
from llvmlite import ir
from numba import from_dtype, njit, types  # pyright: ignore[reportPrivateImportUsage]
from numba.extending import intrinsic as _intrinsic
from numba.extending import register_jitable

OPTIONS: dict[str, Any] = {"error_model": "numpy"}
"""Of all compiled code: a division by zero gives infinity, without a branch that looks for it. Sums and products stay
as they are written: joined, as `fastmath` lets them be, a run would depend in its last digits on what was inlined,
which differs between the process that compiles and those that load its code, and on the processor."""
plain: Any = njit(**OPTIONS)
"""Decorator of functions that compiled code calls."""
usable: Any = register_jitable(**OPTIONS)
"""Makes a plain function of another module, which stays as it is, callable by compiled code."""
intrinsic: Any = _intrinsic  # its decorated functions take one argument fewer than the type checker believes


@intrinsic
def doubles(context, address):
    """Pointer to the doubles at an address."""

    def cast(target, builder, signature, arguments):
        return builder.inttoptr(arguments[0], target.get_value_type(signature.return_type))

    return types.CPointer(types.float64)(types.uint64), cast


@intrinsic
def ints(context, address):
    """Pointer to the 32-bit integers at an address."""

    def cast(target, builder, signature, arguments):
        return builder.inttoptr(arguments[0], target.get_value_type(signature.return_type))

    return types.CPointer(types.int32)(types.uint64), cast


@intrinsic
def bits(context, value):
    """The bits of a double as an integer."""

    def cast(target, builder, signature, arguments):
        return builder.bitcast(arguments[0], ir.IntType(64))

    return types.uint64(types.float64), cast


def record(dtype: np.dtype[Any]) -> Any:
    """Intrinsic: the record of doubles at an address, its numbers read and written by name."""
    kind = from_dtype(dtype)

    @intrinsic
    def at(context, address):
        def cast(target, builder, signature, arguments):
            return builder.inttoptr(arguments[0], target.get_value_type(signature.return_type))

        return kind(types.uint64), cast

    return at
