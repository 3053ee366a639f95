"""A force law: the plain scalar function that runs in Python as it stands and, compiled, inside MuJoCo's callbacks."""

from __future__ import annotations

import zlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from types import FunctionType
from typing import Any

from ..errors import CallbackError

Parameters = Sequence[float]
ScalarLaw = Callable[[float, float, float, Parameters], float]

LAW_TABLE_SIZE = 4096
ACTUATOR_MARK = 20070612.0
"""First user parameter of every actuator that is ours; others are left alone."""
ACTUATOR_HEADER = 6
"""User parameters before the law's own: mark, number of the law, partner, own weight, partner's weight, factor.

The law sees ``own weight * own deflection + partner's weight * partner's deflection``; the partner is so many actuators
further on (0: none). The actuator's force is the factor times the law's. An anti-roll bar weighs 1 and -1.
"""
USERDATA_HEADER = 4
"""Doubles of mjData's `userdata` before the deflection speeds: the mark of a running input and the addresses of its
block, of the road's and of the driver's (0 where there is none)."""


@dataclass(frozen=True)
class Law:
    """Force law of one element between two points whose distance shortens by `deflection`.

    Attributes:
        name: unique name; the number that stands for the law in an MJCF file is derived from it.
        force: ``force(deflection [m], speed [m/s], state, parameters) -> N``, positive when it pushes the points apart.
        state_rate: derivative of the inner state with the same arguments, or None for a law without memory. The
            state at rest is the deflection itself (the series mount carries no force).

    Both functions see `parameters` as something that only `parameters[i]` works on, may use `math` and helper functions
    of their own module, and nothing else: that is what lets numba compile them unchanged.
    """

    name: str
    force: ScalarLaw
    state_rate: ScalarLaw | None = None

    @property
    def number(self) -> int:
        """Identity of the law in an MJCF file, 1..4095, derived from the name and thus the same on every machine."""
        return zlib.crc32(self.name.encode()) % (LAW_TABLE_SIZE - 1) + 1

    def functions(self) -> tuple[ScalarLaw, ...]:
        """The law's functions that need compiling."""
        return (self.force,) if self.state_rate is None else (self.force, self.state_rate)


def helpers(function: Callable[..., Any]) -> dict[str, FunctionType]:
    """Helper functions that a law calls, directly or through each other.

    Raises:
        CallbackError: a helper lives in another module; its changes would go unnoticed by the compiler's disk cache.
    """
    found: dict[str, FunctionType] = {}
    waiting: list[Any] = [function]
    while waiting:
        current = waiting.pop()
        if not isinstance(current, FunctionType):
            raise CallbackError(f"a law must be a plain function, not {type(current).__name__}")
        for name in current.__code__.co_names:
            used = current.__globals__.get(name)
            if not isinstance(used, FunctionType) or name in found:
                continue
            if used.__module__ != current.__module__:
                raise CallbackError(
                    f"law function {current.__module__}.{current.__name__} calls {used.__module__}.{name}; "
                    "a law may only call functions of its own module"
                )
            found[name] = used
            waiting.append(used)
    return found
