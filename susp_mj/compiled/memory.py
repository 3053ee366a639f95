"""Raw memory for compiled code: an address as a pointer, a double as its bits."""

# ruff: noqa: ANN001, ANN202 - intrinsics are written in numba's own untyped protocol

from __future__ import annotations

from llvmlite import ir
from numba import types
from numba.extending import intrinsic


@intrinsic
def doubles(context, address):
    def cast(target, builder, signature, arguments):
        return builder.inttoptr(arguments[0], target.get_value_type(signature.return_type))

    return types.CPointer(types.float64)(types.uint64), cast


@intrinsic
def ints(context, address):
    def cast(target, builder, signature, arguments):
        return builder.inttoptr(arguments[0], target.get_value_type(signature.return_type))

    return types.CPointer(types.int32)(types.uint64), cast


@intrinsic
def bits(context, value):
    """The bits of a double as an integer."""

    def cast(target, builder, signature, arguments):
        return builder.bitcast(arguments[0], ir.IntType(64))

    return types.uint64(types.float64), cast
