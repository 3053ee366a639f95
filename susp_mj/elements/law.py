"""A law: the plain scalar function that runs in Python as it stands and, compiled, inside MuJoCo's callbacks."""

from __future__ import annotations

import math
import zlib
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from types import FunctionType
from typing import Any, Protocol

from ..errors import CallbackError, short, wrong_answer

Parameters = Sequence[float]

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
class Role:
    """What laws of one kind are asked and what they answer.

    Attributes:
        name: one word.
        asked: the arguments, numbers in this order; the law's parameters follow them.
        answers: what the law writes into its last argument ``out``, in this order; empty for a law that returns its
            one answer.
    """

    name: str
    asked: tuple[str, ...]
    answers: tuple[str, ...] = ()


FORCE = Role("force", ("deflection", "speed", "state"))
"""Of an element between two points whose distance shortens by `deflection` [m]: ``force(deflection, speed, state, p)``
[N], positive when it pushes the points apart."""


@dataclass(frozen=True)
class Law:
    """Law of one element.

    Attributes:
        name: unique name; the number that stands for the law in an MJCF file is derived from it.
        function: ``function(*asked, parameters)``, or ``function(*asked, parameters, out)``, as its role says.
        state_rate: of a force law with memory: derivative of its inner state with the same arguments. The state at
            rest is the deflection itself (the series mount carries no force).
        role: what the function is asked and answers.

    The functions see `parameters` and `out` as something that only ``[i]`` works on, may use `math` and helper
    functions of their own module, and nothing else: that is what lets numba compile them unchanged.
    """

    name: str
    function: Callable[..., Any]
    state_rate: Callable[..., float] | None = None
    role: Role = FORCE

    @property
    def number(self) -> int:
        """Identity of the law in an MJCF file, 1..4095, derived from the name and thus the same on every machine."""
        return zlib.crc32(self.name.encode()) % (LAW_TABLE_SIZE - 1) + 1

    def functions(self) -> tuple[Callable[..., Any], ...]:
        """The law's functions that need compiling."""
        return (self.function,) if self.state_rate is None else (self.function, self.state_rate)

    def answer(self, *asked: float, parameters: Parameters) -> tuple[float, ...]:
        """What the law answers, in Python."""
        if not self.role.answers:
            return (self.function(*asked, parameters),)
        out = [0.0] * len(self.role.answers)
        self.function(*asked, parameters, out)
        return tuple(out)


class HasParameters(Protocol):
    """What hands numbers to a law: an element, a driver."""

    def parameters(self) -> tuple[float, ...]: ...


def numbers_of(part: HasParameters) -> tuple[float, ...]:
    """The numbers that a part hands to its law.

    Raises:
        InputError: its `parameters` gives anything but finite numbers.
    """
    given: Any = part.parameters()
    try:
        numbers = tuple(float(each) for each in given)
    except (TypeError, ValueError):
        numbers = (math.nan,)
    if not all(map(math.isfinite, numbers)):
        raise wrong_answer(type(part).parameters, short(given), "a tuple of finite numbers")
    return numbers


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
